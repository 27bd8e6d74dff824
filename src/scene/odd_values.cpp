// Values that are taken, and told because more often they are a wrong unit or a slip of the pen than meant.
#include <algorithm>
#include <cmath>

#include "forming_sim/config/words.h"
#include "geometry.h"

namespace forming_sim {

namespace {

constexpr double kLeastYield = 1e-5, kMostYield = 0.1;    // of Young's modulus: lead .0004, spring steel .01
constexpr double kLightest = 100, kHeaviest = 25000;      // kg/m3: foams, tungsten and gold
constexpr double kMuchScaling = 1e4;

double first_yield(const HardeningConfig& h) {
  if (h.curve == "swift") return h.strength * std::pow(h.prestrain, h.exponent);
  if (h.curve == "table") return h.stresses.empty() ? 0 : h.stresses.front();
  return h.yield_stress;
}

void tell_odd_material(const BodyConfig& body, std::vector<std::string>& notes) {
  const MaterialConfig& m = body.material;
  if (m.density < kLightest || m.density > kHeaviest)
    notes.push_back("the density of body " + body.name + " is " + number_text(m.density) + " kg/m3: steel has 7850, aluminium 2700; give it in kg/m3, not in g/cm3 or t/mm3");
  double most = 0;
  const auto see = [&](const std::optional<HardeningConfig>& h) {
    if (h) most = std::max(most, first_yield(*h));
  };
  see(m.hardening);
  for (const LayerConfig& layer : m.layers) see(layer.hardening);
  const double odd = most > kMostYield * m.E() && m.layers.empty() ? most : most < kLeastYield * m.E() ? most : 0;  // a layer may yield as late as it likes
  if (odd > 0)
    notes.push_back("the yield stress of body " + body.name + " is " + number_text(odd) + " Pa, " + three_digits(odd / m.E()) + " of Young's modulus: metals have .0005 to .01; give both in Pa");
}

void tell_odd_speed(const BodyConfig& body, std::vector<std::string>& notes) {
  const MaterialConfig& m = body.material;
  const double wave = std::sqrt((m.K() + 4. / 3 * m.mu()) / m.density), speed = body.initial_velocity.norm();
  if (speed > wave)
    notes.push_back("body " + body.name + " begins with " + three_digits(speed) + " m/s, faster than waves in it, " + three_digits(wave) + " m/s: give velocities in m/s");
}

}  // namespace

void tell_odd_values(const Scene& scene, std::vector<std::string>& notes) {
  for (const BodyConfig& body : scene.bodies) {
    tell_odd_material(body, notes);
    tell_odd_speed(body, notes);
  }
  if (scene.time_step.mass_scaling > kMuchScaling)
    notes.push_back("time_step.mass_scaling " + number_text(scene.time_step.mass_scaling) + " makes waves " + three_digits(std::sqrt(scene.time_step.mass_scaling)) +
                    " times as slow: look at kinetic_over_internal_forming, and expect bodies to be squeezed flat where tools are faster than these waves");
  double end = 0;
  for (const StageConfig& stage : scene.stages) end += stage.kind == "settle" ? stage.limit : stage.duration;
  const std::string ends = "the stages end at " + three_digits(end) + " s";
  for (const ToolConfig& tool : scene.tools)
    if (tool.motion && !tool.motion->times.empty() && tool.motion->times.back() > end * (1 + 1e-9))
      notes.push_back("the motion of tool " + tool.name + " goes on to " + three_digits(tool.motion->times.back()) + " s and " + ends + ": what comes later does not happen");
  const auto interval = [&](double given, const std::string& field) {
    if (given > end) notes.push_back("output." + field + " is " + three_digits(given) + " s and " + ends + ": nothing is written between the first state and the last");
  };
  interval(scene.output.interval, "interval");
  interval(scene.output.history_interval, "history_interval");
}

}  // namespace forming_sim
