#pragma once
// Scenes as YAML. The keys are the declared fields, nothing else.
#include <string>
#include <vector>

#include "forming_sim/scene/scene.h"

namespace forming_sim {

/// Reads a scene and adds to `faults` everything that can be told without opening
/// another file: YAML syntax (with its line), keys that do not exist or come
/// twice, wrong types, numbers that are not finite or out of range, unknown words,
/// what is missing, what does not apply, and all of check_scene (scene/validate.h).
/// `given` names the line. The scene is complete only where no fault was added;
/// its base_directory and text are set.
Scene read_scene(const std::string& yaml_text, const std::string& base_directory, std::vector<Fault>& faults);

/// Reads a file; relative file names in the scene refer to its directory.
/// Throws SceneError with all faults that read_scene finds, Error(output_error)
/// when the file cannot be read. It opens no mesh.
Scene read_scene_file(const std::string& path);

/// The same, with the faults added to a list.
Scene read_scene_file(const std::string& path, std::vector<Fault>& faults);

/// YAML that reads back to the same scene, without what equals the default.
std::string write_scene(const Scene& scene);

/// Likewise one material.
std::string write_material(const MaterialConfig& material);

/// "in contact: 'mu: 0.1' in the checkpoint, 'mu: 0.2' in the scene", of two such texts; their lines are not those that users wrote, so that their numbers say nothing.
std::string first_difference(const std::string& one, const std::string& other, const std::string& of_one, const std::string& of_other);

/// Appends those of `more` that tell something new: not those of a field whose
/// own fault, or whose parent's, is known already.
void merge_faults(std::vector<Fault>& known, const std::vector<Fault>& more);

}  // namespace forming_sim
