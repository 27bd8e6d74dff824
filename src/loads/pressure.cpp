#include "forming_sim/loads/pressure.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

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
    resolved.profile = ScalarProfile(config.times, config.values);
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

PressureSet::PressureSet(std::vector<ResolvedPressure> pressures, int dimension)
    : pressures_(std::move(pressures)), dimension_(dimension) {}

Vec3 PressureSet::area_vector(const Facet& facet, const NodeField& x) const {
  const Vec3 a = vec3(x[facet.nodes[0]]), ab = vec3(x[facet.nodes[1]]) - a;
  if (dimension_ == 2) return Vec3(ab.y(), -ab.x(), 0);
  return 0.5 * ab.cross(vec3(x[facet.nodes[2]]) - a);
}

double PressureSet::add(double t, const NodeField& x, NodeField& f) const {
  double total = 0;
  for (const ResolvedPressure& pressure : pressures_) {
    const double p = pressure.profile.at(t);
    if (p == 0) continue;
    for (const Facet& facet : pressure.facets) {
      const Vec3 area = area_vector(facet, x);
      const Node share = node(-p / dimension_ * area);
      for (int k = 0; k < dimension_; ++k) f[facet.nodes[k]] += share;
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
      Vec3 velocity = Vec3::Zero();
      for (int k = 0; k < dimension_; ++k)
        velocity += vec3(v_before[facet.nodes[k]]) + vec3(v_after[facet.nodes[k]]);
      work -= p / dimension_ * area_vector(facet, x).dot(velocity);
    }
  }
  return 0.5 * dt * work;
}

}  // namespace forming_sim
