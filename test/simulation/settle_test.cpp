// When a settle stage ends: not before tools that forces drive, and loads that are on their way, have come to rest too.
#include <gtest/gtest.h>

#include <atomic>

#include "forming_sim/simulation/settle.h"
#include "support/runs.h"

namespace forming_sim {
namespace {

/// A cantilever of 10 x 1 mm whose end a force pulls down between two times, in one settle stage.
OneBody loaded(double from, double to, double limit) {
  OneBody run(body_of(generate_blank(strip_of(10e-3, 1e-3, 10, 2)), aluminium()), 1);
  run.plan.stages = {settle(limit)};
  clamp_left(run);
  LoadConfig load;
  load.set = "right";
  load.kind = "force";
  load.times = {from, to};
  load.forces = {Vec3::Zero(), Vec3(0, -1000, 0)};
  run.plan.bodies[0].loads = {load};
  return run;
}
/// How far the end has come, m.
double sag(const Simulation& sim) {
  double lowest = 0;
  for (const Node& x : sim.positions()) lowest = std::max(lowest, -x[1]);
  return lowest;
}
/// How far the first of the bodies has come down when all rest, m.
double sag_at_rest(Simulation& sim) {
  while (sim.step()) {}
  double lowest = 0;
  for (int n = 0; n < sim.model().bodies[0].node_count; ++n) lowest = std::max(lowest, sim.initial_positions()[n][1] - sim.positions()[n][1]);
  return lowest;
}
/// Puts a block that stands on its foot beside the body of a run.
void add_standing(OneBody& run, const BlankConfig& block, const std::string& name) {
  BoundaryConfig foot;
  foot.set = "bottom";
  foot.kind = "fixed";
  add_flying(run.model, run.plan, body_of(generate_blank(block), aluminium()), name, Vec3::Zero()).boundaries = {foot};
}

/// A body of two nodes that drifts, and whose nodes swing against each other, some of it fast: w(t) = a cos(omega t) + b cos(100 omega t).
struct Swinging {
  double omega = 1e3, a = 1e-3, b = 0, drift = 0, dt = 1e-6;
  /// What a settle stage makes of it until `end`, damping told to it as `alpha`: 1/s.
  double damping_at(double end, double alpha) const {
    const Ways::Nodes both{0, 2};
    const std::vector<double> mass(2, 0.1);
    Settle settle(0, {1 / omega}, {0.0}, 0, 1e-5);
    Ways ways;
    NodeField x(2, Node::Zero()), v(2, Node::Zero());
    double dragged = 0;
    for (long step = 0; step * dt < end; ++step) {
      const double t = step * dt, w = a * std::cos(omega * t) + b * std::cos(100 * omega * t);
      const double speed = -omega * (a * std::sin(omega * t) + 100 * b * std::sin(100 * omega * t));
      const double was = x[0][0];
      for (const int i : {0, 1}) {
        const double sign = i ? -1 : 1;
        x[i][0] = i + sign * w, x[i][1] = drift * t;
        v[i][0] = sign * speed, v[i][1] = drift;
      }
      if (step > 0) dragged += alpha * (x[0][0] - was);
      NodeField u = v;  // of the damped body, which the forces -omega^2 m w move as they do the free one
      for (const int i : {0, 1}) u[i][0] -= (i ? -1 : 1) * dragged, u[i][1] -= alpha * drift * t;
      if (step % Settle::kInterval != 0) continue;
      if (ways.empty()) {
        ways.begin(t, 1, x, u);
        continue;
      }
      if (!ways.ends_half(0)) continue;
      ways.go_on(x, alpha);
      if (ways.whole(0) && settle.over(0, ways.way(t, 0, both, x, u, mass, false), dt, false)) ways.begin_again(t, 0, both, x, u);
      else ways.double_up(t, 0, both, x, u);
      settle.take_together(dt);
    }
    return settle.damping();
  }
};

}  // namespace

// Twice the frequency, whatever damps the body, or swings in it with less energy. What flies as a whole is not held up.
TEST(Settle, DampsForTheSwingThatHasTheEnergy) {
  const double end = 3e-3;
  Swinging swing;
  EXPECT_NEAR(swing.damping_at(end, 0), 2 * swing.omega, .1 * swing.omega);
  EXPECT_NEAR(swing.damping_at(end, 3e3), 2 * swing.omega, .1 * swing.omega);
  swing.b = 1e-4 * swing.a;  // 1e-4 of the energy; in a single step it weighs as much as the slow one
  EXPECT_NEAR(swing.damping_at(end, 0), 2 * swing.omega, .2 * swing.omega);
  swing.b = .1 * swing.a;  // a hundred times the energy
  EXPECT_GT(swing.damping_at(end, 0), 20 * swing.omega);
  swing.b = 0;
  swing.drift = 1e3 * swing.a * swing.omega;
  EXPECT_LT(swing.damping_at(end, 0), .01 * swing.omega);
}

// A sheet that sags by its weight has next to no energy: what is left of it when it is told to rest must not show.
TEST(Settle, ASlackSheetHangsWhereItsWeightHoldsIt) {
  double sags[2];
  for (const bool fine : {false, true}) {
    OneBody run(body_of(generate_blank(strip_of(60e-3, 1e-3, 30, 2)), aluminium()), 1);
    run.plan.stages = {settle(1)};
    if (fine) run.plan.stages[0].kinetic_fraction = 1e-10;
    clamp_left(run);
    run.plan.gravity = Vec3(0, -9.81, 0);
    auto sim = run.start();
    while (sim->step()) {}
    sags[fine] = sag(*sim);
    std::printf("  sags by %.5g m, at rest after %.3g s and %ld steps\n", sags[fine], sim->time(), sim->steps());
  }
  EXPECT_NEAR(sags[0], sags[1], .001 * sags[1]);
}

TEST(Settle, WaitsForALoadThatRises) {
  auto quick = loaded(0, 5e-4, .1).start(), slow = loaded(0, 1e-2, .1).start();
  for (auto* sim : {&quick, &slow})
    while ((*sim)->step()) {}
  std::printf("  sags by %.5g m under a load of .5 ms, %.5g m of 10 ms, at rest after %.3g s\n", sag(*quick), sag(*slow), slow->time());
  EXPECT_GT(slow->time(), 1e-2);
  EXPECT_LT(slow->time(), 2e-2);
  EXPECT_NEAR(sag(*slow), sag(*quick), .005 * sag(*quick));
}

TEST(Settle, WaitsInTheLastStageForALoadThatIsToCome) {
  auto last = loaded(4e-3, 6e-3, .1).start();
  while (last->step()) {}
  EXPECT_GT(last->time(), 6e-3);
  EXPECT_LT(last->time(), 7e-3);  // the waiting is no window
  OneBody run = loaded(4e-3, 6e-3, .1);
  run.plan.stages.push_back(form_for(1e-3));
  auto before = run.start();
  while (before->stage() == 0) before->step();
  EXPECT_LT(before->time(), 4e-3);  // the load belongs to what follows
}

// Between level knots nothing is on its way.
TEST(Settle, DoesNotWaitWhileALoadIsHeld) {
  for (const bool last : {true, false}) {
    OneBody run = loaded(0, 5e-4, .1);
    LoadConfig& load = run.plan.bodies[0].loads[0];
    load.times = {0, 5e-4, 8e-2, 9e-2};
    load.forces = {Vec3::Zero(), Vec3(0, -1000, 0), Vec3(0, -1000, 0), last ? Vec3(0, -1000, 0) : Vec3(Vec3::Zero())};
    if (!last) run.plan.stages.push_back(form_for(1e-6));
    auto sim = run.start();
    while (sim->stage() == 0 && sim->step()) {}
    EXPECT_GT(sim->time(), 5e-4) << last;
    EXPECT_LT(sim->time(), 2e-2) << last;
  }
}

TEST(Settle, ThatIsTooShortToTellSaysSo) {
  OneBody run = loaded(0, 1e-6, 2e-6);
  const std::atomic<bool> never{false};
  const Outcome outcome = run.start()->run(never);
  EXPECT_EQ(outcome.code, Code::limit_reached);
  EXPECT_EQ(outcome.message.find("still changed"), std::string::npos) << outcome.message;
}

TEST(Settle, ThatTheLimitCutsOffWhileALoadRisesSaysSo) {
  const std::atomic<bool> never{false};
  OneBody run = loaded(0, .1, 2e-2);
  const Outcome cut = run.start()->run(never);
  EXPECT_EQ(cut.code, Code::limit_reached);
  EXPECT_NE(cut.message.find("still changed"), std::string::npos) << cut.message;
  run.plan.stages[0].ends = "limit";
  EXPECT_EQ(run.start()->run(never).code, Code::success);
  // One that takes its time before others is no failure; what it leaves is told.
  run = loaded(0, 1e-6, 2e-6);
  run.plan.stages[0].ends = "limit";
  run.plan.stages[0].name = "hold";
  run.plan.stages.push_back(settle(1e-2));
  auto sim = run.start();
  const Outcome after = sim->run(never);
  EXPECT_EQ(after.code, Code::success) << after.message;
  ASSERT_EQ(sim->warnings().size(), 1u);
  EXPECT_EQ(sim->warnings()[0].find("stage hold reached its limit"), 0u) << sim->warnings()[0];
}

TEST(Settle, ThatMovesOnIsToldToEndIt) {
  const std::atomic<bool> never{false};
  OneBody run(body_of(generate_blank(strip_of(10e-3, 1e-3, 10, 2)), aluminium(true)), 1e-4);
  run.plan.stages.push_back(settle(1e-4));
  pull_right(run, {0, 1e-5}, {Vec3::Zero(), Vec3(1, 0, 0)});
  const Outcome outcome = run.start()->run(never);
  EXPECT_EQ(outcome.code, Code::limit_reached);
  EXPECT_NE(outcome.message.find("set right of body"), std::string::npos) << outcome.message;
  EXPECT_EQ(outcome.message.find("a longer limit"), std::string::npos) << outcome.message;
}

// A strip sags beside a block under 100 MPa, whose energy is some million times that of the strip.
TEST(Settle, JudgesEachBodyByItself) {
  OneBody alone(body_of(generate_blank(strip_of(40e-3, 1e-3, 40, 2)), aluminium()), 1);
  alone.plan.stages = {settle(.2)};
  clamp_left(alone);
  alone.plan.gravity = Vec3(0, -9.81, 0);
  OneBody both = alone;
  BlankConfig block = strip_of(40e-3, 40e-3, 6, 6);
  block.origin = Vec3(0, -60e-3, 0);
  add_standing(both, block, "heavy");
  PressureConfig pressure;
  pressure.set = "top";
  pressure.times = {0, 1e-4};
  pressure.values = {0, 100e6};
  both.plan.bodies[1].pressures = {pressure};
  double sags[2];
  for (const bool block_too : {false, true}) {
    auto sim = (block_too ? both : alone).start();
    sags[block_too] = sag_at_rest(*sim);
  }
  std::printf("  sags by %.5g m alone, %.5g m beside the block\n", sags[0], sags[1]);
  EXPECT_NEAR(sags[1], sags[0], .01 * sags[0]);
}

// What positions cannot tell of a block of 1 m is more than the energy of a strip of 20 mm that sags beside it.
TEST(Settle, JudgesATinyBodyBesideAHugeOne) {
  OneBody run(body_of(generate_blank(strip_of(20e-3, 5e-4, 20, 2)), aluminium()), 1);
  run.plan.stages = {settle(.2)};
  clamp_left(run);
  run.plan.gravity = Vec3(0, -9.81, 0);
  auto alone = run.start();
  BlankConfig block = strip_of(1, 1, 4, 4);
  block.origin = Vec3(.5, 0, 0);
  add_standing(run, block, "huge");
  auto beside = run.start();
  const double expected = sag_at_rest(*alone), found = sag_at_rest(*beside);
  std::printf("  sags by %.5g m alone, %.5g m beside the block\n", expected, found);
  EXPECT_NEAR(found, expected, .01 * expected);
}

// A body that falls is not at rest because it moves slowly yet, and is not held up.
TEST(Settle, LetsFallWhatFalls) {
  OneBody run(body_of(generate_blank(strip_of(10e-3, 1e-3, 10, 2)), aluminium()), 1);
  run.model.tools = {plane_at("floor", 2, Vec3(0, -2e-4, 0), Vec3::UnitY())};
  run.plan.gravity = Vec3(0, -9.81, 0);
  run.plan.stages = {settle(.1)};
  auto sim = run.start();
  const double fall = std::sqrt(2 * 2e-4 / 9.81);
  while (sim->time() < .9 * fall && sim->step()) {}
  const double way = .5 * 9.81 * sim->time() * sim->time(), gone = sim->initial_positions()[0][1] - sim->positions()[0][1];
  std::printf("  has fallen by %.4g of %.4g mm\n", 1e3 * gone, 1e3 * way);
  EXPECT_GT(gone, .8 * way);
  while (sim->step()) {}
  EXPECT_LT(sim->time(), .05);
  EXPECT_NEAR(sim->tools()[0].force.y(), -9.81 * mass_of(*sim), .01 * 9.81 * mass_of(*sim));
}

// What has bounced off is brought to rest in its flight, and its speed is lost: that is told.
TEST(Settle, TellsOfABodyThatFlies) {
  for (bool falls : {false, true}) {
    OneBody run(body_of(generate_blank(strip_of(10e-3, 1e-3, 10, 2)), aluminium()), 1e-5);
    run.plan.bodies[0].initial_velocity = Vec3(0, 3, 0);
    if (falls) run.plan.gravity = Vec3(0, -9.81, 0);
    run.plan.stages.push_back(settle(1e-4));
    auto sim = run.start();
    while (sim->step()) {}
    const std::vector<std::string>& all = sim->warnings();
    const bool told = std::any_of(all.begin(), all.end(), [](const std::string& w) { return w.find("goes as a whole, with 3 m/s when stage settle begins") != std::string::npos; });
    EXPECT_EQ(told, !falls);
  }
}

// A long thin strip far away, on which nothing acts, once made a settle stage as long as its own slowest swing.
TEST(Settle, DoesNotWaitForABodyThatDoesNothing) {
  OneBody alone = loaded(0, 5e-4, 1), beside = alone;
  BlankConfig strip = strip_of(300e-3, 1e-3, 100, 2);
  strip.origin = Vec3(0.5, 0, 0);
  add_flying(beside.model, beside.plan, body_of(generate_blank(strip), aluminium()), "idle", Vec3::Zero());
  auto first = alone.start(), second = beside.start();
  for (auto* sim : {&first, &second})
    while ((*sim)->step()) {}
  std::printf("  at rest after %.3g s, beside an idle strip %.3g s\n", first->time(), second->time());
  EXPECT_NEAR(second->time(), first->time(), .1 * first->time());
  EXPECT_NEAR(sag(*second), sag(*first), .003 * sag(*first));
}

// A compact block is slower to look at than to swing: it is quiet from one look to the next all the same, a time over which its weight can be felt.
TEST(Settle, IsQuietBeforeItEnds) {
  OneBody run(body_of(generate_blank(strip_of(10e-3, 10e-3, 2, 2)), aluminium()), 1);
  run.model.tools = {plane_at("floor", 2, Vec3(0, -1e-5, 0), Vec3::UnitY())};
  run.plan.gravity = Vec3(0, -9.81, 0);
  run.plan.stages = {settle(.1)};
  run.plan.stages[0].kinetic_fraction = 1e-8;
  auto sim = run.start();
  long quiet = 0;
  while (sim->step()) quiet += sim->quiet();
  EXPECT_GE(quiet, 100);
  EXPECT_LT(sim->time(), .1);
}

// What has left the bodies neither is stopped nor has to come to rest, whatever acts on it.
TEST(Settle, AHammerThatHasLeftFliesOn) {
  for (const double weight : {0., -10.}) {
    OneBody run(body_of(generate_blank(strip_of(10e-3, 1e-3, 20, 2)), aluminium()), 1e-4);
    run.model.tools = {plane_at("table", 2, Vec3::Zero(), Vec3::UnitY()), plane_at("hammer", 2, 1.001e-3 * Vec3::UnitY(), -Vec3::UnitY())};
    drive(run.model.tools[1], {0}, {Vec3(0, weight, 0)}, 1);
    run.model.tools[1].motion->initial_velocity = Vec3(0, -1, 0);
    run.plan.stages.push_back(settle(5e-3));
    auto sim = run.start();
    while (sim->stage() == 0) sim->step();
    const double speed = sim->tools()[1].velocity.y(), began = sim->time();
    EXPECT_GT(speed, .5);
    const std::atomic<bool> never{false};
    EXPECT_EQ(sim->run(never).code, Code::success) << weight;
    EXPECT_NEAR(sim->tools()[1].velocity.y(), speed + weight * (sim->time() - began), 1e-6);
  }
}

// The heavier the tool, the slower it swings on what it presses: the strip stands still at every turning point.
TEST(Settle, AHeavyToolComesToRestWithWhatItPresses) {
  const double force = 1e6;
  for (const double mass : {.027, 1., 100.}) {  // of the strip: .027 kg/m
    OneBody run(body_of(generate_blank(strip_of(10e-3, 1e-3, 20, 2)), aluminium()), 2e-4);
    run.model.tools = {plane_at("table", 2, Vec3::Zero(), Vec3::UnitY()), plane_at("holder", 2, 1e-3 * Vec3::UnitY(), -Vec3::UnitY())};
    drive(run.model.tools[1], {0, 1e-4}, {Vec3::Zero(), Vec3(0, -force, 0)}, mass);
    run.plan.stages.push_back(settle(.05));
    auto sim = run.start();
    while (sim->step()) {}
    std::printf("  mass %g kg/m: force %.7g N/m at %.3g s\n", mass, sim->tools()[1].force.y(), sim->time());
    EXPECT_LT(sim->time(), .04);
    EXPECT_NEAR(sim->tools()[1].force.y(), force, .003 * force);
    EXPECT_NEAR(sim->tools()[0].force.y(), -force, .003 * force);
  }
}

}  // namespace forming_sim
