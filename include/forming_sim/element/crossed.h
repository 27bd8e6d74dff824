#pragma once
// What the law sees of a cell of four crossed triangles: strains drawn towards the mean of the cell,
//
//   F~_s = F + lambda (F_s - F - beta_s z g_s),   F = sum_s V_s F_s / V,
//
// z the way of the middle node from where the corners would have it, g_s its shape gradient in triangle s.
//
// lambda. A triangle has one edge of the cell and the strain there. Where a bent square cell has -e at one edge and e at the other, two
// triangles have these and two have none: mean square e^2/2 instead of e^2/3. Its middle node moves such that the deviators
// cost least, with the strain e/7 across the fibres, and half of the triangles shear by 6/7 e; the pressure, one a cell,
// knows nothing of it. That makes 4/7 mu e^2 lambda^2 per volume, where E/(1-nu^2) e^2/6 = mu e^2/(3 (1-nu)) is exact, and so
//
//   lambda^2 = 7/(12 (1-nu)),
//
// and 1 where this is more (nu > 5/12): elastic bending is exact. In plastic flow the fibres thin by what they
// lengthen, the shear is nothing, and lambda^2 = 2/3 would be exact: what the cell of a metal has too much is a fourth to a third of its
// own bending, not a half. (Liu, Nguyen-Thoi and Lam, Comput. Methods Appl. Mech. Engrg. 197 (2008), scale the strains
// of triangles about a mean by a factor that is to be chosen.) A rhombus whose medians make the angle theta is stiffer, by nearly 1/sin^2 theta (1/sqrt 2:
// 1.88): lambda is drawn by sin theta more.
//
// beta. Of a cell r times as long as high two triangles shear by r e/2 + 2 z/L, and the middle node that would mend it, z = -r^2 e H/4,
// strains the two others across the fibres by 2 z/H: at r = 4 the cell is 7.5 times too stiff. So those at the long edges see
// z by tau = 1 - beta, those at the short ones by r, where tau is such that elastic bending is exact at any r: with z where it costs least
// 4/3 + r^2 - (1 - 2 t/3)^2/(4/3 t^2 + 1/r^2), t = tau/r, takes the place of 16/7, and is 16/7 for
//
//   (r^2 - 9/7) t^2 + t - 5/(7 r^2) = 0:   tau = r t = 1 at r = 1, .48/r where r is large.
//
// (Only the ratio t enters there. That it is split as 1/r and r keeps the middle node as stiff as in a square cell of the lesser length.)
// What is bent the other way, across the long edges, has .5 to .6 of the stiffness of its own cells, little less than with beta = 0. For
// sum_s V_s F~_s = sum_s V_s F_s the beta_s of other shapes than parallelograms are projected on sum_s beta_s V_s g_s = 0.
//
// Uniform strains stay what they are; so do the forces of uniform stress, since sum_s V_s F~_s = sum_s V_s F_s; no shape
// loses its stiffness, since lambda > 0 and tau > 0. The volumes, and with them the pressure, are the triangles' own, and so
// is the hoop of a ring. Far from the axis a ring is a plane section. At the axis its cells are held by nodes that do not move
// radially, which the sum above does not know, and are left as they are:
//   1 - (1 - lambda)(1 - q^2) in place of lambda,   q = (R_max - R_min)/(R_max + R_min) of the cell's corners, 1 at the axis, 0 far from it,
// and beta_s (1 - q^2) in place of beta_s.
//
// F~_s is that of a triangle with the edges y_c - lambda beta_s sum_b w_b x_b, fixed combinations of the ways x_b from the apex to the corners:
//   y_c = sum_b W_cb x_b,  W_cb = lambda delta_cb + (1 - lambda) sum_s V_s/V X_s^b . X_c,
// X_s^b reciprocal to the edge X_b in s, nothing where s has not got it; z = -sum_b w_b x_b, the least w with sum_b w_b = 1, sum_b w_b X_b = 0.
// The forces on these edges come back through the same weights.
#include <Eigen/Core>
#include <algorithm>
#include <array>

