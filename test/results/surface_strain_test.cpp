// The greatest strain of the surface is that of the body, however much of it is meshed.
#include <gtest/gtest.h>

#include "forming_sim/mesh/measure.h"
#include "forming_sim/results/gauge.h"
#include "support/runs.h"

namespace forming_sim {
namespace {

/// A block that is upset by a fifth between rough plates, and swells at its sides.
Peak of_block(bool quarter, double& inside) {
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
  if (quarter) {
    run.plan.bodies[0].boundaries = {symmetric("left", Vec3::UnitX()), symmetric("front", Vec3::UnitY())};
    run.model.bodies[0].cut = cut_facets(run.model.bodies[0].mesh, {{"left", Vec3::UnitX()}, {"front", Vec3::UnitY()}});
  }
  auto sim = run.start();
  while (sim->step()) {}
  inside = 0;
  for (const SurfaceStrain& strain : sim->surface_strain()) inside = std::max(inside, strain.major);
  return Gauge(*sim, {}).at(*sim).surface_strain;
}

}  // namespace

TEST(SurfaceStrain, FacesInPlanesOfSymmetryAreNoSurface) {
  double with_cuts;
  const Peak whole = of_block(false, with_cuts), quarter = of_block(true, with_cuts);
  std::printf("  whole %.4f, quarter %.4f, with the faces that are cut %.4f\n", whole.value, quarter.value, with_cuts);
  EXPECT_NEAR(quarter.value, whole.value, .01 * whole.value);
  EXPECT_GT(with_cuts, 1.1 * whole.value);
}

}  // namespace forming_sim
