// How settle stages take motion out of the bodies, and when these rest (simulation/settle.h).
#include <algorithm>
#include <sstream>

#include "forming_sim/config/words.h"
#include "forming_sim/loads/course.h"
#include "forming_sim/simulation/release.h"
#include "simulation/impl.h"

namespace forming_sim {

const Drive* Simulation::Impl::drive_of(int mover) const {
  const int count = static_cast<int>(tools.size()), tool = mover % count;
  return mover < count ? static_cast<const Drive*>(stages.drive(tool)) : stages.axle(tool);
}
const Drive* Simulation::Impl::settling_drive(int mover) const {
  const ToolStatus& tool = tools[mover % tools.size()];
  return tool.present && tool.pressed ? drive_of(mover) : nullptr;
}

void Simulation::Impl::watch_settling() {
  const long phase = steps % Settle::kInterval;
  if (phase != 0 && phase < Settle::kInterval - 2) return;
  const bool led = let_go_until() > 0 || driven_on();
  if (phase != 0 && !led) return;
  const auto watch = [&](Ways& ways, std::size_t first_mover, const std::vector<Ways::Nodes>& nodes, const NodeField& x, const NodeField& v, const std::vector<double>& mass, double alpha) {
    if (ways.empty()) return ways.begin(time, nodes.size(), x, v);
    if (phase == Settle::kInterval - 2) {  // led on: windows of two steps
      ways.go_on(x, alpha);
      for (std::size_t b = 0; b < nodes.size(); ++b) ways.begin_again(time, b, nodes[b], x, v);
      return;
    }
    std::vector<std::size_t> looked_at;
    for (std::size_t b = 0; b < nodes.size(); ++b)
      if (ways.ends_half(b)) looked_at.push_back(b);
    if (looked_at.empty()) return;
    ways.go_on(x, alpha);
    for (const std::size_t b : looked_at)
      if (ways.whole(b) && settle.over(first_mover + b, ways.way(time, b, nodes[b], x, v, mass, led), previous_dt, led)) ways.begin_again(time, b, nodes[b], x, v);
      else ways.double_up(time, b, nodes[b], x, v);
  };
  std::vector<Ways::Nodes> nodes;
  for (const BodyModel& body : model.bodies) nodes.push_back({body.first_node, body.node_count});
  watch(ways, 0, nodes, x, v, elements.nodal_mass(), damping_rate());
  // A tool goes along its guide as one node would, and about its axle.
  NodeField places, velocities;
  std::vector<double> mass;
  nodes.clear();
  const int movers = 2 * static_cast<int>(tools.size());
  for (int k = 0; k < movers; ++k) {
    const Drive* drive = drive_of(k);
    places.push_back(node(drive ? drive->gone() : 0, 0, 0));
    velocities.push_back(node(drive ? drive->speed() : 0, 0, 0));
    mass.push_back(drive ? drive->mass() : 1);
    nodes.push_back({k, 1});
  }
  watch(tool_ways, model.bodies.size(), nodes, places, velocities, mass, settle.damping());
  for (int k = 0; k < movers; ++k)
    if (!settling_drive(k)) settle.forget(model.bodies.size() + k);
  settle.take_together(previous_dt);
}

void Simulation::Impl::slow_tools() {
  for (int k = 0; k < static_cast<int>(tools.size()); ++k) {
    const double rate = stages.settling() && tools[k].present && tools[k].pressed ? settle.damping() : 0;
    if (ForceDrive* drive = stages.drive(k)) drive->slow_down(rate);
    if (AxleDrive* drive = stages.axle(k)) drive->slow_down(rate);
  }
}

bool Simulation::Impl::still_driven() const { return stages.stage().ends != "limit" && driven_on(); }

bool Simulation::Impl::driven_on() const {
  const bool last = stages.index() + 1 == static_cast<int>(plan.stages.size());
  const double until = last ? time + stages.remaining(time) : time;
  const auto on_its_way = [&](const auto& config) {
    const double began = stages.began(config.since);
    return changes(config, time - began, until - began);
  };
  const auto any = [&](const auto& configs) { return std::any_of(configs.begin(), configs.end(), on_its_way); };
  for (const BodyLoads& body : plan.bodies) {
    if (any(body.pressures) || any(body.loads)) return true;
    for (const BoundaryConfig& b : body.boundaries)
      if (holds_in(stages.index(), b, plan.stages) && on_its_way(b)) return true;
  }
  for (std::size_t k = 0; k < tools.size(); ++k)
    if (model.tools[k].motion && tools[k].present && !stages.stopped(static_cast<int>(k)) && on_its_way(*model.tools[k].motion)) return true;
  return false;
}

void Simulation::Impl::see_rest() {
  if (steps % (10 * Settle::kInterval) != 0) return;
  const std::vector<double>& mass = elements.nodal_mass();
  std::vector<Settle::Energies> bodies;
  for (const BodyModel& body : model.bodies) {
    Settle::Energies energies;
    for (int i = body.first_node; i < body.first_node + body.node_count; ++i) energies.kinetic += 0.5 * mass[i] * v[i].squaredNorm();
    energies.elastic = elements.stored_energy_of(body, x);
    bodies.push_back(energies);
  }
  std::vector<double> of_tools;  // what has left the bodies may fly and turn on
  for (int k = 0; k < 2 * static_cast<int>(tools.size()); ++k) {
    const Drive* drive = settling_drive(k);
    of_tools.push_back(drive ? 0.5 * drive->mass() * drive->speed() * drive->speed() : 0);
  }
  if (let_go_until() > 0 || still_driven()) settle.not_yet(time);
  rests = settle.at_rest(time, bodies, of_tools);
}

std::string Simulation::Impl::what_moves() const {
  const auto goes_on = [&](const auto& velocities) { return !velocities.empty() && velocities.back().norm() > 0; };
  for (int k = 0; k < static_cast<int>(tools.size()); ++k) {
    const Pose told = stages.told(k, time);
    if (tools[k].present && (told.velocity.norm() > 0 || told.spin.norm() > 0)) return "tool " + model.tools[k].name + " still moves";
  }
  for (std::size_t b = 0; b < plan.bodies.size(); ++b)
    for (const BoundaryConfig& boundary : plan.bodies[b].boundaries)
      if (holds_in(stages.index(), boundary, plan.stages) && (goes_on(boundary.velocities) || goes_on(boundary.spins_deg_s))) return "set " + boundary.set + " of body " + model.bodies[b].name + " is still driven";
  return "";
}

std::string Simulation::Impl::what_flies(double least) const {
  constexpr double kNearly = 0.95;  // of the kinetic energy: of the first swing of a cantilever .61
  const std::vector<double>& m = elements.nodal_mass();
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    if (contact && !contact->tools_on(static_cast<int>(b)).empty()) continue;
    double mass = 0, kinetic = 0;
    Vec3 momentum = Vec3::Zero();
    for (int i = body.first_node; i < body.first_node + body.node_count; ++i) {
      mass += m[i];
      momentum += m[i] * vec3(v[i]);
      kinetic += 0.5 * m[i] * v[i].squaredNorm();
    }
    if (model.axisymmetric) momentum.x() = 0;  // outward
    if (kinetic >= least && momentum.squaredNorm() > kNearly * 2 * mass * kinetic) return "body " + body.name + " goes as a whole, with " + three_digits(momentum.norm() / mass) + " m/s";
  }
  return "";
}

