#pragma once
// What keeps a single simplex of a free mesh, or of a cell of 2 or 4 triangles or of 6 or 24 tetrahedra, from collapsing.
//
// With pressures in the nodes and the law at the edges, or one pressure for the simplices of a cell, nothing looks at the volume of one
// simplex alone; in a strong impact some would yield until they are flat. Its own volume resists that by
//   U = theta V0 K/4 d^4,  p = theta K d^3,  d = J - 1 less what is free: nothing for |J - 1| <= .2, J = V/V0 of the simplex,
// so that a body changes its volume by that much as if there were none. The Taylor bar of free tetrahedra collapses
// without, so do forgings of 2 triangles a cell (`squeeze`) and cubes of 24 tetrahedra that meet a wall at 850 m/s, and theta from .05 to .5 give it one shape to .1 %. A share of K (J - 1) itself would have to be paid
// for everywhere: .5 % of it already makes Cook's membrane of 8 triangles a side 2 % stiffer.
// The middle node of a long crossed cell that is bent goes far (element/crossed.h): the triangles at its long edges are free by more.
#include "forming_sim/tensor/pack.h"

namespace forming_sim {

constexpr double kGuard = 0.2, kFreeOfGuard = 0.2;  ///< theta; |J - 1| up to which there is none

/// d
template <class T> T guarded(const T& J, const T& free) { return larger(J - T(1) - free, T(0)) + smaller(J - T(1) + free, T(0)); }

/// p over theta K.
template <class T> T guard_pressure(const T& J, const T& free = T(kFreeOfGuard)) {
  const T d = guarded(J, free);
  return d * d * d;
}
/// d p / d J, likewise.
template <class T> T guard_slope(const T& J, const T& free = T(kFreeOfGuard)) { return T(3) * guarded(J, free) * guarded(J, free); }
/// Per initial volume, likewise.
template <class T> T guard_energy(const T& J, const T& free = T(kFreeOfGuard)) {
  const T square = guarded(J, free) * guarded(J, free);
  return T(0.25) * square * square;
}

}  // namespace forming_sim
