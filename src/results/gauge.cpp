#include "forming_sim/results/gauge.h"

#include <algorithm>
#include <limits>

namespace forming_sim {
namespace {

template <class Nodes>
Vec3 centre(const Nodes& nodes, int count, const NodeField& positions) {
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < count; ++k) sum += vec3(positions[nodes[k]]);
  return sum / count;
}

/// Of the elements from first to before end.
Peak greatest(const Simulation& simulation, const std::vector<double>& values, int first, int end) {
  Peak peak;
  peak.time = simulation.time();
  if (first == end) return peak;
  peak.element = static_cast<int>(std::max_element(values.begin() + first, values.begin() + end) - values.begin());
  peak.value = values[peak.element];
  peak.position = centre(simulation.elements()[peak.element], simulation.model().dimension + 1, simulation.positions());
  return peak;
}

Peak greatest_plastic_strain(const Simulation& simulation) {
  const std::vector<double> strain = simulation.plastic_strain();
  return greatest(simulation, strain, 0, static_cast<int>(strain.size()));
}

std::vector<Peak> greatest_damage(const Simulation& simulation) {
  std::vector<Peak> peaks;
  const std::vector<double> damage = simulation.damage();
  for (const BodyModel* body : with_damage(simulation.model())) peaks.push_back(greatest(simulation, damage, body->first_element, body->first_element + body->element_count));
  return peaks;
}

/// Faces in planes of symmetry are inside of what is simulated, and count for nothing.
Peak greatest_surface_strain(const Simulation& simulation) {
  const std::vector<SurfaceStrain> strain = simulation.surface_strain();
  Peak peak;
  peak.time = simulation.time();
  std::size_t first = 0, greatest = strain.size();
  for (const BodyModel& body : simulation.model().bodies) {
    const bool formed = is_formed(simulation.model(), body);
    for (std::size_t i = 0; i < body.cut.size(); ++i)
      if (formed && !body.cut[i] && (greatest == strain.size() || strain[first + i].major > strain[greatest].major)) greatest = first + i;
    first += body.cut.size();
  }
  if (greatest == strain.size()) return peak;
  const Facet& facet = simulation.surface()[greatest];
  peak.value = strain[greatest].major;
  peak.element = facet.element;
  peak.position = centre(facet.nodes, simulation.model().dimension, simulation.positions());
  return peak;
}

/// thinning: per node, NaN where it is not known. What lies below a node of top only has a copy of its value.
Peak greatest_thinning(const Simulation& simulation, const std::vector<int>& top, const std::vector<double>& thinning) {
  Peak peak;
  peak.time = simulation.time();
  int node = -1;
  for (const int n : top)
    if (thinning[n] > (node < 0 ? -std::numeric_limits<double>::infinity() : thinning[node])) node = n;
  if (node < 0) return peak;
  const auto& elements = simulation.elements();
  const auto has_node = [&](const std::array<int, 4>& corners) { return std::find(corners.begin(), corners.end(), node) != corners.end(); };
  peak.value = thinning[node];
  peak.element = static_cast<int>(std::find_if(elements.begin(), elements.end(), has_node) - elements.begin());
  peak.position = vec3(simulation.positions()[node]);
  return peak;
}

}  // namespace

std::vector<const BodyModel*> with_damage(const Model& model) {
  std::vector<const BodyModel*> bodies;
  for (const BodyModel& body : model.bodies)
    if (body.material.damage) bodies.push_back(&body);
  return bodies;
}

Peak greatest_pressure(const Simulation& simulation, const std::vector<std::array<float, 6>>& stress) {
  Peak peak;
  const Model& model = simulation.model();
  for (const BodyModel& body : model.bodies) {
    if (body.material.law == "hyperelastic") continue;
    for (int e = body.first_element; e < body.first_element + body.element_count; ++e) {
      const std::array<float, 6>& s = stress[e];
      peak.rise_to({-(double(s[0]) + s[1] + s[2]) / (3 * body.material.K()), e, Vec3::Zero(), simulation.time()});
    }
  }
  if (peak.element >= 0) peak.position = centre(simulation.elements()[peak.element], model.dimension + 1, simulation.positions());
  return peak;
}

Peak number_of_pressed_cells(const Simulation& simulation) {
  const std::vector<int> cells = simulation.pressed_cells();
  if (cells.empty()) return {};
  return {static_cast<double>(cells.size()), cells[0], centre(simulation.elements()[cells[0]], simulation.model().dimension + 1, simulation.positions()), simulation.time()};
}

Gauge::Gauge(const Simulation& simulation, const std::vector<ProbeConfig>& probes)
    : probes_(find_probes(probes, simulation.model(), simulation.elements())), sheets_(simulation.model()), limits_(simulation.model()), top_(sheets_.top()) {
  for (Probe& probe : probes_) {
    probe.held = std::any_of(probe.nodes.begin(), probe.nodes.end(), [&](int n) { return simulation.once_held(n); });
    asked_.insert(asked_.end(), probe.elements.begin(), probe.elements.end());
  }
}

const Measures& Gauge::at(const Simulation& simulation) {
  if (step_ == simulation.steps()) return measures_;
  step_ = simulation.steps();
  measures_.plastic_strain = greatest_plastic_strain(simulation);
  measures_.damage = greatest_damage(simulation);
  measures_.surface_strain = greatest_surface_strain(simulation);
  if (sheets_.any()) {
    measures_.thickness_of_nodes = sheets_.at(simulation.positions());
    measures_.thinning_of_nodes = sheets_.thinning(measures_.thickness_of_nodes);
    measures_.thickness = smallest(measures_.thickness_of_nodes, top_);
    measures_.thinning = greatest_thinning(simulation, top_, measures_.thinning_of_nodes);
  }
  measures_.limits = limits_.at(simulation.positions());
  for (Peak& peak : measures_.limits.greatest) peak.time = simulation.time();
  measures_.probes.clear();
  const std::vector<Sym> stress = simulation.stress(asked_);
  const Sym* of_probe = stress.data();
  for (const Probe& probe : probes_) {
    measures_.probes.push_back(measure(probe, simulation.model(), simulation.elements(), simulation.positions(), simulation.velocities(), of_probe));
    of_probe += probe.elements.size();
  }
  return measures_;
}

double springback_angle_deg(const SpringbackConfig& config, int dimension, const std::vector<Probe>& probes,
                            const std::vector<ProbeValue>& values) {
  const auto find = [&](const std::string& name) -> std::size_t {
    return std::find_if(probes.begin(), probes.end(), [&](const Probe& p) { return p.name == name; }) - probes.begin();
  };
  const auto angle = [&](std::size_t from, std::size_t to) {
    if (from >= values.size() || to >= values.size() || values[from].position == values[to].position) return std::numeric_limits<double>::quiet_NaN();
    return line_angle_deg(dimension, values[from].position, values[to].position, config.normal);
  };
  const double of_line = angle(find(config.from), find(config.to));
  return config.has_reference() ? angle_change_deg(angle(find(config.reference_from), find(config.reference_to)), of_line) : of_line;
}

}  // namespace forming_sim
