// Contact of elastic bodies as runs see it: a sharp corner into a coarse block, blocks that meet askew, layers a
// millionth of a cell at 1500 m/s, one thread and two.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "forming_sim/scene/build.h"
#include "forming_sim/scene/yaml.h"
#include "support/runs.h"

namespace forming_sim {
namespace {

/// Two unit blocks of n and m cells fly at each other along x, the second turned by `tilt`.
struct Blocks {
  Model model;
  RunPlan plan;

  Blocks(int dimension, int n, int m, double tilt, double speed, double layer, double after) {
    const double cell = 1.0 / std::max(n, m), gap = 1.02 * layer + 2 * speed * cell / 6300;
    model.dimension = dimension;
    plan.stages.push_back(form_for(gap / (2 * speed) + after));
    plan.contact.layer = layer;
    for (int side = 0; side < 2; ++side) {
      BlankConfig blank;
      blank.shape = dimension == 2 ? "strip" : "plate";
      blank.pattern = dimension == 2 ? "fine" : "coarse";
      blank.length = blank.width = blank.thickness = 1;
      blank.cells_along = blank.cells_across = blank.cells_through = side == 0 ? n : m;
      Mesh mesh = generate_blank(blank);
      const Mat3 turn = Eigen::AngleAxisd(side == 0 ? 0 : tilt, dimension == 2 ? Vec3(0, 0, 1) : Vec3(.3, .5, 1).normalized()).toRotationMatrix();
      double least = 1e300;
      for (Vec3& X : mesh.nodes) X = turn * X, least = std::min(least, side == 0 ? -X.x() : X.x());
      for (Vec3& X : mesh.nodes) X.x() += side == 0 ? least - gap / 2 : gap / 2 - least;
      add_flying(model, plan, body_of(std::move(mesh), aluminium()), side == 0 ? "left" : "right", Vec3(side == 0 ? speed : -speed, 0, 0));
    }
  }
};

struct Drift {
  double linear = 0, angular = 0;
};
/// Runs to the end; the largest drift of the momenta over the momentum of one block (times 1 m).
Drift drift_of(Simulation& sim, double speed) {
  double mass = 0;
  for (double m : sim.nodal_mass()) mass += m / 2;
  Momenta start;
  Drift drift;
  while (sim.step()) {
    const Momenta now = momenta(sim);
    if (sim.steps() == 1) start = now;
    drift.linear = std::max(drift.linear, (now.linear - start.linear).norm() / (mass * speed));
    drift.angular = std::max(drift.angular, (now.angular - start.angular).norm() / (mass * speed));
  }
  return drift;
}

}  // namespace

// 20 on 23 cells, tilted, frictionless: both momenta stay to rounding, contact takes energy and gives none.
TEST(ContactScenes, TiltedBlocksKeepTheirMomenta) {
  for (double tilt : {.1, .2, .3})
    for (double speed : {5., 500.}) {
      const Blocks blocks(2, 20, 23, tilt, speed, 1e-3, 6e-4);
      Simulation sim(blocks.plan, blocks.model, 1);
      const Drift drift = drift_of(sim, speed);
      const Energies& e = sim.energies();
      std::printf("  tilt %g, %g m/s: momentum %.1e, angular %.1e, contact took %.2e of the energy, halvings %ld\n", tilt, speed, drift.linear, drift.angular,
                  e.contact / e.initial, sim.contact_status().halvings);
      EXPECT_LT(drift.linear, 1e-13) << tilt << " " << speed;
      EXPECT_LT(drift.angular, 1e-13) << tilt << " " << speed;
      EXPECT_GT(e.contact, 0);
      EXPECT_EQ(sim.contact_status().crossings, 0);
      EXPECT_LT(sim.balance_error(), .01);
    }
}

// A contact that gives energy, or takes it without saying where to, is told at the end of the stage, once; the implicit one has nothing to tell.
TEST(ContactScenes, AnOpenLedgerIsTold) {
  Blocks blocks(2, 20, 23, .1, 50, 1e-3, 2e-3);
  const StageConfig stage = blocks.plan.stages[0];
  blocks.plan.stages.assign(2, stage);
  for (StageConfig& half : blocks.plan.stages) half.duration /= 2;
  for (const char* method : {"implicit", "geometric"}) {
    blocks.plan.contact.method = method;
    Simulation sim(blocks.plan, blocks.model, 1);
    while (sim.step()) continue;
    std::printf("  %s: balance error %.3g\n", method, sim.balance_error());
    long told = 0;
    for (const std::string& warning : sim.warnings()) told += warning.find("the energies do not add up") != std::string::npos;
    EXPECT_EQ(told, method == std::string("geometric") ? 1 : 0);
  }
}

// h0 a millionth of a cell, far less than the way of a step: some steps are halved, those after them are short too, and the run gets through.
TEST(ContactScenes, LayersOfAMillionthAtHighSpeed) {
  struct Case {
    int dimension, n, m;
    double tilt;
  };
  for (const Case& c : {Case{2, 16, 19, .1}, Case{3, 5, 6, .1}}) {
    const double speed = 1500, layer = 1e-6 / std::max(c.n, c.m);
    const Blocks blocks(c.dimension, c.n, c.m, c.tilt, speed, layer, 6e-5);
    Simulation sim(blocks.plan, blocks.model, 1);
    const Drift drift = drift_of(sim, speed);
    const ContactStatus status = sim.contact_status();
    std::printf("  %dD, %d on %d, tilt %g: %ld steps, %ld halvings, momentum %.1e, angular %.1e\n", c.dimension, c.m, c.n, c.tilt, sim.steps(), status.halvings, drift.linear,
                drift.angular);
    EXPECT_GT(status.halvings, 10);
    EXPECT_LT(status.halvings, 0.1 * sim.steps());
    EXPECT_LT(drift.linear, 1e-12);
    EXPECT_LT(drift.angular, 1e-12);
    EXPECT_EQ(status.crossings, 0);
  }
}

// A wedge narrower than a cell, into the middle of a side of a coarse block: it is held, and no element is crushed.
TEST(ContactScenes, ATipIntoACoarseBlock) {
  for (double speed : {50., 500.}) {
    const double cell = .25;
    BlankConfig blank = strip_of(1, .5, 4, 2);
    blank.origin = Vec3(-.5, 0, 0);
    OneBody run(body_of(generate_blank(blank), aluminium()), .1 * cell / speed);
    ToolModel wedge;
    wedge.name = "wedge";
    wedge.mesh.dimension = 2;
    wedge.mesh.nodes = {Vec3(-.02, -1, 0), Vec3(0, 0, 0), Vec3(.02, -1, 0)};
    join_nodes(wedge.mesh);
    wedge.position = Vec3(.11, -1e-3, 0);
    MotionConfig motion;
    motion.kind = "velocity";
    motion.times = {0};
    motion.velocities = {Vec3(0, speed, 0)};
    wedge.motion = motion;
    run.model.tools.push_back(wedge);
    auto sim = run.start();
    double least = 1;
    while (sim->step())
      for (double ratio : sim->volume_ratio()) least = std::min(least, ratio);
    std::printf("  %g m/s: least V/V0 %.3f, impulse on the wedge %.3g N s\n", speed, least, -sim->tools()[0].felt.impulse.y());
    EXPECT_GT(least, .6);
    EXPECT_LT(sim->tools()[0].felt.impulse.y(), 0);
    EXPECT_EQ(sim->contact_status().crossings, 0);
    EXPECT_EQ(sim->contact_status().halvings, 0);
  }
}

// A wedge goes through a block of one-point cells to the ground below: what is left between has nowhere to go.
TEST(ContactScenes, AWedgeThatGoesThroughABlockEndsTheRun) {
  BlankConfig blank = strip_of(1, .5, 4, 2);
  blank.origin = Vec3(-.5, 0, 0);
  blank.pattern = "one_point";
  OneBody run(body_of(generate_blank(blank), aluminium()), .01);
  ToolModel wedge, ground;
  wedge.name = "wedge";
  wedge.mesh.dimension = ground.mesh.dimension = 2;
  wedge.mesh.nodes = {Vec3(-.2, 1, 0), Vec3(0, .5, 0), Vec3(.2, 1, 0)};
  join_nodes(wedge.mesh);
  MotionConfig motion;
  motion.kind = "velocity";
  motion.times = {0};
  motion.velocities = {Vec3(0, -100, 0)};
  wedge.motion = motion;
  ground.name = "ground";
  ground.normal = Vec3::UnitY();
  run.model.tools = {wedge, ground};
  auto sim = run.start();
  try {
    long steps = 0;
    while (sim->step()) ASSERT_LT(++steps, 100000) << "at " << sim->time() << " s";
    ADD_FAILURE() << "the wedge has passed the ground";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), Code::mesh_error) << e.what();
    EXPECT_NE(std::string(e.what()).find("element"), std::string::npos) << e.what();
  }
  EXPECT_EQ(sim->contact_status().crossings, 0);
}

