// The bar in uniaxial strain against a plane and against another bar.
#include <gtest/gtest.h>

#include "support/bars.h"

namespace forming_sim {
namespace {

TEST(Impact, PressureAndDurationOfTheUniaxialBar) {
  double previous = 0;
  for (int cells : {40, 80}) {
    const Impact found = hit_wall(cells, 0.9);
    std::cout << "  " << cells << " cells: " << found.pressure / 1e6 << " MPa, " << found.duration * 1e3
              << " ms, restitution " << found.restitution << ", balance " << found.balance << "\n";
    EXPECT_NEAR(found.pressure, kBarPressure, 2e-3 * kBarPressure);
    EXPECT_NEAR(found.duration, kBarDuration, 0.02 * kBarDuration);
    EXPECT_LE(found.restitution, 1.0);
    EXPECT_GT(found.restitution, 0.95);
    EXPECT_LT(found.balance, 1e-3);
    EXPECT_EQ(found.crossings, 0);
    const double error = std::fabs(found.duration - kBarDuration);
    if (previous > 0) {
      EXPECT_LT(error, 0.7 * previous) << "the duration must converge";
    }
    previous = error;
  }
}

TEST(Impact, TheStepDoesNotMatter) {
  const Impact coarse = hit_wall(40, 0.9), fine = hit_wall(40, 0.2);
  EXPECT_NEAR(coarse.pressure, fine.pressure, 3e-3 * fine.pressure);
  EXPECT_NEAR(coarse.duration, fine.duration, 0.01 * fine.duration);
}

// A layer of 1e-2 to 1e-5 of a cell, a tenth to a thousand times as stiff as the bar: not felt.
TEST(Impact, TheLayerAndItsStiffnessDoNotMatter) {
  for (double layer : {1e-3, 1e-4, 1e-6})
    for (double stiffness : {7e9, 7e11, 7e13}) {
      ContactConfig contact;
      contact.layer = layer;
      contact.stiffness = stiffness;
      const Impact found = hit_wall(40, 0.9, contact);
      std::cout << "  h0 " << layer << " m, E " << stiffness << " Pa: " << found.pressure / 1e6 << " MPa, " << found.duration * 1e3 << " ms\n";
      EXPECT_NEAR(found.pressure, kBarPressure, 2e-3 * kBarPressure);
      EXPECT_NEAR(found.duration, kBarDuration, 0.02 * kBarDuration);
      EXPECT_EQ(found.crossings, 0);
    }
}

TEST(Impact, TwoBarsDoToEachOtherWhatThePlaneDoes) {
  for (int other : {40, 46}) {
    const Meeting found = hit_each_other(40, other);
    std::cout << "  40 and " << other << " cells: " << found.pressure / 1e6 << " MPa, " << found.duration * 1e3 << " ms, restitution "
              << found.restitution << ", balance " << found.balance << ", momentum " << found.momentum << "\n";
    EXPECT_NEAR(found.pressure, kBarPressure, 4e-3 * kBarPressure);
    EXPECT_NEAR(found.duration, kBarDuration, 0.03 * kBarDuration);
    EXPECT_LE(found.restitution, 1.0);
    EXPECT_GT(found.restitution, 0.95);
    EXPECT_LT(found.balance, 1e-3);
    EXPECT_LT(found.momentum, 1e-11);
    EXPECT_EQ(found.crossings, 0);
  }
}

}  // namespace
}  // namespace forming_sim
