// A long thick cylinder under inner pressure, turned about its axis: elastic by Lame, and yielding from inside.
#include <gtest/gtest.h>

#include "support/sphere.h"

namespace forming_sim {
namespace {

constexpr double kInner = sphere::kInner, kOuter = sphere::kOuter, kYield = sphere::kYield;

/// Rows of cells between two planes that keep the length, radii in geometric progression.
OneBody cylinder(int cells, const std::string& pattern, const MaterialConfig& material) {
  const Mesh mesh = mapped_section(cells, 2, [](double s, double t) { return Vec3(sphere::radius(s), 0.1 * t, 0); }, pattern);
  OneBody run = one_ring(mesh, material, sphere::kDuration);
  for (const char* set : {"bottom", "top"}) run.plan.bodies[0].boundaries.push_back(symmetric(set, Vec3::UnitY()));
  return run;
}

/// Motion of the inner wall, m, when the pressure that rises to `last` has come to each of `asked`.
std::vector<double> motion(int cells, const std::string& pattern, const MaterialConfig& material, double last, const std::vector<double>& asked) {
  OneBody run = cylinder(cells, pattern, material);
  sphere::press(run, "left", last, 1e2);
  const int wall = run.model.bodies[0].mesh.sets.at("left")[0];
  auto sim = run.start();
  std::vector<double> found;
  while (sim->step())
    if (found.size() < asked.size() && sim->time() >= sphere::kDuration * asked[found.size()] / last) found.push_back(sim->positions()[wall][0] - kInner);
  EXPECT_EQ(found.size(), asked.size());
  EXPECT_LT(sim->balance_error(), 0.01);
  return found;
}

// Lame: u(a) = (1+nu)/E p a^2/(b^2-a^2) ((1-2 nu) a + b^2/a); second order in the cell.
TEST(ThickCylinder, ElasticAsLame) {
  MaterialConfig m = sphere::steel();
  m.hardening.reset();
  const double nu = m.poissons_ratio, a = kInner, b = kOuter, p = 1e6;
  const double exact = (1 + nu) / m.youngs_modulus * p * a * a / (b * b - a * a) * ((1 - 2 * nu) * a + b * b / a);
  for (const char* pattern : {"fine", "one_point"}) {
    const double coarse = motion(4, pattern, m, 1.1 * p, {p})[0] / exact - 1, fine = motion(16, pattern, m, 1.1 * p, {p})[0] / exact - 1;
    std::printf("  %s: u(a) off by %+.2f %% with 4 cells, %+.2f %% with 16\n", pattern, 100 * coarse, 100 * fine);
    EXPECT_LT(std::abs(fine), 0.01);
    EXPECT_LT(std::abs(fine), 0.2 * std::abs(coarse));
  }
}

// Perfectly plastic and next to incompressible, the front at c:
//   p(c) = Y/sqrt 3 (2 ln(c/a) + 1 - c^2/b^2),  u(a) = Y c^2/(2 sqrt 3 mu a).
TEST(ThickCylinder, YieldsFromInside) {
  MaterialConfig m = sphere::steel();
  m.poissons_ratio = 0.499;
  const double mu = m.youngs_modulus / (2 * (1 + m.poissons_ratio));
  const auto pressure = [](double c) { return kYield / std::sqrt(3.) * (2 * std::log(c / kInner) + 1 - c * c / (kOuter * kOuter)); };
  for (const char* pattern : {"fine", "one_point"}) {
    const std::vector<double> u = motion(16, pattern, m, pressure(0.85), {pressure(0.4), pressure(0.6), pressure(0.8)});
    for (int i = 0; i < 3; ++i) {
      const double c = 0.4 + 0.2 * i, exact = kYield * c * c / (2 * std::sqrt(3.) * mu * kInner);
      std::printf("  %s, front at %.1f m: u(a) off by %+.2f %%\n", pattern, c, 100 * (u[i] / exact - 1));
      EXPECT_NEAR(u[i], exact, 0.03 * exact);
    }
  }
}

}  // namespace
}  // namespace forming_sim
