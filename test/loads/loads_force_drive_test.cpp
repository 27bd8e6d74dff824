// A tool that a force drives, without a mesh: what it weighs, how it follows, what it keeps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "forming_sim/config/fault.h"
#include "forming_sim/loads/drive.h"

using namespace forming_sim;

namespace {

MotionConfig pushing(std::vector<Vec3> forces, double mass) {
  MotionConfig config;
  config.kind = "force";
  for (std::size_t k = 0; k < forces.size(); ++k) config.times.push_back(1e-3 * k);
  config.forces = std::move(forces);
  config.mass = mass;
  return config;
}

/// Steps of this dt from t = 0 on; answer(J that would hold it where it is): J, N s.
template <class Answer> void steps(ForceDrive& drive, double dt, int count, const Answer& answer) {
  for (int n = 0; n < count; ++n) {
    const double t = n * dt, kick = n == 0 ? dt / 2 : dt, J = answer(-drive.free_speed(t, kick) / drive.inverse_mass(kick));
    drive.take(t, kick, dt, J * drive.inverse_mass(kick), J);
  }
}

Vec3 way(const ForceDrive& drive) { return drive.gone() * drive.guide(); }
Vec3 velocity(const ForceDrive& drive) { return drive.speed() * drive.guide(); }

const auto nothing = [](double) { return 0.0; };

}  // namespace

TEST(LoadsForceDrive, AloneItFallsAsItsForceSays) {
  const Vec3 force(-30, 40, 0);
  ForceDrive drive(pushing({force}, 2.5));
  EXPECT_LT((drive.guide() - Vec3(-0.6, 0.8, 0)).norm(), 1e-15);
  steps(drive, 1e-5, 400, nothing);
  EXPECT_LT((way(drive) - 0.5 * force / 2.5 * std::pow(400e-5, 2)).norm(), 1e-12 * way(drive).norm());
  EXPECT_LT((velocity(drive) - force / 2.5 * 399.5e-5).norm(), 1e-12 * velocity(drive).norm());
}

// It stands less than a step's way past the stop, whatever drives it on, until something draws it back.
TEST(LoadsForceDrive, AStopHoldsItAndLetsItGo) {
  const double ahead = 4e-6, behind = 2e-6, dt = 1e-6;
  MotionConfig config = pushing({Vec3(0, -40, 0), Vec3(0, -40, 0), Vec3(0, 40, 0)}, 2);
  config.stop_ahead = ahead;
  config.stop_behind = behind;
  ForceDrive drive(config);
  double stood = 0, left = 0, came = 0, highest = -1, lowest = 1;  // s; m
  for (int n = 0; n < 5000; ++n) {
    const double t = n * dt;
    drive.take(t, dt, dt, 0, 0);
    highest = std::max(highest, drive.gone());
    lowest = std::min(lowest, drive.gone());
    if (stood == 0 && drive.stands()) stood = t;
    if (stood > 0 && left == 0 && !drive.stands()) left = t;
    if (left > 0 && came == 0 && drive.stands()) came = t;
    if (drive.stands() && t > stood + dt) {
      EXPECT_TRUE(drive.inverse_mass(dt) == 0 && drive.free_speed(t, dt) == 0) << t;
    }
  }
  std::printf("  stands at %g s, leaves at %g s, comes to the other stop at %g s; way from %.9g to %.9g m\n", stood, left, came, lowest, highest);
  EXPECT_NEAR(stood, std::sqrt(2 * ahead / 20), 3 * dt);
  EXPECT_NEAR(left, 1.5e-3, 3 * dt);  // where the force changes its sign
  EXPECT_GE(highest, ahead);
  EXPECT_LE(highest, ahead + dt * 20 * (stood + dt));
  EXPECT_LE(lowest, -behind);
  EXPECT_GE(lowest, -behind - dt * 20 * (came - left + dt));
  EXPECT_TRUE(drive.stands());
  EXPECT_EQ(drive.fallen(5e-3), 0);
}

