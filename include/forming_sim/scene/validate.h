#pragma once
// All that can be known to be wrong with a scene before it runs.
#include <vector>

#include "forming_sim/scene/scene.h"
#include "forming_sim/simulation/model.h"

namespace forming_sim {

/// The declared rules (ranges, required, choices, what applies) over a scene that
/// came from a message or from code: what equals the default counts as not given.
std::vector<Fault> check_declarations(const Scene& scene);

/// check_declarations, and what the fields say of each other, without opening a file.
std::vector<Fault> check_scene(const Scene& scene);

/// check_scene, then everything that needs the meshes: files, sets, inverted
/// cells, sizes that betray a wrong unit_scale. Bodies and tools whose own fields
/// are at fault are not meshed. `known`: faults found while reading the scene
/// (scene/yaml.h); they come first and are not told twice.
/// Contact at the start is not looked at here but where the simulation is built.
std::vector<Fault> validate(const Scene& scene, std::vector<Fault> known = {});

/// The same, and of a scene without faults its model (as build_model), meshed once.
struct CheckedModel {
  std::vector<Fault> faults;
  Model model;  ///< complete only without faults
};
CheckedModel validated_model(const Scene& scene, std::vector<Fault> known = {});

/// Reads a scene file and validates it.
/// Throws SceneError with all faults, Error(output_error) when it cannot be read.
Scene read_valid_scene(const std::string& path);

}  // namespace forming_sim
