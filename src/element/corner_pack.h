#pragma once
// The guard of the corners of a pack of one-point cells (element/corner_guard.h), whose strains say that one may be in
// its range. Out of line, from the nodes on: what cells without it have in registers stays there. For files that are
// compiled once per vector width only.
#include "element/cell_pack.h"
#include "forming_sim/element/corner_guard.h"

namespace forming_sim {
namespace FORMING_SIM_ISA {

/// A pack's corners, and their guard.
template <class Cell> struct Corners {
  static constexpr int D = kD<Cell>;
  const double* constants;
  Vector<Pack, D> x[Cell::nodes];
  CellEdges<Cell> e;

  /// ahead: where they are so much later, s.
  Corners(const CellGroup& g, const NodalView& view, long pack, const Pack* ahead = nullptr) : constants(constants_of<Cell>(g, pack)) {
    const int* nodes = nodes_of<Cell>(g, pack);
    gather<Cell>(nodes, view.x, x);
    if (ahead) {
      Vector<Pack, D> v[Cell::nodes];
      gather<Cell>(nodes, view.v, v);
      for (int a = 0; a < Cell::nodes; ++a) x[a] += *ahead * v[a];
    }
    edges_of<Cell>(constants, x, 0, e.x);
    find_reciprocal(e);
  }
  CornerGuard<Pack, D, Cell::ring> guard() const { return {constants, x, e.x, e.up}; }
};

/// Adds the forces.
template <class Cell> [[gnu::noinline]] void guard_corners(const CellGroup& g, const NodalView& view, long pack) {
  const Corners<Cell> corners(g, view, pack);
  const auto guard = corners.guard();
  const Pack least = guard.least();
  if (!any(least < Pack(kFreeCorner))) return;
  if (!Cell::ring && !all(least > Pack(0.0))) g.upright[block_of(pack)] = false;
  if (any(least < Pack(kPressedCorner))) g.pressed[block_of(pack)] = true;
  Vector<Pack, kD<Cell>> slope[Cell::nodes];
  guard.gradient(slope);
  const int* slots = slots_of<Cell>(g, pack);
  const Pack scale = Pack(-kCornerGuard * g.solid.K) * initial_volume(g, memory_of<Cell>(g, pack, 0));
  for (int a = 0; a < Cell::nodes; ++a) add_vectors(scale * slope[a], slots + a * kLanes, g.sums);
}

/// What it adds to omega^2, the square of the cell's frequency without: the stiffness that q will have after a step, or
/// half of q where it falls by more.
template <class Cell> [[gnu::noinline]] Pack corner_rate(const CellGroup& g, const NodalView& view, long pack, const Pack& omega2) {
  const Corners<Cell> corners(g, view, pack);
  const auto guard = corners.guard();
  if (!any(guard.least() < Pack(kFreeCorner))) return Pack(0.0);
  const Pack scale(kCornerGuard * g.solid.K / g.density);
  const Pack step = Pack(2.0) / sqrt(omega2 + scale * guard.stiffness(guard.q));
  const Corners<Cell> moved(g, view, pack, &step);
  const auto later = moved.guard();
  Pack ahead[Cell::nodes];
  for (int a = 0; a < Cell::nodes; ++a) ahead[a] = larger(smaller(guard.q[a], later.q[a]), Pack(0.5) * guard.q[a]);
  return scale * guard.stiffness(ahead);
}

}  // namespace FORMING_SIM_ISA
}  // namespace forming_sim
