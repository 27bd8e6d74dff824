// The Taylor bar of copper at a coarse mesh; scenes/taylor_bar.yaml is the finer one.
#include <gtest/gtest.h>

#include "support/runs.h"

namespace forming_sim {
namespace {

struct Shape {
  double length, radius;  ///< m
};

/// 5 cells a radius, 80 us. The wall pushes only, or keeps the face.
Shape taylor_bar(bool keeps_the_face) {
  BlankConfig bar;
  bar.shape = "bar";
  bar.portion = "quarter";
  bar.pattern = "coarse";
  bar.length = 32.4e-3;
  bar.radius = 3.2e-3;
  bar.cells_radius = 5;
  bar.cells_along = 50;
  MaterialConfig copper;
  copper.density = 8930;
  copper.youngs_modulus = 117e9;
  copper.poissons_ratio = 0.35;
  HardeningConfig h;
  h.curve = "linear";
  h.yield_stress = 400e6;
  h.modulus = 100e6;
  copper.hardening = h;
  OneBody run(body_of(generate_blank(bar), copper, "node"), 80e-6);
  run.plan.bodies[0].initial_velocity = Vec3(0, 0, -227);
  const auto symmetric = [&](const char* set, int axis) {
    BoundaryConfig b;
    b.set = set;
    b.kind = "symmetric";
    b.normal = Vec3::Unit(axis);
    run.plan.bodies[0].boundaries.push_back(b);
  };
  symmetric("symmetry_x", 0);
  symmetric("symmetry_y", 1);
  if (keeps_the_face) {
    symmetric("bottom", 2);
  } else {
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
  double low = 1, high = -1, radius = 0;
  for (const Node& n : sim->positions()) {
    low = std::min(low, n[2]);
    high = std::max(high, n[2]);
    radius = std::max(radius, n.head<2>().norm());
  }
  std::cout << "  length " << (high - low) * 1e3 << " mm, radius " << radius * 1e3 << " mm, balance "
            << sim->balance_error() << ", " << sim->wall_time() << " s\n";
  return {high - low, radius};
}

// What an independent axisymmetric program (one-point quadrilaterals, radial return,
// a wall that releases) converges to: its rim lifts by .3 mm.
TEST(TaylorBar, WallThatOnlyPushes) {
  const Shape shape = taylor_bar(false);
  EXPECT_NEAR(shape.length, 21.46e-3, 0.01 * 21.46e-3);
  EXPECT_NEAR(shape.radius, 7.37e-3, 0.02 * 7.37e-3);
}

// The published shape, which that program finds where the face cannot leave the wall.
TEST(TaylorBar, WallThatKeepsTheFace) {
  const Shape shape = taylor_bar(true);
  EXPECT_NEAR(shape.length, 21.42e-3, 0.01 * 21.42e-3);
  EXPECT_NEAR(shape.radius, 7.22e-3, 0.02 * 7.22e-3);
}

}  // namespace
}  // namespace forming_sim
