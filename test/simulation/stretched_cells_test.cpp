// Long crossed cells that are stretched keep their middle nodes where they are.
#include <gtest/gtest.h>

#include <cmath>

#include "support/runs.h"

namespace forming_sim {
namespace {

/// A strip of 12 x 3 cells r times as long as high, the sheet of width 1 m, stretched along x to `stretch` and at rest.
std::unique_ptr<Simulation> stretched(const MaterialConfig& material, double r, double stretch) {
  const double H = 1e-4, L = 12 * r * H, time = 40 * L / 100, speed = (stretch - 1) * L / time;
  Mesh mesh = generate_blank(strip_of(L, 3 * H, 12, 3));
  OneBody run(body_of(std::move(mesh), material), time);
  pull_right(run, {0, time / 2, time}, {Vec3::Zero(), Vec3(2 * speed, 0, 0), Vec3::Zero()});
  run.plan.bodies[0].boundaries[0] = symmetric("left", Vec3(1, 0, 0));
  run.plan.stages.push_back(settle(10 * time));
  auto sim = run.start();
  while (sim->step()) {}
  return sim;
}

double spread(const Simulation& sim) {
  double most = 0;
  for (double J : sim.volume_ratio()) most = std::max(most, std::abs(J - 1));
  return most;
}

// Incompressible, Bbar = diag(l^2, 1/l^2, 1): W = h1/2 (l^2 + l^-2 - 2), a force of h1 (l - l^-3) per initial area.
TEST(StretchedCells, LongOnesOfRubberBearWhatTheyShould) {
  MaterialConfig material = rubber(20e9);
  material.h2 = 0;
  for (const double r : {2., 3., 5.}) {
    const double l = 1.6;
    const auto sim = stretched(material, r, l);
    const double W = 0.5 * material.h1 * (l * l + 1 / (l * l) - 2) * 12 * r * 1e-4 * 3e-4;
    std::printf("  r %g: V/V0 differs by %.2g, energy by %.1e of the exact one\n", r, spread(*sim), sim->energies().elastic / W - 1);
    EXPECT_LT(spread(*sim), 0.01);
    EXPECT_NEAR(sim->energies().elastic, W, 2e-3 * W);
    EXPECT_LT(sim->balance_error(), 1e-4);
  }
}

TEST(StretchedCells, LongOnesOfMetalThinEvenly) {
  MaterialConfig metal = aluminium(true);
  metal.hardening->curve = "linear";
  metal.hardening->modulus = 1e9;
  const auto sim = stretched(metal, 8, 1.5);
  const std::vector<double> p = sim->plastic_strain();
  const auto [least, most] = std::minmax_element(p.begin(), p.end());
  std::printf("  V/V0 differs by %.2g, plastic strain %.4f to %.4f\n", spread(*sim), *least, *most);
  EXPECT_LT(spread(*sim), 0.05);
  EXPECT_LT(*most - *least, 0.03);
}

}  // namespace
}  // namespace forming_sim
