// What begins with a stage.
#include "forming_sim/loads/course_clock.h"

#include <gtest/gtest.h>

#include "forming_sim/loads/dead_load.h"
#include "forming_sim/loads/drive.h"
#include "forming_sim/loads/motion.h"
#include "forming_sim/loads/pressure.h"
#include "forming_sim/loads/rigid_velocity.h"

namespace forming_sim {
namespace {

TEST(CourseClock, RunsFromTheBeginningOfItsStageOn) {
  EXPECT_TRUE(CourseClock().runs());
  EXPECT_EQ(CourseClock().at(3), 3);
  CourseClock clock(2);
  clock.begin(0, 0);
  clock.begin(1, 5);
  EXPECT_FALSE(clock.runs());
  EXPECT_LT(clock.at(1e9), 0);
  clock.begin(2, 7);
  EXPECT_TRUE(clock.runs());
  EXPECT_EQ(clock.at(7.5), 0.5);
  EXPECT_EQ(clock.of_run(0.5), 7.5);
}

TEST(CourseClock, PressuresAndLoadsAreNoneBefore) {
  ResolvedPressure pressure;
  pressure.profile = ScalarProfile({0}, {100});
  Face face;
  face.corners = 2;
  face.nodes[0] = 0, face.nodes[1] = 1;
  pressure.faces = {face};
  pressure.clock = CourseClock(1);
  PressureSet pressures({pressure});
  ResolvedLoad load;
  load.value = load_curve({0, 1}, {Vec3(0, 8, 0), Vec3(0, 10, 0)}, "linear");
  load.nodes = {0};
  load.share = {1};
  load.clock = CourseClock(1);
  DeadLoadSet loads({load});
  const NodeField x{Node(0, 0, 0, 0), Node(1, 0, 0, 0)};
  const auto at = [&](double t) {
    NodeField f(2, Node::Zero());
    pressures.add(t, x, f);
    loads.add(t, f);
    return f;
  };
  EXPECT_TRUE(at(3)[0].isZero(0) && at(3)[1].isZero(0));
  pressures.begin(1, 3);
  loads.begin(1, 3);
  EXPECT_EQ(std::abs(at(3)[1].y()), 50);
  EXPECT_EQ(at(3.5)[0].y() - at(3.5)[1].y(), 9);
}

TEST(CourseClock, MotionsAreThoseOfTheirOwnTime) {
  MotionConfig motion;
  motion.kind = "velocity";
  motion.times = {0, 1, 2};
  motion.velocities = {Vec3(0, 0, 0), Vec3(1, 2, 0), Vec3(0, 1, 0)};
  motion.spins_deg_s = {Vec3(0, 0, 0), Vec3(30, 0, 0), Vec3(0, 40, 0)};
  const RigidMotion now(motion, 3), later = now.beginning(5);
  for (const double t : {0., .3, 1.5, 4.}) {
    EXPECT_EQ(later.at(5 + t).translation, now.at((5 + t) - 5).translation) << t;
    EXPECT_EQ(later.at(5 + t).rotation, now.at((5 + t) - 5).rotation) << t;
  }
  BoundaryConfig boundary;
  boundary.kind = "velocity";
  boundary.times = motion.times;
  boundary.velocities = motion.velocities;
  boundary.spins_deg_s = motion.spins_deg_s;
  CourseClock clock(1);
  clock.begin(1, 4);
  const RigidVelocity of_run(boundary), of_stage(boundary, clock);
  EXPECT_EQ(of_stage.times(), (std::vector<double>{4, 5, 6}));
  EXPECT_EQ(of_stage.step(4.5, 0.25).at(Vec3(1, 1, 1)), of_run.step(0.5, 0.25).at(Vec3(1, 1, 1)));
  MotionConfig push;
  push.times = {0, 1};
  push.forces = {Vec3(0, 0, 0), Vec3(0, 0, 6)};
  push.mass = 2;
  ForceDrive drive(push);
  drive.begin(10);
  EXPECT_EQ(drive.force(10.5), 3);
  EXPECT_EQ(drive.free_speed(10.5, 0.1), 0.1 * 3 / 2);
}

}  // namespace
}  // namespace forming_sim
