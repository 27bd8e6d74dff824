#include "forming_sim/loads/dead_load.h"

#include <map>

#include "forming_sim/config/fault.h"
#include "forming_sim/loads/profile.h"
#include "forming_sim/mesh/faces.h"

namespace forming_sim {
namespace {

/// Area at the start of every node that a face of the set has.
std::map<int, double> areas_of(const Mesh& mesh, const std::vector<int>& set, bool axisymmetric) {
  NodeField X;
  for (const Vec3& at : mesh.nodes) X.push_back(node(at));
  std::map<int, double> area;
  for (const Face& face : faces_within(mesh, set))
    for (int k = 0; k < face.corners; ++k) area[face.nodes[k]] += area_share(face, k, X, axisymmetric).norm();
  return area;
}

}  // namespace

ResolvedLoad resolve(const LoadConfig& config, const std::string& body, const Mesh& mesh, int first_node, bool axisymmetric) {
  const bool traction = config.kind == "traction";
  const std::string where = config.kind + " on body \"" + body + "\": set: given \"" + config.set + "\"";
  const auto set = mesh.sets.find(config.set);
  if (set == mesh.sets.end()) throw Error(Code::invalid_scene, where + ", which the body does not have; name one of its sets");
  ResolvedLoad resolved;
  try {
    resolved.value = load_curve(config.times, traction ? config.tractions : config.forces, config.profile);
  } catch (const Error& error) {
    throw Error(error.code(), where + ": " + error.what());
  }
  std::map<int, double> shares = areas_of(mesh, set->second, axisymmetric);
  if (shares.empty() && traction)
    throw Error(Code::invalid_scene, where + ", which holds all nodes of no surface face; a traction needs whole faces of the surface");
  if (shares.empty())
    for (int n : set->second) shares[n] = 1;
  if (shares.empty()) throw Error(Code::invalid_scene, where + ", which holds no node; a force needs one at least");
  double whole = 0;
  for (const auto& [n, share] : shares) whole += share;
  for (const auto& [n, share] : shares) {
    resolved.nodes.push_back(first_node + n);
    resolved.share.push_back(traction ? share : share / whole);
  }
  return resolved;
}

void DeadLoadSet::add(double t, NodeField& f) const {
  for (const ResolvedLoad& load : loads_) {
    if (!load.clock.runs()) continue;
    const Node value = node(load.value.at(load.clock.at(t)));
    for (std::size_t i = 0; i < load.nodes.size(); ++i) f[load.nodes[i]] += load.share[i] * value;
  }
}

}  // namespace forming_sim
