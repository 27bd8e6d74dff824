#pragma once
// Scenes as messages, by the declarations of the Configs: a message has the same
// field names, so no Config has code of its own here.
#include <vector>

#include "forming_sim/SceneFault.h"
#include "forming_sim/SceneSpec.h"
#include "forming_sim/config/fault.h"
#include "forming_sim/scene/scene.h"

namespace forming_sim {

/// The message of a scene. Every value is written out, defaults too; a group
/// that is absent is an empty message.
/// Throws SceneError for a group that is present but has nothing in it: in a
/// message it could not be told from an absent one.
SceneSpec scene_message(const Scene& scene);

/// The scene of a message: 0, "" and [] give the default, an empty group is
/// absent. `shape` of a mesh becomes points, cells and cell_type. Adds a fault
/// where a mesh has both, and where a mesh URL is relative: a message has no
/// directory that it could refer to.
Scene scene_from(const SceneSpec& message, std::vector<Fault>& faults);

std::vector<SceneFault> fault_messages(const std::vector<Fault>& faults);

/// Turns URLs that are relative to scene.base_directory into absolute file://
/// URLs, so that a server can be asked from anywhere on this machine.
void make_urls_absolute(Scene& scene);

}  // namespace forming_sim
