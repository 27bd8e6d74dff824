// The test that measures friction: a strip is drawn from between a flat die and a holder that a force presses on it. What the
// tools feel along the strip is mu times what they feel across it.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "forming_sim/scene/build.h"
#include "forming_sim/scene/validate.h"
#include "forming_sim/scene/yaml.h"
#include "forming_sim/simulation/simulation.h"

namespace forming_sim {

namespace {

struct Choice {
  double mu, speed;
  std::string swing = "damped", pattern = "fine";
};

/// Force along over force across, mean of the two tools from 1.2 to 2 ms.
double measured_friction(const Choice& choice) {
  Scene scene = read_valid_scene(std::string(FORMING_SIM_SOURCE_DIR) + "/scenes/strip_draw.yaml");
  BodyConfig& strip = scene.bodies[0];
  strip.blank->cells_along = 40;
  strip.blank->cells_through = 2;
  strip.blank->pattern = choice.pattern;
  strip.boundaries[0].velocities.back() = Vec3(choice.speed, 0, 0);
  for (ToolConfig& tool : scene.tools) tool.friction = choice.mu;
  scene.contact.swing = choice.swing;
  Simulation sim(build_plan(scene), build_model(scene), 1);
  while (sim.time() < 1.2e-3 && sim.step()) {}
  const Vec3 die = sim.tools()[0].felt.impulse, holder = sim.tools()[1].felt.impulse;
  while (sim.time() < 2e-3 && sim.step()) {}
  const Vec3 on_die = sim.tools()[0].felt.impulse - die, on_holder = sim.tools()[1].felt.impulse - holder;
  EXPECT_EQ(sim.contact_status().crossings, 0);
  EXPECT_LT(std::abs(sim.balance_error()), 1e-3);
  const double found = .5 * (std::abs(on_die.x() / on_die.y()) + std::abs(on_holder.x() / on_holder.y()));
  std::printf("  friction %g, %g m/s, swing %s, %s: %.5f\n", choice.mu, choice.speed, choice.swing.c_str(), choice.pattern.c_str(), found);
  return found;
}

}  // namespace

TEST(StripDraw, MeasuresTheFrictionThatWasGiven) {
  for (const Choice& c : {Choice{.12, 3}, Choice{.12, .5}, Choice{.3, 3}, Choice{.12, 3, "damped", "one_point"}}) EXPECT_NEAR(measured_friction(c), c.mu, 2e-3 * c.mu);
}

// Control: what rigid tools that throw all waves back make of it.
TEST(StripDraw, FreeToSwingItFeelsLess) { EXPECT_LT(measured_friction({.12, .5, "free"}), .11); }

// A strip that stretches under light plates, of its own inertia: what leaves with waves of shear and comes back does no work on it. (It once made
// twice the energy of the strip.)
TEST(StripDraw, WhatWavesBringBackDoesNoWork) {
  const auto run = [](const std::string& swing) {
    std::vector<Fault> faults;
    Scene scene = read_scene(R"yaml(
name: stretching
dimension: 2
bodies:
  - name: strip
    blank: {shape: strip, length: 0.02, thickness: 0.001, cells_along: 40, cells_through: 4}
    material: {density: 7850, youngs_modulus: 200e9, poissons_ratio: 0.3, hardening: {curve: perfect, yield_stress: 150e6}}
    initial_velocity_field: ["2000*(x-0.01)", "0"]
tools:
  - {name: low, point: [0, 0], normal: [0, 1], friction: 0.01}
  - name: up
    point: [0, 0.001]
    normal: [0, -1]
    friction: 0.01
    motion: {kind: force, times: [0, 2e-6], forces: [[0, 0], [0, -200e3]], mass: 0.02}
stages:
  - {kind: form, duration: 1e-3}
)yaml", ".", faults);
    EXPECT_TRUE(faults.empty());
    scene.contact.swing = swing;
    Simulation sim(build_plan(scene), build_model(scene), 1);
    double most = 0, fall = 0;
    for (long step = 0; sim.step(); ++step) {
      if (step % 50 > 0) continue;
      const double friction = sim.energies().friction;
      fall = std::max(fall, most - friction);
      most = std::max(most, friction);
    }
    const Energies e = sim.energies();
    std::printf("  %s: plastic %.3f, friction %.3f of %.3f J/m, which falls by %.2g at most\n", swing.c_str(), e.plastic, e.friction, e.initial, fall);
    EXPECT_LT(fall, .01 * e.initial);
    return e.plastic;
  };
  const double free = run("free");
  EXPECT_NEAR(run("damped"), free, .03 * free);
}

}  // namespace forming_sim
