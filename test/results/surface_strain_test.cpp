// The greatest strain of the surface is that of the body, however much of it is meshed.
#include <gtest/gtest.h>

#include "forming_sim/results/gauge.h"
#include "support/runs.h"

namespace forming_sim {
namespace {

/// A block that is upset by a fifth between rough plates, and swells at its sides.
struct Greatest {
  double surface, all;  ///< all: faces in planes of symmetry too
};
Greatest of_block(bool quarter) {
  const double width = 8e-3, height = 8e-3, time = 4e-4;
  const int cells = quarter ? 3 : 6;
  BlankConfig blank = strip_of(quarter ? width / 2 : width, height, cells, 6);
  blank.shape = "plate";
  blank.width = blank.length;
  blank.cells_across = cells;
  blank.pattern = "one_point";
  if (!quarter) blank.origin = Vec3(-width / 2, -width / 2, 0);
  OneBody run(body_of(generate_blank(blank), aluminium(true)), time);
  press(run, height, time, height / 5);
  for (ToolModel& tool : run.model.tools) tool.friction = .5;
  if (quarter) run.plan.bodies[0].boundaries = {symmetric("left", Vec3::UnitX()), symmetric("front", Vec3::UnitY())};
  auto sim = run.start();
  while (sim->step()) {}
  Greatest found{Gauge(*sim, {}).at(*sim).surface_strain.value, 0};
  for (const SurfaceStrain& strain : sim->surface_strain()) found.all = std::max(found.all, strain.major);
  return found;
}

}  // namespace

TEST(SurfaceStrain, FacesInPlanesOfSymmetryAreNoSurface) {
  const Greatest whole = of_block(false), quarter = of_block(true);
  std::printf("  whole %.4f, quarter %.4f, with the faces that are cut %.4f\n", whole.surface, quarter.surface, quarter.all);
  EXPECT_EQ(whole.surface, whole.all);
  EXPECT_NEAR(quarter.surface, whole.surface, .01 * whole.surface);
  EXPECT_GT(quarter.all, 1.1 * whole.surface);
}

}  // namespace forming_sim
