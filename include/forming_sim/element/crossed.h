#pragma once
// What the law sees of a cell of four crossed triangles: strains drawn towards the mean of the cell,
//
//   F~_s = F + lambda (F_s - F),   F = sum_s V_s F_s / V.
//
// A triangle has one edge of the cell and the strain there. Where a bent square cell has -e at one edge and e at the other, two
// triangles have these and two have none: mean square e^2/2 instead of e^2/3. Its middle node moves such that the deviators
// cost least, with the strain e/7 across the fibres, and half of the triangles shear by 6/7 e; the pressure, one a cell,
// knows nothing of it. That makes 4/7 mu e^2 lambda^2 per volume, where E/(1-nu^2) e^2/6 = mu e^2/(3 (1-nu)) is exact, and so
//
//   lambda^2 = 7/(12 (1-nu)),
//
// and 1 where this is more (nu > 5/12): elastic bending is exact. In plastic flow the fibres thin by what they
// lengthen, the shear is nothing, and lambda^2 = 2/3 would be exact: what the cell of a metal has too much is a fourth to a third of its
// own bending, not a half. (Liu, Nguyen-Thoi and Lam, Comput. Methods Appl. Mech. Engrg. 197 (2008), scale the strains
// of triangles about a mean by a factor that is to be chosen.)
//
// Uniform strains stay what they are; so do the forces of uniform stress, since sum_s V_s F~_s = sum_s V_s F_s; no shape
// loses its stiffness, since lambda > 0. The volumes, and with them the pressure, are the triangles' own, and so
// is the hoop of a ring. Far from the axis a ring is a plane section. At the axis its cells are held by nodes that do not move
// radially, which the sum above does not know, and are left as they are:
//   1 - (1 - lambda)(1 - q^2) in place of lambda,   q = (R_max - R_min)/(R_max + R_min) of the cell's corners, 1 at the axis, 0 far from it.
//
// F~_s is that of a triangle between the apex and y_c, fixed combinations of the ways x_b from the apex to the corners:
//   y_c = sum_b W_cb x_b,  W_cb = lambda delta_cb + (1 - lambda) sum_s V_s/V X_s^b . X_c,
// X_s^b reciprocal to the edge X_b in s, nothing where s has not got it. The forces on the edges y_c come back through W.
#include <vector>

#include "forming_sim/material/constants.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// Of a cell. corners: its four and its middle.
double crossed_lambda(const SolidConstants& solid, const Vec3* corners, bool ring);

/// W_cb of a cell, [c][b].
constexpr int kCrossedItems = 16;
std::vector<double> crossed_weights(const Vec3* corners, bool ring, double lambda);

}  // namespace forming_sim