// The force on a tool is what the body stands on it with, however strongly it is damped and however short the last step is. Its
// impulses by themselves are less, by half the damping of a step, and belong to the mean of two steps.
TEST(ContactScenes, AStandingBodyWeighsItsWeight) {
  BlankConfig blank = strip_of(1, .5, 4, 2);
  blank.origin = Vec3(0, 1e-7, 0);
  OneBody run(body_of(generate_blank(blank), aluminium()), 8e-2);
  run.plan.stages.push_back(form_for(2e-5));  // less than a step
  ToolModel ground;
  ground.name = "ground";
  ground.normal = Vec3::UnitY();
  ground.mesh.dimension = 2;
  run.model.tools.push_back(ground);
  run.plan.contact.layer = 1e-5;
  run.plan.gravity = Vec3(0, -1e4, 0);
  run.plan.time_step.damping = 1e4;
  auto sim = run.start();
  double dt = 0, last_dt = 0;
  while (sim->step()) {
    dt = last_dt;
    last_dt = sim->dt();
  }
  const double weight = 1e4 * aluminium().density * .5;
  std::printf("  force %.9f of the weight; damping %.3g a step, last step %.2g of the one before\n", -sim->tools()[0].force.y() / weight, 1e4 * dt, sim->dt() / dt);
  EXPECT_NEAR(-sim->tools()[0].force.y() / weight, 1, 1e-6);
  EXPECT_GT(1e4 * dt, .01);
  EXPECT_LT(sim->dt(), .9 * dt);
}

