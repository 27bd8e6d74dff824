// The test that measures friction: a strip is drawn from between a flat die and a holder that a force presses on it. What the
// tools feel along the strip is mu times what they feel across it.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "forming_sim/scene/build.h"
#include "forming_sim/scene/validate.h"
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

}  // namespace forming_sim
