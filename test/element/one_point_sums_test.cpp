// The corners of a one-point cell by their sums (element/one_point_sums.h).
#include "forming_sim/element/one_point_sums.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "support/moved.h"

namespace forming_sim {
namespace {

/// A cell and what it starts with.
template <int D> struct Started {
  static constexpr int N = OnePoint<D>::nodes;
  Vec3 X[8];
  OnePointStart start;

  /// Corners of the unit cell moved by up to `shake`, and then sheared.
  explicit Started(double shake, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> along(-shake, shake);
    for (int a = 0; a < N; ++a) {
      Vec3 at = Vec3::Zero();
      for (int i = 0; i < D; ++i) at[i] = 0.5 * kCornerSides[a][i] + along(random);
      X[a] = Vec3(at.x() + 0.4 * at.y() + 0.1 * at.z(), 0.6 * at.y() - 0.2 * at.x(), at.z() + 0.3 * at.y());
      if (D == 2) X[a].z() = 0;
    }
    start = started();
  }
  OnePointStart started() const {
    CurveTables curves;
    return start_one_point(X, D, false, solid_constants(aluminium(), curves));
  }
  const double* constants() const { return start.constants.data(); }
};

/// w_ma = c E_m . dV0/dX_a / V0, X_m = c E_m, by central differences of the volume.
template <int D> void expect_weights_from_volume(Started<D> cell) {
  const double h = 1e-5;
  for (int a = 0; a < Started<D>::N; ++a) {
    Vec3 slope = Vec3::Zero();
    for (int i = 0; i < D; ++i)
      for (int side : {1, -1}) {
        const Vec3 at = cell.X[a];
        cell.X[a][i] += side * h;
        slope[i] += side * cell.started().volume / (2 * h);
        cell.X[a] = at;
      }
    for (int m = 0; m < D; ++m) EXPECT_NEAR((corner_weight<double, D>(cell.constants(), a, m)), cell.start.edges.col(m).dot(slope) / cell.start.volume, 1e-9);
  }
}

template <int D> void expect_sums_of_weights(const Started<D>& cell, unsigned seed) {
  constexpr int N = Started<D>::N, modes = OnePoint<D>::modes;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  Vector<double, D> x[N], edge[D], on_edge[D], r[modes];
  for (auto& each : x) repeat<D>([&](auto i) { each[i] = number(random); });
  for (auto& each : on_edge) repeat<D>([&](auto i) { each[i] = number(random); });
  for (auto& each : r) repeat<D>([&](auto i) { each[i] = number(random); });
  CornerSums<double, D> sums;
  sums.add_all(x);
  sums.find_edges(cell.constants(), edge);
  const CornerForces<double, D> forces(cell.constants(), on_edge, r);
  Vector<double, D> f[N], all{};
  repeat<N / 2>([&](auto a) { forces.template at<a>(f[a], f[a + N / 2]); });
  const auto weight = [&](int a, int m) { return corner_weight<double, D>(cell.constants(), a, m); };
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k < modes; ++k) {
      double sum = 0;
      for (int a = 0; a < N; ++a) sum += kHourglass<D>[k][a] * x[a][i];
      EXPECT_NEAR(sums.mode[k][i], sum, 1e-14);
    }
    for (int m = 0; m < D; ++m) {
      double sum = 0;
      for (int a = 0; a < N; ++a) sum += weight(a, m) * x[a][i];
      EXPECT_NEAR(edge[m][i], sum, 1e-14);
    }
    for (int a = 0; a < N; ++a) {
      double sum = 0;
      for (int m = 0; m < D; ++m) sum += weight(a, m) * on_edge[m][i];
      for (int k = 0; k < modes; ++k) sum -= kHourglass<D>[k][a] * r[k][i];
      EXPECT_NEAR(f[a][i], sum, 1e-14);
      all[i] += f[a][i];
    }
    EXPECT_NEAR(all[i], 0, 1e-14);
  }
}

TEST(OnePointSums, WeightsAreTheGradientOfTheVolume) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    expect_weights_from_volume(Started<2>(0.15, seed));
    expect_weights_from_volume(Started<3>(0.15, seed));
  }
  expect_weights_from_volume(Started<2>(0, 1));
  expect_weights_from_volume(Started<3>(0, 1));
}

TEST(OnePointSums, EdgesAndForcesAreThoseOfTheWeights) {
  for (unsigned seed = 1; seed <= 5; ++seed)
    for (double shake : {0.0, 0.15}) {
      expect_sums_of_weights(Started<2>(shake, seed), seed);
      expect_sums_of_weights(Started<3>(shake, seed), seed);
    }
}

// Of a quadrilateral in the plane b_a is across h_a, whatever its shape.
TEST(OnePointSums, OnlyHexahedraThatAreNoParallelepipedsHaveTwist) {
  EXPECT_FALSE((is_twisted<double, 3>(Started<3>(0, 1).constants())));
  for (double shake : {1e-6, 0.15}) {
    EXPECT_FALSE((is_twisted<double, 2>(Started<2>(shake, 1).constants())));
    EXPECT_TRUE((is_twisted<double, 3>(Started<3>(shake, 1).constants())));
  }
}

// Neither has a brick of a tenth of a millimetre a metre from the origin, whose corners are rounded there.
TEST(OnePointSums, ASmallBrickFarAwayHasNoTwist) {
  Started<3> cell(0, 1);
  for (Vec3& X : cell.X) X = Vec3(1.1, 0.7, -1.3) + 1e-4 * X;
  cell.start = cell.started();
  EXPECT_FALSE((is_twisted<double, 3>(cell.constants())));
}

}  // namespace
}  // namespace forming_sim
