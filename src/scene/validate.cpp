#include "forming_sim/scene/validate.h"

#include <algorithm>

#include "forming_sim/scene/yaml.h"
#include "geometry.h"
#include "rules.h"

namespace forming_sim {

std::vector<Fault> check_declarations(const Scene& scene) {
  std::vector<Fault> faults;
  FaultList list(faults);
  check_config(scene, "", list);
  return faults;
}

std::vector<Fault> check_scene(const Scene& scene) {
  std::vector<Fault> faults = check_declarations(scene), between;
  FaultList list(between);
  check_names(scene, list);
  check_section(scene, list);
  check_axisymmetric(scene, list);
  check_bodies(scene, list);
  check_tools(scene, list);
  check_contact(scene, list);
  check_time_step(scene, list);
  check_stages(scene, list);
  check_output(scene, list);
  merge_faults(faults, between);
  return faults;
}

CheckedModel validated_model(const Scene& scene, std::vector<Fault> known) {
  // A text that is no scene at all has nothing else to be told about.
  if (std::any_of(known.begin(), known.end(), [](const Fault& fault) { return fault.field == "scene"; })) return {std::move(known), {}};
  merge_faults(known, check_scene(scene));
  Geometry geometry = make_geometry(scene, known);
  merge_faults(known, geometry.faults);
  return {std::move(known), std::move(geometry.model)};
}

std::vector<Fault> validate(const Scene& scene, std::vector<Fault> known) { return validated_model(scene, std::move(known)).faults; }

Scene read_valid_scene(const std::string& path) {
  std::vector<Fault> faults;
  Scene scene = read_scene_file(path, faults);
  faults = validate(scene, faults);
  if (!faults.empty()) throw SceneError(faults);
  return scene;
}

}  // namespace forming_sim
