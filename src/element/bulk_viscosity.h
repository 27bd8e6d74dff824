#pragma once
// Bulk viscosity of the cells of a pack. For files that are compiled once per vector width only.
#include "element/cell_pack.h"

namespace forming_sim {
namespace FORMING_SIM_ISA {

/// V, dV/dt and extent (tensor.h) of the cell whose nodes stand at x and move with v.
template <class Cell>
void volume_and_rate(const double* constants, const Vector<Pack, kD<Cell>>* x, const Vector<Pack, kD<Cell>>* v, Pack& V, Pack& rate, Pack& size) {
  V = rate = size = Pack(0.0);
  each_moving<Cell>(constants, x, v, [&](int, const CellEdges<Cell>& e, const Vector<Pack, kD<Cell>>* w) {
    V += e.volume;
    size += extent(e);
    rate += e.volume * CellIncrement<Cell>(e, w).divergence();
  });
}

inline bool is_viscous(const CellGroup& g) { return g.linear_viscosity > 0 || g.quadratic_viscosity > 0; }

/// Bulk viscosity of the cells of a pack, q, which adds to p,
///   q = rho l (b1 c D + b2^2 l D |D| where D < 0), D = (dV/dt)/V, l = extent^(1/d), with the velocities before the kick.
/// Its work is that of a force that acts in the kick, q times the mean of dV/dt before and after it: it is booked when the
/// next step knows that. Out of line: most scenes have none.
template <class Cell> [[gnu::noinline]] Pack viscosity_of_pack(const CellGroup& g, const NodalView& view, long pack) {
  constexpr int D = kD<Cell>;
  const int* nodes = nodes_of<Cell>(g, pack);
  Vector<Pack, D> x[Cell::nodes], v[Cell::nodes];
  gather_ways<Cell>(nodes, view.x, x);
  gather_ways<Cell>(nodes, view.v, v);
  Pack V, rate, size;
  volume_and_rate<Cell>(constants_of<Cell>(g, pack), x, v, V, rate, size);
  const Pack D_v = rate / V;
  const Pack l = lanewise([](double volume) { return D == 2 ? __builtin_sqrt(volume) : __builtin_cbrt(volume); }, size);
  const Pack c(__builtin_sqrt((g.solid.K + 4.0 / 3 * g.solid.mu) / g.density));
  const Pack b2(g.quadratic_viscosity);
  const Pack q = Pack(g.density) * l * D_v * (Pack(g.linear_viscosity) * c + select(D_v < Pack(0.0), b2 * b2 * l * absolute(D_v), Pack(0.0)));
  double* last = lanes_of(g.last_viscosity, 2, pack);
  const Pack q_last = Pack::load(last), rate_last = Pack::load(last + kLanes);
  g.viscous_work[block_of(pack)] += sum_of_first(q_last * (rate_last + rate), lanes_in_use(g, pack)) * 0.5 * view.last_kick;
  q.store(last);
  rate.store(last + kLanes);
  return q;
}

}  // namespace FORMING_SIM_ISA
}  // namespace forming_sim
