// What holds or drives nodes pushes on them: momentum, the ledger of a turned end, and what lets go.
#include <gtest/gtest.h>

#include "support/runs.h"

namespace forming_sim {
namespace {

BlankConfig plate_of(double length, double width, double thickness, int along, int across, int through) {
  BlankConfig blank;
  blank.shape = "plate";
  blank.length = length, blank.width = width, blank.thickness = thickness;
  blank.cells_along = along, blank.cells_across = across, blank.cells_through = through;
  blank.pattern = "coarse";
  return blank;
}

BoundaryConfig fixed(const std::string& set, std::vector<std::string> axes = {}) {
  BoundaryConfig b;
  b.set = set;
  b.kind = "fixed";
  b.axes = std::move(axes);
  return b;
}

Vec3 momentum_of(const Simulation& sim) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < sim.velocities().size(); ++i) sum += sim.nodal_mass()[i] * vec3(sim.velocities()[i]);
  return sum;
}

/// A plate under gravity is held at its left end and along y at its top, and a plane with friction comes down on its right end.
OneBody pressed_plate() {
  OneBody run(body_of(generate_blank(plate_of(0.02, 0.01, 0.004, 6, 3, 2)), aluminium(true)), 3e-4);
  run.plan.gravity = Vec3(300, -200, -1e4);
  run.plan.bodies[0].boundaries = {fixed("left"), fixed("top", {"y"})};
  ToolModel plane;
  plane.name = "punch";
  plane.friction = 0.3;
  plane.mesh.dimension = 3;
  plane.normal = Vec3(-0.4, 0.2, -1).normalized();
  plane.point = Vec3(0.02, 0, 0.004) - 1e-5 * plane.normal;
  MotionConfig motion;
  motion.kind = "velocity";
  motion.times = {0};
  motion.velocities = {3 * plane.normal};
  plane.motion = motion;
  run.model.tools.push_back(plane);
  return run;
}

/// Of the momentum and of what changed it, all in N s.
struct Momentum {
  Vec3 gained, reaction, tool, weight;
  double error() const { return (gained - reaction + tool - weight).norm() / reaction.norm(); }
};
Momentum run_to_the_end(const OneBody& run) {
  auto sim = run.start();
  const Vec3 start = momentum_of(*sim);
  std::vector<int> all;
  double mass = 0, kicks = 0, before = 0;
  for (std::size_t i = 0; i < sim->positions().size(); ++i) {
    all.push_back(static_cast<int>(i));
    mass += sim->nodal_mass()[i];
  }
  for (bool more = true; more; before = sim->dt()) {
    more = sim->step();
    kicks += 0.5 * (before + sim->dt());
  }
  EXPECT_LT(sim->balance_error(), 1e-3);
  return {momentum_of(*sim) - start, sim->reaction(all).impulse, sim->tools()[0].felt.impulse, mass * kicks * run.plan.gravity};
}

// The nodes along y are held and pressed at once: what the tool pushes there goes into what holds them.
TEST(HeldNodes, MomentumChangesByReactionsToolsAndWeight) {
  const Momentum m = run_to_the_end(pressed_plate());
  EXPECT_GT(m.tool.norm(), 0.1 * m.reaction.norm());
  EXPECT_GT(std::abs(m.tool.y()), 1e-3 * m.reaction.norm());
  EXPECT_LT(m.error(), 1e-10);
}

// What nobody asks for is not kept, and leaves the run and its ledger as they are: of what is driven the work is known all the same.
TEST(HeldNodes, ReactionsAreKeptOfTheNodesThatAreAskedForAlone) {
  OneBody run = pressed_plate();
  pull_right(run, {0, 3e-4}, {Vec3(0, 0, 0), Vec3(1, 0, 0)});
  run.plan.bodies[0].boundaries.back().axes = {"x"};
  const auto& sets = run.model.bodies[0].mesh.sets;
  const std::vector<int>&left = sets.at("left"), &top = sets.at("top");
  auto all = run.start(), some = run.start(), none = run.start();
  some->keep_reactions(left);
  none->keep_reactions({});
  EXPECT_EQ(none->reactions_kept(), 0);
  EXPECT_EQ(some->reactions_kept(), static_cast<int>(left.size()));
  EXPECT_GT(all->reactions_kept(), some->reactions_kept());
  while (all->step()) {}
  while (some->step()) {}
  while (none->step()) {}
  EXPECT_GT(all->energies().work, 0);
  EXPECT_GT(all->reaction(left).impulse.norm(), 0);
  EXPECT_EQ(some->reaction(left).impulse, all->reaction(left).impulse);
  EXPECT_EQ(some->reaction(left).angular, all->reaction(left).angular);
  EXPECT_FALSE(some->reaction(top).impulse.isApprox(all->reaction(top).impulse));
  EXPECT_EQ(none->reaction(top).impulse, Vec3(Vec3::Zero()));
  for (const auto* other : {some.get(), none.get()}) {
    EXPECT_EQ(other->energies().work, all->energies().work);
    EXPECT_EQ(other->positions(), all->positions());
  }
}

