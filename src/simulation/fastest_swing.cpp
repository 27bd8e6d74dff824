#include "forming_sim/simulation/fastest_swing.h"

#include <algorithm>
#include <cmath>

namespace forming_sim {

namespace {
/// Strain that stands for an infinitesimal one: the stresses' curvature makes an error of about
/// as much in the product, rounding one of 1e-15 times the size of the model over that of a cell, by it.
constexpr double kSmallStrain = 1e-6;
constexpr double kProductError = 1e-3;  ///< allowance for both in the bound
}  // namespace

SpectrumBound fastest_swing(Elements& elements, const NodeField& x, const NodalRates& nodal, const BoundarySet& held, int dimension, long run) {
  const std::vector<double>& mass = elements.nodal_mass();
  double cap = 0;
  for (std::size_t n = 0; n < mass.size(); ++n) cap = std::max(cap, nodal.stiffness[n] / mass[n]);
  const auto project = [&](NodeField& w) {
    for (std::size_t k = 0; k < held.nodes().size(); ++k) {
      Node& at = w[held.nodes()[k]];
      at = node(held.projector(static_cast<int>(k)) * vec3(at));
    }
  };
  // A cell at node n measures about speed/omega_n where it is thinnest.
  const double speed = elements.slowest_wave();
  std::vector<double> root(mass.size()), steepness(mass.size());
  for (std::size_t n = 0; n < mass.size(); ++n) {
    root[n] = std::sqrt(mass[n]);
    steepness[n] = std::sqrt(nodal.stiffness[n]) / (mass[n] * speed);
  }
  NodeField at_rest(x.size()), moved(x);
  elements.elastic_forces(x, at_rest);
  // w = - P M^-1/2 (f(x + h u) - f(x)) / h,  u = M^-1/2 y, y in the range of P
  const auto apply = [&](const NodeField& y, NodeField& w) {
    double strain = 0;
    for (std::size_t n = 0; n < x.size(); ++n) strain = std::max(strain, y[n].norm() * steepness[n]);
    const double h = kSmallStrain / strain;
    for (std::size_t n = 0; n < x.size(); ++n) moved[n] = x[n] + h / root[n] * y[n];
    elements.elastic_forces(moved, w);
    for (std::size_t n = 0; n < x.size(); ++n) w[n] = (at_rest[n] - w[n]) / (h * root[n]);
    project(w);
  };
  SpectrumBound bound = bound_spectrum(x.size(), dimension, static_cast<std::uint64_t>(run), cap, project, apply);
  bound.above = std::min(cap, bound.above * (1 + kProductError));
  return bound;
}

}  // namespace forming_sim
