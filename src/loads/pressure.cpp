#include "forming_sim/loads/pressure.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "forming_sim/config/fault.h"
#include "forming_sim/mesh/axis.h"

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
  const auto holds = [&](int node) {
    return std::binary_search(set->second.begin(), set->second.end(), node);
  };
  for (Facet facet : mesh.surface) {
    const auto end = facet.nodes.begin() + mesh.dimension;
    if (!std::all_of(facet.nodes.begin(), end, holds)) continue;
    std::for_each(facet.nodes.begin(), end, [&](int& node) { node += first_node; });
    resolved.facets.push_back(facet);
  }
  if (resolved.facets.empty())
    throw Error(
        Code::invalid_scene,
        where + ", which holds all nodes of no surface face; a pressure needs whole faces of the surface");
  return resolved;
}

PressureSet::PressureSet(std::vector<ResolvedPressure> pressures, int dimension, bool axisymmetric)
    : pressures_(std::move(pressures)), dimension_(dimension), axisymmetric_(axisymmetric) {}

Vec3 PressureSet::share(const Facet& facet, int k, const NodeField& x) const {
  const Vec3 a = vec3(x[facet.nodes[0]]), ab = vec3(x[facet.nodes[1]]) - a;
  if (dimension_ == 3) return 1.0 / 6 * ab.cross(vec3(x[facet.nodes[2]]) - a);
  const double part = axisymmetric_ ? turned_share(x[facet.nodes[k]][0], x[facet.nodes[1 - k]][0]) : 0.5;
  return part * Vec3(ab.y(), -ab.x(), 0);
}

double PressureSet::add(double t, const NodeField& x, NodeField& f) const {
  double total = 0;
  for (const ResolvedPressure& pressure : pressures_) {
    const double p = pressure.profile.at(t);
    if (p == 0) continue;
    for (const Facet& facet : pressure.facets) {
      Vec3 area = Vec3::Zero();
      for (int k = 0; k < dimension_; ++k) {
        const Vec3 part = share(facet, k, x);
        f[facet.nodes[k]] -= node(p * part);
        area += part;
      }
      total += p * area.norm();
    }
  }
  return total;
}

double PressureSet::work(double t, const NodeField& x, const NodeField& v_before, const NodeField& v_after,
                         double dt) const {
  double work = 0;
  for (const ResolvedPressure& pressure : pressures_) {
    const double p = pressure.profile.at(t);
    if (p == 0) continue;
    for (const Facet& facet : pressure.facets) {
      for (int k = 0; k < dimension_; ++k)
        work -= p * share(facet, k, x).dot(vec3(v_before[facet.nodes[k]]) + vec3(v_after[facet.nodes[k]]));
    }
  }
  return 0.5 * dt * work;
}

}  // namespace forming_sim
