#include "forming_sim/mesh/surface_strain.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace forming_sim {

SurfaceStrain strain_of_segment(const std::array<Vec3, 3>& X, const std::array<Vec3, 3>& x, bool axisymmetric) {
  const double along = std::log((x[1] - x[0]).norm() / (X[1] - X[0]).norm());
  const double across = axisymmetric ? std::log((x[0].x() + x[1].x()) / (X[0].x() + X[1].x())) : 0;
  return {std::max(along, across), std::min(along, across)};
}

SurfaceStrain strain_of_triangle(const std::array<Vec3, 3>& X, const std::array<Vec3, 3>& x) {
  const Vec3 A = X[1] - X[0], B = X[2] - X[0], a = x[1] - x[0], b = x[2] - x[0];
  // C = E^-T (edges now) E^-1 in the facet's initial plane; its eigenvalues are the squares of the stretches,
  // their product that of the areas
  Eigen::Matrix2d initial, now;
  initial << A.dot(A), A.dot(B), A.dot(B), B.dot(B);
  now << a.dot(a), a.dot(b), a.dot(b), b.dot(b);
  const Eigen::Matrix2d C = initial.inverse() * now;
  const double middle = 0.5 * C.trace(), apart = 0.5 * (C(0, 0) - C(1, 1));
  const double largest = middle + std::sqrt(std::max(0.0, apart * apart + C(0, 1) * C(1, 0)));
  return {0.5 * std::log(largest), 0.5 * std::log(now.determinant() / initial.determinant() / largest)};
}

}  // namespace forming_sim
