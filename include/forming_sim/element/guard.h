#pragma once
// What keeps a single simplex of a free mesh from collapsing.
//
// With pressures in the nodes and the law at the edges nothing looks at one simplex alone; in a strong
// impact some would yield until they are flat. Its own volume resists that by
//   U = theta V0 K/4 (J - 1)^4,  p = theta K (J - 1)^3,  J = V/V0 of the simplex,
// which is as good as nothing where the volume stays and much where J nears 0. The Taylor bar of tetrahedra
// collapses with none, and theta from .02 to .2 give it one shape to .1 %, the moment of a bent sheet to 1e-5. A
// share of K (J - 1) itself would have to be paid for everywhere: .5 % of it already makes Cook's
// membrane of 8 triangles a side 2 % stiffer.
namespace forming_sim {

constexpr double kGuard = 0.1;  ///< theta

/// Over theta K.
template <class T> T guard_pressure(const T& J) {
  const T strain = J - T(1);
  return strain * strain * strain;
}
/// d p / d J, likewise.
template <class T> T guard_slope(const T& J) { return T(3) * (J - T(1)) * (J - T(1)); }
/// Per initial volume, likewise.
template <class T> T guard_energy(const T& J) {
  const T square = (J - T(1)) * (J - T(1));
  return T(0.25) * square * square;
}

}  // namespace forming_sim
