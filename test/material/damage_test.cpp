// Damage criteria at a point: what they are in tension, compression, shear and under a pressure beside them, in whatever frame.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "forming_sim/material/damage.h"

namespace forming_sim {
namespace {

constexpr double kStress = 300e6;
const char* const kCriteria[] = {"cockcroft_latham", "normalized_cockcroft_latham", "rice_tracey"};

double weight(const char* criterion, const Mat3& sigma) {
  const DamageStress stress = damage_stress(sigma);
  return damage_per_strain(damage_criterion(criterion), stress, stress.sigma_e);
}
Mat3 principal(double a, double b, double c) { return Vec3(a, b, c).asDiagonal(); }

TEST(Damage, InTensionCompressionAndShearIsWhatItsFormulaSays) {
  const Mat3 tension = principal(kStress, 0, 0), compression = principal(0, -kStress, 0);
  EXPECT_NEAR(weight("cockcroft_latham", tension), kStress, 1e-6 * kStress);
  EXPECT_NEAR(weight("normalized_cockcroft_latham", tension), 1, 1e-6);
  EXPECT_NEAR(weight("rice_tracey", tension), std::exp(0.5), 1e-6);
  EXPECT_NEAR(weight("cockcroft_latham", compression), 0, 1e-6 * kStress);
  EXPECT_NEAR(weight("normalized_cockcroft_latham", compression), 0, 1e-6);
  EXPECT_NEAR(weight("rice_tracey", compression), std::exp(-0.5), 1e-6);
  Mat3 shear = Mat3::Zero();
  shear(0, 2) = shear(2, 0) = kStress;
  EXPECT_NEAR(weight("cockcroft_latham", shear), kStress, 1e-6 * kStress);
  EXPECT_NEAR(weight("normalized_cockcroft_latham", shear), 1 / std::sqrt(3), 1e-6);
  EXPECT_NEAR(weight("rice_tracey", shear), 1, 1e-6);
}

TEST(Damage, UnderAPressureBesideItIsLess) {
  // A neck under a hydrostatic tension sigma_e/2, and the same under a pressure that ends all tension.
  const Mat3 neck = principal(kStress, 0, 0) + 0.5 * kStress * Mat3::Identity(), pressed = principal(kStress, 0, 0) - kStress * Mat3::Identity();
  EXPECT_NEAR(weight("normalized_cockcroft_latham", neck), 1.5, 1e-6);
  EXPECT_NEAR(weight("rice_tracey", neck), std::exp(1.5 * (1. / 3 + 0.5)), 1e-6);
  EXPECT_NEAR(weight("normalized_cockcroft_latham", pressed), 0, 1e-6);
  EXPECT_NEAR(weight("rice_tracey", pressed), std::exp(-1), 1e-6);
}

// Unloaded to next to no deviator under a tension from all sides, an element that has flowed before counts as it did then.
TEST(Damage, OfAnUnloadedElementIsBounded) {
  const DamageStress unloaded = damage_stress(kStress * Mat3::Identity() + principal(1e-3, 0, 0));
  EXPECT_NEAR(damage_per_strain(DamageCriterion::normalized_cockcroft_latham, unloaded, kStress), 1, 1e-6);
  EXPECT_NEAR(damage_per_strain(DamageCriterion::rice_tracey, unloaded, kStress), std::exp(1.5), 1e-6);
  EXPECT_NEAR(weight("rice_tracey", kStress * Mat3::Identity() + principal(1e-3, 0, 0)), std::exp(7.5), 1e-6);
}

TEST(Damage, WithoutStressThereIsNone) {
  for (const char* criterion : kCriteria) EXPECT_EQ(weight(criterion, Mat3::Zero()), 0) << criterion;
}

TEST(Damage, DoesNotKnowTheFrame) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int k = 0; k < 100; ++k) {
    Mat3 sigma;
    for (int i = 0; i < 9; ++i) sigma(i) = kStress * number(random);
    sigma = (sigma + sigma.transpose()).eval();
    const Mat3 turn = Eigen::Quaterniond(number(random), number(random), number(random), number(random)).normalized().toRotationMatrix();
    for (const char* criterion : kCriteria) {
      const double w = weight(criterion, sigma);
      EXPECT_NEAR(weight(criterion, turn * sigma * turn.transpose()), w, 1e-6 * std::max(w, std::string(criterion) == "cockcroft_latham" ? kStress : 1)) << criterion;
    }
    const double largest = Eigen::EigenSolver<Mat3>(sigma).eigenvalues().real().maxCoeff();
    EXPECT_NEAR(weight("cockcroft_latham", sigma), std::max(largest, 0.0), 1e-6 * kStress);
  }
}

}  // namespace
}  // namespace forming_sim
