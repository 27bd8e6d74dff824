// The Taylor bar of copper at a coarse mesh; scenes/taylor_bar.yaml is the finer one.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/taylor.h"

namespace forming_sim {
namespace {

/// 5 cells a radius, 80 us. The wall pushes only, or keeps the face.
TaylorShape bar(bool keeps_the_face) {
  OneBody run = taylor_bar(3, 5, "coarse", "node");
  if (!keeps_the_face) {
    std::vector<BoundaryConfig>& held = run.plan.bodies[0].boundaries;
    held.erase(std::remove_if(held.begin(), held.end(), [](const BoundaryConfig& b) { return b.set == "bottom"; }), held.end());
    ToolModel wall;
    wall.name = "wall";
    wall.normal = Vec3::UnitZ();
    run.model.tools.push_back(wall);
  }
  auto sim = run.start(2);
  const std::atomic<bool> cancel{false};
  const Outcome outcome = sim->run(cancel);
  EXPECT_EQ(outcome.code, Code::success) << outcome.message;
  EXPECT_EQ(sim->contact_status().crossings, 0);
  EXPECT_LT(sim->balance_error(), 0.01);
  const TaylorShape shape = taylor_shape(sim->positions(), 3);
  std::cout << "  length " << shape.length * 1e3 << " mm, radius " << shape.radius * 1e3 << " mm, balance "
            << sim->balance_error() << ", " << sim->wall_time() << " s\n";
  return shape;
}

// What an independent axisymmetric program (one-point quadrilaterals, radial return,
// a wall that releases) converges to: its rim lifts by .3 mm.
TEST(TaylorBar, WallThatOnlyPushes) {
  const TaylorShape shape = bar(false);
  EXPECT_NEAR(shape.length, 21.46e-3, 0.01 * 21.46e-3);
  EXPECT_NEAR(shape.radius, 7.37e-3, 0.02 * 7.37e-3);
}

// The published shape, which that program finds where the face cannot leave the wall.
TEST(TaylorBar, WallThatKeepsTheFace) {
  const TaylorShape shape = bar(true);
  EXPECT_NEAR(shape.length, 21.42e-3, 0.01 * 21.42e-3);
  EXPECT_NEAR(shape.radius, 7.22e-3, 0.02 * 7.22e-3);
}

}  // namespace
}  // namespace forming_sim
