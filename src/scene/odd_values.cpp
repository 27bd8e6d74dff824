// Values that are taken, and told because more often they are a wrong unit or a slip of the pen than meant.
#include <algorithm>
#include <cmath>
#include <limits>

#include "forming_sim/config/words.h"
#include "forming_sim/loads/course.h"
#include "forming_sim/simulation/release.h"
#include "geometry.h"

namespace forming_sim {

namespace {

constexpr double kLeastYield = 1e-5, kMostYield = 0.1;    // of Young's modulus: lead .0004, spring steel .01
constexpr double kLightest = 100, kHeaviest = 25000;      // kg/m3: foams, tungsten and gold
constexpr double kMostStrain = 5;
constexpr double kMuchScaling = 1e4;
constexpr double kFast = 0.1;                             // of the waves: what moves so squeezes metal by a tenth before the rest of it knows

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
    if (!h) return;
    most = std::max(most, first_yield(*h));
    if (!h->plastic_strains.empty() && h->plastic_strains.back() > kMostStrain)
      notes.push_back("the hardening curve of body " + body.name + " goes to a plastic strain of " + number_text(h->plastic_strains.back()) + ": 1 is 100 %, so give 0.2 for 20 %");
  };
  see(m.hardening);
  for (const LayerConfig& layer : m.layers) see(layer.hardening);
  const double odd = most > kMostYield * m.E() && m.layers.empty() ? most : most < kLeastYield * m.E() ? most : 0;  // a layer may yield as late as it likes
  if (most > 0 && m.law != "hyperelastic" && m.poissons_ratio == 0)
    notes.push_back("poissons_ratio of body " + body.name + " is 0 or not given, as for cork: steel has 0.3, aluminium 0.33");
  constexpr double kSoftestMetal = 1e8;  // Pa
  if (most > 0 && m.law != "hyperelastic" && m.E() < kSoftestMetal)
    notes.push_back("Young's modulus of body " + body.name + " is " + number_text(m.E()) + " Pa: metals have 1e10 to 4e11; give it and the yield stress in Pa, not in MPa");
  if (m.hardening && m.hardening->modulus >= m.E() && m.law != "hyperelastic")
    notes.push_back("the hardening modulus of body " + body.name + " is " + number_text(m.hardening->modulus) + " Pa, not below Young's modulus, " + number_text(m.E()) + " Pa: it is the slope of the yield stress over the plastic strain, of metals a hundredth of it or less");
  if (odd > 0)
    notes.push_back("the yield stress of body " + body.name + " is " + number_text(odd) + " Pa, " + three_digits(odd / m.E()) + " of Young's modulus: metals have .0005 to .01; give both in Pa");
}

double wave_speed(const MaterialConfig& m) { return std::sqrt((m.K() + 4. / 3 * m.mu()) / m.density); }

double greatest(const std::vector<Vec3>& values) {
  double most = 0;
  for (const Vec3& v : values) most = std::max(most, v.norm());
  return most;
}

/// Of places the mean from knot to knot.
template <class Course> double fastest(const Course& course) {
  double most = greatest(course.velocities);
  for (std::size_t k = 1; k < std::min(course.positions.size(), course.times.size()); ++k) most = std::max(most, (course.positions[k] - course.positions[k - 1]).norm() / (course.times[k] - course.times[k - 1]));
  return most;
}

void tell_odd_speeds(const Scene& scene, std::vector<std::string>& notes) {
  double slowest = std::numeric_limits<double>::infinity();
  const auto tell = [&](const std::string& what, double speed, double wave, const std::string& whose) {
    notes.push_back(what + " with " + three_digits(speed) + " m/s, where waves " + whose + " have " + three_digits(wave) + " m/s: give velocities in m/s, lengths in m and times in s");
  };
  for (const BodyConfig& body : scene.bodies) {
    const double wave = wave_speed(body.material), speed = body.initial_velocity.norm();
    slowest = std::min(slowest, wave);
    if (speed > wave) tell("body " + body.name + " begins", speed, wave, "in it");
    for (const BoundaryConfig& boundary : body.boundaries)
      if (const double driven = fastest(boundary); driven > kFast * wave) tell("set " + boundary.set + " of body " + body.name + " is driven", driven, wave, "in it");
  }
  for (const ToolConfig& tool : scene.tools)
    if (const double speed = tool.motion ? std::max(fastest(*tool.motion), tool.motion->initial_velocity.norm()) : 0; speed > kFast * slowest) tell("tool " + tool.name + " moves", speed, slowest, "in the bodies");
}

/// Loads and motions that go on when the stages are over.
void tell_late(const Scene& scene, double end, std::vector<std::string>& notes) {
  const std::vector<StageConfig> stages = named(scene.stages);
  const auto tell = [&](const std::string& what, const auto& config) {
    const double began = latest_begin(config.since, stages), last = last_change(config);
    if (began + last <= end * (1 + 1e-9)) return;
    notes.push_back(what + " goes on to " + three_digits(last) + " s and the stages end at " + three_digits(end - began) + " s" + (config.since.empty() ? "" : ", both from the beginning of " + config.since + " on") +
                    ": what comes later does not happen");
  };
  for (const BodyConfig& body : scene.bodies) each_named_course(body, body.name, tell);
  for (const ToolConfig& tool : scene.tools)
    if (tool.motion) tell("the motion of tool " + tool.name, *tool.motion);
}

