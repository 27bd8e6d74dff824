#pragma once
// What the classical method asks of a pack of cells beside positions. For files that are compiled once per vector width only.
#include "element/cell_pack.h"

namespace forming_sim {
namespace FORMING_SIM_ISA {

/// The ways of edges in the last step, from their velocities.
template <class Cell> void moved(const NodalView& view, Vector<Pack, kD<Cell>>* w) {
  for (int m = 0; m < kE<Cell>; ++m) w[m] = Pack(view.last_dt) * w[m];
}

/// Incremental pressure (2.11) of the classical method, p + K tr D dt, with the
/// mean rate of the cell or that of the element. Keep::no: the memory stays as it is.
template <class Cell>
void classical_pressures(const CellGroup& g, const NodalView& view, long pack, const Vector<Pack, kD<Cell>>* x,
                         const Vector<Pack, kD<Cell>>* v, Pack* p, Keep keep) {
  constexpr int D = kD<Cell>;
  Pack rate[Cell::simplices], sum_V(0.0), sum_rate(0.0);
  each_moving<Cell>(constants_of<Cell>(g, pack), x, v, [&](int s, const CellEdges<Cell>& e, Vector<Pack, D>* w) {
    moved<Cell>(view, w);
    rate[s] = CellIncrement<Cell>(e, w).divergence();
    sum_V += e.volume;
    sum_rate += e.volume * rate[s];
  });
  const Pack mean = sum_rate / sum_V, theta(g.pressure == PressureMode::element ? 1 : g.element_share);
  for (int s = 0; s < Cell::simplices; ++s) {
    double* at = memory_of<Cell>(g, pack, s);
    load(at, kClassicalPressure<D>, p[s]);
    p[s] += Pack(g.solid.K) * ((Pack(1.0) - theta) * mean + theta * rate[s]);
    if (keep == Keep::yes) store(at, kClassicalPressure<D>, p[s]);
  }
}

/// What the pressures of a cell would store in an elastic body, of the current volumes: V [mean^2 / 2K + (p - mean)^2 / (2 theta K)].
/// A share theta of K is what an element's own part has answered with, and so its part stores 1/theta of what K would say.
template <class Cell> Pack energy_of_classical_pressures(const Pack* V, const Pack* p, double K, double theta) {
  Pack sum_V(0.0), sum_p(0.0), own(0.0);
  for (int s = 0; s < Cell::simplices; ++s) {
    sum_V += V[s];
    sum_p += V[s] * p[s];
  }
  const Pack mean = sum_p / sum_V;
  if (theta > 0)
    for (int s = 0; s < Cell::simplices; ++s) own += V[s] * (p[s] - mean) * (p[s] - mean);
  return Pack(0.5 / K) * (sum_V * mean * mean + own * Pack(theta > 0 ? 1 / theta : 0));
}

/// Of one-point cells: p, and the ways w of the edges.
template <class Cell> [[gnu::noinline]] Pack classical_step_of_edges(const CellGroup& g, const NodalView& view, long pack, Vector<Pack, kD<Cell>>* w) {
  const int* nodes = nodes_of<Cell>(g, pack);
  Vector<Pack, kD<Cell>> x[Cell::nodes], v[Cell::nodes];
  gather<Cell>(nodes, view.x, x);
  gather<Cell>(nodes, view.v, v);
  edges_of<Cell>(constants_of<Cell>(g, pack), v, 0, w);
  moved<Cell>(view, w);
  Pack p;
  classical_pressures<Cell>(g, view, pack, x, v, &p, Keep::yes);
  return p;
}

}  // namespace FORMING_SIM_ISA
}  // namespace forming_sim
