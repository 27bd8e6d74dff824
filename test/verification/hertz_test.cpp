// A cylinder pressed on a rigid plane, against Hertz: half width a = sqrt(4 P R / (pi E')), pressure p0 = 2 P / (pi a)
// in the middle and p0 sqrt(1 - (x/a)^2) about it, E' = E / (1 - nu^2).
#include <gtest/gtest.h>

#include "support/runs.h"

namespace forming_sim {
namespace {

struct Found {
  double force, half_width, middle, shape;  ///< N/m; m; Pa; rms of the pressure about Hertz' over p0
  double balance;
  long crossings, steps;
};

/// The part of a cylinder of 10 mm radius about its lowest line, 32 a wide and 16 a high, pressed by about 100 N/mm.
Found press(double cells_across_a) {
  const double E = 70e9, nu = 0.3, R = 10e-3, P = 1e5, E1 = E / (1 - nu * nu), a = std::sqrt(4 * P * R / (M_PI * E1)), size = 16 * a;
  // Cells grow from the middle of the contact outwards: x = d sinh(s), the same spacing on both sides.
  const double d = 1.2 * a, reach = std::asinh(size / d);
  const int half = static_cast<int>(std::ceil(reach * d / (a / cells_across_a)));
  BlankConfig blank = strip_of(2, 1, 2 * half, half);
  blank.origin = Vec3(-1, 0, 0);
  Mesh mesh = generate_blank(blank);
  for (Vec3& X : mesh.nodes) {
    const double x = d * std::sinh(reach * X.x()), y = d * std::sinh(reach * X.y());
    X = Vec3(x, y + x * x / (2 * R) * std::pow(1 - y / size, 2), 0);
  }
  MaterialConfig material;
  material.density = 2700;
  material.youngs_modulus = E;
  material.poissons_ratio = nu;
  const double time = 6e-6;
  OneBody run(body_of(std::move(mesh), material), 2 * time);
  BoundaryConfig top;  // driven down until the load is about P; compared at the load found
  top.set = "top";
  top.kind = "velocity";
  top.times = {0, time / 2, time};
  const double approach = P / (M_PI * E1) * (2 * std::log(4 * size / a) - 1) * 0.9;
  top.velocities = {Vec3::Zero(), Vec3(0, -approach / (time / 2), 0), Vec3::Zero()};
  top.profile = "smooth";
  run.plan.bodies[0].boundaries.push_back(top);
  run.plan.time_step.damping = 2e6;
  run.plan.contact.layer = 1e-3 * a / cells_across_a;
  ToolModel plane;
  plane.name = "plane";
  plane.normal = Vec3::UnitY();
  plane.mesh.dimension = 2;
  run.model.tools.push_back(plane);
  auto sim = run.start();
  while (sim->step()) {
  }
  Found found;
  found.force = -sim->tools()[0].force.y();
  const double a_exact = std::sqrt(4 * found.force * R / (M_PI * E1)), p0 = 2 * found.force / (M_PI * a_exact);
  std::vector<std::pair<double, double>> pressure;  // of the lower face, by x
  for (int n : run.model.bodies[0].mesh.sets.at("bottom")) pressure.emplace_back(sim->positions()[n][0], sim->contact_pressure()[n]);
  std::sort(pressure.begin(), pressure.end());
  // The half width from the second moment of the pressure: a^2 / 4 for Hertz.
  double sum = 0, moment = 0, square = 0;
  int count = 0;
  found.middle = 0;
  for (size_t i = 1; i + 1 < pressure.size(); ++i) {
    const auto [x, p] = pressure[i];
    const double width = (pressure[i + 1].first - pressure[i - 1].first) / 2;
    sum += p * width;
    moment += p * width * x * x;
    if (std::abs(x) < 0.05 * a) found.middle = std::max(found.middle, p);
    if (std::abs(x) > 1.5 * a_exact) continue;
    const double hertz = std::abs(x) < a_exact ? p0 * std::sqrt(1 - x * x / (a_exact * a_exact)) : 0;
    square += std::pow(p - hertz, 2);
    ++count;
  }
  found.half_width = 2 * std::sqrt(moment / sum) / a_exact - 1;
  found.middle = found.middle / p0 - 1;
  found.shape = std::sqrt(square / count) / p0;
  found.balance = sim->balance_error();
  found.crossings = sim->contact_status().crossings;
  found.steps = sim->steps();
  return found;
}

}  // namespace

TEST(Hertz, CylinderOnAPlane) {
  struct Allowed {
    double cells, half_width, middle, shape;
  };
  for (const Allowed& allowed : {Allowed{4, .02, .01, .03}, Allowed{8, .005, .005, .015}}) {
    const Found found = press(allowed.cells);
    std::printf("  %g cells across a: %.1f N/mm, half width %+.2f %%, pressure in the middle %+.2f %%, rms %.2f %% of p0; %ld steps, balance %.1e\n", allowed.cells,
                found.force / 1e3, 100 * found.half_width, 100 * found.middle, 100 * found.shape, found.steps, found.balance);
    EXPECT_NEAR(found.force, 1e5, .1e5);
    EXPECT_LT(std::abs(found.half_width), allowed.half_width);
    EXPECT_LT(std::abs(found.middle), allowed.middle);
    EXPECT_LT(found.shape, allowed.shape);
    EXPECT_EQ(found.crossings, 0);
    EXPECT_LT(found.balance, 1e-4);
  }
}

}  // namespace forming_sim
