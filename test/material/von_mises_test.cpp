#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <random>

#include "forming_sim/material/law.h"
#include "forming_sim/material/von_mises_points.h"
#include "support/point.h"

namespace forming_sim {
namespace {

Mat3 sample_gradient(double size) {
  Mat3 F;
  F << 1.02, 0.3, -0.1, 0.05, 0.97, 0.2, -0.15, 0.1, 1.05;
  return Mat3::Identity() + size * (F - Mat3::Identity());
}

TEST(VonMises, StressIsTheGradientOfTheEnergy) { EXPECT_LT(distance_from_gradient(solid_of(70e9, 0.34), sample_gradient(1)), 1e-7); }

TEST(VonMises, RotationCarriesNoStressAndTurnsIt) {
  MaterialPoint point(solid_of(70e9, 0.34, perfect(200e6)));
  const Mat3 R = Eigen::AngleAxisd(2.3, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  EXPECT_LT(point.step(R).stress.norm(), 70e9 * 1e-14);
  const Mat3 F = sample_gradient(0.3);
  MaterialPoint other = point;
  const Mat3 sigma = point.step(F).stress, turned = other.step(R * F).stress;
  EXPECT_GT(point.plastic_strain(), 0);
  EXPECT_LT((R * sigma * R.transpose() - turned).norm(), 1e-12 * sigma.norm());
}

// A small shear stores mu gamma^2 / 2: nothing is lost beside the terms of order 1.
TEST(VonMises, EnergyOfASmallShear) {
  const double mu = 26e9, K = 70e9, gamma = 1e-7;
  MaterialPoint point(solid_of(9 * K * mu / (3 * K + mu), (3 * K - 2 * mu) / (2 * (3 * K + mu)), perfect(200e6)));
  Mat3 F = Mat3::Identity();
  F(0, 1) = gamma;
  EXPECT_NEAR(point.step(F).energy, 0.5 * mu * gamma * gamma, 1e-5 * 0.5 * mu * gamma * gamma);
}

TEST(VonMises, UniaxialCycleOfPerfectPlasticity) {  // the paper's Fig. 3
  const double E = 100e9, Y = 1e9;
  MaterialPoint point(solid_of(E, 0.45, perfect(Y)));
  double first = 0;
  const int n = 400;
  for (int i = 1; i <= n; ++i) {
    const double strain = 0.02 * i / n;
    const double sigma = point.uniaxial(1 + strain);
    if (i == 40) first = sigma / strain;  // strain .002, before yield
    if (strain > 0.0105) {
      EXPECT_NEAR(sigma, Y, 1e-9 * Y) << strain;
    }
  }
  EXPECT_NEAR(first, E, 0.01 * E);
  for (int i = 1; i <= 2 * n; ++i) {
    const double strain = 0.02 - 0.04 * i / (2 * n);
    const double sigma = point.uniaxial(1 + strain);
    if (strain < -0.002) {
      EXPECT_NEAR(sigma, -Y, 1e-9 * Y) << strain;
    }
  }
}

TEST(VonMises, SimpleShearDoesNotOscillate) {
  const double G = 26306e6, Y = 192.1e6, nu = 0.34;
  MaterialPoint point(solid_of(2 * G * (1 + nu), nu, perfect(Y)));
  const int n = 20000;
  Mat3 sigma;
  double lowest = 1e300, highest = 0;
  for (int i = 1; i <= n; ++i) {
    Mat3 F = Mat3::Identity();
    F(0, 1) = 5.0 * i / n;
    sigma = point.step(F).stress;
    if (i > n / 5) lowest = std::min(lowest, sigma(0, 1)), highest = std::max(highest, sigma(0, 1));
  }
  EXPECT_NEAR(sigma(0, 1), 110.9077e6, 1e-4 * 110.9e6);
  EXPECT_NEAR(sigma(0, 0) - sigma(1, 1), 0.93519e6, 0.03 * 0.935e6);  // first order in the step
  EXPECT_LT(highest - lowest, 1e-5 * highest);
}

TEST(VonMises, ElasticShearIsLinear) {
  const double G = 26306e6, nu = 0.34;
  MaterialPoint point(solid_of(2 * G * (1 + nu), nu));
  for (double gamma : {0.01, 0.5, 3.0}) {
    Mat3 F = Mat3::Identity();
    F(0, 1) = gamma;
    EXPECT_NEAR(point.step(F, false).stress(0, 1), G * gamma, 1e-12 * G * gamma);
  }
}

class Hardening : public ::testing::TestWithParam<int> {
 public:
  HardeningCurve curve() {
    HardeningCurve h;
    switch (GetParam()) {
      case 0: return perfect(192.1e6);
      case 1: h.kind = HardeningCurve::linear; h.a = 192.1e6; h.d = 500e6; return h;
      case 2: return voce(192.1e6, 429.8e6, 8.504);
      case 3: h.kind = HardeningCurve::swift; h.a = 500e6; h.b = 0.01; h.c = 0.22; return h;
      default:
        h.kind = HardeningCurve::table;
        h.strain = strain_;
        h.stress = stress_;
        h.points = 4;
        return h;
    }
  }
  const double strain_[4] = {0, 0.01, 0.05, 0.2}, stress_[4] = {190e6, 200e6, 260e6, 300e6};
};

TEST_P(Hardening, TheYieldConditionHoldsAfterEveryStep) {
  const HardeningCurve h = curve();
  for (double step : {1e-5, 1e-3, 0.05}) {
    MaterialPoint point(solid_of(70.5e9, 0.34, h));
    for (int i = 1; i <= 6; ++i) {
      const double before = point.plastic_strain();
      const double sigma = point.uniaxial(1 + 0.004 + step * i);
      ASSERT_GT(point.plastic_strain(), before);
      EXPECT_NEAR(sigma, yield_stress(h, point.plastic_strain()).value, 1e-9 * sigma) << "step " << step;
    }
  }
}

TEST_P(Hardening, PlasticStrainAndWorkAreThoseOfATensileTest) {
  const HardeningCurve h = curve();
  const double E = 70.5e9;
  MaterialPoint point(solid_of(E, 0.34, h));
  double sigma = 0, plastic_work = 0, before = 0;
  const int n = 4000;
  for (int i = 1; i <= n; ++i) {
    sigma = point.uniaxial(std::exp(0.15 * i / n));
    plastic_work += 0.5 * (yield_stress(h, point.plastic_strain()).value + yield_stress(h, before).value) * (point.plastic_strain() - before);
    before = point.plastic_strain();
  }
  // J differs from 1 by the elastic volume change only; Hencky and this law differ by O(q_B)
  EXPECT_NEAR(point.plastic_strain(), 0.15 - sigma / E, 2e-5);
  EXPECT_NEAR(point.dissipated(), plastic_work, 2e-3 * plastic_work);
}

// At strains far apart in its lanes, and after ways on either side of what the series reach.
TEST_P(Hardening, APackFollowsTheCurve) {
  const HardeningCurve h = curve();
  const auto exact = [&](double p) {
    switch (h.kind) {
      case HardeningCurve::swift: return h.a * std::pow(h.b + p, h.c);
      case HardeningCurve::voce: return h.a - h.b * std::exp(-h.c * p) + h.d * p;
      case HardeningCurve::table: {
        for (int i = 0; i + 1 < h.points; ++i)
          if (p < h.strain[i + 1]) return h.stress[i] + (h.stress[i + 1] - h.stress[i]) * (p - h.strain[i]) / (h.strain[i + 1] - h.strain[i]);
        return h.stress[h.points - 1];
      }
      default: return h.a + h.d * p;
    }
  };
  using portable::Pack, portable::kWidth;
  const std::vector<double> strains{0, 1e-9, .005, .01, .0499999, .05, .19, 3};
  for (const double way : {0.0, 1e-12, 1e-6, 1e-4, 1e-3, 1e-2, .5}) {
    for (std::size_t i = 0; i < strains.size(); ++i) {
      const double strain = strains[i];
      Pack p(strains[(i + 1) % strains.size()]);  // another one beside it
      const int l = static_cast<int>(i) % kWidth;
      p.v[l] = strain;
      const YieldStress<Pack> at = yield_stress(h, p), beyond = yield_stress_beyond(h, p, at, Pack(way));
      EXPECT_NEAR(at.value[l] / exact(strain), 1, 1e-15) << strain;
      EXPECT_NEAR(beyond.value[l] / exact(strain + way), 1, 1e-15) << strain << " + " << way;
      const YieldStress<double> single = yield_stress(h, strain + way);
      EXPECT_NEAR(beyond.slope[l], single.slope, 1e-13 * single.value / (strain + .01));
      EXPECT_NEAR(beyond.bend[l], single.bend, 1e-12 * single.value / ((strain + .01) * (strain + .01)));
      const double apart = 1e-6;  // the slope is that of the value
      if (h.kind != HardeningCurve::table) {
        EXPECT_NEAR(single.slope, (exact(strain + way + apart) - exact(strain + way - apart)) / (2 * apart), 2e-6 * single.value / (strain + .01));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Curves, Hardening, ::testing::Range(0, 5));

TEST(VonMises, PointsOfABlockAreThoseOneByOne) {
  using portable::Pack, portable::kPacks, portable::kWidth;
  const SolidConstants solid = solid_of(70.5e9, 0.34, voce(192.1e6, 429.8e6, 8.504));
  Symmetric<Pack, 3> B[kPacks];
  Pack J[kPacks], p[kPacks];
  double single_p[kLanes];
  PointResponse<double, 3> single[kLanes];
  for (int l = 0; l < kLanes; ++l) {
    const double s = 1e-3 * l;  // lane 0 stays elastic
    const Symmetric<double, 3> b{{1 + 2 * s, 1 - s, 1 - 0.9 * s, 0.5 * s, -s, 0.2 * s}};
    const int pack = l / kWidth, lane = l % kWidth;
    for (int i = 0; i < 6; ++i) B[pack][i].v[lane] = b[i];
    J[pack].v[lane] = 1 + 1e-3 * (l - 4);
    p[pack].v[lane] = single_p[l] = 0.01 * l;
    const double j = 1 + 1e-3 * (l - 4);
    single[l] = update_layer(solid.layer[0].hardening, stress_factor(solid, j), b, j, single_p[l]);
  }
  const HardeningCurve& curve = solid.layer[0].hardening;
  PointResponse<Pack, 3> packed[kPacks];
  for (int i = 0; i < kPacks; ++i) packed[i] = update_layer(curve, stress_factor(solid, J[i]), B[i], J[i], p[i]);
  int yielding = 0;
  for (int l = 0; l < kLanes; ++l) {
    yielding += single[l].kept < 1;
    const int pack = l / kWidth, lane = l % kWidth;
    EXPECT_NEAR(packed[pack].kept[lane], single[l].kept, 1e-12);
    EXPECT_NEAR(p[pack][lane], single_p[l], 1e-13);
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(packed[pack].S[i][lane], single[l].S[i], 1e-3);
  }
  EXPECT_GT(yielding, 3);
  EXPECT_LT(yielding, kLanes);
}

using OnEdges = std::array<Vector<double, 3>, 3>;  ///< V sigma . x^m
constexpr double kPressure = 3e7;

/// N points, a bundle of material/von_mises_points.h, and what they are told.
template <int N> struct SomePoints {
  Edges<double, 3> e[N];
  double J[N], dissipated[N];
  std::vector<double> items[N];
  OnEdges forces[N];
  bool is_open = false, is_closed = false;

  void open() { is_open = true; }
  void edges(int i, Edges<double, 3>& to) const { std::copy(e[i].x, e[i].x + 3, to.x); }
  double ratio(int i, const Edges<double, 3>&) const {
    EXPECT_TRUE(is_open);
    return J[i];
  }
  double* memory(int i) { return items[i].data(); }
  void dissipate(int i, double what) { dissipated[i] += what; }
  OnEdges* start_forces() { return forces; }
  template <class Pull> void respond(int i, const Edges<double, 3>& with_normals, Pull pull, OnEdges* sums) const {
    EXPECT_DOUBLE_EQ(with_normals.det, e[i].det);
    pull.add(kPressure);
    for (int m = 0; m < 3; ++m) sums[i][m] = pull.on(with_normals, m);
  }
  void close(OnEdges*) { is_closed = true; }
};

/// A step of `count` bundles of N points, at most M, of which some or all yield, in passes, against one point after the other.
/// L: 2 where it is made for two layers.
template <int N, int M, int L = 0> void compare_with_one_after_the_other(int count, int layers, double last) {
  SolidConstants solid = solid_of(70.5e9, 0.34, voce(192.1e6, 429.8e6, 8.504));
  solid.layers = layers;
  for (int k = 0; k < layers; ++k) solid.layer[k].weight = 1.0 / layers;
  if (layers > 1) solid.layer[1].hardening = perfect(300e6);
  SomePoints<N> bundles[M];
  double stretch[N * M];
  for (int i = 0; i < count * N; ++i) {
    stretch[i] = i + 1 == count * N ? last : 0.01 + 0.002 * i;
    SomePoints<N>& points = bundles[i / N];
    const int s = i % N;
    Edges<double, 3> e;
    e.x[0] = {{1 + stretch[i], 0.2 * stretch[i], 0}};
    e.x[1] = {{0.3 * stretch[i], 1 - 0.5 * stretch[i], 0}};
    e.x[2] = {{-0.2 * stretch[i], 0.4 * stretch[i], 1}};
    find_reciprocal(e);
    points.e[s] = e;
    points.J[s] = 6 * e.volume;
    points.dissipated[s] = 0;
    for (int k = 0; k < layers; ++k) points.items[s].insert(points.items[s].end(), {1, 1, 1, 0, 0, 0, 0.01 * k});
  }
  std::vector<std::vector<double>> alone;
  for (int i = 0; i < count * N; ++i) alone.push_back(bundles[i / N].items[i % N]);
  if constexpr (L == 2) layers_of_points<2, N, M, double, 3, false>(solid, bundles, count);
  else von_mises_points<N, M, double, 3, false>(solid, bundles, count);
  for (int i = 0; i < count * N; ++i) {
    const SomePoints<N>& points = bundles[i / N];
    const int s = i % N;
    EXPECT_TRUE(points.is_closed);
    const PointResponse<double, 3> one = von_mises_step(solid, points.e[s], points.J[s], alone[i].data(), Keep::yes);
    EXPECT_EQ(alone[i][6] > 0, stretch[i] > 0) << "point " << i;
    Symmetric<double, 3> sigma = one.S;
    for (int c = 0; c < 3; ++c) sigma[c] += kPressure;
    for (int m = 0; m < 3; ++m) {
      const Vector<double, 3> exact = points.e[s].volume * (sigma * points.e[s].up[m]);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(points.forces[s][m][c], exact[c], 1e-3);
    }
    EXPECT_NEAR(points.dissipated[s], one.dissipation, 1e-11 * one.dissipation);
    for (std::size_t item = 0; item < alone[i].size(); ++item) EXPECT_NEAR(points.items[s][item], alone[i][item], 1e-13);
  }
}
TEST(VonMises, PointsInPassesArePointsOneAfterTheOther) {
  for (int layers : {1, 2})
    for (double last : {0.0, 0.004, 0.02}) {
      compare_with_one_after_the_other<1, 1>(1, layers, last);
      compare_with_one_after_the_other<1, 4>(4, layers, last);
      compare_with_one_after_the_other<1, 4>(3, layers, last);
      compare_with_one_after_the_other<6, 1>(1, layers, last);
      compare_with_one_after_the_other<2, 3>(2, layers, last);
      if (layers == 1) continue;
      compare_with_one_after_the_other<1, 4, 2>(4, layers, last);
      compare_with_one_after_the_other<1, 4, 2>(3, layers, last);
      compare_with_one_after_the_other<6, 1, 2>(1, layers, last);
      compare_with_one_after_the_other<2, 3, 2>(2, layers, last);
    }
}

/// Of edges in any direction, stretched `flat` times along x, and a memory near their metric, as metals have it.
template <int D, bool Ring> void expect_invariants_without_b(double flat) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int trial = 0; trial < 50; ++trial) {
    Edges<double, D, Ring> e;
    for (int m = 0; m < D; ++m)
      for (int i = 0; i < D; ++i) e.x[m][i] = (m == i) + 0.4 * any(random);
    for (int m = 0; m < D; ++m) e.x[m][0] *= flat;
    if constexpr (Ring) e.x[2] = {{0.7, 0}};
    find_reciprocal(e);
    Symmetric<double, D> G = metric_of<D, Ring>(e.up, 1.0);
    for (int c = 0; c < Symmetric<double, D>::size; ++c) G[c] *= 1 + 0.004 * any(random);
    Trial<double> by_b, without;
    find_trial(push(G, e), by_b);
    find_trial(G, find_upright(e), without);
    const double size = std::sqrt(by_b.m), error = 2e-15 * std::max(flat * flat, 1 / (flat * flat));  // of B, both ways
    EXPECT_GT(size, 1e-4);
    EXPECT_NEAR(without.s, by_b.s, error);
    EXPECT_NEAR(without.m, by_b.m, error * size);
    EXPECT_NEAR(without.d, by_b.d, error * size * size);
  }
}
TEST(UprightEdges, InvariantsAreThoseOfB) {
  for (double flat : {1.0, 0.1, 30.0}) {
    expect_invariants_without_b<3, false>(flat);
    expect_invariants_without_b<2, false>(flat);
    expect_invariants_without_b<2, true>(flat);
  }
}
TEST(Normals, MetricIsThatOfTheReciprocalVectors) {
  Edges<double, 3> e;
  e.x[0] = {{1, 0.2, -0.3}};
  e.x[1] = {{0.1, 0.9, 0.4}};
  e.x[2] = {{-0.2, 0.5, 1.1}};
  find_reciprocal(e);
  const Symmetric<double, 3> direct = metric_of<3, false>(e.up, 1.0), found = metric_of_normals(e);
  for (int c = 0; c < 6; ++c) EXPECT_NEAR(found[c] / (e.det * e.det), direct[c], 1e-14);
}

// By its series on both sides of 1, and beyond where that is right.
TEST(VonMises, PowerOfTheVolumeRatio) {
  for (double d : {-0.9, -0.05, -0.0201, -0.0199, -0.01, -0.0041, -0.0039, -1e-5, 0.0, 1e-5, 0.0039, 0.0041, 0.01, 0.0199, 0.0201, 0.1, 3.0})
    EXPECT_NEAR(power_minus_five_thirds(1 + d) * std::pow(1 + d, 5.0 / 3), 1, std::abs(d) < 0.02 ? 5e-16 : 2e-14) << d;
  portable::Pack J(1.001);
  J.v[1] = 1.3;  // one lane far away
  for (int lane : {0, 1}) EXPECT_NEAR(power_minus_five_thirds(J)[lane] * std::pow(J[lane], 5.0 / 3), 1, 2e-14);
}

TEST(Pack, Logarithm) {
  using portable::Pack;
  const auto check = [](double x) { EXPECT_NEAR(log(Pack(x))[1], std::log(x), 3e-16 * (1 + std::fabs(std::log(x)))) << x; };
  for (double x : {1e-300, 1e-9, .5, .999999999, 1.0, 1.000000001, 2.0, 1e300}) check(x);
  for (double x = .4; x < 2.5; x += 1.0 / 1024) check(x);
}

TEST(Pack, ExponentialAndCubeRoot) {
  using portable::Pack;
  for (double x : {-690.0, -30.0, -1.0, -1e-9, 0.0, 0.3, 1.0, 20.0, 690.0}) EXPECT_NEAR(exp(Pack(x))[1] / std::exp(x), 1, 4.5e-16);
  for (double x = -3; x < 3; x += 1.0 / 64) EXPECT_NEAR(exp(Pack(x))[1] / std::exp(x), 1, 4.5e-16) << x;
  for (double J : {0.05, 0.7, 0.999, 1.0, 1.3, 3.9, 20.0, 35.9, 36.1, 200.0, 1e6}) {
    EXPECT_NEAR(inverse_cube_root(J) * std::cbrt(J), 1, 1e-14);
    EXPECT_NEAR(inverse_cube_root(Pack(J))[1] * std::cbrt(J), 1, 1e-14);
  }
}

}  // namespace
}  // namespace forming_sim
