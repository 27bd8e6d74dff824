// Tools that turn freely about an axle: friction spins an idle roll up, a torque drives what the roll lies on, and the books close.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "support/runs.h"

namespace forming_sim {
namespace {

constexpr double kLength = 20e-3, kThickness = 2e-3, kRadius = 5e-3, kMass = 1, kInertia = 0.5 * kMass * kRadius * kRadius;

/// A closed polygon of a roll about its own middle; in 3D a barrel along y, as wide as `width`.
Mesh roll_of(int dimension, int sides, double width) {
  Mesh mesh;
  mesh.dimension = dimension;
  const int rows = dimension == 3 ? 2 : 1;
  for (int row = 0; row < rows; ++row)
    for (int k = 0; k < sides; ++k) {
      const double a = 2 * M_PI * k / sides;
      mesh.nodes.push_back(dimension == 3 ? Vec3(kRadius * std::cos(a), (row - 0.5) * width, kRadius * std::sin(a)) : Vec3(kRadius * std::cos(a), kRadius * std::sin(a), 0));
    }
  for (int k = 0; k < sides; ++k) {
    const int next = (k + 1) % sides;
    Facet f;
    f.nodes = {k, next, dimension == 3 ? k + sides : -1};
    mesh.surface.push_back(f);
    if (dimension == 2) continue;
    f.nodes = {next, next + sides, k + sides};
    mesh.surface.push_back(f);
  }
  return mesh;
}

/// An elastic block on a frictionless table (y = 0, in 3D z = 0), a roll on top of it that a force presses down.
OneBody block_under_roll(int dimension, double force, double duration) {
  BlankConfig blank = strip_of(kLength, kThickness, 40, 4);
  if (dimension == 3) blank.shape = "plate", blank.width = 2e-3, blank.cells_along = 20, blank.cells_through = 2, blank.cells_across = 2, blank.pattern = "coarse";
  OneBody run(body_of(generate_blank(blank), aluminium()), duration);
  const Vec3 up = dimension == 3 ? Vec3::UnitZ() : Vec3::UnitY();
  run.model.tools.push_back(plane_at("table", dimension, Vec3::Zero(), up));
  ToolModel roll;
  roll.name = "roll";
  roll.mesh = roll_of(dimension, 360, 4e-3);
  roll.position = Vec3(0.5 * kLength, 0, 0) + (kThickness + kRadius) * up + (dimension == 3 ? Vec3(0, 1e-3, 0) : Vec3(0, 0, 0));
  roll.friction = 0.2;
  run.model.tools.push_back(roll);
  drive(run.model.tools[1], {0, 1e-4}, {Vec3::Zero(), -force * up}, kMass);
  MotionConfig& motion = *run.model.tools[1].motion;
  motion.centre = roll.position;
  motion.axle = dimension == 3 ? Vec3(0, -2, 0) : Vec3(0, 0, 3);  // of any length
  motion.inertia = kInertia;
  return run;
}

/// Its spin about the axle, from how far it turned in the last step, rad/s.
struct Turned {
  double before = 0, spin = 0;
  void see(const Simulation& sim, int tool = 1) {
    spin = (sim.tools()[tool].turned - before) / sim.dt();
    before = sim.tools()[tool].turned;
  }
};

}  // namespace

// Under a block that is driven at v the friction mu F turns it up at mu F R/I until it rolls at v/R; until then the block slid by half the way. The moment that
// it has felt is its angular momentum.
TEST(Axle, FrictionSpinsAnIdleRollUpUntilItRolls) {
  const double force = 2e4, v = 2;
  OneBody run = block_under_roll(2, force, 6e-4);
  BoundaryConfig pulled;
  pulled.set = "bottom";
  pulled.kind = "velocity";
  pulled.axes = {"x"};
  pulled.times = {0};
  pulled.velocities = {Vec3(v, 0, 0)};
  run.plan.bodies[0].boundaries = {pulled};
  run.plan.bodies[0].initial_velocity = Vec3(v, 0, 0);
  auto sim = run.start();
  Turned roll;
  double half = 0, at_rolling = 0;
  while (sim->step()) {
    roll.see(*sim);
    if (half == 0 && roll.spin > 0.5 * v / kRadius) half = sim->time();
    if (at_rolling == 0 && roll.spin > 0.98 * v / kRadius) at_rolling = sim->time();
  }
  const double up = 0.2 * force * kRadius / kInertia, expected = v / kRadius / up;
  const double moment = sim->tools()[1].felt.angular.z() - (sim->tools()[1].position.cross(sim->tools()[1].felt.impulse)).z();
  std::printf("  spin %.2f of %.2f rad/s; from half to full %.4g of %.4g s; slid away %.5g J/m, energy of its spin %.5g; balance %.1e\n", roll.spin, v / kRadius, at_rolling - half, 0.48 * expected,
              sim->energies().friction, 0.5 * kInertia * roll.spin * roll.spin, sim->balance_error());
  EXPECT_NEAR(roll.spin, v / kRadius, 0.01 * v / kRadius);
  EXPECT_NEAR(at_rolling - half, 0.48 * expected, 0.05 * expected);
  EXPECT_NEAR(sim->energies().friction, 0.5 * kInertia * roll.spin * roll.spin, 0.05 * sim->energies().friction);
  EXPECT_NEAR(moment, kInertia * roll.spin, 0.01 * kInertia * roll.spin);  // the roll rises by no more than the block gives way: its place is that of the end
  EXPECT_EQ(sim->contact_status().crossings, 0);
  EXPECT_LT(sim->balance_error(), 1e-3);
}

// A torque on the axle drives the block along: without slip the block goes at T R/(I + m R^2), in the plane and in 3D.
TEST(Axle, ATorqueDrivesWhatItRollsOn) {
  for (const int dimension : {2, 3}) {
    const double force = dimension == 2 ? 4e4 : 80, torque = dimension == 2 ? 20 : 0.04, duration = 8e-4;
    OneBody run = block_under_roll(dimension, force, duration);
    const double mass = mass_of(*run.start());
    MotionConfig& motion = *run.model.tools[1].motion;
    motion.mass = mass;
    motion.inertia = mass * kRadius * kRadius;
    motion.times = {0, 1e-4, 3e-4, 5e-4};
    motion.forces = {Vec3::Zero(), motion.forces[1], motion.forces[1], motion.forces[1]};
    motion.torques = {0, 0, torque, torque};
    auto sim = run.start();
    Turned roll;
    while (sim->step()) roll.see(*sim);
    const double given = torque * (0.5 * 2e-4 + (duration - 3e-4)), block = momenta(*sim).linear.x(), of_roll = motion.inertia * roll.spin;
    std::printf("  %dD: block %.5g of %.5g N s; roll %.5g of %.5g N m s; way round %.5g m, block %.5g m/s\n", dimension, block, 0.5 * given / kRadius, of_roll, 0.5 * given, kRadius * roll.before, block / mass);
    EXPECT_NEAR(block, 0.5 * given / kRadius, 0.03 * given / kRadius);
    EXPECT_NEAR(of_roll, 0.5 * given, 0.03 * given);
    EXPECT_NEAR(of_roll + block * kRadius, given, 0.01 * given);
    EXPECT_EQ(sim->contact_status().crossings, 0);
  }
}

// Two threads, and a run resumed while it turns, give the same bits.
TEST(Axle, TheSameWithTwoThreadsAndResumed) {
  const OneBody run = [] {
    OneBody r = block_under_roll(2, 2e4, 2e-4);
    r.plan.bodies[0].initial_velocity = Vec3(3, 0, 0);
    r.model.tools[1].motion->spin_damping = 100;
    return r;
  }();
  auto one = run.start(), two = run.start(2);
  std::vector<char> saved;
  while (one->step()) {
    ASSERT_TRUE(one->time() == 2e-4 || two->step());
    if (saved.empty() && one->time() > 1e-4) saved = one->save();
  }
  while (two->step()) {}
  auto resumed = run.start();
  resumed->restore(saved);
  EXPECT_NE(resumed->tools()[1].turned, 0);
  while (resumed->step()) {}
  EXPECT_NE(one->tools()[1].turned, 0);
  for (const auto* other : {&two, &resumed}) {
    EXPECT_EQ((*other)->tools()[1].turned, one->tools()[1].turned);
    EXPECT_EQ((*other)->tools()[1].peak_moment, one->tools()[1].peak_moment);
    EXPECT_EQ((*other)->positions(), one->positions());
  }
}

// Nothing turns it: it stands; it was turning, and turns on at the same speed, less what its bearing takes.
TEST(Axle, AloneItTurnsOn) {
  for (const double damping : {0., 500.}) {
    OneBody run = block_under_roll(2, 1e-3, 1e-4);
    ToolModel& roll = run.model.tools[1];
    roll.position.y() += 1e-3;
    roll.motion->centre = roll.position;
    roll.motion->kind = "velocity";
    roll.motion->forces.clear();
    roll.motion->mass = 0;
    roll.motion->times = {0};
    roll.motion->initial_spin_deg_s = 9000;
    roll.motion->spin_damping = damping;
    auto sim = run.start();
    while (sim->step()) {}
    const double expected = 9000 * M_PI / 180 * (damping > 0 ? (1 - std::exp(-damping * 1e-4)) / damping : 1e-4);
    EXPECT_NEAR(sim->tools()[1].turned, expected, 1e-3 * expected);
    EXPECT_LT((sim->tools()[1].rotation * Vec3::UnitX() - Vec3(std::cos(expected), std::sin(expected), 0)).norm(), 1e-3 * expected);
    EXPECT_LT((sim->tools()[1].position - roll.position).norm(), 1e-12);
  }
}

// Tied to a roll, a block goes round with it: the torque is in the momentum about the axle of both.
TEST(Axle, ATieHandsItsTorqueOn) {
  const double torque = 30, duration = 1e-4;
  OneBody run = block_under_roll(2, 1, duration);
  run.model.tools.erase(run.model.tools.begin());  // the table
  MotionConfig& motion = *run.model.tools[0].motion;
  motion.kind = "velocity";
  motion.forces.clear();
  motion.mass = 0;
  motion.times = {0, duration / 2, duration};
  motion.torques = {0, torque, 0};
  PairConfig tied;
  tied.first = "block", tied.second = "roll", tied.kind = "tied", tied.tie_distance = 2e-5;
  run.plan.contact.pairs.push_back(tied);
  auto sim = run.start();
  Turned turned;
  while (sim->step()) turned.see(*sim, 0);
  double of_block = 0;
  for (std::size_t n = 0; n < sim->positions().size(); ++n) of_block += sim->nodal_mass()[n] * (vec3(sim->positions()[n]) - motion.centre).cross(vec3(sim->velocities()[n])).z();
  const double given = torque * duration / 2;
  std::printf("  block %.6g, roll %.6g of %.6g N m s\n", of_block, kInertia * turned.spin, given);
  EXPECT_GT(std::abs(of_block), 0.05 * given);
  EXPECT_NEAR(of_block + kInertia * turned.spin, given, 0.01 * given);  // places are those of the end of the step, velocities of its middle
}

// A mill roll: it turns as it is told, and its force keeps it on the block, which it takes along.
TEST(Axle, ATurnedRollIsPressedByItsForce) {
  const double force = 4e4, v = 2;
  OneBody run = block_under_roll(2, force, 1e-3);
  MotionConfig& motion = *run.model.tools[1].motion;
  motion.axle = Vec3::Zero();
  motion.inertia = 0;
  motion.times = {0, 1e-4, 2e-4};
  motion.forces = {Vec3::Zero(), motion.forces[1], motion.forces[1]};
  motion.spins_deg_s = {Vec3::Zero(), Vec3::Zero(), Vec3(0, 0, v / kRadius * 180 / M_PI)};
  auto sim = run.start();
  while (sim->step()) {}
  const double angle = v / kRadius * (1e-3 - 1.5e-4), block = momenta(*sim).linear.x() / mass_of(*sim);
  const double given = force * (1e-3 - 0.5e-4), pressed = sim->tools()[1].felt.impulse.y();
  std::printf("  block %.4f of %.4f m/s, pressed by %.5g of %.5g N s/m\n", block, v, pressed, given);
  EXPECT_NEAR(block, v, 0.02 * v);
  EXPECT_NEAR(pressed, given, 0.02 * given);  // it swings
  EXPECT_LT((sim->tools()[1].rotation * Vec3::UnitX() - Vec3(std::cos(angle), std::sin(angle), 0)).norm(), 1e-9);
}

// It waits for its stage, turns from there on and while it is withdrawn, and is gone; resumed in any of these the bits are the same.
TEST(Axle, ThroughItsStages) {
  OneBody run = block_under_roll(2, 1e4, 2e-5);
  MotionConfig& motion = *run.model.tools[1].motion;
  motion.since = "turn";
  motion.times = {0};
  motion.forces = {motion.forces[1]};
  motion.initial_spin_deg_s = 20000;
  run.plan.stages[0].name = "wait";
  run.plan.stages.push_back(form_for(4e-5));
  run.plan.stages.back().name = "turn";
  run.plan.stages.push_back(withdraw(1e-3, 4e-5));
  run.plan.stages.push_back(form_for(2e-5));
  run.plan.stages.back().name = "after";
  auto whole = run.start();
  std::vector<std::vector<char>> saved(4);
  std::vector<double> turned(5);
  double gone = 0;
  while (whole->step()) {
    if (gone == 0 && !whole->tools()[1].present) gone = whole->tools()[1].turned;
    const int stage = whole->stage();
    turned[stage] = whole->tools()[1].turned;
    if (stage < 4 && saved[stage].empty() && whole->steps() % 7 == 0) saved[stage] = whole->save();
  }
  EXPECT_EQ(turned[0], 0);
  EXPECT_GT(turned[1], 0.8 * 20000 * M_PI / 180 * 4e-5);
  EXPECT_GT(turned[2], turned[1] + 0.8 * 20000 * M_PI / 180 * 3e-5);
  EXPECT_GE(gone, turned[2]);
  EXPECT_EQ(whole->tools()[1].turned, gone);
  EXPECT_FALSE(whole->tools()[1].present);
  for (const std::vector<char>& state : saved) {
    ASSERT_FALSE(state.empty());
    auto resumed = run.start();
    resumed->restore(state);
    while (resumed->step()) {}
    EXPECT_EQ(resumed->tools()[1].turned, whole->tools()[1].turned);
    EXPECT_EQ(resumed->tools()[1].position, whole->tools()[1].position);
    EXPECT_EQ(resumed->positions(), whole->positions());
  }
}

// Pressed down off its axle, it gives way along its guide and about its axle at once: both are found together, however light it is.
TEST(Axle, OffItsMiddleItGivesWayInBothAtOnce) {
  for (const double part : {1.1e-3, 1.}) {
    OneBody run = block_under_roll(2, 4e4, 2e-4);
    const double mass = mass_of(*run.start()), off = 4e-3;
    MotionConfig& motion = *run.model.tools[1].motion;
    motion.centre.x() += off;
    motion.mass = part * mass;
    motion.inertia = part * mass * (kRadius + off) * (kRadius + off);
    motion.torques = {0, off * 4e4};  // holds it level
    auto sim = run.start();
    while (sim->step()) {}
    std::printf("  %g of the mass: %.2f sweeps a step, %ld steps of %ld unsettled; turned by %.4f rad, force %.5g\n", part, static_cast<double>(sim->contact_status().sweeps) / static_cast<double>(sim->contact_status().swept_steps),
                sim->contact_status().unsettled_steps, sim->contact_status().swept_steps, sim->tools()[1].turned, sim->tools()[1].force.y());
    EXPECT_EQ(sim->contact_status().unsettled_steps, 0);
    EXPECT_EQ(sim->contact_status().crossings, 0);
    EXPECT_LT(sim->balance_error(), 1e-3);
  }
}

// A settle stage waits for a flywheel as it does for a holder: at rest friction bears its torque.
TEST(Axle, AHeavyOneComesToRestToo) {
  const double torque = 5;
  for (const double inertia : {1e-5, 1e-3, 0.1}) {
    OneBody run = block_under_roll(2, 1e4, 2e-4);
    MotionConfig& motion = *run.model.tools[1].motion;
    motion.times = {0, 1e-4, 2e-4};
    motion.forces = {Vec3::Zero(), motion.forces[1], motion.forces[1]};
    motion.torques = {0, 0, torque};
    motion.inertia = inertia;
    BoundaryConfig held;
    held.set = "bottom";
    held.kind = "fixed";
    run.plan.bodies[0].boundaries = {held};
    run.plan.stages.push_back(settle(0.2));
    auto sim = run.start();
    const std::atomic<bool> never{false};
    EXPECT_EQ(sim->run(never).code, Code::success) << inertia;
    std::printf("  inertia %g kg m: moment %.5f of %.5f N m/m at %.3g s\n", inertia, sim->tools()[1].moment.z(), -torque, sim->time());
    EXPECT_NEAR(sim->tools()[1].moment.z(), -torque, 0.01 * torque);
  }
}

// Braked harder than a step can follow it stands, and does not swing.
TEST(Axle, ABrakeStopsIt) {
  OneBody run = block_under_roll(2, 1e-3, 1e-5);
  ToolModel& roll = run.model.tools[1];
  roll.position.y() += 1e-3;
  roll.motion->centre = roll.position;
  roll.motion->initial_spin_deg_s = 1e6;
  roll.motion->spin_damping = 1e12;
  auto sim = run.start();
  double back = 0, before = 0;
  while (sim->step()) {
    back = std::min(back, sim->tools()[1].turned - before);
    before = sim->tools()[1].turned;
  }
  EXPECT_EQ(back, 0);
  EXPECT_LT(before, 1e-5);
}

// The default inertia is told; what drowns in what the sweeps leave open is refused.
TEST(Axle, ItsInertia) {
  OneBody run = block_under_roll(2, 1e3, 1e-6);
  run.model.tools[1].motion->inertia = 0;
  auto sim = run.start();
  const double mass = mass_of(*sim);
  EXPECT_NEAR(sim->model().tools[1].motion->inertia, mass * kRadius * kRadius, 1e-12 * mass * kRadius * kRadius);
  const auto told = std::find_if(sim->warnings().begin(), sim->warnings().end(), [](const std::string& w) { return w.find("turns freely about its axle") != std::string::npos; });
  ASSERT_NE(told, sim->warnings().end());
  run.model.tools[1].motion->inertia = 0.9e-3 * mass * kRadius * kRadius;
  try {
    run.start();
    FAIL() << "accepted";
  } catch (const SceneError& error) {
    EXPECT_EQ(error.faults()[0].field, "tools[1].motion.inertia");
  }
}

}  // namespace forming_sim