void tell_odd_friction(const Scene& scene, std::vector<std::string>& notes) {
  constexpr double kMost = 1;
  const auto tell = [&](double friction, const std::string& whose, bool limited) {
    if (friction > kMost && !limited) notes.push_back("friction " + whose + " is " + number_text(friction) + ": metals in forming have .02 to .6; give a part of the normal force, not percent");
  };
  for (const ToolConfig& tool : scene.tools) tell(tool.friction, "of tool " + tool.name, tool.friction_limit > 0);
  tell(scene.contact.friction, "of bodies against each other", scene.contact.friction_limit > 0);
  for (const PairConfig& pair : scene.contact.pairs) tell(pair.friction, "of the pair " + pair.first + ", " + pair.second, pair.friction_limit > 0);
}

void tell_odd_centres(const Scene& scene, std::vector<std::string>& notes) {
  for (const ToolConfig& tool : scene.tools) {
    if (!tool.motion) continue;
    const Vec3& centre = tool.motion->centre;
    const bool spins = greatest(tool.motion->spins_deg_s) != 0 || tool.motion->turns_freely();
    if (spins && !centre.isZero(0) && tool.position.isZero(0))
      notes.push_back("tool " + tool.name + " turns about " + given_text(centre) + ", and its position, [0, 0, 0], goes round with it: the moments that are written are about that. If it is a roll, draw it about [0, 0, 0] and give its centre as position too: they are its torque then");
    if (!centre.isZero(0) || tool.position.isZero(0)) continue;
    if (!spins && greatest(tool.motion->rotations_deg) == 0) continue;
    notes.push_back("tool " + tool.name + " turns about [0, 0, 0], since motion.centre is not given, and its position is " + given_text(tool.position) + ": a roll that turns about itself has that as its centre");
  }
}

/// Paths as controllers write them: angles between -180 and 180, and many knots.
void tell_odd_path(const std::string& who, const std::vector<Vec3>& positions, const std::vector<Vec3>& rotations_deg, bool stops_at_knots, const char* meant, std::vector<std::string>& notes) {
  constexpr double kHalfTurn = 180;
  constexpr std::size_t kMany = 20;
  for (std::size_t k = 1; k < rotations_deg.size(); ++k) {
    const Vec3 &before = rotations_deg[k - 1], &now = rotations_deg[k];
    if ((now - before).norm() <= kHalfTurn || before.dot(now) >= 0) continue;
    notes.push_back(who + " turns from " + given_text(before) + " to " + given_text(now) + " degrees, by " + three_digits((now - before).norm()) + ", from knot " + std::to_string(k - 1) + " to the next: rotations_deg count on beyond 180 degrees, and these turn the long way round");
    break;
  }
  std::size_t stops = 0;  // at knots between others, on a way that goes on
  for (std::size_t k = 1; k + 1 < positions.size(); ++k) stops += (positions[k] - positions[k - 1]).dot(positions[k + 1] - positions[k]) > 0;
  if (stops_at_knots && stops >= kMany) notes.push_back(who + " stops at each of " + std::to_string(stops) + " knots on its way, since profile is smooth: a path of many points is meant for " + meant);
}

void tell_odd_paths(const Scene& scene, std::vector<std::string>& notes) {
  for (const ToolConfig& tool : scene.tools) {
    if (!tool.motion || !tool.motion->by_places()) continue;
    const MotionConfig& motion = *tool.motion;
    tell_odd_path("tool " + tool.name, motion.positions, motion.rotations_deg, motion.profile == "smooth", motion.by_force() ? "linear" : "spline, or linear", notes);
  }
  for (const BodyConfig& body : scene.bodies)
    for (const BoundaryConfig& boundary : body.boundaries)
      if (boundary.kind == "trajectory") tell_odd_path("set " + boundary.set + " of body " + body.name, boundary.positions, boundary.rotations_deg, boundary.shape() == "smooth", "spline, or linear", notes);
}

/// A tool that goes away by a displacement takes what is tied to it along.
void tell_tied_withdrawal(const Scene& scene, std::vector<std::string>& notes) {
  for (const StageConfig& stage : scene.stages) {
    if (stage.kind != "withdraw" || stage.displacement.isZero(0)) continue;
    for (const PairConfig& pair : scene.contact.pairs) {
      if (pair.kind != "tied") continue;
      for (const std::string& tool : {pair.first, pair.second})
        if (std::any_of(scene.tools.begin(), scene.tools.end(), [&](const ToolConfig& t) { return t.name == tool; }) &&
            (stage.tools.empty() || std::find(stage.tools.begin(), stage.tools.end(), tool) != stage.tools.end()))
          notes.push_back("tool " + tool + " is withdrawn by a displacement while " + (tool == pair.first ? pair.second : pair.first) + " is tied to it, and pulls it along until it is gone: leave displacement out, and it lets go at once");
    }
  }
}

}  // namespace

void tell_odd_values(const Scene& scene, std::vector<std::string>& notes) {
  for (const BodyConfig& body : scene.bodies) tell_odd_material(body, notes);
  tell_odd_speeds(scene, notes);
  tell_odd_friction(scene, notes);
  tell_odd_centres(scene, notes);
  tell_odd_paths(scene, notes);
  tell_tied_withdrawal(scene, notes);
  if (scene.time_step.mass_scaling > kMuchScaling)
    notes.push_back("time_step.mass_scaling " + number_text(scene.time_step.mass_scaling) + " makes waves " + three_digits(std::sqrt(scene.time_step.mass_scaling)) +
                    " times as slow: look at kinetic_over_internal_forming, and expect bodies to be squeezed flat where tools are faster than these waves");
  const double end = longest_time(scene.stages);
  tell_late(scene, end, notes);
  const auto interval = [&](double given, const std::string& field) {
    if (given > end) notes.push_back("output." + field + " is " + three_digits(given) + " s and the stages end at " + three_digits(end) + " s: nothing is written between the first state and the last");
  };
  interval(scene.output.interval, "interval");
  interval(scene.output.history_interval, "history_interval");
}

}  // namespace forming_sim
