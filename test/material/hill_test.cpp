// Hill's anisotropic yield at a single point: the numbers of tension in every direction, normality, without anisotropy von Mises,
// turns, work, sections, and axes that go with the material.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "forming_sim/material/law.h"
#include "forming_sim/material/material_point.h"
#include "support/point.h"

namespace forming_sim {
namespace {

constexpr double kE = 70e9, kNu = 0.3, kYield = 150e6;

AnisotropyConfig ratios(double r0, double r45, double r90, const Vec3& rolling = Vec3::Zero(), const Vec3& normal = Vec3::Zero()) {
  AnisotropyConfig config;
  config.r0 = r0, config.r45 = r45, config.r90 = r90;
  config.rolling_direction = rolling;
  config.sheet_normal = normal;
  return config;
}

SolidConstants sheet(const AnisotropyConfig& anisotropy, HardeningCurve curve = perfect(kYield)) {
  SolidConstants s = solid_of(kE, kNu, curve);
  s.law = Law::hill;
  s.orthotropy = orthotropy_of(anisotropy);
  return s;
}

/// Plastic strains of a tension along x to `stretch`, let go: stress before, and the logarithmic strains that stay.
struct Tension {
  double stress;
  Vec3 strain;
};
Tension tension(const SolidConstants& solid, double stretch = 1.02) {
  MaterialPoint point(solid);
  Tension result{};
  for (int i = 1; i <= 1000; ++i) result.stress = point.uniaxial(std::pow(stretch, i / 1000.));
  for (int i = 0; i < 3; ++i) result.strain[i] = std::log(point.deformation()(i, i));
  result.strain -= result.stress / kE * Vec3(1, -kNu, -kNu);
  return result;
}

// sigma(angle)/sigma(0) and r(angle) of Hill's sheet.
TEST(Hill, TensionAlongAcrossAndBetween) {
  const double r0 = 0.7, r90 = 1.8;
  const Tension along = tension(sheet(ratios(r0, 1.3, r90)));
  EXPECT_NEAR(along.stress, kYield, 1e-6 * kYield);
  EXPECT_NEAR(along.strain.y() / along.strain.z(), r0, 5e-3 * r0);
  const Tension across = tension(sheet(ratios(r0, 1.3, r90, Vec3::UnitY())));
  EXPECT_NEAR(across.stress, kYield * std::sqrt(r90 * (1 + r0) / (r0 * (1 + r90))), 1e-6 * kYield);
  EXPECT_NEAR(across.strain.y() / across.strain.z(), r90, 5e-3 * r90);
  // at 45 degrees nothing shears where r0 = r90
  const double r = 0.8, r45 = 1.6, G = 1 / (1 + r), N = G * (1 + 2 * r45);
  const Tension between = tension(sheet(ratios(r, r45, r, Vec3(1, 1, 0))));
  EXPECT_NEAR(between.stress, 2 * kYield / std::sqrt(2 * G + 2 * N), 1e-6 * kYield);
  EXPECT_NEAR(between.strain.y() / between.strain.z(), r45, 5e-3 * r45);
  // through the thickness: 1/sqrt(F + G)
  const Tension through = tension(sheet(ratios(r0, 1.3, r90, Vec3::UnitZ(), Vec3::UnitX())));
  EXPECT_NEAR(through.stress, kYield / std::sqrt((r0 / r90 + 1) / (1 + r0)), 1e-6 * kYield);
}

TEST(Hill, OneRatioIsTheSameInThePlane) {
  const SolidConstants one = sheet(ratios(2, 0, 0));
  for (double angle : {0., 0.3, 0.8}) {
    const Tension at = tension(sheet(ratios(2, 2, 2, Vec3(std::cos(angle), std::sin(angle), 0))));
    EXPECT_NEAR(at.stress, kYield, 1e-6 * kYield);
    EXPECT_NEAR(at.strain.y() / at.strain.z(), 2, 0.01);
  }
  for (int i = 0; i < 5; ++i) EXPECT_EQ(one.orthotropy.space.p[i], sheet(ratios(2, 2, 2)).orthotropy.space.p[i]);
}

Mat3 wild_path(double t) {
  Mat3 F = Mat3::Identity();
  F(0, 0) += 0.08 * t;
  F(1, 1) -= 0.05 * t * t;
  F(2, 2) -= 0.02 * t;
  F(0, 1) = 0.1 * std::sin(3 * t);
  F(1, 2) = 0.06 * t * (1 - t);
  F(2, 0) = -0.05 * t;
  return F / std::cbrt(F.determinant());
}

TEST(Hill, WithoutAnisotropyItIsVonMises) {
  const HardeningCurve curve = voce(kYield, 300e6, 12);
  MaterialPoint hill(sheet(ratios(1, 1, 1), curve)), mises(solid_of(kE, kNu, curve));
  for (int i = 1; i <= 4000; ++i) {
    const Mat3 F = wild_path(i / 4000.), a = hill.step(F).stress, b = mises.step(F).stress;
    ASSERT_LT((a - b).norm(), 1e-4 * b.norm() + 1e3) << i;
  }
  EXPECT_GT(mises.plastic_strain(), 0.05);
  EXPECT_NEAR(hill.plastic_strain(), mises.plastic_strain(), 1e-4 * mises.plastic_strain());
  EXPECT_NEAR(hill.dissipated(), mises.dissipated(), 1e-4 * mises.dissipated());
}

double hill_norm(const SolidConstants& solid, const Mat3& S) {  // in the axes x, y, z
  const HillModes& h = solid.orthotropy.space;
  double q2 = 0;
  for (int k = 0; k < 2; ++k) {
    double y = 0;
    for (int i = 0; i < 3; ++i) y += h.normal[k][i] * S(i, i);
    q2 += h.p[k] * y * y;
  }
  for (int i = 0; i < 3; ++i) q2 += h.p[2 + i] * 2 * S(i, (i + 1) % 3) * S(i, (i + 1) % 3);
  return std::sqrt(q2);
}

TEST(Hill, TheModesAreTheFormula) {
  const double r0 = 0.7, r45 = 1.3, r90 = 1.8, G = 1 / (1 + r0), H = r0 * G, F = H / r90, N = (F + G) * (1 + 2 * r45) / 2;
  Mat3 S;
  S << 3, 1.1, -0.4, 1.1, -2, 0.9, -0.4, 0.9, 0.6;
  const auto square = [](double a) { return a * a; };
  const double q2 = F * square(S(1, 1) - S(2, 2)) + G * square(S(2, 2) - S(0, 0)) + H * square(S(0, 0) - S(1, 1)) + 3 * square(S(1, 2)) + 3 * square(S(2, 0)) + 2 * N * square(S(0, 1));
  EXPECT_NEAR(hill_norm(sheet(ratios(r0, r45, r90)), S), std::sqrt(q2), 1e-14 * q2);
}

// A straight path of small strain: what stays when all is let go is normal to the surface at the stress.
TEST(Hill, FlowIsNormalAndTheStressStaysOnTheSurface) {
  const SolidConstants solid = sheet(ratios(0.6, 1.7, 2.2));
  MaterialPoint point(solid);
  Mat3 direction;
  direction << 1, 0.4, -0.3, 0.4, -0.7, 0.5, -0.3, 0.5, -0.3;
  Mat3 stress, F = Mat3::Identity();
  for (int i = 1; i <= 250; ++i) stress = point.step(F = Mat3::Identity() + 2e-5 * i * direction).stress;  // by then the stress has come to its place
  EXPECT_NEAR(hill_norm(solid, stress), kYield, 2e-3 * kYield);  // the axes turn by as much
  const double p = point.plastic_strain(), work = point.dissipated();
  const Mat3 dF = 2e-5 * direction, next = point.step(F + dF).stress;
  Mat3 N;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      Mat3 plus = stress, minus = stress;
      const double h = 1e-4 * kYield;
      plus(i, j) += 0.5 * h, plus(j, i) += 0.5 * h;
      minus(i, j) -= 0.5 * h, minus(j, i) -= 0.5 * h;
      N(i, j) = (hill_norm(solid, plus) - hill_norm(solid, minus)) / (2 * h);
    }
  const auto deviator = [](const Mat3& A) -> Mat3 { return A - A.trace() / 3 * Mat3::Identity(); };
  const Mat3 rate = dF * F.inverse(), plastic = deviator(0.5 * (rate + rate.transpose())) - deviator(next - stress) / (2 * solid.mu);
  EXPECT_LT((plastic.normalized() - N.normalized()).norm(), 5e-3);
  const double dp = point.plastic_strain() - p;
  EXPECT_NEAR(point.dissipated() - work, F.determinant() * kYield * dp, 1e-4 * kYield * dp);
}

// Two layers too: dW of the stress is what is stored and what is dissipated, to the first order of the step.
TEST(Hill, WorkIsStoredOrDissipated) {
  SolidConstants solid = sheet(ratios(0.6, 1.7, 2.2), voce(kYield, 300e6, 12));
  for (int layers : {1, 2}) {
    if (layers == 2) {
      solid.layers = 2;
      solid.layer[1] = {0.4, perfect(2 * kYield)};
      solid.layer[0].weight = 0.6;
    }
    double left[2];
    for (int fine = 0; fine < 2; ++fine) {
      const int n = fine ? 4000 : 2000;
      MaterialPoint point(solid);
      double work = 0;
      Mat3 before = Mat3::Identity(), P_before = Mat3::Zero();
      MaterialPoint::Answer answer{};
      for (int i = 1; i <= n; ++i) {
        const Mat3 F = wild_path(1.0 * i / n);
        answer = point.step(F);
        const Mat3 P = F.determinant() * answer.stress * F.inverse().transpose();
        work += (0.5 * (P + P_before)).cwiseProduct(F - before).sum();
        before = F, P_before = P;
      }
      left[fine] = std::fabs(work - answer.energy - point.dissipated()) / work;
    }
    EXPECT_LT(left[0], 2e-4) << layers;
    EXPECT_LT(left[1], 0.6 * left[0]) << layers;
  }
}

TEST(Hill, FlowKeepsTheVolumeOfTheMemory) {
  MaterialPoint point(sheet(ratios(0.6, 1.7, 2.2)));
  for (int i = 1; i <= 10000; ++i) point.step(wild_path(0.5 + 0.5 * std::sin(i / 200.)));
  EXPECT_GT(point.plastic_strain(), 2);
  Mat3 G;
  const std::vector<double>& g = point.memory();
  G << g[0], g[3], g[5], g[3], g[1], g[4], g[5], g[4], g[2];
  EXPECT_NEAR(G.determinant(), 1, 1e-10);
}

TEST(Hill, TurnedItAnswersTheSameTurned) {
  const SolidConstants solid = sheet(ratios(0.6, 1.7, 2.2), voce(kYield, 300e6, 12));
  MaterialPoint still(solid), turning(solid);
  for (int i = 1; i <= 500; ++i) {
    const double t = i / 500.;
    const Mat3 R = Eigen::AngleAxisd(7 * t, Vec3(1, 2, 2) / 3).toRotationMatrix(), F = wild_path(t);
    const Mat3 a = still.step(F).stress, b = turning.step(R * F).stress;
    ASSERT_LT((R * a * R.transpose() - b).norm(), 1e-9 * a.norm());
  }
  EXPECT_GT(still.plastic_strain(), 0.05);
}

// The normal stays across the sheet, and the sheet turns in its plane by the rotation of the polar decomposition: in the turned axes
// what is left of the deformation is symmetric.
TEST(Hill, AxesTurnAsTheSheetDoes) {
  const Vec3 rolling = Vec3(1, 1, 0).normalized(), transverse = Vec3(-1, 1, 0).normalized();
  const SolidConstants solid = sheet(ratios(0.6, 1.7, 2.2, rolling));
  Edges<double, 3> e;
  Mat3 F;
  F << 1.5, 0.4, 0.2, 0, 0.8, -0.3, 0.1, 0, 0.9;
  for (int m = 0; m < 3; ++m) e.x[m] = {{F(0, m), F(1, m), F(2, m)}};
  find_reciprocal(e);
  const std::vector<double> axes = axes_at_start(solid.orthotropy, 3, Mat3::Identity());
  Vector<double, 3> a[3];
  find_axes(solid.orthotropy, e.x, axes.data(), a);
  Mat3 Q;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) Q(i, k) = a[k][i];
  EXPECT_LT((Q.transpose() * Q - Mat3::Identity()).norm(), 1e-14);
  EXPECT_LT((Q.col(2) - (F.inverse().transpose() * Vec3::UnitZ()).normalized()).norm(), 1e-14);
  EXPECT_NEAR(Q.col(0).dot(F * transverse), Q.col(1).dot(F * rolling), 1e-14);
  EXPECT_GT(Q.col(0).dot(F * rolling), 0);
}