// A bar that turns at both ends as one is a rigid bar: the reactions are those of its angular momentum.
TEST(HeldNodes, EndsThatTurnTogetherTurnTheBar) {
  OneBody run(body_of(generate_blank(plate_of(0.02, 0.01, 0.004, 6, 3, 2)), aluminium()), 2e-3);
  run.plan.time_step.damping = 2e4;
  const Vec3 centre(0.01, 0.005, 0.002);
  for (const char* end : {"left", "right"}) {
    BoundaryConfig b;
    b.set = end;
    b.kind = "velocity";
    b.times = {0, 1e-3, 2e-3};
    b.spins_deg_s = {Vec3(0, 0, 0), Vec3(0, 0, 36000), Vec3(0, 0, 0)};  // 36 degrees in all
    b.profile = "smooth";
    b.centre = centre;
    run.plan.bodies[0].boundaries.push_back(b);
  }
  auto sim = run.start();
  while (sim->step()) {}
  EXPECT_LT(sim->balance_error(), 1e-3);
  const double a = 36 * M_PI / 180;
  double off = 0;
  for (std::size_t i = 0; i < sim->positions().size(); ++i) {
    const Vec3 r = vec3(sim->initial_positions()[i]) - centre;
    const Vec3 there(std::cos(a) * r.x() - std::sin(a) * r.y(), std::sin(a) * r.x() + std::cos(a) * r.y(), r.z());
    off = std::max(off, (vec3(sim->positions()[i]) - centre - there).norm());
  }
  EXPECT_LT(off, 1e-6);  // m: what its own inertia bends it
}

/// A strip is pulled within its elastic range, then its end is let go and it settles.
OneBody let_go() {
  OneBody run(body_of(generate_blank(strip_of(0.02, 0.004, 10, 2)), aluminium(true)), 2e-4);
  pull_right(run, {0, 1e-4, 2e-4}, {Vec3(0, 0, 0), Vec3(0.2, 0, 0), Vec3(0, 0, 0)});
  run.plan.bodies[0].boundaries.back().until = "settle";
  run.plan.stages.push_back(settle(5e-3));
  return run;
}

TEST(HeldNodes, WhatIsLetGoSpringsBack) {
  OneBody run = let_go();
  run.plan.time_step.safety = 0.3;  // the wave of letting go is as steep as the mesh bears
  auto sim = run.start();
  const std::vector<int>& right = run.model.bodies[0].mesh.sets.at("right");
  while (sim->stage() == 0) sim->step();
  const double pulled = vec3(sim->positions()[right[0]]).x() - 0.02;
  EXPECT_NEAR(pulled, 2e-5, 1e-9);
  const Vec3 impulse = sim->reaction(right).impulse;
  EXPECT_GT(impulse.x(), 0);
  while (sim->step()) {}
  EXPECT_LT(std::abs(vec3(sim->positions()[right[0]]).x() - 0.02), 0.02 * pulled);
  EXPECT_EQ(sim->reaction(right).impulse, impulse);  // nothing holds it any more
  EXPECT_LT(sim->balance_error(), 1e-3);
  // The other way: held to the end it keeps its length.
  run.plan.bodies[0].boundaries.back().until.clear();
  auto held = run.start();
  while (held->step()) {}
  EXPECT_NEAR(vec3(held->positions()[right[0]]).x() - 0.02, pulled, 1e-12);
}

TEST(HeldNodes, ResumesBeforeAndAfterTheyAreLetGo) {
  const OneBody run = let_go();
  auto whole = run.start();
  std::vector<std::vector<char>> saved;
  for (long step = 1; whole->step(); ++step)
    if (whole->stage() == 1 ? saved.size() == 1 : step == 20) saved.push_back(whole->save());
  ASSERT_EQ(saved.size(), 2u);
  for (const auto& checkpoint : saved) {
    const std::vector<int>& left = run.model.bodies[0].mesh.sets.at("left");
    auto resumed = run.start();
    resumed->keep_reactions(left);
    resumed->restore(checkpoint);
    while (resumed->step()) {}
    EXPECT_EQ(resumed->steps(), whole->steps());
    for (std::size_t i = 0; i < whole->positions().size(); ++i) ASSERT_EQ(resumed->positions()[i], whole->positions()[i]);
    EXPECT_EQ(resumed->reaction(left).impulse, whole->reaction(left).impulse);
  }
}

}  // namespace
}  // namespace forming_sim
