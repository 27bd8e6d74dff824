#include "forming_sim/element/one_point.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "element/corner_reach.h"
#include "forming_sim/element/corner_guard.h"
#include "forming_sim/element/hourglass_strain.h"

namespace forming_sim {
namespace {

/// Corner a's shape function prod (1 + xi_a xi)/2 at a point, and its gradient there.
template <int D> double shape_function(int a, const double* xi, double* gradient) {
  double value = 1;
  for (int i = 0; i < D; ++i) {
    value *= 0.5 * (1 + kCornerSides[a][i] * xi[i]);
    gradient[i] = 0.5 * kCornerSides[a][i];
    for (int j = 0; j < D; ++j)
      if (j != i) gradient[i] *= 0.5 * (1 + kCornerSides[a][j] * xi[j]);
  }
  return value;
}

constexpr double kNoTwist = 1e-11;  ///< twist, over the size of the sides' shares, that is none: cells of one block may differ by as much (element/alike.h)

template <int D, bool Ring = false> class Start {
  using Cell = OnePoint<D, Ring>;
  static constexpr int N = Cell::nodes, M = Cell::modes;
  using Square = Eigen::Matrix<double, D, D>;
  using Corners = Eigen::Matrix<double, D, N>;
  using Modes = Eigen::Matrix<double, M, N>;

 public:
  OnePointStart result;

  Start(const Vec3* corners, const SolidConstants& solid) {
    for (int a = 0; a < N; ++a) X_.col(a) = corners[a].head<D>();
    if (!integrate()) return;
    find_frame();
    if constexpr (Ring) put_hoop();
    put_weights();
    Eigen::Matrix<double, M, D> start = h_ * X_.transpose() * E_ / c_;
    for (int k = 0; k < M; ++k) put(Cell::start + k * D, Eigen::Matrix<double, D, 1>(start.row(k)));
    put_strain(start);
    Eigen::Matrix<double, N, 1> share;
    for (int a = 0; a < N; ++a) share[a] = result.share[a];
    const Square inertia = w_ * share.cwiseInverse().asDiagonal() * w_.transpose();
    put_pairs(Cell::inertia, inertia);
    bound_step(h_ - start * w_, share, inertia, solid);
    put_corners();
  }

 private:
  /// V0, b_a and the masses, by 2^D Gauss points: all of these are exact.
  bool integrate() {
    b_.setZero();
    result.constants.assign(Cell::items, 0.0);
    for (int p = 0; p < N; ++p) {
      double xi[D], slope[D];
      for (int i = 0; i < D; ++i) xi[i] = kCornerSides[p][i] / std::sqrt(3.0);
      Corners dN;  // d N_a / d xi_i
      double value[N];
      for (int a = 0; a < N; ++a) {
        value[a] = shape_function<D>(a, xi, slope);
        for (int i = 0; i < D; ++i) dN(i, a) = slope[i];
      }
      const Square J = X_ * dN.transpose();
      const double det = J.determinant();
      double circle = 1;  // of this point, in a ring
      if constexpr (Ring) {
        circle = 0;
        for (int a = 0; a < N; ++a) circle += kTwoPi * value[a] * X_(0, a);
      }
      const double volume = circle * det;
      if (!(det > 0) || !(volume > 0)) {
        result.volume = std::min(volume, 0.0);
        return false;
      }
      extent_ += det;
      result.volume += volume;
      b_ += volume * J.inverse().transpose() * dN;
      for (int a = 0; a < N; ++a) {
        result.share[a] += volume * value[a];
        even_[a] += det * value[a];
      }
    }
    b_ /= result.volume;
    for (double& s : result.share) s /= result.volume;
    return true;
  }

  /// The frame nearest to the edges, from the polar decomposition of the Jacobian at the centre.
  void find_frame() {
    Corners dN;
    const double centre[3] = {0, 0, 0};
    double slope[D];
    for (int a = 0; a < N; ++a) {
      shape_function<D>(a, centre, slope);
      for (int i = 0; i < D; ++i) dN(i, a) = slope[i];
      for (int k = 0; k < M; ++k) h_(k, a) = kHourglass<D>[k][a];
    }
    const Square J = X_ * dN.transpose();
    const Eigen::JacobiSVD<Square> svd(J, Eigen::ComputeFullU | Eigen::ComputeFullV);
    E_ = svd.matrixU() * svd.matrixV().transpose();
    c_ = D == 2 ? std::sqrt(2 * extent_) : std::cbrt(6 * extent_);
    w_ = c_ * E_.transpose() * b_;
    const Square U = E_.transpose() * J;
    for (int i = 0; i < D; ++i) {
      const double slope = c_ / (N * U.col(i).norm());
      put(Cell::fibres + D * i, Eigen::Matrix<double, D, 1>(slope * U.col(i).normalized()));
      result.constants[Cell::slopes + i] = slope;
    }
    if constexpr (D == 3)
      for (int d = 0; d < 3; ++d) {
        const int i = (d + 1) % 3, j = (d + 2) % 3;
        const double* slope = result.constants.data() + Cell::slopes;
        const Vec3 a = U.col(i).normalized(), b = U.col(j).normalized();
        const double sine = a.cross(b).norm(), cotangent = a.dot(b) / sine;
        const double skew[4] = {cotangent, 1 / (sine * sine), slope[j] / (slope[i] * sine), slope[i] / (slope[j] * sine)};
        for (int k = 0; k < 4; ++k) result.constants[Cell::skew + 4 * d + k] = skew[k];
      }
    result.edges.template topLeftCorner<D, D>() = c_ * E_;
  }

  /// w_ma by the signs of sides and modes, which are orthogonal.
  void put_weights() {
    Eigen::Matrix<double, D, N> sides;
    for (int a = 0; a < N; ++a)
      for (int i = 0; i < D; ++i) sides(i, a) = kCornerSides[a][i];
    const Square linear = sides * w_.transpose() / N;
    Eigen::Matrix<double, M, D> twist = h_ * w_.transpose() / N;
    twist = (twist.array().abs() > kNoTwist * linear.norm()).select(twist, 0.0);
    for (int i = 0; i < D; ++i) put(Cell::linear + i * D, Eigen::Matrix<double, D, 1>(linear.row(i)));
    for (int k = 0; k < M; ++k) put(Cell::twist + k * D, Eigen::Matrix<double, D, 1>(twist.row(k)));
    result.constants[Cell::twisted] = twist.cwiseAbs().maxCoeff();
  }

  /// The fibres that take z.
  Fibres<double, D> fibres() const {
    Vector<double, D> unit[D] = {};
    for (int m = 0; m < D; ++m) unit[m][m] = 1;
    return Fibres<double, D>(result.constants.data(), unit);
  }

  void put_strain(const Eigen::Matrix<double, M, D>& start) {
    Vector<double, D> z[M];
    for (int k = 0; k < M; ++k)
      for (int m = 0; m < D; ++m) z[k][m] = start(k, m);
    double* to = result.constants.data() + Cell::strain;
    HourglassStrain<double, D> strain;
    strain.from(z, fibres(), result.constants.data());
    for (int d = 0; d < D; ++d) {
      *to++ = strain.plane[d].a;
      if (D == 2) continue;
      *to++ = strain.plane[d].b;
      *to++ = strain.plane[d].shear;
    }
    if (D == 3)
      for (double warp : strain.warp) *to++ = warp;
  }

  void put_hoop() {
    double slope[2] = {}, radius = 0;
    for (int a = 0; a < N; ++a) {
      const double share = even_[a] / extent_;
      radius += share * X_(0, a);
      for (int i = 0; i < 2; ++i) slope[i] += 0.25 * kCornerSides[a][i] * X_(0, a);
      result.constants[Cell::hoop + a] = share;
    }
    for (int i = 0; i < 2; ++i) result.constants[Cell::hoop_start + i] = slope[i] / radius;
    result.edges(2, 2) = radius;
  }

  /// The modes in terms of the mass: gamma = L Q with rows of Q of unit length in 1/share.
  /// Their stiffness per volume is (L^T x 1) k (L x 1) between components m, and not larger than
  /// diag(stiffness_m) by Gershgorin's circles after scaling.
  void bound_step(const Modes& gamma, const Eigen::Matrix<double, N, 1>& share, const Square& inertia, const SolidConstants& solid) {
    const auto inverse = share.cwiseInverse().asDiagonal();
    const Eigen::Matrix<double, M, M> P = gamma * inverse * gamma.transpose();
    const Eigen::Matrix<double, M, M> L = P.llt().matrixL();
    Eigen::Matrix<double, M * D, M * D> k;
    for (int column = 0; column < M * D; ++column) {
      Vector<double, D> z[M] = {}, g[M];
      for (int a = 0; a < M; ++a) z[a][column % D] = L(a, column / D);
      hourglass_stiffness<D>(solid, fibres(), result.constants.data(), z, g);
      for (int row = 0; row < M * D; ++row) {
        k(row, column) = 0;
        for (int a = 0; a < M; ++a) k(row, column) += L(a, row / D) * g[a][row % D];
      }
    }
    double scale[D] = {}, circle = 0;
    for (int i = 0; i < M * D; ++i) scale[i % D] = std::max(scale[i % D], k(i, i));
    for (int i = 0; i < M * D; ++i) {
      double sum = 0;
      for (int j = 0; j < M * D; ++j) sum += std::abs(k(i, j)) / std::sqrt(scale[i % D] * scale[j % D]);
      circle = std::max(circle, sum);
    }
    double* constants = result.constants.data();
    for (int m = 0; m < D; ++m) constants[Cell::stiffness + m] = circle * scale[m];
    constants[Cell::looseness] = 1 / Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, M, M>>(P, Eigen::EigenvaluesOnly).eigenvalues()[0];
    const Square root = inertia.llt().matrixL();
    const Eigen::Matrix<double, D, M> cosines =
        root.inverse() * (w_ * inverse * gamma.transpose()) * L.inverse().transpose();
    constants[Cell::slant] = cosines.norm();
  }

  /// Of the guard of corners. N j_a over the sum of all is what a corner has of its even share.
  void put_corners() {
    double j[N], sum = 0;
    for (int a = 0; a < N; ++a) sum += j[a] = corner_edges<D, N>(X_, a).determinant();
    double* constants = result.constants.data();
    const Square X_m = c_ * E_;
    for (int a = 0; a < N; ++a) {
      constants[Cell::share + a] = result.share[a];
      constants[Cell::corner + a] = N * j[a] < kLeastCorner * sum ? 0 : X_m.determinant() / j[a];
    }
    constants[Cell::near] = corner_reach<D, N, M>(X_, w_, h_, X_m, fibres(), constants, constants + Cell::corner);
  }

  template <class Vector> void put(int at, const Vector& values) {
    for (int i = 0; i < D; ++i) result.constants[at + i] = values[i];
  }
  void put_pairs(int at, const Square& A) {
    for (int i = 0; i < D; ++i)
      for (int j = 0; j <= i; ++j) result.constants[at + kPair<D>[i][j]] = A(i, j);
  }

  Corners X_, b_, w_;
  Modes h_;
  Square E_;
  double c_ = 0, extent_ = 0;  ///< extent: volume, of a ring the area of its section
  double even_[N] = {};        ///< int N_a over the section
};

}  // namespace

OnePointStart start_one_point(const Vec3* corners, int dimension, bool ring, const SolidConstants& solid) {
  if (ring) return Start<2, true>(corners, solid).result;
  if (dimension == 2) return Start<2>(corners, solid).result;
  return Start<3>(corners, solid).result;
}

}  // namespace forming_sim
