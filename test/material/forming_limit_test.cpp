// The forming limit curve at single points.
#include <gtest/gtest.h>

#include "forming_sim/material/forming_limit.h"

namespace forming_sim {
namespace {

const FormingLimitConfig kCurve{{-0.2, 0, 0.3}, {0.5, 0.3, 0.36}};

TEST(FormingLimit, GoesThroughItsPointsInStraightLines) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_DOUBLE_EQ(limit_strain(kCurve, kCurve.minor_strains[i]), kCurve.major_strains[i]);
  EXPECT_DOUBLE_EQ(limit_strain(kCurve, -0.1), 0.4);
  EXPECT_DOUBLE_EQ(limit_strain(kCurve, 0.1), 0.32);
}

TEST(FormingLimit, IsLevelBeyondItsEnds) {
  EXPECT_DOUBLE_EQ(limit_strain(kCurve, -1), 0.5);
  EXPECT_DOUBLE_EQ(limit_strain(kCurve, 1), 0.36);
  EXPECT_DOUBLE_EQ(limit_strain({{0.1}, {0.25}}, -1), 0.25);  // of one point everywhere
}

TEST(FormingLimit, TheRatioIsOneOnTheCurveAndBelowZeroInCompression) {
  EXPECT_DOUBLE_EQ(limit_ratio(kCurve, 0.4, -0.1), 1);
  EXPECT_DOUBLE_EQ(limit_ratio(kCurve, 0.15, 0), 0.5);
  EXPECT_DOUBLE_EQ(limit_ratio(kCurve, -0.05, -0.1), -0.125);
}

}  // namespace
}  // namespace forming_sim
