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
