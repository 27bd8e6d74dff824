// What bounds the time step, and forces with plastic flow held.
#include <algorithm>
#include <cmath>

#include "element/group.h"
#include "forming_sim/element/guard.h"
#include "forming_sim/element/nodes.h"
#include "forming_sim/element/one_point.h"
#include "forming_sim/parallel/stage_clock.h"

namespace forming_sim {

double stable_step(double omega2, double damping) {
  const double omega = std::sqrt(omega2), xi = damping / (2 * omega);
  return 2 / omega * (std::sqrt(1 + xi * xi) - xi);
}

namespace {
/// The first that is no number wins, and stays.
bool lowers(double dt, double least) { return !std::isnan(least) && !(dt >= least); }
}  // namespace

NodeLimit slowest_node(const NodalRates& rates, const std::vector<double>& mass) {
  NodeLimit limit;
  for (std::size_t n = 0; n < mass.size(); ++n) {
    if (rates.stiffness[n] == 0) continue;  // a node of no cell
    const double dt = stable_step(rates.stiffness[n] / mass[n], rates.damping[n] / mass[n]);
    if (lowers(dt, limit.dt)) limit = {dt, static_cast<int>(n)};
  }
  return limit;
}

namespace {

/// [block][simplex][lane] of a number per simplex; copies of the last cell like it.
template <class Group> std::vector<Lane> lanes_of_simplices(const Group& g, const std::vector<double>& of_simplex) {
  std::vector<Lane> lanes(static_cast<std::size_t>(g.blocks) * g.cell_simplices);
  for (int b = 0; b < g.blocks; ++b)
    for (int l = 0; l < kLanes; ++l)
      for (int s = 0; s < g.cell_simplices; ++s)
        lanes[static_cast<std::size_t>(b) * g.cell_simplices + s][l] = of_simplex[static_cast<std::size_t>(std::min(b * kLanes + l, g.cells - 1)) * g.cell_simplices + s];
  return lanes;
}

}  // namespace

void Elements::find_rates(const NodeField& x, const NodeField& v, CellRates& rates) const {
  const NodalView view{x.data()->data(), v.data()->data(), inertia_.data(), nullptr, 0, 0};
  rates.resize(groups_.size());
  std::vector<double> of_edge;
  if (points_ > 0) of_edge = edge_rates(view);
  for (std::size_t k = 0; k < groups_.size(); ++k) {
    const Group& own = groups_[k];
    if (own.at_edges) continue;  // the simplices around it bound its stiffness
    CellGroup g = own;
    std::vector<Lane> of_simplex;
    if (own.nodal()) {
      of_simplex = lanes_of_simplices(own, means_over_edges(own, of_edge, 1));
      g.edge_omega2 = of_simplex.data()->value;
    }
    rates[k].resize(g.blocks);
    team_->share(g.blocks, blocks_of_a_thread(own), [&](long first, long last) {
      kernels_.rates(g, view, static_cast<int>(first), static_cast<int>(last), rates[k].data());
    });
  }
}

CellLimit Elements::slowest_cell(const CellRates& rates, const BodyModel* of) const {
  CellLimit limit;
  for (std::size_t k = 0; k < groups_.size(); ++k) {
    const Group& g = groups_[k];
    if (g.at_edges || (of && g.body != of->name)) continue;
    for (int cell = 0; cell < g.cells; ++cell) {
      const BlockRates& block = rates[k][cell / kLanes];
      const double dt = forming_sim::stable_step(block.omega2[cell % kLanes], block.damping[cell % kLanes]);
      if (lowers(dt, limit.dt)) limit = {dt, g.element(cell, 0)};
    }
  }
  return limit;
}

void Elements::stable_step(const NodeField& x, const NodeField& v, double& dt, int& element) const {
  StageClock clock(times_);
  CellRates rates;
  find_rates(x, v, rates);
  const CellLimit limit = slowest_cell(rates);
  dt = limit.dt;
  element = limit.element;
  clock.ends(&StepTimes::bound);
}

/// The masses M_c of element/step_bounds.h, [cell][node]: those to which element/time_step.h refers.
void Elements::keep_shares(const NodeField& X) {
  for (Group& g : groups_) {
    if (g.at_edges) continue;
    g.share.assign(static_cast<std::size_t>(g.cells) * g.cell_nodes, 0.0);
    for (int cell = 0; cell < g.cells; ++cell) {
      const int b = cell / kLanes, l = cell % kLanes;
      const auto node = [&](int a) { return g.node_storage[(static_cast<std::size_t>(b) * g.cell_nodes + a) * kLanes + l]; };
      const auto mass = [&](int s) { return g.density * g.memory_storage[(static_cast<std::size_t>(b) * g.cell_simplices + s + 1) * g.items - 1][l]; };
      double* share = &g.share[static_cast<std::size_t>(cell) * g.cell_nodes];
      if (is_one_point(static_cast<CellKind>(g.kind))) {
        Vec3 corners[8];
        for (int a = 0; a < g.cell_nodes; ++a) corners[a] = vec3(X[node(a)]);
        const OnePointStart start = start_one_point(corners, dimension_, axisymmetric_, g.solid);
        for (int a = 0; a < g.cell_nodes; ++a) share[a] = mass(0) * start.share[a];
        continue;
      }
      const CellShape& shape = shape_of(static_cast<CellKind>(g.kind));
      for (int s = 0; s < g.cell_simplices; ++s)
        for (int a = 0; a <= dimension_; ++a) {
          const int corner = shape.simplex[s][a];
          share[corner] += mass(s) / (dimension_ + 1) / (axisymmetric_ ? inertia_[node(corner)] : 1);
        }
    }
  }
}

NodalRates Elements::sum_rates(const CellRates& rates) const {
  NodalRates sum;
  sum.stiffness.assign(mass_.size(), 0.0);
  sum.damping.assign(mass_.size(), 0.0);
  for (std::size_t k = 0; k < groups_.size(); ++k) {
    const Group& g = groups_[k];
    if (g.at_edges) continue;
    for (int cell = 0; cell < g.cells; ++cell) {
      const int b = cell / kLanes, l = cell % kLanes;
      const BlockRates& block = rates[k][b];
      for (int a = 0; a < g.cell_nodes; ++a) {
        const int node = g.node_storage[(static_cast<std::size_t>(b) * g.cell_nodes + a) * kLanes + l];
        const double share = g.share[static_cast<std::size_t>(cell) * g.cell_nodes + a];
        sum.stiffness[node] += share * block.omega2[l];
        sum.damping[node] += share * block.damping[l];
      }
    }
  }
  return sum;
}

namespace {
/// d ln V / dt of a simplex, in a ring without the hoop's part.
double growth_of(const NodeField& x, const NodeField& v, const std::array<int, 4>& nodes, int dimension) {
  Vec3 e[3] = {Vec3::Zero(), Vec3::Zero(), Vec3::UnitZ()}, w[3] = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  for (int k = 0; k < dimension; ++k) e[k] = vec3(x[nodes[k + 1]] - x[nodes[0]]), w[k] = vec3(v[nodes[k + 1]] - v[nodes[0]]);
  const double volume = e[0].cross(e[1]).dot(e[2]);
  return (w[0].cross(e[1]).dot(e[2]) + e[0].cross(w[1]).dot(e[2]) + e[0].cross(e[1]).dot(w[2])) / volume;
}
}  // namespace

Elements::GuardLimit Elements::guard_limit(const NodeField& x, const NodeField& v, const CellRates& rates, double thin) const {
  constexpr double kAhead = 0.05;  // of J: what comes before the next look
  GuardLimit limit;
  std::vector<double> sum;  // per node, as sum_rates()
  for (std::size_t k = 0; k < groups_.size(); ++k) {
    const Group& g = groups_[k];
    if (g.at_edges || g.cell_simplices != 1 || g.pressure != PressureMode::node) continue;
    for (int cell = 0; cell < g.cells; ++cell) {
      const int b = cell / kLanes, l = cell % kLanes, element = g.element(cell, 0);
      if (!(rates[k][b].omega2[l] > thin)) continue;  // its own stiffness is in that of the mesh, and its guard is a small part of it
      const double J = volume_ratio(x, element), d = std::abs(J - 1) - kFreeOfGuard + kAhead;
      limit.change = std::max(limit.change, std::abs(J * growth_of(x, v, simplices_[element], dimension_)));
      if (!(d > 0)) continue;
      sum.resize(mass_.size(), 0.0);
      const double part = kGuard * 3 * d * d * std::max(1.0, J * J);  // of K, which the cell's bound has whole, in the shape of now
      for (int a = 0; a < g.cell_nodes; ++a)
        sum[g.node_storage[(static_cast<std::size_t>(b) * g.cell_nodes + a) * kLanes + l]] += part * g.share[static_cast<std::size_t>(cell) * g.cell_nodes + a] * rates[k][b].omega2[l];
    }
  }
  for (std::size_t n = 0; n < sum.size(); ++n) limit.omega2 = std::max(limit.omega2, sum[n] / mass_[n]);
  return limit;
}

double Elements::slowest_wave() const {
  double speed = 1e300;
  for (const Group& g : groups_) speed = std::min(speed, std::sqrt((g.solid.K + 4.0 / 3 * g.solid.mu) / g.density));
  return speed;
}

void Elements::add_mass(const std::vector<double>& kg) {
  for (std::size_t n = 0; n < mass_.size(); ++n) mass_[n] += kg[n];
}

void Elements::elastic_forces(const NodeField& x, NodeField& f) {
  const NodalView view{x.data()->data(), nullptr, nullptr, pressure_.data(), 0, 0};
  if (any_nodal_) nodal_pressure(view, slots_);
  std::vector<double> unused;
  for (const Group& g : groups_) unused.resize(std::max<std::size_t>(unused.size(), static_cast<std::size_t>(g.blocks)));
  const std::unique_ptr<bool[]> unread = std::make_unique<bool[]>(unused.size());
  for (const Group& own : groups_) {
    CellGroup g = own;
    for (int k = 0; k < g.solid.layers; ++k) g.solid.layer[k].hardening.kind = HardeningCurve::elastic;
    g.linear_viscosity = g.quadratic_viscosity = 0;
    g.plastic_work = unused.data();
    g.upright = g.pressed = unread.get();
    team_->share(own.tiles, tiles_of_a_thread(own), [&](long first, long last) {
      for (long t = first; t < last; ++t) forces_of_tile(g, own, view, t);
    });
  }
  stillness_.forget();  // the slots hold the forces at x now
  sum_nodes(*node_team_, nodal_forces(), f);
}

}  // namespace forming_sim