#include "forming_sim/material/constants.h"
#include "forming_sim/mesh/cell_tables.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// Of a cell. corners: its four and its middle.
double crossed_lambda(const SolidConstants& solid, const Vec3* corners, bool ring);

/// What a cell keeps of the above: W_cb at c 4 + b, then -lambda w_b, then beta_s, then up to which |J - 1| triangle s is free of its guard (element/guard.h). by_shape: false for beta = 0.
constexpr int kCrossedApex = 16, kCrossedFreed = 20, kCrossedGuard = 24, kCrossedItems = 28;
/// ratio: r for beta, that of the corners or a later one.
std::array<double, kCrossedItems> crossed_weights(const Vec3* corners, bool ring, double lambda, bool by_shape, double ratio);
/// r: how much longer the first median of a cell is than the second.
double crossed_ratio(const Vec3* corners);

/// The r that a cell is to have in its weights, which now have `of_weights`, when it has flowed from the shape `first` to `now`. What is r times as long as high sees the
/// middle node by r at its short edges. When it has become shorter that is too much: cells that are upset from their ends wind their way down in zigzag (`squeeze`), the
/// faster the more their weights ask for. So these follow where they ask for more than kStale times what the shape does, and are those of a square cell from kFlowed times on:
/// that is no sheet that bends any more.
///
/// What is stretched gives way likewise: corners and middle nodes move in zigzag, the triangles at the short edges turn by r times what their middle node does, and under stress that sets
/// more free than the others cost. A patch of rubber of such cells (6 x 3, the smallest eigenvalue of its stiffness) is stable up to an elongation of its cells, now/first, of
/// 1.7 to 2.2 at r = 2, 1.3 to 1.5 at 3, 1.2 to 1.3 at 5 where it is stretched both ways, 3.6, 2 and 1.6 one way; metals, which are softer along their flow alone, bear more. With the
/// weights of r = 2 longer cells bear as much as those of 2, with those of 1.5 all that was tried. So from stretch_borne() on the weights are those of kLongest, and of what is not longer than that of a square cell:
/// what has been stretched is a membrane first, and its own bending, 1/n^2 of that of n cells through, counts less.
/// Where the middle node goes so far that to the law a triangle has less than kSeen of what it had of its cell at the start, A~_s/A~ < kSeen A~_s0/A~_0 with A~ by the edges of the law, which an impact alone does, r is 1 likewise:
/// at 2 lambda r z/H = 1 the law sees a triangle at the short edges flat while three fifths of it are there.
constexpr double kSeen = 0.7;
constexpr double kStale = 1.25, kFlowed = 2, kMildRatio = 1.2, kLongest = 2;
inline double stretch_borne(double r) { return 1 + std::min(0.7 / r, 2.5 / (r * r)); }
double renewed_ratio(double first, double of_weights, double now);
inline bool is_mild(double of_weights) { return of_weights < kMildRatio && of_weights * kMildRatio > 1; }  ///< these stay as they are

/// Memory of a layer in plane strain or of a ring, G^11, G^22, G^33, G^12, that goes on with other edges of the law: the same B where the volume is the same, and
/// scaled so that J^(-2/3) B, and with it energy and J S, stay what they are. before, after: the two edges as columns.
std::array<double, 4> moved_memory(const std::array<double, 4>& G, const Eigen::Matrix2d& before, const Eigen::Matrix2d& after);

/// sum_b item(first + b) x_b.
template <class Item, class Way> Way crossed_mix(const Item& item, int first, const Way* x) {
  Way y = item(first) * x[0];
  for (int b = 1; b < 4; ++b) y += item(first + b) * x[b];
  return y;
}
/// The two edges of the law of triangle s. x: the ways from the middle to the corners.
template <class Item, class Way> std::array<Way, 2> crossed_edges(const Item& item, const Way* x, int s) {
  const Way drawn = crossed_mix(item, kCrossedApex, x);
  std::array<Way, 2> edges;
  for (int m = 0; m < 2; ++m) edges[m] = crossed_mix(item, kCrossed[s][m + 1] * 4, x) + item(kCrossedFreed + s) * drawn;
  return edges;
}

}  // namespace forming_sim
