#include "forming_sim/loads/pressure.h"

#include "forming_sim/config/fault.h"

namespace forming_sim {

ResolvedPressure resolve(const PressureConfig& config, const std::string& body, const Mesh& mesh,
                         int first_node) {
  const std::string where = "pressure on body \"" + body + "\": set: given \"" + config.set + "\"";
  const auto set = mesh.sets.find(config.set);
  if (set == mesh.sets.end())
    throw Error(Code::invalid_scene, where + ", which the body does not have; name one of its sets");
  ResolvedPressure resolved;
  try {
    resolved.profile = ScalarProfile(config.times, config.values, config.profile);
  } catch (const Error& error) {
    throw Error(error.code(), where + ": " + error.what());
  }
  for (Face face : faces_within(mesh, set->second)) {
    for (int k = 0; k < face.corners; ++k) face.nodes[k] += first_node;
    resolved.faces.push_back(face);
  }
  if (resolved.faces.empty())
    throw Error(
        Code::invalid_scene,
        where + ", which holds all nodes of no surface face; a pressure needs whole faces of the surface");
  return resolved;
}

PressureSet::PressureSet(std::vector<ResolvedPressure> pressures, bool axisymmetric)
    : pressures_(std::move(pressures)), axisymmetric_(axisymmetric) {}

void PressureSet::add(double t, const NodeField& x, NodeField& f) const {
  for (const ResolvedPressure& pressure : pressures_) {
    if (!pressure.clock.runs()) continue;
    const double p = pressure.profile.at(pressure.clock.at(t));
    if (p == 0) continue;
    for (const Face& face : pressure.faces)
      for (int k = 0; k < face.corners; ++k) f[face.nodes[k]] -= node(p * area_share(face, k, x, axisymmetric_));
  }
}

}  // namespace forming_sim
