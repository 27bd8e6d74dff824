// A sheet that nothing holds lies on two dies, and a punch bends it between them. What the tools tell of the sheet's motion as a whole does not agree,
// and their surfaces are hardly inclined against each other: where friction took its reference from all of them by least squares, it threw the sheet
// along the dies and gave it many times the work of the punch.
#include <gtest/gtest.h>

#include <optional>

#include "support/runs.h"

namespace forming_sim {

namespace {

ToolModel box(const char* name, const Vec3& min, const Vec3& max) {
  ToolModel tool;
  tool.name = name;
  tool.friction = .05;
  tool.mesh.dimension = 3;
  for (int k = 0; k < 8; ++k) tool.mesh.nodes.push_back(Vec3(k & 1 ? max.x() : min.x(), k & 2 ? max.y() : min.y(), k & 4 ? max.z() : min.z()));
  for (const auto& nodes : {std::array{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}}) {
    Facet facet;
    facet.nodes = nodes;
    tool.mesh.surface.push_back(facet);
  }
  return tool;
}

/// Bent within .244 ms by a punch that starts from rest; or by one of constant speed, while everything goes on by `drift`, m/s, along x as well.
OneBody bent(double friction, std::optional<double> drift = {}) {
  const double length = 10.3e-3, width = 5.24e-3, thickness = 1e-3, stroke = 2.5e-3, end = 2.44e-4;
  BlankConfig blank;
  blank.shape = "plate";
  blank.pattern = "one_point";
  blank.length = length, blank.width = width, blank.thickness = thickness;
  blank.cells_along = 13, blank.cells_across = 5, blank.cells_through = 2;
  MaterialConfig steel;
  steel.density = 7850;
  steel.youngs_modulus = 210e9;
  steel.poissons_ratio = .3;
  HardeningConfig swift;
  swift.curve = "swift";
  swift.strength = 550e6, swift.prestrain = .005, swift.exponent = .2;
  steel.hardening = swift;
  OneBody run(body_of(generate_blank(blank), steel), end);
  const double inner = .21 * length;
  run.model.tools = {box("left", Vec3(-thickness, -thickness, -3 * thickness), Vec3(inner, width + thickness, 0)),
                     box("right", Vec3(length - inner, -thickness, -3 * thickness), Vec3(length + thickness, width + thickness, 0)),
                     box("punch", Vec3(length / 2 - thickness, .3 * width, thickness), Vec3(length / 2 + thickness, .7 * width, 4 * thickness))};
  for (ToolModel& tool : run.model.tools) {
    tool.friction = friction;
    if (!drift && tool.name != "punch") continue;
    MotionConfig motion;
    motion.times = {0, end};
    if (drift) {
      motion.kind = "velocity";
      motion.velocities.assign(2, Vec3(*drift, 0, tool.name == "punch" ? -stroke / end : 0));
    } else {
      motion.kind = "trajectory";
      motion.positions = {Vec3::Zero(), Vec3(0, 0, -stroke)};
    }
    tool.motion = motion;
  }
  if (drift) run.plan.bodies[0].initial_velocity = Vec3(*drift, 0, 0);
  run.plan.time_step.limit = "element";
  return run;
}

}  // namespace

TEST(FreeSheet, TakesNoEnergyFromFriction) {
  const auto run = bent(.05);
  const auto sim = run.start();
  while (sim->step()) {}
  const Energies& e = sim->energies();
  std::printf("  work %.4g J, plastic %.4g, friction %.4g, kinetic %.4g, ledger %.2g\n", e.work, e.plastic, e.friction, e.kinetic, sim->balance_error());
  EXPECT_GT(e.friction, 0);
  EXPECT_LT(e.kinetic, .01 * e.work);
  EXPECT_LT(std::abs(sim->balance_error()), .01);
}

// As friction goes to none its work does: waves that leave took 7 % of this sheet's work at 1e-4 while they were those of a surface that sticks.
TEST(FreeSheet, SlidesFreelyWhereFrictionIsNextToNone) {
  double plastic[2], work[2], rubbed = 0;
  for (const bool next_to_none : {false, true}) {
    const auto sim = bent(next_to_none ? 1e-4 : 0).start();
    while (sim->step()) {}
    plastic[next_to_none] = sim->energies().plastic, work[next_to_none] = sim->energies().work;
    rubbed = sim->energies().friction;
  }
  std::printf("  friction 1e-4 takes %.2g of %.4g J\n", rubbed, work[1]);
  EXPECT_GT(rubbed, 0);
  EXPECT_LT(rubbed, 2e-4);  // mu times 0.93 J, by swing: free
  EXPECT_NEAR(plastic[1], plastic[0], 5e-4 * plastic[0]);
  EXPECT_NEAR(work[1], work[0], 5e-4 * work[0]);
}

// In a train that goes by the sheet is bent as it is on the platform.
TEST(FreeSheet, IsBentTheSameInAnyFrame) {
  double plastic[2], rubbed[2];
  for (const bool moving : {false, true}) {
    const auto sim = bent(.05, moving ? 100. : 0.).start();
    while (sim->step()) {}
    plastic[moving] = sim->energies().plastic, rubbed[moving] = sim->energies().friction;
  }
  std::printf("  friction takes %.5g J, in a frame that moves at 100 m/s %.5g\n", rubbed[0], rubbed[1]);
  EXPECT_NEAR(rubbed[1], rubbed[0], 2e-3 * rubbed[0]);
  EXPECT_NEAR(plastic[1], plastic[0], 1e-4 * plastic[0]);
}

}  // namespace forming_sim
