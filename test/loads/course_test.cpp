#include "forming_sim/loads/course.h"

#include <gtest/gtest.h>

namespace forming_sim {
namespace {

MotionConfig trajectory() {
  MotionConfig m;
  m.kind = "trajectory";
  m.times = {1, 2, 3, 4, 5};
  const Vec3 down(0, -1, 0);
  m.positions = {Vec3::Zero(), down, down, Vec3::Zero(), Vec3::Zero()};  // goes, holds, comes back, rests
  return m;
}

TEST(Course, OfATrajectoryEndsWithItsLastMove) {
  const MotionConfig m = trajectory();
  EXPECT_EQ(last_change(m), 4);
  EXPECT_FALSE(changes(m, .5, 1));
  EXPECT_TRUE(changes(m, 1.5, 1.5));
  EXPECT_FALSE(changes(m, 2.5, 2.5));
  EXPECT_TRUE(changes(m, 2.5, 3.5));
  EXPECT_FALSE(changes(m, 4.5, 9));
}

TEST(Course, OfALevelVelocityIsAMotionUntilItChangesForTheLastTime) {
  BoundaryConfig b;
  b.times = {0, 1, 2, 3};
  b.velocities = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitX(), Vec3::Zero()};
  EXPECT_TRUE(changes(b, 1.5, 1.5));
  b.velocities[3] = Vec3::UnitX();  // for good
  EXPECT_EQ(last_change(b), 1);
  EXPECT_FALSE(changes(b, 1.5, 1.5));
  b.velocities.assign(4, Vec3::UnitX());
  EXPECT_EQ(last_change(b), 0);
  EXPECT_FALSE(changes(b, .5, .5));
}

TEST(Course, OfNothingIsNone) {
  EXPECT_EQ(last_change(BoundaryConfig()), 0);
  EXPECT_FALSE(changes(LoadConfig(), 0, 1));
  PressureConfig one;
  one.times = {1};
  one.values = {1e6};
  EXPECT_EQ(last_change(one), 0);
}

}  // namespace
}  // namespace forming_sim