// A strip driven into a groove with walls of so little slope that they hold it like a wedge: contact takes energy and gives none.
TEST(ContactScenes, ASharpGrooveGivesNothing) {
  for (double slope : {.005, .02})
    for (double speed : {5., 50., 500.}) {
      const double half = .5e-3, way = 1e-3, depth = half / slope;  // it is as wide as the groove when it has gone that way
      BlankConfig blank = strip_of(2 * half, 10e-3, 4, 40);
      blank.origin = Vec3(-half, way, 0);
      OneBody run(body_of(generate_blank(blank), aluminium()), 2 * way / speed + 2e-5);
      run.plan.bodies[0].initial_velocity = Vec3(0, -speed, 0);
      ToolModel groove;
      groove.name = "groove";
      groove.mesh.dimension = 2;
      groove.mesh.nodes = {Vec3(-2 * half, depth, 0), Vec3(0, -depth, 0), Vec3(2 * half, depth, 0)};
      join_nodes(groove.mesh);
      run.model.tools.push_back(groove);
      auto sim = run.start();
      double least = 0, most = 0;
      while (sim->step()) {
        const Energies& e = sim->energies();
        least = std::min(least, e.contact / e.initial);
        most = std::max(most, e.contact / e.initial);
      }
      std::printf("  slope %g, %g m/s: energy in contact %.1e to %.1e of that at the start, %ld halvings\n", slope, speed, least, most, sim->contact_status().halvings);
      EXPECT_GE(least, -1e-6);
      EXPECT_GT(most, 1e-6);
      EXPECT_EQ(sim->contact_status().crossings, 0);
    }
}