TEST(LoadsForceDrive, AHammerFliesWithWhatItStartsWith) {
  MotionConfig config = pushing({Vec3::Zero()}, 2.5);
  config.initial_velocity = Vec3(0, -6, 0);
  ForceDrive flies(config);
  EXPECT_EQ(velocity(flies), Vec3(0, -6, 0));
  steps(flies, 1e-5, 400, nothing);
  EXPECT_LT((way(flies) - Vec3(0, -6 * 400e-5, 0)).norm(), 1e-15);
  config.forces = {Vec3(0, 2.5 * 9.81, 0)};  // it is thrown up against its weight, seen along the weight
  config.initial_velocity = Vec3(0, -6, 0);
  ForceDrive braked(config);
  steps(braked, 1e-5, 400, nothing);
  EXPECT_NEAR(velocity(braked).y(), -6 + 9.81 * 399.5e-5, 1e-12);
  config.initial_velocity = Vec3(1, -6, 0);
  EXPECT_THROW(ForceDrive{config}, Error);
  config = pushing({Vec3::Zero()}, 2.5);
  EXPECT_THROW(ForceDrive{config}, Error);
}

TEST(LoadsForceDrive, ItsGuideTakesSpeed) {
  MotionConfig config = pushing({Vec3(8, 0, 0)}, 2);
  config.damping = 500;
  ForceDrive drive(config);
  steps(drive, 1e-4, 1000, nothing);
  EXPECT_NEAR(velocity(drive).x(), 8 / (500. * 2), 1e-14);
}

// What holds it still bears its force, whatever its guide takes.
TEST(LoadsForceDrive, HeldStillItPressesWithItsForce) {
  for (const double damping : {0., 500.}) {
    MotionConfig config = pushing({Vec3(8, 0, 0)}, 2);
    config.damping = damping;
    ForceDrive drive(config);
    steps(drive, 1e-4, 100, [](double holding) {
      EXPECT_NEAR(holding, -8e-4, 4.001e-4);
      return holding;
    });
    EXPECT_EQ(way(drive).x(), 0);
    EXPECT_NEAR(drive.free_speed(1, 1e-4) / drive.inverse_mass(1e-4), 8e-4, 1e-17);
  }
}

// Whatever presses on it, when and in steps of whatever length, and however well contact has met its speed: in the end it has the sum of all impulses.
TEST(LoadsForceDrive, NoImpulseIsLost) {
  const double mass = 3;
  ForceDrive drive(pushing({Vec3(5, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, 0)}, mass));
  double t = 0, previous = 0, sum = 0;
  const ScalarProfile force({0, 1e-3, 2e-3}, {5, -1, 0}, "smooth");
  for (int n = 0; t < 3e-3; ++n) {
    const double dt = n % 7 == 3 ? 2.5e-6 : 2e-5, kick = (previous + dt) / 2, answer = t > 1e-4 && t < 2e-3 ? -4 * kick * std::sin(1e4 * t) : 0;
    sum += kick * force.at(t) + answer;
    drive.take(t, kick, dt, answer * drive.inverse_mass(kick) * (n % 2 ? 1.001 : 0.999), answer);
    previous = dt;
    t += dt;
  }
  EXPECT_GT(std::abs(sum), 1e-5);
  EXPECT_NEAR(velocity(drive).x() * mass, sum, 1e-14);
}

namespace {

/// A tool on a column of four springs between unit masses, the lowest held, the highest (half a mass) moving with the tool, steps a fifth of what is stable.
/// How much the swing has grown over 40 000 steps. together: V and J as they go with each other; else V first, without the J of the step.
double growth_on_a_column(double mass, bool together) {
  constexpr int count = 4, all = 40000;
  const double dt = 0.2, m[count] = {1, 1, 1, 0.5};
  ForceDrive drive(pushing({Vec3(-1e-3, 0, 0)}, mass));
  double x[count] = {}, v[count] = {}, first = 0, last = 0;
  for (int n = 0; n < all; ++n) {
    const double kick = n == 0 ? dt / 2 : dt, t = n * dt;
    for (int i = 0; i < count; ++i) v[i] += kick / m[i] * ((i > 0 ? x[i - 1] : 0) - x[i] + (i + 1 < count ? x[i + 1] - x[i] : 0));
    double& top = v[count - 1];
    const double M = 1 / drive.inverse_mass(kick), alone = drive.free_speed(t, kick) * drive.guide().x();
    const double V = together ? (M * alone + m[count - 1] * top) / (M + m[count - 1]) : alone;
    const double J = -m[count - 1] * (V - top);
    drive.take(t, kick, dt, drive.guide().x() * (V - alone), drive.guide().x() * J);
    top = V;
    for (int i = 0; i < count; ++i) x[i] += dt * v[i];
    double& most = n < all / 2 ? first : last;
    if ((n < all / 10 || n > all - all / 10) && !(std::abs(V) <= most)) most = std::abs(V);
  }
  return last / first;
}

}  // namespace

