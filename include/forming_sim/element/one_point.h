#pragma once
// The cell with one point: a quadrilateral or hexahedron that is a single element of
// three edge vectors (two in 2D), fixed linear combinations of its node positions,
//
//   x_m = sum_a w_ma x_a,   w_ma = c b_a . E_m,   b_a = 1/V0 dV0/dX_a,
//
// so that x_m = c F E_m with F = sum_a x_a b_a the mean deformation gradient (the uniform
// gradient of Flanagan and Belytschko, 1981, taken once in the initial configuration),
// E_m an orthonormal frame along the cell's edges and c such that det(x_m)/D! = V0 det F:
// the law and its memory are those of a simplex of volume V0.
//
// Masses: exact row sums rho int N_a dV, which keep the centre of mass of a distorted
// cell; equal shares do only for a parallelepiped.
//
// Its shapes that F does not see are element/hourglass.h's. Their amplitudes are
//   z_alpha,m = x^m . sum_a h_alpha,a x_a - start_alpha,m
// with h the signs of xi eta (2D), or of eta zeta, zeta xi, xi eta, xi eta zeta (3D), at the
// corners, and `start` such that all z vanish wherever x is a linear image of X:
// z_alpha,m = 2^D/c times the component m of F^-1 q_alpha, q_alpha the displacement of the mode.
// The strains that vary across the cell are linear in z (element/hourglass_strain.h), and so
// linear in the x^m times the sums of the modes, less what `strain` holds of them.
#include <vector>

#include "forming_sim/material/constants.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// The constants of a cell, numbers one after the other. Ring: turned about the y axis, element/one_point_ring.h.
template <int D, bool Ring = false> struct OnePoint {
  static constexpr int nodes = D == 2 ? 4 : 8, modes = D == 2 ? 1 : 4, pairs = D * (D + 1) / 2;
  static constexpr int linear = 0;                      ///< [i][m] of the weights w_ma: element/one_point_sums.h
  static constexpr int twist = linear + D * D;          ///< [mode][m] likewise, 0 for a parallelepiped
  static constexpr int twisted = twist + modes * D;     ///< the largest of them
  static constexpr int fibres = twisted + 1;            ///< [i][m] a_i u_i . E_m, u_i = g_i/|g_i|, g_i = dX/dxi_i at the centre
  static constexpr int skew = fibres + D * D;           ///< 3D: [d] with the angle from u_i to u_j, d, i, j cyclic: its cotangent, 1/sin^2, a_j/a_i over its sine, a_i/a_j over it
  static constexpr int strain = skew + (D == 2 ? 0 : 4 * D);           ///< of `start`: 2D [d] e_d; 3D [d] three of e_d, then the three of xi eta zeta
  static constexpr int slopes = strain + (D == 2 ? D : 4 * D);         ///< [i] a_i = c/2^D/|g_i|
  static constexpr int start = slopes + D;              ///< [mode][m]
  static constexpr int inertia = start + modes * D;     ///< [pair] sum_a w_ma w_ka / share_a
  static constexpr int stiffness = inertia + pairs;     ///< [m] Pa, bounds the modes' stiffness: element/one_point_step.h
  static constexpr int looseness = stiffness + D;       ///< 1 / smallest eigenvalue of the modes' inverse inertia
  static constexpr int slant = looseness + 1;           ///< cosine between the modes and the uniform shapes, 0 for a parallelepiped
  static constexpr int share = slant + 1;               ///< [node] in the mass
  static constexpr int near = share + nodes;            ///< the square of the strains that vary up to which no corner is near to its guard: element/corner_guard.h
  static constexpr int corner = near + 1;               ///< [node] 1/c_a of the guard, 0 where a corner has none
  static constexpr int hoop = corner + nodes;           ///< ring: [node] o_a
  static constexpr int hoop_start = hoop + 4;           ///< ring: [i] R_i/X_3
  static constexpr int items = Ring ? hoop_start + 2 : hoop;
};

/// Place of (i, j) among the pairs.
template <int D> inline constexpr int kPair[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
template <> inline constexpr int kPair<2>[3][3] = {{0, 2, -1}, {2, 1, -1}, {-1, -1, -1}};

/// Sides of a corner: xi, eta, zeta = -1 or 1, in the orders of mesh.h.
inline constexpr int kCornerSides[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                           {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

/// h_alpha,a: in 3D mode alpha < 3 is the product of the other two coordinates, the last that of all.
template <int D> inline constexpr int kHourglass[4][8] = {{1, 1, -1, -1, -1, -1, 1, 1},
                                                          {1, -1, -1, 1, -1, 1, 1, -1},
                                                          {1, -1, 1, -1, 1, -1, 1, -1},
                                                          {-1, 1, -1, 1, 1, -1, 1, -1}};
template <> inline constexpr int kHourglass<2>[4][8] = {{1, -1, 1, -1}};

/// A one-point cell at the start.
struct OnePointStart {
  double volume = 0;                   ///< V0, m3 (m2 in 2D), exact for straight edges
  Mat3 edges = Mat3::Identity();       ///< X_m as columns; 2D: the third is e_3
  double share[8] = {};                ///< of each corner in the mass
  std::vector<double> constants;       ///< OnePoint<D>::items
};
/// corners: as in mesh.h, 4 of them (z = 0) or 8. Where the volume at an integration point is not
/// positive, so is the volume returned, and nothing else is.
/// ring: the volume is that of the whole circle, the third edge the hoop of mean radius.
OnePointStart start_one_point(const Vec3* corners, int dimension, bool ring, const SolidConstants& solid);
inline int one_point_items(int dimension, bool ring) { return dimension == 3 ? OnePoint<3>::items : ring ? OnePoint<2, true>::items : OnePoint<2>::items; }

}  // namespace forming_sim
