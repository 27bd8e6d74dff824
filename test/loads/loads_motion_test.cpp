// Rigid motions: orthonormal rotations, spins against finite differences,
// spins of changing axis against a closed form, frames of tools, withdrawal.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "forming_sim/config/fault.h"
#include "forming_sim/loads/motion.h"
#include "forming_sim/loads/rotation.h"
#include "forming_sim/simulation/model.h"

namespace forming_sim {
namespace {

const double kPi = 3.14159265358979323846;

MotionConfig trajectory(const std::string& profile) {
  MotionConfig config;
  config.kind = "trajectory";
  config.profile = profile;
  config.times = {1e-3, 2e-3, 4e-3};
  config.positions = {{0, 0, 0}, {1e-3, -2e-3, 0}, {1e-3, -5e-3, 2e-3}};
  config.rotations_deg = {{0, 0, 0}, {0, 40, 90}, {10, -50, 200}};
  return config;
}

MotionConfig spinning(std::vector<Vec3> spins) {
  MotionConfig config;
  config.kind = "velocity";
  config.profile = "linear";
  for (size_t k = 0; k < spins.size(); ++k) config.times.push_back(1e-3 * (k + 1));
  config.spins_deg_s = std::move(spins);
  config.velocities.assign(config.times.size(), Vec3(1, 2, 3));
  return config;
}

/// Orthonormal, and velocity and spin agree with differences of the pose.
void expect_consistent(const RigidMotion& motion, double t) {
  const double h = 1e-9;
  const Pose pose = motion.at(t), before = motion.at(t - h), after = motion.at(t + h);
  EXPECT_LT((pose.rotation * pose.rotation.transpose() - Mat3::Identity()).norm(), 1e-12) << t;
  EXPECT_NEAR(pose.rotation.determinant(), 1, 1e-12) << t;
  const Vec3 velocity = (after.translation - before.translation) / (2 * h);
  EXPECT_LT((pose.velocity - velocity).norm(), 1e-5 * (1 + velocity.norm())) << t;
  const Mat3 w = (after.rotation - before.rotation) / (2 * h) * pose.rotation.transpose();
  const Vec3 spin(0.5 * (w(2, 1) - w(1, 2)), 0.5 * (w(0, 2) - w(2, 0)), 0.5 * (w(1, 0) - w(0, 1)));
  EXPECT_LT((pose.spin - spin).norm(), 1e-4 * (1 + spin.norm())) << t;
}

TEST(Rotation, quarter_turn_and_small_angles) {
  EXPECT_LT((rotation_matrix(Vec3(0, 0, kPi / 2)) * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-15);
  EXPECT_EQ(rotation_matrix(Vec3::Zero()), Mat3(Mat3::Identity()));
  // Both branches of each formula meet.
  const Vec3 axis = Vec3(1, -2, 2) / 3, rate(3, 1, -4);
  for (double angle : {1e-8, 1e-2}) {
    const Vec3 below = (1 - 1e-9) * angle * axis, above = (1 + 1e-9) * angle * axis;
    EXPECT_LT((rotation_matrix(below) - rotation_matrix(above)).norm(), 4e-9 * angle + 1e-16);
    EXPECT_LT((spin_of(below, rate) - spin_of(above, rate)).norm(), 1e-8 * angle + 1e-11);
  }
}

TEST(RigidMotion, default_rests) {
  const RigidMotion motion;
  const Pose pose = motion.at(7);
  EXPECT_EQ(pose.translation, Vec3::Zero());
  EXPECT_EQ(pose.rotation, Mat3(Mat3::Identity()));
  EXPECT_EQ(pose.spin, Vec3::Zero());
}

TEST(RigidMotion, trajectories_meet_their_knots_and_are_consistent) {
  for (const char* profile : {"smooth", "linear", "spline"}) {
    const MotionConfig config = trajectory(profile);
    const RigidMotion motion(config, 3);
    for (size_t k = 0; k < config.times.size(); ++k) {
      const Pose pose = motion.at(config.times[k]);
      EXPECT_LT((pose.translation - config.positions[k]).norm(), 1e-15) << profile;
      EXPECT_LT((pose.rotation - rotation_matrix(kRadiansPerDegree * config.rotations_deg[k])).norm(), 1e-13)
          << profile;
    }
    for (double t = 0.06e-3; t < 5e-3; t += 0.19e-3) expect_consistent(motion, t);
    EXPECT_EQ(motion.at(9).velocity, Vec3::Zero());
    EXPECT_EQ(motion.at(9).spin, Vec3::Zero());
  }
}

TEST(RigidMotion, spin_about_one_axis_is_the_exact_integral) {
  const Vec3 axis(0.6, 0, 0.8);
  const RigidMotion motion(spinning({1e4 * axis, -3e4 * axis, 8e4 * axis}), 3);
  // Straight lines: 1 ms at 1e4, then mean -1e4 and 2.5e4 over 1 ms each, then 8e4 deg/s.
  const double degrees = 10 - 10 + 25 + 80;
  const Pose pose = motion.at(4e-3);
  EXPECT_LT((pose.rotation - rotation_matrix(degrees * kRadiansPerDegree * axis)).norm(), 1e-13);
  EXPECT_LT((pose.translation - 4e-3 * Vec3(1, 2, 3)).norm(), 1e-15);
  for (double t = 0.3e-3; t < 5e-3; t += 0.4e-3) expect_consistent(motion, t);
}

TEST(RigidMotion, spin_of_changing_axis_agrees_with_small_exact_turns) {
  // Between knots the spin is a straight line from a to b; an independent product
  // of midpoint turns converges with 1/n^2 and is extrapolated.
  const Vec3 a(4e4, 0, 0), b(0, 6e4, 2e4);
  const RigidMotion motion(spinning({a, b}), 3);
  const auto product = [&](int n) {
    Mat3 rotation = rotation_matrix(kRadiansPerDegree * 1e-3 * a);
    for (int k = 0; k < n; ++k)
      rotation = rotation_matrix(kRadiansPerDegree * 1e-3 / n * (a + (k + 0.5) / n * (b - a))) * rotation;
    return rotation;
  };
  const Mat3 coarse = product(4000), fine = product(8000);
  const Mat3 exact = fine + (fine - coarse) / 3;
  EXPECT_LT((motion.at(2e-3).rotation - exact).norm(), 1e-9);
  EXPECT_LT((motion.at(3e-3).rotation - rotation_matrix(kRadiansPerDegree * 1e-3 * b) * exact).norm(), 1e-9);
  for (double t = 0.3e-3; t < 3e-3; t += 0.17e-3) expect_consistent(motion, t);
}

TEST(RigidMotion, precession_has_its_closed_form) {
  // Spin w(t) = W + R_W(t) s turns into R(t) = R_W(t) R_s(t). Sampled finely as knots.
  const Vec3 whirl(0, 0, 2000), own(500, 0, 0);  // rad/s
  MotionConfig config;
  config.kind = "velocity";
  config.profile = "linear";
  const int n = 2000;
  const double end = kPi / 1000;  // one turn of the whirl
  for (int k = 0; k <= n; ++k) {
    config.times.push_back(end * k / n);
    config.spins_deg_s.push_back((whirl + rotation_matrix(end * k / n * whirl) * own) / kRadiansPerDegree);
  }
  const Pose pose = RigidMotion(config, 3).at(end);
  const Mat3 expected = rotation_matrix(end * whirl) * rotation_matrix(end * own);
  // What is left is the straight lines between the knots: (2 pi / n)^2 / 12 of the own turn.
  EXPECT_LT((pose.rotation - expected).norm(), 5e-6);
}

TEST(RigidMotion, withdraw_starts_where_the_tool_stands_and_at_rest) {
  const Pose from = RigidMotion(trajectory("linear"), 3).at(3e-3);
  ASSERT_GT(from.velocity.norm(), 1);
  const RigidMotion away = withdraw(from, Vec3(0, 0, 5e-3), 3e-3, 1e-3);
  const Pose start = away.at(3e-3), middle = away.at(3.5e-3), end = away.at(4e-3);
  EXPECT_EQ(start.translation, from.translation);
  EXPECT_EQ(start.rotation, from.rotation);
  EXPECT_LT(start.velocity.norm(), 1e-12);
  EXPECT_EQ(start.spin, Vec3::Zero());
  EXPECT_NEAR(middle.velocity.z(), 15.0 / 8 * 5, 1e-9);
  EXPECT_LT((end.translation - from.translation - Vec3(0, 0, 5e-3)).norm(), 1e-17);
  EXPECT_EQ(end.velocity, Vec3::Zero());
  EXPECT_THROW(withdraw(from, Vec3::Zero(), 0, 0), Error);
}

TEST(ToolPose, turns_about_the_centre_that_moves_along) {
  ToolModel tool;
  tool.position = Vec3(2, 0, 0);
  tool.rotation_deg = Vec3(0, 0, 90);
  MotionConfig config;
  config.kind = "trajectory";
  config.profile = "linear";
  config.times = {0, 1};
  config.positions = {{0, 0, 0}, {0, 3, 0}};
  config.rotations_deg = {{0, 0, 0}, {0, 0, 180}};
  config.centre = Vec3(1, 0, 0);
  tool.motion = config;
  const RigidMotion motion(config, 2);
  const ToolPose start = tool_pose(tool, motion.at(0)), end = tool_pose(tool, motion.at(1));
  EXPECT_LT((start.position - Vec3(2, 0, 0)).norm(), 1e-15);
  EXPECT_LT((start.rotation * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-15);
  EXPECT_LT((end.position - Vec3(0, 3, 0)).norm(), 1e-15);
  EXPECT_LT((end.rotation * Vec3::UnitX() + Vec3::UnitY()).norm(), 1e-15);
  const double h = 1e-6, t = 0.3;
  const Vec3 velocity =
      (tool_pose(tool, motion.at(t + h)).position - tool_pose(tool, motion.at(t - h)).position) / (2 * h);
  EXPECT_LT((tool_pose(tool, motion.at(t)).velocity - velocity).norm(), 1e-8);
  // Withdrawing keeps the centre, so nothing jumps.
  const RigidMotion away = withdraw(motion.at(t), Vec3(0, 1, 0), t, 1);
  EXPECT_LT((tool_pose(tool, away.at(t)).position - tool_pose(tool, motion.at(t)).position).norm(), 1e-15);
}

// The axle goes with what is told, and the spin is that of both: as differences in time say.
TEST(RigidMotion, an_axle_is_taken_along) {
  MotionConfig config;
  config.kind = "trajectory";
  config.profile = "linear";
  config.times = {0, 1};
  config.positions = {{0, 0, 0}, {0, 3, 0}};
  config.rotations_deg = {{0, 0, 0}, {90, 0, 0}};
  const RigidMotion motion(config, 3);
  const double rate = 2.5;
  const auto at = [&](double t) { return turned_about(Vec3::UnitY(), 0.4 + rate * t, rate, motion.at(t)); };
  const double h = 1e-6, t = 0.3;
  const Mat3 W = (at(t + h).rotation - at(t - h).rotation) / (2 * h) * at(t).rotation.transpose();
  EXPECT_LT((at(t).spin - Vec3(W(2, 1), W(0, 2), W(1, 0))).norm(), 1e-8);
  EXPECT_LT((at(1).rotation * Vec3::UnitY() - Vec3::UnitZ()).norm(), 1e-15);  // a point on the axle does not go round it
  EXPECT_EQ(at(t).translation, motion.at(t).translation);
}

TEST(RigidMotion, refusals_name_field_and_remedy) {
  const auto message = [](const MotionConfig& config, int dimension) -> std::string {
    try {
      RigidMotion(config, dimension);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Code::invalid_scene);
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message(trajectory("smooth"), 2).find("motion.positions[2]"), std::string::npos);
  MotionConfig tilted = trajectory("smooth");
  tilted.positions.clear();
  EXPECT_NE(message(tilted, 2).find("motion.rotations_deg[1]"), std::string::npos);
  MotionConfig short_of_one = trajectory("smooth");
  short_of_one.positions.pop_back();
  EXPECT_NE(message(short_of_one, 3).find("2 values for 3 times"), std::string::npos);
  MotionConfig spline = spinning({Vec3(0, 0, 1)});
  spline.profile = "spline";
  EXPECT_NE(message(spline, 3).find("motion.profile"), std::string::npos);
  MotionConfig for_ever = spinning({Vec3(360, 0, 0), Vec3(0, 360, 0)});
  for_ever.times = {0, 1e6};
  EXPECT_NE(message(for_ever, 3).find("motion.spins_deg_s"), std::string::npos);
  MotionConfig backwards = trajectory("linear");
  backwards.times = {0, 2, 1};
  EXPECT_EQ(message(backwards, 3).rfind("motion.times[2]", 0), 0u);
  EXPECT_NE(message(MotionConfig(), 3).find("motion.kind"), std::string::npos);
}

}  // namespace
}  // namespace forming_sim
