#pragma once
// The forces of a block of one-point cells (element/one_point.h). For files that are compiled once per vector width only.
//
// On the way in the nodes are gathered in pairs, and only the edges and the sums of the modes remain of them; on the way out
// each node's force is made when it is added up. With p I + S = sigma and r_alpha = dU/d(sum_alpha) of the hourglass energy,
// sum_alpha = sum_a h_alpha,a x_a, the force on edge m is
//   M . x^m,  M = sum_alpha r_alpha (x) sum_alpha - V sigma,
// and that on corner a sum_m w_ma M . x^m - sum_alpha h_alpha,a r_alpha.
#include "element/bulk_viscosity.h"
#include "element/classical_block.h"
#include "element/corner_block.h"
#include "forming_sim/element/hourglass.h"

namespace forming_sim {
namespace FORMING_SIM_ISA {

/// Edges of one-point cells and the sums of their corners.
template <class Cell> void gather_one_point(const int* nodes, const double* field, const double* constants, Vector<Pack, kD<Cell>>* edge, CornerSums<Pack, kD<Cell>>& sums) {
  constexpr int D = kD<Cell>, half = Cell::nodes / 2;
  if constexpr (Cell::ring) edge[2] = {{Pack(0.0), Pack(0.0)}};
  repeat<half>([&](auto a) {
    const Vector<Pack, D> low = gather_vectors<D>(nodes + a * kLanes, field), high = gather_vectors<D>(nodes + (a + half) * kLanes, field);
    sums.template add<a>(low, high);
    if constexpr (Cell::ring) edge[2][0] += weight(constants, OnePoint<D, true>::hoop + a) * low[0] + weight(constants, OnePoint<D, true>::hoop + a + half) * high[0];
  });
  sums.find_edges(constants, edge);
}

/// The constants of the next block, where they are others: cells of a file have each their own.
template <class Cell> void fetch_constants(const CellGroup& g, long block) {
  if (block + 1 == g.blocks || g.constant_set[block + 1] == g.constant_set[block]) return;
  using Items = OnePoint<kD<Cell>, Cell::ring>;
  const double* constants = constants_of<Cell>(g, block + 1);
  fetch_ahead(constants, 0, Items::inertia);  // those behind are for the time step, but for one
  fetch_ahead(constants + Items::near * kLanes, 0, 1);
}

/// What varies across the cells of a block whose nodes are gathered.
template <class Cell> class Variation {
 public:
  Variation(const CellGroup& g, const double* constants, const CellEdges<Cell>& e, const Vector<Pack, kD<Cell>>* x) : moduli_(g.solid), hourglass(moduli_, constants, e, sums_.mode, x) {
    sums_.add_all(x);
    hourglass.find_strains();
  }
  Variation(const Variation&) = delete;

 private:
  PlaneModuli<Pack> moduli_;
  CornerSums<Pack, kD<Cell>> sums_;

 public:
  Hourglass<Pack, kD<Cell>, Cell::ring> hourglass;
};

template <class Cell, Made made> [[gnu::flatten]] void forces_of_one_point_block(const CellGroup& g, const PlaneModuli<Pack>& moduli, const NodalView& view, long block) {
  constexpr int D = kD<Cell>;
  const double* constants = constants_of<Cell>(g, block);
  const int* nodes = g.nodes + block * Cell::nodes * kLanes;
  double* memory = memory_of<Cell>(g, block, 0);
  fetch_memory(g, memory, 2);
  fetch_constants<Cell>(g, block);
  fetch_ahead(hourglass_of<Cell>(g, block), 2L * g.hourglass_items * static_cast<long>(sizeof(Lane)), g.hourglass_items);
  CellEdges<Cell> e;
  CornerSums<Pack, D> sums;
  gather_one_point<Cell>(nodes, view.x, constants, e.x, sums);
  find_reciprocal(e);
  const Pack V0 = initial_volume(g, memory), J = e.volume / V0;
  g.upright[block] = all(J > Pack(0.0));
  const int in_use = lanes_in_use(g, block);

  Vector<Pack, D> x[Cell::ring ? Cell::nodes : 1];
  if constexpr (Cell::ring) gather<Cell>(nodes, view.x, x);
  Hourglass<Pack, D, Cell::ring> hourglass(moduli, constants, e, sums.mode, x);
  PointResponse<Pack, D> point;
  Pack p = Pack(g.solid.K) * (J - Pack(1.0));
  if constexpr (made == Made::any) {
    Vector<Pack, D> w[kE<Cell>];
    const bool classical = g.solid.law == Law::classical;
    if (classical) p = classical_step_of_edges<Cell>(g, view, block, w);
    point = step_with_hourglass(g.solid, e, classical ? w : nullptr, J, memory, hourglass, hourglass_of<Cell>(g, block));
  } else {
    point = von_mises_with_hourglass<made == Made::one_layer>(g.solid, e, J, memory, hourglass, hourglass_of<Cell>(g, block));
  }
  if (is_viscous(g)) p += viscosity_of_block<Cell>(g, view, block);
  g.plastic_work[block] += sum_of_first(point.dissipation * V0, in_use);

  Vector<Pack, D> r[OnePoint<D>::modes], M[D], force[D];
  hourglass.gradient(V0, r);
  for (int c = 0; c < 3; ++c) point.S[c] += p;  // sigma = p I + S (3.4)
  repeat<D>([&](auto i) {
    repeat<D>([&](auto j) { M[i][j] = r[0][i] * sums.mode[0][j] - e.volume * point.S[kFull[i][j]]; });
    repeat<OnePoint<D>::modes - 1>([&](auto k) { M[i] += r[k + 1][i] * sums.mode[k + 1]; });
  });
  repeat<D>([&](auto m) { repeat<D>([&](auto i) { force[m][i] = dot(M[i], e.up[m]); }); });
  Pack hoop;  // of a ring, through the weights of x_3
  if constexpr (Cell::ring) hoop = e.volume * e.up[2][0] * point.S[2];

  const CornerForces<Pack, D> corners(constants, force, r);
  const int* slots = g.slots + block * Cell::nodes * kLanes;
  repeat<Cell::nodes / 2>([&](auto a) {
    constexpr int opposite = a + Cell::nodes / 2;
    Vector<Pack, D> low, high;
    corners.template at<a>(low, high);
    if constexpr (Cell::ring) {
      low[0] -= weight(constants, OnePoint<D, true>::hoop + a) * hoop + hourglass.hoop_force(V0, a);
      high[0] -= weight(constants, OnePoint<D, true>::hoop + opposite) * hoop + hourglass.hoop_force(V0, opposite);
    }
    add_vectors(low, slots + a * kLanes, g.sums);
    add_vectors(high, slots + opposite * kLanes, g.sums);
  });
  g.pressed[block] = false;
  if (hourglass.far()) guard_corners<Cell>(g, view, block);
}

}  // namespace FORMING_SIM_ISA
}  // namespace forming_sim
