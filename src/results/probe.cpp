#include "forming_sim/results/probe.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "forming_sim/config/fault.h"
#include "forming_sim/mesh/measure.h"

namespace forming_sim {
namespace {

constexpr double kDegrees = 180 / M_PI;

std::vector<int> elements_of(const std::vector<int>& nodes, int corners,
                             const std::vector<std::array<int, 4>>& elements) {
  std::vector<int> inside, touching;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    int count = 0;
    for (int k = 0; k < corners; ++k) count += std::binary_search(nodes.begin(), nodes.end(), elements[e][k]);
    if (count == corners) inside.push_back(static_cast<int>(e));
    if (count > 0) touching.push_back(static_cast<int>(e));
  }
  return inside.empty() ? touching : inside;
}

}  // namespace

std::vector<Probe> place_probes(const std::vector<ProbeConfig>& configs, const Model& model) {
  std::vector<Probe> probes;
  std::vector<Fault> faults;
  for (std::size_t i = 0; i < configs.size(); ++i) {
    const ProbeConfig& config = configs[i];
    const std::string field = "output.probes[" + std::to_string(i) + "]";
    const auto named = [&](const BodyModel& body) { return config.body.empty() || body.name == config.body; };
    const auto body = std::find_if(model.bodies.begin(), model.bodies.end(), named);
    if (body == model.bodies.end()) {
      faults.push_back({Code::invalid_scene, field + ".body", config.body, "give the name of a body of the scene"});
      continue;
    }
    Probe probe;
    probe.name = config.name;
    if (config.set.empty()) {
      probe.nodes = {nearest_node(body->mesh, config.point)};
    } else if (const auto set = body->mesh.sets.find(config.set); set != body->mesh.sets.end() && !set->second.empty()) {
      probe.nodes = set->second;
    } else {
      faults.push_back({Code::invalid_scene, field + ".set", config.set, "give a set of body " + body->name + " that has nodes"});
      continue;
    }
    for (int& node : probe.nodes) node += body->first_node;
    probes.push_back(std::move(probe));
  }
  if (!faults.empty()) throw SceneError(faults);
  return probes;
}

std::vector<Probe> find_probes(const std::vector<ProbeConfig>& configs, const Model& model,
                               const std::vector<std::array<int, 4>>& elements) {
  std::vector<Probe> probes = place_probes(configs, model);
  for (Probe& probe : probes) probe.elements = elements_of(probe.nodes, model.dimension + 1, elements);
  return probes;
}

double simplex_volume(const Model& model, const std::array<int, 4>& element, const NodeField& positions) {
  const Vec3 a = vec3(positions[element[0]]);
  const Vec3 b = vec3(positions[element[1]]) - a, c = vec3(positions[element[2]]) - a;
  const double radius = model.axisymmetric ? a.x() + (b.x() + c.x()) / 3 : 1;
  if (model.dimension == 2) return radius * 0.5 * (b.x() * c.y() - b.y() * c.x());
  const Vec3 d = vec3(positions[element[3]]) - a;
  return b.cross(c).dot(d) / 6;
}

ProbeValue measure(const Probe& probe, const Model& model, const std::vector<std::array<int, 4>>& elements,
                   const NodeField& positions, const NodeField& velocities, const Sym* stress) {
  ProbeValue value;
  for (int node : probe.nodes) {
    value.position += vec3(positions[node]);
    value.velocity += vec3(velocities[node]);
  }
  value.position /= static_cast<double>(probe.nodes.size());
  value.velocity /= static_cast<double>(probe.nodes.size());
  double volume = 0;
  for (std::size_t i = 0; i < probe.elements.size(); ++i) {
    const double share = simplex_volume(model, elements[probe.elements[i]], positions);
    volume += share;
    value.stress += share * stress[i];
  }
  if (volume > 0) value.stress /= volume;
  return value;
}

double line_angle_deg(int dimension, const Vec3& from, const Vec3& to, const Vec3& normal) {
  constexpr double kAcross = 0.99;  // cosine
  const Vec3 line = to - from;
  if (normal.isZero(0)) return std::atan2(dimension == 2 ? line.y() : line.z(), line.x()) * kDegrees;
  const Vec3 n = normal.stableNormalized(), axis = std::abs(n.x()) < kAcross ? Vec3(Vec3::UnitX()) : Vec3(Vec3::UnitY());
  const Vec3 first = (axis - axis.dot(n) * n).normalized();
  return std::atan2(line.dot(n.cross(first)), line.dot(first)) * kDegrees;
}

double angle_change_deg(double a, double b) {
  const double change = std::remainder(b - a, 360.0);
  return change <= -180 ? change + 360 : change;
}

}  // namespace forming_sim
