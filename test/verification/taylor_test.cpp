// The Taylor bar of copper at a coarse mesh; scenes/taylor_bar.yaml is the fine one.
#include <gtest/gtest.h>

#include "support/runs.h"

namespace forming_sim {
namespace {

TEST(TaylorBar, LengthAndRadius) {
  BlankConfig bar;
  bar.shape = "bar";
  bar.portion = "quarter";
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
  OneBody run(body_of(generate_blank(bar), copper), 80e-6);
  run.plan.bodies[0].initial_velocity = Vec3(0, 0, -227);
  for (const char* face : {"symmetry_x", "symmetry_y"}) {
    BoundaryConfig b;
    b.set = face;
    b.kind = "symmetric";
    b.normal = face[9] == 'x' ? Vec3(Vec3::UnitX()) : Vec3(Vec3::UnitY());
    run.plan.bodies[0].boundaries.push_back(b);
  }
  ToolModel wall;
  wall.name = "wall";
  wall.normal = Vec3::UnitZ();
  run.model.tools.push_back(wall);
  auto sim = run.start(2);
  const std::atomic<bool> cancel{false};
  const Outcome outcome = sim->run(cancel);
  ASSERT_EQ(outcome.code, Code::success) << outcome.message;
  double low = 1, high = -1, radius = 0;
  for (const Node& n : sim->positions()) {
    low = std::min(low, n[2]);
    high = std::max(high, n[2]);
    radius = std::max(radius, n.head<2>().norm());
  }
  std::cout << "  length " << (high - low) * 1e3 << " mm, radius " << radius * 1e3 << " mm, balance "
            << sim->balance_error() << ", " << sim->wall_time() << " s\n";
  EXPECT_NEAR(high - low, 21.42e-3, 0.02 * 21.42e-3);
  EXPECT_NEAR(radius, 7.22e-3, 0.04 * 7.22e-3);  // 2 % is for 10 cells a radius
  EXPECT_EQ(sim->contact_status().crossings, 0);
  EXPECT_LT(sim->balance_error(), 0.01);
}

}  // namespace
}  // namespace forming_sim