// A section is the plane part of the solid, however the sheet lies in it.
TEST(Hill, ASectionIsASolidThatDoesNotStrainAcrossIt) {
  const std::pair<Vec3, Vec3> sheets[] = {{Vec3::UnitX(), Vec3::UnitY()}, {Vec3::UnitZ(), Vec3::UnitY()}, {Vec3(1, 2, 0), Vec3::UnitZ()}, {Vec3(2, -1, 0), Vec3(1, 2, 0)}};
  for (const auto& [rolling, normal] : sheets) {
    const SolidConstants solid = sheet(ratios(0.6, 1.7, 2.2, rolling, normal), voce(kYield, 300e6, 12));
    MaterialPoint space(solid);
    std::vector<double> memory(memory_items<2>(solid));
    start_memory<2>(solid, {{1, 1, 1, 0}}, axes_at_start(solid.orthotropy, 2, Mat3::Identity()).data(), [&](int item, double value) { memory[item] = value; });
    for (int i = 1; i <= 2000; ++i) {
      Mat3 F = wild_path(i / 2000.);
      F(0, 2) = F(1, 2) = F(2, 0) = F(2, 1) = 0, F(2, 2) = 1;
      const Mat3 a = space.step(F).stress;
      Edges<double, 2> e;
      for (int m = 0; m < 2; ++m) e.x[m] = {{F(0, m), F(1, m)}};
      find_reciprocal(e);
      const double p = solid.K * (F.determinant() - 1);
      const PointResponse<double, 2> b = hill_step(solid, e, F.determinant(), memory.data(), Keep::yes);
      const double found[4] = {b.S[0] + p, b.S[1] + p, b.S[2] + p, b.S[3]}, exact[4] = {a(0, 0), a(1, 1), a(2, 2), a(0, 1)};
      for (int c = 0; c < 4; ++c) ASSERT_NEAR(found[c], exact[c], 1e-8 * kYield) << i << " " << c;
    }
    EXPECT_GT(space.plastic_strain(), 0.05);
  }
}

TEST(Hill, DirectionsThatCannotBeAreNamed) {
  EXPECT_TRUE(find_direction_faults(ratios(1, 1, 1), 2).empty());
  EXPECT_TRUE(find_direction_faults(ratios(1, 1, 1), 3).empty());
  EXPECT_EQ(find_direction_faults(ratios(1, 1, 1, Vec3(0, 0, 2)), 3).at(0).field, "rolling_direction");
  EXPECT_EQ(find_direction_faults(ratios(1, 1, 1, Vec3::Zero(), Vec3(1, 0, 1)), 3).at(0).field, "sheet_normal");
  EXPECT_EQ(find_direction_faults(ratios(1, 1, 1, Vec3(1, 0, 1), Vec3(-1, 0, 1)), 2).size(), 2u);
  EXPECT_TRUE(find_direction_faults(ratios(1, 1, 1, Vec3(1, 0, 1), Vec3(-1, 0, 1)), 3).empty());
  EXPECT_TRUE(find_direction_faults(ratios(1, 1, 1, Vec3(0, 0, -3)), 2).empty());
}

}  // namespace
}  // namespace forming_sim
