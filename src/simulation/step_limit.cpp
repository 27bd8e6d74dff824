// How long a step may be: what the mesh bears by the bound that the scene asks for, and
// the mass that raises it.
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "forming_sim/config/words.h"
#include "forming_sim/mesh/measure.h"
#include "forming_sim/simulation/body_of_element.h"
#include "forming_sim/simulation/fastest_swing.h"
#include "simulation/impl.h"

namespace forming_sim {

namespace {
constexpr double kThin = 2;        ///< frequencies of a simplex over that of the mesh from which on the step of the mesh passes over it
constexpr double kChange = 0.03;    ///< of the volume of a sliver in a step
constexpr double kCollapse = 1e-3;  ///< an element whose stable step falls to this part of the first is no element any more
/// A step is at most this many times the last one. Steps of L and b L by turns, kicks between them of (1 + b) L/2, take a
/// swing of frequency omega over both by a map of trace 2 - (1 + b)^2 z + (1 + b)^2 b z^2/4, z = (omega L)^2, below -2 where
/// 4/(1 + b) < z < 4/(b (1 + b)): it grows, although each step alone is stable.
/// Steps that fall at once and rise slowly do not feed it: halved steps, and those that time_step.maximum or the end of a stage made short. Limits that come and go: simulation/steady_step.h.
constexpr double kRise = 1.01;
/// The last steps of a stage are of one length that meets its end. One that is cut short there changes the energy of a swing of
/// frequency omega by up to (omega dt)^2/8 of it, and what is read in it, such as a reaction, is not that of the steps before.
constexpr double kToEnd = 50;
}  // namespace

void Simulation::Impl::choose_dt() {
  if (departure.sudden() || elements.corners_pressed()) control.hurry();
  if (control.due()) find_stable_step();
  const TimeStepConfig& config = plan.time_step;
  dt = std::min(steady.follow(config.safety * control.stable_dt), control.stable_dt);
  if (previous_dt > 0) dt = std::min(dt, kRise * previous_dt);
  limit.dt = dt;
  limit.element = control.element;
  limit.node = control.node;
  limit.reason = control.element < 0 && control.node < 0 ? "the whole mesh" : "";
  if (config.maximum > 0 && config.maximum < dt) dt = config.maximum, limit = {dt, -1, -1, "time_step.maximum"};
  if (const auto [most, tool] = spring_dt(); most < dt) dt = most, limit = {dt, -1, -1, "the stiffness of tool " + model.tools[tool].name};
  if (steps == 0) first_dt = dt;
  if (smallest.dt == 0 || limit.dt < smallest.dt) smallest = limit;
  const double left = stages.remaining(time), count = std::ceil(left / dt * (1 - 1e-9));
  if (count <= kToEnd) dt = left / std::max(1.0, count);
}

std::pair<double, int> Simulation::Impl::spring_dt() const {
  std::pair<double, int> least{std::numeric_limits<double>::infinity(), -1};
  for (int k = 0; k < static_cast<int>(tools.size()); ++k)
    if (const ForceDrive* drive = stages.drive(k)) least = std::min(least, {plan.time_step.safety * drive->stable_step(), k});
  return least;
}

double Simulation::Impl::full_dt() const {
  double stable = plan.time_step.safety * control.stable_dt;
  if (steps > 0) stable = std::min(stable, steady.dt());
  stable = std::min(stable, spring_dt().first);
  return plan.time_step.maximum > 0 ? std::min(stable, plan.time_step.maximum) : stable;
}

void Simulation::Impl::find_stable_step() {
  elements.renew_weights(x);
  elements.find_rates(x, v, rates);
  const CellLimit cell = elements.slowest_cell(rates);
  if (cell.dt < kCollapse * first_element_dt) collapse(cell.dt, cell.element);
  control.element = cell.element;
  control.node = -1;
  control.longer = false;
  const TimeStepConfig& config = plan.time_step;
  if (by_cells()) return control.update(cell.dt, false);

  departure.look(v, cell.dt);
  const NodalRates nodal = elements.sum_rates(rates);
  const NodeLimit node = slowest_node(nodal, elements.nodal_mass());
  double stable = node.dt;
  control.element = -1;
  control.node = node.node;
  if (config.limit == "global" && std::isfinite(node.dt)) {
    const std::vector<double>& mass = elements.nodal_mass();
    if (global.due(steps, rates)) {
      const SpectrumBound bound = fastest_swing(elements, x, nodal, boundaries, model.dimension, global.estimates);
      global.set(steps, bound.above, bound.products, rates);
    }
    double damping = 0;
    for (std::size_t n = 0; n < mass.size(); ++n) damping = std::max(damping, nodal.damping[n] / mass[n]);
    const double swings = global.omega2(rates);
    const Elements::GuardLimit guard = elements.guard_limit(x, v, rates, kThin * kThin * swings);
    const double whole = std::min(forming_sim::stable_step(swings + guard.omega2, damping), kChange / guard.change);
    if (whole > stable) {
      stable = whole;
      control.node = -1;
      control.longer = true;
    }
  }
  control.update(stable, true);
}

void Simulation::Impl::raise_step() {
  const TimeStepConfig& config = plan.time_step;
  if (config.raise_to == 0) return;
  elements.find_rates(x, v, rates);
  const NodalRates nodal = elements.sum_rates(rates);
  const std::vector<double>& mass = elements.nodal_mass();
  const double all = mass_of_bodies();
  const auto needed = [&](std::size_t n, double step) { return std::max(0.0, nodal.mass_for(n, step / config.safety) - mass[n]); };
  const auto share = [&](double step) {
    double sum = 0;
    for (std::size_t n = 0; n < mass.size(); ++n) sum += needed(n, step);
    return sum / all;
  };
  added.fraction = share(config.raise_to);
  if (added.fraction > config.raise_limit) {
    double low = 0, high = config.raise_to;
    for (int i = 0; i < 40; ++i) (share(0.5 * (low + high)) > config.raise_limit ? high : low) = 0.5 * (low + high);
    std::ostringstream remedy;
    remedy.precision(3);
    remedy << "it takes " << 100 * added.fraction << " % more mass, and time_step.raise_limit allows " << 100 * config.raise_limit << " %: give at most "
           << low << ", or a larger raise_limit; without raise_to the first step is "
           << config.safety * slowest_node(nodal, mass).dt << " s";
    throw SceneError({{Code::invalid_scene, "time_step.raise_to", number_text(config.raise_to) + " s", remedy.str()}});
  }
  std::vector<double> kg(mass.size());
  for (const BodyModel& body : model.bodies) {
    double sum = 0;
    for (int n = body.first_node; n < body.first_node + body.node_count; ++n) {
      sum += kg[n] = needed(n, config.raise_to);
      if (kg[n] > added.most) added.most = kg[n], added.node = n;
    }
    added.bodies.push_back(sum);
    added.total += sum;
  }
  elements.add_mass(kg);
  if (added.node < 0) return;
  std::ostringstream text;
  text.precision(3);
  text << "time_step.raise_to has added " << added.total << (model.per_width() ? " kg/m" : " kg") << " to the masses, " << 100 * added.fraction << " %:";
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (added.bodies[b] > 0) text << (b > 0 ? "," : "") << ' ' << added.bodies[b] << " to " << model.bodies[b].name;
  text << "; most, " << added.most << ", to node " << added.node << " at (" << vec3(x[added.node]).transpose() << ") m";
  warnings.push_back(text.str());
}

void Simulation::Impl::collapse(double stable, int element) const {
  std::ostringstream text;
  const BodyModel& of = body_of_element(model, element);
  Vec3 at = Vec3::Zero();
  const std::array<int, 4> nodes = of.mesh.simplices()[element - of.first_element];
  for (int k = 0; k <= model.dimension; ++k) at += vec3(x[of.first_node + nodes[k]]) / (model.dimension + 1);
  text << "at time " << time << " s the stable step of element " << element << " of body " << of.name << ", at " << place(at) << ", has fallen to " << stable << " s, from " << first_element_dt;
  if (stable > 0) {
    const char* what = model.tools.empty() ? "" : "Look whether a tool presses or withdraws through the body there, lower its speed or stroke or time_step.mass_scaling (docs/scene.md). ";
    const char* load = pressures.empty() && dead_loads.empty() ? "" : "A load beyond what the body can bear thins it without end, as a bulge bursts: the last frames tell at which load that began. ";
    text << " s at the start: the element is squeezed flat. " << what << load << "Refine the mesh, or check the material";
  } else {
    text << " s at the start: what drives it is beyond what a step can follow. Look for a boundary, a pressure, a load, gravity or an initial velocity in other units than m, s, Pa";
  }
  throw Error(Code::mesh_error, text.str());
}

}  // namespace forming_sim
