// A thick sphere under inner pressure, perfectly plastic: where is the front of the
// plastic zone at which pressure? Small strain: p = 2 Y ln(c/a) + 2 Y/3 (1 - c^3/b^3).
//
// A quarter of the section, the upper half of the sphere. The strength is a hundredth
// of a steel's, so that the strains stay as small as the formula has them.
#include <gtest/gtest.h>

#include <cmath>

#include "support/sections.h"

namespace forming_sim {
namespace {

constexpr double kInner = 0.2, kOuter = 1.0, kYield = 1.5e6;  // m, Pa

double exact_pressure(double c) {
  return 2 * kYield * std::log(c / kInner) + 2 * kYield / 3 * (1 - std::pow(c / kOuter, 3));
}

/// Largest error of the pressure at which the front passes .4, .6, .8 and 1 m (the
/// elements within a cell of there), relative.
double front_error(int cells, const std::string& pattern) {
  // Radii in geometric progression, so that cells are as long as they are wide.
  const Mesh mesh = bent_section(cells, cells, [&](double s, double t) {
    const double r = kInner * std::pow(kOuter / kInner, s), angle = M_PI / 2 * t;
    return Vec3(t == 1 ? 0 : r * std::cos(angle), r * std::sin(angle), 0);
  }, pattern);
  MaterialConfig steel;
  steel.density = 7800;
  steel.youngs_modulus = 200e9;
  steel.poissons_ratio = 0.3;
  HardeningConfig perfect;
  perfect.curve = "perfect";
  perfect.yield_stress = kYield;
  steel.hardening = perfect;
  const double duration = 40e-3, last = exact_pressure(kOuter);  // 200 times what a wave takes
  OneBody run = one_ring(mesh, steel, duration);
  run.plan.time_step.damping = 1e3;
  BodyLoads& loads = run.plan.bodies[0];
  loads.boundaries.push_back(symmetric_along_y("bottom"));
  PressureConfig pressure;
  pressure.set = "left";
  pressure.times = {0, duration};
  pressure.values = {0, last};
  loads.pressures.push_back(pressure);
  auto sim = run.start(2);
  std::vector<double> at(sim->elements().size(), 0.0);  // pressure at first yield
  while (sim->step()) {
    if (sim->steps() % 20 != 0) continue;
    const std::vector<double> strain = sim->plastic_strain();
    for (std::size_t e = 0; e < at.size(); ++e)
      if (at[e] == 0 && strain[e] > 0) at[e] = last * sim->time() / duration;
  }
  EXPECT_LT(sim->balance_error(), 0.01);
  double worst = 0;
  const double cell = std::pow(kOuter / kInner, 1.0 / cells);
  for (double c : {0.4, 0.6, 0.8, 1.0}) {
    double found = 0, exact = 0;
    for (std::size_t e = 0; e < at.size(); ++e) {
      const auto& n = sim->elements()[e];
      const Vec3 middle = (mesh.nodes[n[0]] + mesh.nodes[n[1]] + mesh.nodes[n[2]]) / 3;
      if (middle.norm() < c / cell || middle.norm() > c * cell) continue;
      found += at[e] > 0 ? at[e] : last;
      exact += exact_pressure(middle.norm());
    }
    std::cout << "  front at " << c << " m: pressure off by " << 100 * (found / exact - 1) << " %\n";
    worst = std::max(worst, std::abs(found / exact - 1));
  }
  return worst;
}

TEST(ThickSphere, ThePlasticFrontMovesAtTheRightPressure) {
  const double coarse = front_error(10, "fine"), fine = front_error(20, "fine");
  EXPECT_LT(fine, 0.01);
  EXPECT_LT(fine, coarse);
}

TEST(ThickSphere, TwoTrianglesACell) { EXPECT_LT(front_error(16, "coarse"), 0.02); }

}  // namespace
}  // namespace forming_sim
