// A bar in uniaxial strain meets a rigid plane: p = rho c_p v for 2 L / c_p.
#include <gtest/gtest.h>

#include <cmath>

#include "support/runs.h"

namespace forming_sim {
namespace {

struct Impact {
  double pressure, duration, restitution, balance;
  long crossings;
};

Impact hit_wall(int cells, double safety) {
  const double G = 26.5e9, K = 65.1e9, rho = 2800, v = 5, L = 4, height = 0.4;
  MaterialConfig m;
  m.density = rho;
  m.youngs_modulus = 9 * K * G / (3 * K + G);
  m.poissons_ratio = (3 * K - 2 * G) / (2 * (3 * K + G));
  BlankConfig blank = strip_of(L, height, cells, std::max(1, cells / 10));
  blank.origin = Vec3(1e-3, 0, 0);
  OneBody run(body_of(generate_blank(blank), m), 2.2e-3);
  run.plan.bodies[0].initial_velocity = Vec3(-v, 0, 0);
  run.plan.time_step.safety = safety;
  for (const char* side : {"bottom", "top"}) {
    BoundaryConfig b;
    b.set = side;
    b.kind = "symmetric";
    b.normal = Vec3::UnitY();
    run.plan.bodies[0].boundaries.push_back(b);
  }
  ToolModel wall;
  wall.name = "wall";
  wall.normal = Vec3::UnitX();
  wall.mesh.dimension = 2;
  run.model.tools.push_back(wall);
  auto sim = run.start();
  const double start = 1e-3 / v;
  double early = 0, late = 0, t_early = 0, t_late = 0, first = 0, last = 0, before = 0;
  while (sim->step()) {
    const double t = sim->time() - start, impulse = -sim->tools()[0].impulse[0];
    if (impulse > before) {
      if (first == 0) first = sim->time();
      last = sim->time();
    }
    before = impulse;
    if (t < 0.3e-3) early = impulse, t_early = t;
    if (t < 1.0e-3) late = impulse, t_late = t;
  }
  const double momentum = 2 * rho * L * height * v;  // for restitution 1
  return {(late - early) / (t_late - t_early) / height, last - first, sim->tools()[0].impulse.norm() / momentum * 2 - 1,
          sim->balance_error(), sim->contact_status().crossings};
}

TEST(Impact, PressureAndDurationOfTheUniaxialBar) {
  double previous = 0;
  for (int cells : {40, 80}) {
    const Impact found = hit_wall(cells, 0.9);
    std::cout << "  " << cells << " cells: " << found.pressure / 1e6 << " MPa, " << found.duration * 1e3
              << " ms, restitution " << found.restitution << ", balance " << found.balance << "\n";
    EXPECT_NEAR(found.pressure, 83.85e6, 2e-3 * 83.85e6);
    EXPECT_NEAR(found.duration, 1.336e-3, 0.02 * 1.336e-3);
    EXPECT_LE(found.restitution, 1.0);
    EXPECT_GT(found.restitution, 0.95);
    EXPECT_LT(found.balance, 1e-3);
    EXPECT_EQ(found.crossings, 0);
    const double error = std::fabs(found.duration - 1.336e-3);
    if (previous > 0) {
      EXPECT_LT(error, 0.7 * previous) << "the duration must converge";
    }
    previous = error;
  }
}

TEST(Impact, TheStepDoesNotMatter) {
  const Impact coarse = hit_wall(40, 0.9), fine = hit_wall(40, 0.2);
  EXPECT_NEAR(coarse.pressure, fine.pressure, 3e-3 * fine.pressure);
  EXPECT_NEAR(coarse.duration, fine.duration, 0.01 * fine.duration);
}

}  // namespace
}  // namespace forming_sim
