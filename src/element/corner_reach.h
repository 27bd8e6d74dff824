#pragma once
// Up to which square of the strains that vary across a one-point cell none of its corners comes near to its guard
// (element/corner_guard.h).
//
// The strains e give the amplitudes z, these the displacements of the corners that F does not see, and so H of every
// corner: its edges are (I + H) those of the start, and
//   q = det(I + H) = 1 + tr H + I2 + det H >= 1 - l1 s - (l s)^2 - (l s)^3/sqrt 27,   s = |e|,
// l1 and l the norms of e -> tr H and e -> H. In a section I2 = det H is nothing: all corners move along one vector. H is
// taken between the edges' unit vectors, whose lengths differ: no determinant sees it.
#include <Eigen/LU>

#include "forming_sim/element/corner_guard.h"
#include "forming_sim/element/hourglass_strain.h"

namespace forming_sim {

/// The edges of a cell that meet at corner a, as columns. x: its corners.
template <int D, int N> Eigen::Matrix<double, D, D> corner_edges(const Eigen::Matrix<double, D, N>& x, int a) {
  Eigen::Matrix<double, D, D> edges;
  for (int i = 0; i < D; ++i) edges.col(i) = -kCornerSides[a][i] * (x.col(kNextCorner[a][i]) - x.col(a));
  return edges;
}

/// X, w, h: positions, weights and modes of the corners as columns; X_m: the edges of the start; fibres: those that take z.
template <int D, int N, int M>
double corner_reach(const Eigen::Matrix<double, D, N>& X, const Eigen::Matrix<double, D, N>& w, const Eigen::Matrix<double, M, N>& h,
                    const Eigen::Matrix<double, D, D>& X_m, const Fibres<double, D>& fibres, const double* constants, const double* corner) {
  constexpr int size = M * D;
  using Square = Eigen::Matrix<double, D, D>;
  Eigen::Matrix<double, N, N> all;  // of displacements: their sum, F, the modes
  all << Eigen::Matrix<double, 1, N>::Ones(), w, h;
  const Eigen::Matrix<double, N, N> inverse = all.inverse();
  const auto shapes = inverse.template rightCols<M>();

  Eigen::Matrix<double, size, size> strains;  // of z
  for (int k = 0; k < size; ++k) {
    Vector<double, D> z[M] = {};
    z[k / D][k % D] = 1;
    HourglassStrain<double, D> e;
    e.from(z, fibres, constants);
    for (int d = 0; d < D; ++d) {
      if constexpr (D == 2) {
        strains(d, k) = e.plane[d].a;
      } else {
        strains.template block<3, 1>(3 * d, k) << e.plane[d].a, e.plane[d].b, e.plane[d].shear;
        strains(9 + d, k) = e.warp[d];
      }
    }
  }
  const Eigen::Matrix<double, size, size> z_of_strains = strains.inverse();

  double reach = 1e300;
  for (int a = 0; a < N; ++a) {
    if (!(corner[a] > 0)) continue;
    const Square edges = corner_edges<D, N>(X, a);
    Eigen::Matrix<double, D, M> moved;  // of each edge by the modes
    for (int i = 0; i < D; ++i) moved.row(i) = -kCornerSides[a][i] * (shapes.row(kNextCorner[a][i]) - shapes.row(a));
    const Eigen::Matrix<double, D, 1> length = edges.colwise().norm().transpose();
    const Square along = length.asDiagonal() * edges.inverse() * X_m;  // X_m in terms of the edges' unit vectors
    Eigen::Matrix<double, D * D, size> H;
    for (int k = 0; k < size; ++k)
      for (int i = 0; i < D; ++i) H.template block<D, 1>(D * i, k) = moved(i, k / D) / length[i] * along.col(k % D);
    H = H * z_of_strains;
    Eigen::Matrix<double, 1, size> traces = H.row(0);
    for (int i = 1; i < D; ++i) traces += H.row((D + 1) * i);
    const double l1 = traces.norm(), l = D == 2 ? 0 : H.norm();
    double s = (1 - kFreeCorner) / l1;
    for (int n = 0; n < 20; ++n) {  // Newton's method on a convex function, from above
      const double ls = l * s, excess = l1 * s + ls * ls + ls * ls * ls / std::sqrt(27.) - (1 - kFreeCorner);
      s -= excess / (l1 + 2 * l * ls + 3 * l * ls * ls / std::sqrt(27.));
    }
    reach = std::min(reach, s);
  }
  return (1 - 1e-6) * reach * reach;
}

}  // namespace forming_sim