// Ties on nodes that boundaries hold: what these cannot do the sweeps do not wait for.
TEST(ContactScenes, TiesOnAPlaneOfSymmetrySettle) {
  std::vector<Fault> faults;
  const Scene scene = read_scene(R"yaml(
name: tied
dimension: 2
bodies:
  - name: a
    blank: {shape: strip, length: 0.004, thickness: 0.001, cells_along: 4, cells_through: 2}
    material: {density: 2800, youngs_modulus: 70e9, poissons_ratio: 0.32}
    initial_velocity: [0, -1]
    boundaries: [{set: left, kind: symmetric, normal: [1, 0]}]
  - name: b
    blank: {shape: strip, origin: [0, 0.001001], length: 0.003, thickness: 0.001, cells_along: 6, cells_through: 2}
    material: {density: 2800, youngs_modulus: 70e9, poissons_ratio: 0.32}
    initial_velocity: [0, -1]
    boundaries: [{set: left, kind: symmetric, normal: [1, 0]}]
tools:
  - name: anvil
    profile: {start: [0.0045, -0.005], pieces: [{to: [0.0045, -1e-5]}, {to: [0.003, -1e-5]}, {to: [0.003, -0.005]}]}
contact: {pairs: [{first: a, second: b, kind: tied}]}
stages: [{kind: form, duration: 1e-4}]
)yaml", ".", faults);
  ASSERT_TRUE(faults.empty());
  Simulation sim(build_plan(scene), build_model(scene), 1);
  while (sim.step()) {}
  const ContactStatus contact = sim.contact_status();
  std::printf("  %.1f sweeps a step, %ld steps ended at the most\n", static_cast<double>(contact.sweeps) / static_cast<double>(contact.swept_steps), contact.unsettled_steps);
  EXPECT_EQ(contact.unsettled_steps, 0);
  EXPECT_LT(sim.balance_error(), 1e-3);
}

// At the rim of two blocks of one size the sides of the lower one are as near as its top: the pressure goes through the top, everywhere.
TEST(ContactScenes, TiedBlocksFeelTheirPressureUpToTheRim) {
  const double pressure = 20e6, side = 6e-3;
  for (const int D : {2, 3}) {
    MaterialConfig m = aluminium();
    m.poissons_ratio = 0;
    BlankConfig lower = strip_of(side, side, 3, 3);
    lower.pattern = "one_point";
    if (D == 3) lower.shape = "plate", lower.width = side, lower.cells_across = 3;
    BlankConfig upper = lower;
    upper.origin[D - 1] = side;
    OneBody run(body_of(generate_blank(lower), m), 2e-4);
    run.model.bodies[0].name = "lower";
    BodyLoads& loads = add_flying(run.model, run.plan, body_of(generate_blank(upper), m), "upper", Vec3::Zero());
    PressureConfig press;
    press.set = "top";
    press.times = {0, 1e-4};
    press.values = {0, pressure};
    press.profile = "smooth";
    loads.pressures = {press};
    run.plan.bodies[0].boundaries = {symmetric("bottom", Vec3::Unit(D - 1))};
    run.plan.contact.pairs = {{}};
    run.plan.contact.pairs[0].first = "lower";
    run.plan.contact.pairs[0].second = "upper";
    run.plan.contact.pairs[0].kind = "tied";
    run.plan.time_step.damping = 2e5;
    auto sim = run.start();
    while (sim->step()) {}
    const std::vector<double> felt = sim->contact_pressure();
    int between = 0;
    for (std::size_t n = 0; n < felt.size(); ++n) {
      if (std::abs(sim->initial_positions()[n][D - 1] - side) > 1e-9) continue;
      ++between;
      EXPECT_NEAR(felt[n], pressure, .01 * pressure) << D << "D, at " << vec3(sim->initial_positions()[n]).transpose();
    }
    EXPECT_EQ(between, D == 2 ? 8 : 32);
  }
}

}  // namespace forming_sim