void Simulation::Impl::tell_flight(const Energies& energies) {
  constexpr double kLittle = 0.01;  // of what was put in
  if (!stages.settling() || !plan.gravity.isZero(0) || !what_moves().empty()) return;  // what falls or is driven is meant to move
  const std::string flying = what_flies(kLittle * (energies.work + energies.initial));
  if (!flying.empty()) warnings.push_back(flying + " when stage " + stages.stage().title() + " begins, which brings it to rest: if it is to fly on, let a form stage last that long, and read its speed there");
}

std::string Simulation::Impl::why_unsettled() const {
  const char* unit = model.per_width() ? " J/m" : " J";
  std::ostringstream text;
  text << "stage " << stages.stage().title() << " reached its limit ";
  if (settle.restless() > settle.quiet()) {
    const std::size_t mover = settle.most_restless(), bodies = model.bodies.size();
    const bool is_body = mover < bodies;
    text << "before all rested: at its end the kinetic energy of " << (is_body ? "body " + model.bodies[mover].name : "tool " + model.tools[(mover - bodies) % model.tools.size()].name) << ", the farthest from rest, and what the forces out of balance could still set free in it, were " << settle.restless()
         << unit << ", and should stay below stages[].kinetic_fraction of " << (is_body ? "its elastic energy, " : "that of all bodies, ") << settle.quiet() << unit << "; ";
    NodeField loads(x.size(), Node::Zero());
    pressures.add(time, x, loads);
    dead_loads.add(time, loads);
    const bool loaded = std::any_of(loads.begin(), loads.end(), [](const Node& f) { return !f.isZero(0); });
    const std::string moving = what_moves(), flying = what_flies(0);
    if (!moving.empty()) text << moving << ": end it with a velocity of 0";
    else if (still_driven()) text << "a motion, a pressure or a load still changed: a longer limit lets them come to rest after it";
    else if (!flying.empty()) text << flying << (plan.gravity.isZero(0) ? "" : " under gravity") << ", and nothing stops it: hold it, or lay it on a tool that stays";
    else text << (loaded ? "pressures or loads still act on them: let these end before (last entry 0) if nothing holds the bodies against them" : "a longer limit lets them come to rest");
  } else if (let_go_until() > 0) {
    text << "before the bodies rested; what held them was still fading, until " << let_go_until() << " s: a longer limit or a shorter stages[].release_time lets them come to rest";
  } else if (still_driven()) {
    text << "while a motion, a pressure or a load still changed: a longer limit lets the bodies come to rest after it, and with `ends: limit` the stage does not wait for it";
  } else {
    text << "before it could be told that the bodies rest: they have to be quiet for " << settle.shortest() << " s, since they are so at every turning point of a swing; give a longer limit, or, where that does not help, a larger kinetic_fraction: contact keeps some jitter";
  }
  return text.str();
}

}  // namespace forming_sim
