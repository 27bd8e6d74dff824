#include "paper/two_bodies.h"

#include <cmath>

#include "support/runs.h"

namespace forming_sim::bench {
namespace {

constexpr double kDensity = 2800, kSpeed = 5, kLength = 4, kHeight = 2;

/// The mesh seen in a mirror at x = 0.
Mesh mirrored(Mesh mesh) {
  for (Vec3& X : mesh.nodes) X.x() = -X.x();
  for (Cells& cells : mesh.cells)
    for (std::size_t i = 0; i < cells.nodes.size(); i += 4) std::swap(cells.nodes[i + 1], cells.nodes[i + 3]);  // four corners, the diagonal from the first
  find_surface(mesh);
  return mesh;
}

/// Body 0 flies to the left, body 1, if any, to the right.
Simulation impact(const ImpactCase& c, Model& model) {
  MaterialConfig m = impact_material();
  m.law = "paper";
  RunPlan plan;
  model.dimension = 2;
  plan.stages.push_back(form_for(c.until));
  plan.contact = c.contact;
  plan.time_step.safety = c.safety;
  for (int side = 0; side < (c.wall ? 1 : 2); ++side) {
    BodyModel body = body_of(impact_mesh(c, side), m, "element");
    add_flying(model, plan, std::move(body), side == 0 ? "right" : "left", Vec3(side == 0 ? -kSpeed : kSpeed, 0, 0));
  }
  if (c.wall) {
    model.tools.push_back(wall_at_zero());
  }
  return Simulation(plan, model, 1);
}

}  // namespace

Mesh impact_mesh(const ImpactCase& c, int side) {
  const int through = side == 0 ? c.through : c.through_left;
  // Tools are set back by the layer, so that a body meets the wall's layer where the wall was; bodies are not.
  const double gap = c.wall ? kImpactStart * kSpeed : kImpactStart * 2 * kSpeed + c.contact.layer;
  BlankConfig blank = strip_of(kLength, kHeight, 2 * through, through);
  blank.pattern = "coarse";
  blank.origin = Vec3(side == 0 ? gap : c.mirror ? 0 : -kLength, 0, 0);
  Mesh mesh = generate_blank(blank);
  return side == 1 && c.mirror ? mirrored(std::move(mesh)) : mesh;
}

ContactConfig mild(const std::string& method, double layer) {
  ContactConfig config;
  config.method = method;
  config.layer = layer;
  return config;
}

ContactConfig algorithm_2(const std::string& pairing, double layer, double coefficient) {
  ContactConfig config = mild("explicit", layer);
  config.pairing = pairing;
  config.coefficient = coefficient;
  return config;
}

ImpactFound collide(const ImpactCase& c) {
  const Clock clock;
  Model model;
  Simulation sim = impact(c, model);
  const auto momentum = [&](std::size_t body) {
    double p = 0;
    for (int i = model.bodies[body].first_node, last = i + model.bodies[body].node_count; i < last; ++i) p += sim.nodal_mass()[i] * sim.velocities()[i][0];
    return p;
  };
  const double whole = kDensity * kLength * kHeight * kSpeed;
  ImpactFound found;
  double last = 0, before = -whole;
  try {
    while (sim.step()) {
      const double now = momentum(0), middle = sim.time() - 0.5 * sim.dt();
      if (found.dt == 0) found.dt = sim.dt(), found.bulk_dt = sim.dt() / c.safety;
      // What elements alone do to the momentum is rounding.
      const double stress = (now - before) / sim.dt() / kHeight;
      before = now;
      found.time.push_back(middle);
      found.stress.push_back(stress);
      if (stress < 1e-6 * kImpactStress) continue;
      if (found.start == 0) found.start = sim.time() - sim.dt();
      if (found.rise == 0 && stress > kImpactStress) found.rise = middle - found.start;
      last = sim.time();
      found.peak = std::max(found.peak, stress);
    }
  } catch (const Error& e) {
    found.error = e.what();
  }
  found.duration = last - found.start;
  double sum = 0, squares = 0;
  long n = 0;
  for (std::size_t i = 0; i < found.time.size(); ++i) {
    const double t = found.time[i] - found.start;
    if (t < 0.4e-3 || t > 1.4e-3) continue;
    sum += found.stress[i];
    squares += found.stress[i] * found.stress[i];
    ++n;
  }
  if (n > 0) {
    found.mean = sum / n;
    found.rms = std::sqrt(std::max(0.0, squares / n - found.mean * found.mean));
  }
  const auto levels = averaged(found);
  for (std::size_t i = 1; i < levels.size(); ++i)
    if (levels[i].first > 2.4e-3) found.fall = std::max(found.fall, levels[i - 1].second - levels[i].second);
  const Energies& e = sim.energies();
  found.energy = (e.kinetic + e.elastic) / e.initial - 1;
  found.restitution = momentum(0) / whole;
  found.momentum = c.wall ? (momentum(0) + whole + sim.tools()[0].felt.impulse[0]) / whole : (momentum(0) + momentum(1)) / whole;
  const ContactStatus status = sim.contact_status();
  found.crossings = status.crossings;
  found.halvings = status.halvings;
  found.layer_dt = status.explicit_stable_dt;
  found.steps = sim.steps();
  found.balance = sim.balance_error();
  found.wall_time = clock.seconds();
  return found;
}

Tried largest_sound_step(const ContactConfig& contact, double bound) {
  ImpactCase c;
  c.contact = contact;
  for (double fraction : {.9, .8, .7, .6, .5, .4, .35, .3, .25, .2, .15, .1, .07, .05, .035, .025}) {
    c.safety = fraction;
    ImpactFound found = collide(c);
    if (found.sound(bound)) return {fraction, std::move(found)};
  }
  return {};
}

std::vector<std::pair<double, double>> averaged(const ImpactFound& found) {
  std::vector<std::pair<double, double>> levels;
  const double window = 0.89 * found.bulk_dt;  // a single step at .9 of the bulk step
  double impulse = 0, passed = 0;
  for (std::size_t i = 0; i < found.time.size(); ++i) {
    const double end = i + 1 < found.time.size() ? 0.5 * (found.time[i] + found.time[i + 1]) : found.time[i] + 0.5 * found.dt;
    const double dt = 2 * (end - found.time[i]);
    impulse += found.stress[i] * dt;
    passed += dt;
    if (passed < window) continue;
    levels.emplace_back(end - 0.5 * passed, impulse / passed);
    impulse = passed = 0;
  }
  return levels;
}

void add_stress(Figure& figure, const std::string& series, const ImpactFound& found) {
  for (const auto& [time, stress] : averaged(found)) figure.add(series, 1e3 * time, 1e-6 * stress);
}

void add_analytic(Figure& figure) {
  const double begin = 1e3 * kImpactStart, end = begin + 1e3 * kImpactDuration, level = 1e-6 * kImpactStress;
  const double corners[][2] = {{0, 0}, {begin, 0}, {begin, level}, {end, level}, {end, 0}, {3.4, 0}};
  for (const auto& [x, y] : corners) figure.add("analytic, one-dimensional", x, y);
}

}  // namespace forming_sim::bench
