#pragma once
// A part from formed.h5, put where a scene has it.
#include <string>
#include <vector>

#include "forming_sim/element/formed.h"
#include "forming_sim/scene/scene.h"

namespace forming_sim {

struct FormedBody {
  Mesh mesh;            ///< where it stands
  FormedMemory memory;
};

/// The part that `body.formed` names, turned and shifted; faults: of `path`, the body's, where something of it does not go with the scene; the result is of no use then.
/// notes: that it was still held. Throws Error(mesh_error): no such file, damaged.
FormedBody load_formed_body(const Scene& scene, const BodyConfig& body, const std::string& path, std::vector<Fault>& faults, std::vector<std::string>& notes);

}  // namespace forming_sim