TEST(LoadsForceDrive, OneAfterTheOtherItFeedsTheSwing) {
  for (const double mass : {0.01, 0.5, 4., 25.}) {
    const double together = growth_on_a_column(mass, true), staggered = growth_on_a_column(mass, false);
    std::printf("  mass %g: together %.3f, one after the other %.3g\n", mass, together, staggered);
    EXPECT_NEAR(together, 1, 0.05) << mass;
    EXPECT_FALSE(staggered < 100) << mass;
  }
}

// Let go where its spring is not slack it swings about where that bears its force: x = F/K (1 - cos(omega t)).
TEST(LoadsForceDrive, ASpringHoldsItWhereItBearsItsForce) {
  MotionConfig config = pushing({Vec3(0, 0, -600)}, 2);
  config.stiffness = 8e4;  // omega = 200/s
  ForceDrive drive(config);
  EXPECT_DOUBLE_EQ(drive.stable_step(), 2 / 200.);
  double farthest = 0;
  for (int n = 0; n < 4000; ++n) {
    const double dt = 1e-5, t = n * dt, kick = n == 0 ? dt / 2 : dt;
    drive.take(t, kick, dt, 0, 0);
    EXPECT_NEAR(drive.gone(), 600 / 8e4 * (1 - std::cos(200 * (t + dt))), 1e-5 * 600 / 8e4);  // of second order in omega dt = .002
    farthest = std::max(farthest, drive.gone());
  }
  EXPECT_NEAR(farthest, 2 * 600 / 8e4, 1e-8);
  config.damping = 400;  // critical
  ForceDrive rests(config);
  steps(rests, 1e-5, 20000, nothing);
  EXPECT_NEAR(rests.gone(), 600 / 8e4, 1e-12);
  EXPECT_NEAR(rests.force(0.2), 0, 1e-6);
}

TEST(LoadsForceDrive, TheOtherEndOfItsSpringTakesItAlong) {
  MotionConfig config = pushing({Vec3::Zero(), Vec3::Zero()}, 2);
  config.guide = Vec3(0, 0, -3);
  config.stiffness = 8e4;
  config.damping = 400;
  config.profile = "linear";
  config.times = {0, 1};
  config.velocities = {Vec3(0.5, 0, -0.25), Vec3(0.5, 0, -0.25)};
  ForceDrive drive(config);
  EXPECT_EQ(drive.guide(), Vec3(0, 0, -1));
  steps(drive, 1e-5, 20000, nothing);
  // A damping against the end's speed lets the spring be slack once both go alike.
  EXPECT_NEAR(drive.gone(), 0.25 * 0.2, 1e-9);
  EXPECT_NEAR(drive.speed(), 0.25, 1e-9);
  Pose told;
  told.translation = Vec3(0.1, 0, -0.05);
  told.velocity = Vec3(0.5, 0, -0.25);
  const Pose placed = drive.placed(told, 0.04, 0.2);
  EXPECT_LT((placed.translation - Vec3(0.1, 0, -0.04)).norm(), 1e-16);
  EXPECT_LT((placed.velocity - Vec3(0.5, 0, -0.2)).norm(), 1e-15);
}

TEST(LoadsForceDrive, RefusesWhatIsNoForceAlongALine) {
  EXPECT_THROW(ForceDrive(pushing({Vec3::Zero()}, 1)), Error);
  EXPECT_THROW(ForceDrive(pushing({Vec3(1, 0, 0), Vec3(1, 1e-6, 0)}, 1)), Error);
  EXPECT_NO_THROW(ForceDrive(pushing({Vec3(1, 2, 0), Vec3(-0.5, -1, 0)}, 1)));
  MotionConfig config = pushing({Vec3(1, 0, 0)}, 1);
  config.profile = "spline";
  try {
    ForceDrive drive(config);
    FAIL() << "a force as a spline";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("motion.profile: given \"spline\" for a load; give linear or smooth"), std::string::npos) << error.what();
  }
}
