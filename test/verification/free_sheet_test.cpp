// A sheet that nothing holds lies on two dies, and a punch bends it between them. What the tools tell of the sheet's motion as a whole does not agree,
// and their surfaces are hardly inclined against each other: where friction took its reference from all of them by least squares, it threw the sheet
// along the dies and gave it many times the work of the punch.
#include <gtest/gtest.h>

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

}  // namespace

TEST(FreeSheet, TakesNoEnergyFromFriction) {
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
  MotionConfig down;
  down.kind = "trajectory";
  down.times = {0, end};
  down.positions = {Vec3::Zero(), Vec3(0, 0, -stroke)};
  run.model.tools[2].motion = down;
  const auto sim = run.start();
  while (sim->step()) {}
  const Energies& e = sim->energies();
  std::printf("  work %.4g J, plastic %.4g, friction %.4g, kinetic %.4g, ledger %.2g\n", e.work, e.plastic, e.friction, e.kinetic, sim->balance_error());
  EXPECT_GT(e.friction, 0);
  EXPECT_LT(e.kinetic, .01 * e.work);
  EXPECT_LT(std::abs(sim->balance_error()), .01);
}

}  // namespace forming_sim
