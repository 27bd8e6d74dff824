// Tools that a force drives: a blank holder presses with its force, a hammer keeps momentum and energy, and neither needs a parameter.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/runs.h"

namespace forming_sim {
namespace {

constexpr double kLength = 10e-3, kThickness = 1e-3;
/// A strip between a table at y = 0 and a holder `gap` above it, which a force presses down.
OneBody held_strip(int along, int through, double gap, double duration) {
  OneBody run(body_of(generate_blank(strip_of(kLength, kThickness, along, through)), aluminium()), duration);
  run.model.tools.push_back(plane_at("table", 2, Vec3::Zero(), Vec3::UnitY()));
  run.model.tools.push_back(plane_at("holder", 2, Vec3(0, kThickness + gap, 0), -Vec3::UnitY()));
  return run;
}
ToolModel& holder_of(OneBody& run) { return run.model.tools[1]; }

/// Of a tool of this mass, J.
double kinetic_energy(const Simulation& sim, int tool, double mass) { return 0.5 * mass * sim.tools()[tool].velocity.squaredNorm(); }

}  // namespace

// In the end the sheet bears the force, and is thinner by F t/(L E'), E' = E/(1 - nu^2), whatever the holder weighs.
TEST(DrivenTool, AHolderPressesWithItsForce) {
  const double force = 1e6;
  for (const double mass : {0., 3e-5, 10.}) {  // of the sheet: .027 kg/m
    OneBody run = held_strip(40, 4, 0, 1.5e-3);
    drive(holder_of(run), {0, 5e-4}, {Vec3::Zero(), Vec3(0, -force, 0)}, mass);
    run.plan.time_step.damping = 5e4;
    auto sim = run.start();
    const double start = sim->tools()[1].position.y();
    while (sim->step()) {}
    const MaterialConfig m = aluminium();
    const double thinner = force * kThickness / kLength * (1 - m.poissons_ratio * m.poissons_ratio) / m.E(), way = start - sim->tools()[1].position.y();
    std::printf("  mass %g kg/m: force on holder %.7g, on table %.7g of %g N/m; way %.5g of %.5g m; kinetic energy %.1e of elastic\n", mass, sim->tools()[1].force.y(),
                sim->tools()[0].force.y(), force, way, thinner, sim->energies().kinetic / sim->energies().elastic);
    EXPECT_NEAR(sim->tools()[1].force.y(), force, 1e-3 * force);
    EXPECT_NEAR(sim->tools()[0].force.y(), -force, 1e-3 * force);
    EXPECT_NEAR(way, thinner, 0.005 * thinner);
    EXPECT_LT(sim->energies().kinetic, 1e-5 * sim->energies().elastic);
    EXPECT_EQ(sim->contact_status().crossings, 0);
  }
}

// A holder on spacers presses the sheet as far as they let it, and with what the sheet then asks for; they bear the rest of its force.
TEST(DrivenTool, OnSpacersItPressesNoFurther) {
  const double force = 1e8, stop = 1e-6;
  OneBody run = held_strip(20, 4, 0, 1.5e-3);
  drive(holder_of(run), {0, 5e-4}, {Vec3::Zero(), Vec3(0, -force, 0)});
  holder_of(run).motion->stop_ahead = stop;
  run.plan.time_step.damping = 5e4;
  auto sim = run.start();
  const double start = sim->tools()[1].position.y();
  std::vector<char> saved;
  while (sim->step())
    if (saved.empty() && sim->time() > 1e-3) saved = sim->save();
  const MaterialConfig m = aluminium();
  const double asks = stop / kThickness * kLength * m.E() / (1 - m.poissons_ratio * m.poissons_ratio), way = start - sim->tools()[1].position.y();
  std::printf("  way %.9g of %g m; force on holder %.6g, on table %.6g of %.6g N/m; balance %.1e\n", way, stop, sim->tools()[1].force.y(), sim->tools()[0].force.y(), asks, sim->balance_error());
  EXPECT_GE(way, stop);
  EXPECT_LT(way, 1.01 * stop);
  EXPECT_NEAR(sim->tools()[1].force.y(), asks, 0.02 * asks);
  EXPECT_NEAR(sim->tools()[0].force.y(), -sim->tools()[1].force.y(), 1e-3 * asks);
  EXPECT_EQ(sim->contact_status().crossings, 0);
  for (const std::string& warning : sim->warnings()) EXPECT_TRUE(warning.find("no more") == std::string::npos && warning.find("lifted off") == std::string::npos) << warning;
  auto resumed = run.start(2);
  resumed->restore(saved);
  while (resumed->step()) {}
  for (std::size_t n = 0; n < resumed->positions().size(); ++n) ASSERT_EQ(resumed->positions()[n], sim->positions()[n]) << n;
}

/// A ram presses the strip by `way` within half a millisecond, and stops under `force`; then it is taken away.
OneBody stopping_ram(double force, double way) {
  OneBody run = held_strip(20, 2, 0, 5e-4);
  lead(holder_of(run), 5e-4, Vec3(0, -way, 0));
  holder_of(run).motion->stop_force = force;
  run.plan.time_step.damping = 2e4;
  run.plan.stages[0].until_stopped = "holder";
  run.plan.stages.push_back(withdraw(1e-3, 1e-4));
  run.plan.stages.back().tools = {"holder"};
  return run;
}

/// The warning that a tool did not stop; empty: none.
std::string told_unstopped(const Simulation& sim) {
  for (const std::string& warning : sim.warnings())
    if (warning.find("that stop it") != std::string::npos) return warning;
  return "";
}

TEST(DrivenTool, ARamStopsUnderItsForce) {
  const double force = 2e5, way = 50e-6;
  auto sim = stopping_ram(force, way).start();
  const double start = sim->tools()[1].position.y();
  double felt = 0;
  while (sim->stage() == 0) {
    felt = sim->tools()[1].force.y();
    sim->step();
  }
  const double stands = sim->tools()[1].position.y(), ended = sim->time();
  std::printf("  stopped at %.3g s under %.6g N/m, after %.3g m\n", ended, sim->tools()[1].force.y(), start - stands);
  EXPECT_LT(felt, force);
  EXPECT_GE(sim->tools()[1].force.y(), force);
  EXPECT_LT(sim->tools()[1].force.y(), 1.01 * force);
  EXPECT_LT(ended, 4e-4);
  EXPECT_LT(start - stands, .5 * way);
  const std::vector<char> saved = sim->save();
  while (sim->step()) {}
  EXPECT_NEAR(sim->time(), ended + 1e-4, 1e-9);
  EXPECT_NEAR(sim->tools()[1].position.y(), stands + 1e-3, 1e-9);  // from where it stood
  EXPECT_TRUE(told_unstopped(*sim).empty());

  auto resumed = stopping_ram(force, way).start();
  resumed->restore(saved);
  while (resumed->step()) {}
  EXPECT_EQ(resumed->time(), sim->time());
  EXPECT_EQ(resumed->tools()[1].position, sim->tools()[1].position);
  EXPECT_EQ(vec3(resumed->positions()[5]), vec3(sim->positions()[5]));
}

// A flap on a hinge far from the origin of its frame: what moves there is no way of the flap, and its whole force stops it.
TEST(DrivenTool, AFlapStopsUnderItsWholeForce) {
  const double force = 2e5;
  OneBody run = held_strip(20, 2, 0, 5e-4);
  ToolModel& flap = holder_of(run);
  flap.motion = MotionConfig();
  flap.motion->kind = "trajectory";
  flap.motion->times = {0, 5e-4};
  flap.motion->positions = {Vec3::Zero(), Vec3::Zero()};
  flap.motion->rotations_deg = {Vec3::Zero(), Vec3(0, 0, .5)};
  flap.motion->centre = Vec3(kLength + 1e-3, kThickness, 0);
  flap.motion->stop_force = force;
  run.plan.time_step.damping = 2e4;
  run.plan.stages[0].until_stopped = "holder";
  auto sim = run.start();
  while (sim->step()) {}
  const ToolStatus& told = sim->tools()[1];
  ASSERT_TRUE(told.stopped.has_value()) << told.force.transpose();
  EXPECT_NEAR(told.force.norm(), force, .02 * force);
}

// Half a block pushes its ram aside by friction, which the other half would balance: a press feels neither.
TEST(DrivenTool, ARamOnHalfABlockStopsWhereItDoesOnTheWhole) {
  const double height = 10e-3, force = 4e6;
  double way[2];
  for (const bool half : {false, true}) {
    const double length = half ? 10e-3 : 20e-3;
    OneBody run(body_of(generate_blank(strip_of(length, height, half ? 5 : 10, 5)), aluminium(true)), 1e-3);
    press(run, height, 1e-3, 1e-3);
    for (ToolModel& tool : run.model.tools) tool.friction = .3;
    run.model.tools[1].motion->stop_force = half ? force / 2 : force;
    run.plan.stages[0].until_stopped = "ram";
    run.plan.time_step.damping = 2e4;
    if (half) run.plan.bodies[0].boundaries = {symmetric("left", Vec3::UnitX())};
    auto sim = run.start();
    while (sim->step()) {}
    const ToolStatus& ram = sim->tools()[1];
    ASSERT_TRUE(ram.stopped.has_value());
    way[half] = -ram.position.y();
    std::printf("  %s: stopped after %.4g mm under (%.4g, %.4g) N/m\n", half ? "half" : "whole", 1e3 * way[half], ram.force.x(), ram.force.y());
    const double stop = run.model.tools[1].motion->stop_force;
    EXPECT_GE(ram.force.y(), stop);
    EXPECT_LT(ram.force.y(), 1.01 * stop);
    EXPECT_EQ(std::abs(ram.force.x()) > .1 * ram.force.y(), half);
  }
  EXPECT_NEAR(way[1], way[0], .01 * way[0]);
}

TEST(DrivenTool, WhatDidNotStopIsTold) {
  auto sim = stopping_ram(1e9, 5e-6).start();
  while (sim->step()) {}
  EXPECT_NEAR(sim->time(), 6e-4, 1e-9);
  EXPECT_NE(told_unstopped(*sim).find("of the 1e+09 N/m"), std::string::npos) << told_unstopped(*sim);
}

// A tool that is taken away at once stays where it was taken away, though its motion would go on.
TEST(DrivenTool, ThatIsGoneMovesNoMore) {
  OneBody run = held_strip(4, 1, 1e-3, 1e-4);
  lead(holder_of(run), 4e-4, Vec3(0, -5e-4, 0));
  run.plan.stages.push_back(withdraw(0, 1e-4));
  run.plan.stages.push_back(form_for(1e-4));
  auto sim = run.start();
  while (sim->stage() == 0) sim->step();
  const Vec3 place = sim->tools()[1].position;
  while (sim->step()) {}
  EXPECT_FALSE(sim->tools()[1].present);
  EXPECT_EQ(sim->tools()[1].position, place);
}

// Where it lies its force does not let it fall, however light it is: contact looks no farther than for a heavy one.
TEST(DrivenTool, ALightOneIsNotSoughtFarAway) {
  long listed[2] = {0, 0};
  for (const bool light : {false, true}) {
    OneBody run = held_strip(60, 1, 0, 2e-5);
    ToolModel& holder = holder_of(run);
    holder.normal = holder.point = Vec3::Zero();
    for (int k = 0; k <= 60; ++k) holder.mesh.nodes.push_back(Vec3((1.2 * k / 60 - 0.1) * kLength, kThickness, 0));
    join_nodes(holder.mesh);
    drive(holder, {0, 1e-5}, {Vec3::Zero(), Vec3(0, -1e6, 0)}, light ? 3e-5 : 1.);
    auto sim = run.start();
    while (sim->step()) listed[light] = std::max(listed[light], sim->contact_status().listed_pairs);
  }
  std::printf("  most pairs listed: heavy %ld, light %ld\n", listed[0], listed[1]);
  EXPECT_LT(listed[1], 1.5 * listed[0]);
}

// In its first step it has no speed yet, and its force takes it through all that there is of the sheet: it is looked for that far.
TEST(DrivenTool, OneThatIsThrownInASingleStepMeetsTheSheet) {
  for (const double gap : {1e-3, 1e-2}) {
    OneBody run = held_strip(10, 2, gap, 1e-6);
    const double mass = 2e-3 * mass_of(*run.start()), step = run.start()->dt();
    drive(holder_of(run), {0}, {Vec3(0, -2 * mass * 3 * (gap + kThickness) / (step * step), 0)}, mass);
    auto sim = run.start();
    try {
      while (sim->step()) EXPECT_EQ(sim->contact_status().crossings, 0);
    } catch (const Error& error) {  // more than a sheet can bear
      EXPECT_TRUE(error.code() == Code::mesh_error || error.code() == Code::contact_error) << error.what();
    }
    EXPECT_GT(sim->tools()[1].position.y(), -gap - kThickness);
  }
}

// A mass that drowns in what the sweeps leave open is refused, and told what would do.
TEST(DrivenTool, ATooLightOneIsRefused) {
  for (const double part : {0.9e-3, 1.1e-3}) {
    OneBody run = held_strip(10, 1, 0, 1e-6);
    const double mass = mass_of(*run.start());
    drive(holder_of(run), {0}, {Vec3(0, -1e5, 0)}, part * mass);
    try {
      run.start();
      EXPECT_GT(part, 1e-3);
    } catch (const SceneError& error) {
      EXPECT_LT(part, 1e-3);
      ASSERT_EQ(error.faults().size(), 1u);
      EXPECT_EQ(error.faults()[0].field, "tools[1].motion.mass");
      EXPECT_NE(error.faults()[0].remedy.find("0.001 of the mass of the bodies"), std::string::npos) << error.what();
    }
  }
}

// A hammer is pushed, flies, strikes a free block and flies on, or back: what it had, both have together. What the hammer loses is what the
// ledger of the block counts as work on it; that ledger is open by what the step leaves open.
TEST(DrivenTool, AStrikeKeepsMomentumAndEnergy) {
  for (const int dimension : {2, 3})
    for (const double heavier : {3., .1, .002}) {
      BlankConfig blank = strip_of(0.1, 0.05, 12, 6);
      if (dimension == 3) blank.shape = "plate", blank.width = 0.05, blank.cells_across = 6, blank.pattern = "coarse";
      OneBody run(body_of(generate_blank(blank), aluminium()), 3e-4);
      const double mass = heavier * mass_of(*run.start()), push = 2e-5, force = 20 * mass / push;  // to 10 m/s, smoothly
      run.model.tools.push_back(plane_at("hammer", dimension, Vec3(-2e-4, 0, 0), Vec3::UnitX()));
      drive(run.model.tools[0], {0, push / 2, push}, {Vec3::Zero(), force * Vec3::UnitX(), Vec3::Zero()}, mass);
      auto sim = run.start();
      double before = 0, open = 0;
      while (sim->step()) {
        if (sim->time() > push && before == 0) before = sim->tools()[0].velocity.x();
        if (before > 0) open = std::max(open, std::abs(kinetic_energy(*sim, 0, mass) + sim->energies().work - 0.5 * mass * before * before));
      }
      const double after = sim->tools()[0].velocity.x(), given = mass * before, energy = 0.5 * given * before;
      const double kept = momenta(*sim).linear.x() + mass * after;
      std::printf("  %dD, %g of the block: %.4f m/s before, %.4f after; momentum %.1e, energy %.1e open, ledger of the block %.1e\n", dimension, heavier, before, after, kept / given - 1,
                  open / energy, sim->energies().residual() / energy);
      EXPECT_NEAR(before, 10, 0.05);
      EXPECT_LT(after, 0.9 * before);
      EXPECT_EQ(sim->contact_status().crossings, 0);
      EXPECT_NEAR(kept / given, 1, 1e-10);
      EXPECT_LT(open / energy, 1e-4);
    }
}

// A drop hammer upsets a cylinder without friction: what it had, and its weight on the way, is in the plastic work of even compression.
TEST(DrivenTool, AHammerSpendsItsEnergyOnTheBlank) {
  const double radius = 5e-3, height = 10e-3, gap = 1e-4, mass = 8, speed = 5, weight = mass * 9.81;
  OneBody run(body_of(generate_blank(strip_of(radius, height, 4, 8)), aluminium(true)), 4e-3);
  run.model.axisymmetric = true;
  run.model.tools.push_back(plane_at("anvil", 2, Vec3::Zero(), Vec3::UnitY()));
  run.model.tools.push_back(plane_at("hammer", 2, Vec3(0, height + gap, 0), -Vec3::UnitY()));
  drive(run.model.tools[1], {0}, {Vec3(0, -weight, 0)}, mass);
  run.model.tools[1].motion->initial_velocity = Vec3(0, -speed, 0);
  auto sim = run.start();
  EXPECT_EQ(sim->tools()[1].velocity, Vec3(0, -speed, 0));
  const double start = sim->tools()[1].position.y(), given = kinetic_energy(*sim, 1, mass);
  double deepest = 0;
  while (sim->step()) deepest = std::min(deepest, sim->tools()[1].position.y() - start);
  const double fallen = start - sim->tools()[1].position.y(), left = kinetic_energy(*sim, 1, mass);
  EXPECT_NEAR(sim->energies().work, given + weight * fallen - left, 1e-3 * given);
  EXPECT_GT(sim->tools()[1].velocity.y(), 0);  // it flies back
  const HardeningConfig h = *aluminium(true).hardening;
  const double squeezed = std::log(height / (height + gap + deepest)), volume = M_PI * radius * radius * height;
  const double strain = squeezed - (h.saturation_stress - (h.saturation_stress - h.yield_stress) * std::exp(-h.rate * squeezed)) / aluminium().E();  // plastic
  const double work = volume * (h.saturation_stress * strain - (h.saturation_stress - h.yield_stress) / h.rate * (1 - std::exp(-h.rate * strain)));
  std::printf("  %.4g J given, %.4g J plastic; %.4g J by the even compression to strain %.4f; it flies back at %.3f m/s\n", given, sim->energies().plastic, work, strain,
              sim->tools()[1].velocity.y());
  EXPECT_NEAR(sim->energies().plastic, work, .01 * work);
  EXPECT_GT(sim->energies().plastic, .95 * given);
}

// Dropped with its whole force on a sheet of one cell it rattles: what the force does is in its motion and in the work on the sheet.
TEST(DrivenTool, DroppedOnOneCellItRattlesAndGainsNothing) {
  const double force = 1e5, gap = 1.5e-4;
  for (const double mass : {1e-3, 0.1}) {
    OneBody run = held_strip(10, 1, gap, 2e-3);
    drive(holder_of(run), {0}, {Vec3(0, -force, 0)}, mass);
    auto sim = run.start();
    const double start = sim->tools()[1].position.y();
    double open = 0, back = 0;
    while (sim->step()) {
      const double way = start - sim->tools()[1].position.y() + 0.5 * sim->dt() * sim->tools()[1].velocity.y();  // at the half step, as the ledger
      open = std::max(open, std::abs(kinetic_energy(*sim, 1, mass) + sim->energies().work - force * way));
      if (sim->time() > 1e-3) back = std::max(back, gap - way);
    }
    std::printf("  mass %g kg/m: %.1e of what the force gave is open; rebound in the second half %.3g m\n", mass, open / (force * gap), back);
    EXPECT_LT(open / (force * gap), 2e-3);
    EXPECT_LT(back, gap);
    EXPECT_EQ(sim->contact_status().crossings, 0);
  }
}

// Tied to the end of a bar it pulls that along: all that the force gives is in both.
TEST(DrivenTool, ATieHandsItsForceOn) {
  const double mass = 0.02, force = 3e4, duration = 1e-4;
  OneBody run(body_of(generate_blank(strip_of(0.05, 0.01, 20, 4)), aluminium()), duration);
  run.model.tools.push_back(plane_at("jaw", 2, Vec3(0.05, 0, 0), -Vec3::UnitX()));
  drive(run.model.tools[0], {0, duration / 2, duration}, {Vec3::Zero(), Vec3(force, 0, 0), Vec3::Zero()}, mass);
  PairConfig tied;
  tied.first = "block", tied.second = "jaw", tied.kind = "tied";
  run.plan.contact.pairs.push_back(tied);
  auto sim = run.start();
  while (sim->step()) {}
  const double bar = momenta(*sim).linear.x(), jaw = mass * sim->tools()[0].velocity.x(), given = force * duration / 2;
  std::printf("  bar %.6g, jaw %.6g of %.6g N s\n", bar, jaw, given);
  EXPECT_NEAR((bar + jaw) / given, 1, 1e-6);  // the force is summed over the steps
  EXPECT_GT(bar, 0.8 * given);
}

// A ring under a ring: force, mass and the answer are of the whole circle.
TEST(DrivenTool, ARingIsPressedWithTheForceOnItsWholeCircle) {
  const double force = 5e4, inner = 10e-3, outer = 20e-3, height = 2e-3;
  BlankConfig blank = strip_of(outer - inner, height, 20, 4);
  blank.origin = Vec3(inner, 0, 0);
  OneBody run(body_of(generate_blank(blank), aluminium()), 1e-3);
  run.model.axisymmetric = true;
  run.model.tools.push_back(plane_at("table", 2, Vec3::Zero(), Vec3::UnitY()));
  run.model.tools.push_back(plane_at("holder", 2, Vec3(0, height, 0), -Vec3::UnitY()));
  drive(run.model.tools[1], {0, 4e-4}, {Vec3::Zero(), Vec3(0, -force, 0)});
  run.plan.time_step.damping = 5e4;
  auto sim = run.start();
  const double start = sim->tools()[1].position.y(), thinner = force / (M_PI * (outer * outer - inner * inner)) * height / aluminium().youngs_modulus;
  while (sim->step()) {}
  std::printf("  force on holder %.6g of %g N; way %.5g of %.5g m\n", sim->tools()[1].force.y(), force, start - sim->tools()[1].position.y(), thinner);
  EXPECT_NEAR(sim->tools()[1].force.y(), force, 1e-3 * force);
  EXPECT_NEAR(start - sim->tools()[1].position.y(), thinner, 0.01 * thinner);
}

// Two threads, and a run resumed while the force acts and while the tool is withdrawn, give the same bits.
TEST(DrivenTool, ThreadsAndResumesGiveTheSameBits) {
  OneBody run = held_strip(24, 4, 2e-5, 1e-4);
  ToolModel& holder = holder_of(run);  // a surface instead of a plane, which rubs
  holder.normal = holder.point = Vec3::Zero();
  holder.friction = 0.1;
  for (const double x : {-0.1, 0.45, 1.1}) holder.mesh.nodes.push_back(Vec3(x * kLength, kThickness + 2e-5 + 1e-6 * x, 0));
  join_nodes(holder.mesh);
  drive(holder_of(run), {0, 5e-5}, {Vec3::Zero(), Vec3(0, -2e5, 0)});
  run.plan.stages.push_back(withdraw(1e-3, 5e-5));
  run.plan.stages.push_back(form_for(2e-5));
  auto one = run.start(1), two = run.start(2);
  std::vector<std::vector<char>> saved;
  Vec3 before_withdrawal = Vec3::Zero();
  for (bool goes_on = true; goes_on;) {
    goes_on = one->step();
    EXPECT_EQ(two->step(), goes_on);
    if (one->stage() == 0) before_withdrawal = one->tools()[1].position;
    if (one->time() > 7e-5 && saved.empty()) saved.push_back(one->save());
    if (one->time() > 1.2e-4 && saved.size() == 1) saved.push_back(one->save());
  }
  for (std::size_t n = 0; n < one->positions().size(); ++n) ASSERT_EQ(two->positions()[n], one->positions()[n]) << n;
  EXPECT_EQ(two->tools()[1].position, one->tools()[1].position);
  ASSERT_EQ(saved.size(), 2u);
  EXPECT_LT(before_withdrawal.y(), -1e-5);
  EXPECT_NEAR(one->tools()[1].position.y() - before_withdrawal.y(), 1e-3, 1e-7);
  for (const std::vector<char>& state : saved) {
    auto resumed = run.start(1);
    resumed->restore(state);
    while (resumed->step()) {}
    for (std::size_t n = 0; n < resumed->positions().size(); ++n) ASSERT_EQ(resumed->positions()[n], one->positions()[n]) << n;
    EXPECT_EQ(resumed->tools()[1].position, one->tools()[1].position);
  }
}

}  // namespace forming_sim
