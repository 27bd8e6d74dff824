#include "formed_body.h"

#include <algorithm>

#include "forming_sim/config/words.h"
#include "forming_sim/files/formed_file.h"
#include "forming_sim/loads/course.h"
#include "forming_sim/loads/rotation.h"
#include "forming_sim/mesh/url.h"
#include "forming_sim/scene/yaml.h"
#include "forming_sim/simulation/release.h"
#include "rules.h"

namespace forming_sim {

namespace {

/// Its number in the file; a fault where there is none of that name.
std::size_t find_part(const std::vector<std::string>& names, const BodyConfig& body, const std::string& path, FaultList& faults) {
  const std::string& wanted = body.formed->body.empty() ? body.name : body.formed->body;
  const auto found = std::find(names.begin(), names.end(), wanted);
  if (found == names.end() && body.formed->body.empty() && names.size() == 1) return 0;
  if (found == names.end()) faults.add(path + ".formed.body", given_text(wanted), "the file has " + one_of(names, " and ") + did_you_mean(wanted, names));
  return static_cast<std::size_t>(found - names.begin());
}

void check_kind(const Scene& scene, const BodyConfig& body, const FormedPart& part, const std::string& path, FaultList& faults) {
  if (part.axisymmetric != scene.axisymmetric && part.mesh.dimension == scene.dimension)
    faults.add("axisymmetric", scene.axisymmetric ? "true" : "false", std::string("part ") + part.name + " was formed in a scene with axisymmetric: " + (part.axisymmetric ? "true" : "false"));
  if (const std::string material = write_material(body.material); material != part.material)
    faults.add(path + ".material", first_difference(part.material, material, "when the part was formed", "now"), "give the material that the part was formed of: what it remembers is of that");
  if (body.pressure_average != part.pressure_average)
    faults.add(path + ".pressure_average", given_text(body.pressure_average), "give " + part.pressure_average + ", with which the part was formed");
}

}  // namespace

FormedBody load_formed_body(const Scene& scene, const BodyConfig& body, const std::string& path, std::vector<Fault>& faults, std::vector<std::string>& notes) {
  const FormedConfig& formed = *body.formed;
  FaultList list(faults);
  const std::size_t before = faults.size();
  const std::string file = resolve_url(formed.url, scene.base_directory);
  const std::vector<std::string> names = formed_names(file);
  const std::size_t which = find_part(names, body, path, list);
  if (which == names.size()) return {};
  FormedPart part = load_formed(file, which);
  check_kind(scene, body, part, path, list);
  if (faults.size() > before) return {};
  const Mat3 rotation = rotation_matrix(kRadiansPerDegree * formed.turn_deg);
  for (Vec3& x : part.mesh.nodes) x = rotation * (x - formed.turn_centre) + formed.turn_centre + formed.shift;
  turn(part.memory, body.material.law, part.mesh.dimension, rotation);
  const std::vector<StageConfig> stages = named(scene.stages);
  const auto goes_on = [&](const std::string& by) {
    const auto is_it = [&](const auto& load) { return by == name_of(load) && first_stage(load.since, stages) == 0 && acts(load, 0); };
    return std::any_of(body.pressures.begin(), body.pressures.end(), is_it) || std::any_of(body.loads.begin(), body.loads.end(), is_it);
  };
  part.pressed_by.erase(std::remove_if(part.pressed_by.begin(), part.pressed_by.end(), goes_on), part.pressed_by.end());
  if (!part.pressed_by.empty())
    notes.push_back("body " + body.name + " was still pressed by " + one_of(part.pressed_by, " and ") + " when its run ended: what they bore is let go at once here. Let it go and settle there, with a withdraw and a settle stage, and with pressures and loads that end with 0");
  std::vector<std::string> let_go;
  for (const std::string& set : part.held_sets)
    if (std::none_of(body.boundaries.begin(), body.boundaries.end(), [&](const BoundaryConfig& b) { return b.set == set && holds_in(0, b, stages); })) let_go.push_back(set);
  if (!let_go.empty())
    notes.push_back("body " + body.name + " was held at " + one_of(let_go, " and ") + " when its run ended, and is not here: what boundaries bore there is let go at once. Hold it here too, with until if it is to let go slowly, or end those boundaries there and let it settle");
  return {std::move(part.mesh), std::move(part.memory)};
}

}  // namespace forming_sim
