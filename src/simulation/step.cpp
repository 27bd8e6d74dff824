// One step: forces, the kick, contact, and the ledger's sums.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

#include "forming_sim/loads/course.h"
#include "forming_sim/loads/gravity.h"
#include "forming_sim/parallel/denormals.h"
#include "simulation/impl.h"

namespace forming_sim {

namespace {
constexpr double kForceMeanSteps = 50;  ///< tool forces and contact pressures are running means over about this many steps
}

NodalForces Simulation::Impl::forces() const {
  NodalForces f = elements.nodal_forces();
  if (!external.empty()) f.load = external.data()->data();
  return f;
}

Kick Simulation::Impl::kick_of(double step_dt) const { return Kick(0.5 * (previous_dt + step_dt), damping_rate(), resting > 0 ? &resting_bodies : nullptr); }

void Simulation::Impl::predict(double step_dt, NodeField& v_star) {
  resting = kick_nodes(elements.node_team(), kick_of(step_dt), v, forces(), elements.nodal_mass(), v_star);
  boundaries.apply_velocity(time, step_dt, x, v_star);
}

void Simulation::Impl::find_loads() {
  if (pressures.empty() && dead_loads.empty() && supports.empty() && fading.empty() && plan.gravity.isZero()) return external.clear();
  external.assign(x.size(), Node::Zero());
  pressures.add(time, x, external);
  dead_loads.add(time, external);
  supports.add(time, x, external);
  fading.add(time, external);
  if (!plan.gravity.isZero()) add_gravity(plan.gravity, physical_mass, external);
}

void Simulation::Impl::take_step() {
  const DenormalsAreZero quick;
  choose_dt();
  --control.until_next;
  if (control.longer) ++longer_steps;
  go_on_letting_go();
  elements.find_forces(x, v, previous_dt, previous_kick);
  find_loads();
  if (stages.settling()) watch_settling();
  slow_tools();
  struct {
    const NodeField* then;
    double departed;  // squared
  } way{by_cells() ? nullptr : &departure.then(), 0};
  if (contact) {
    // Each asks for no more than two pointers, which a std::function has room for.
    const ContactStep& done = contact->advance(
        time, dt, x, v, v_before, [this](double step_dt, NodeField& v_star) { predict(step_dt, v_star); },
        [this, &way](double step_dt, const NodeField& with, NodeField& at) { way.departed = move_nodes(elements.node_team(), step_dt, with, way.then, at); },
        [this](double step_dt, std::vector<ToolMotion>& motion) { tool_motions(step_dt, motion); }, full_dt(), damping_rate());
    dt = done.dt;
    book(done);
  } else {
    v.swap(v_before);
    const BoundarySet::Prescription& prescribed = boundaries.prescription(time, dt);
    const auto hold = [&](long first, long last) { boundaries.apply_velocity(prescribed, x, first, last, v); };
    const KickedAndMoved moved = kick_and_move_nodes(elements.node_team(), kick_of(dt), v_before, forces(), elements.nodal_mass(), hold, dt, way.then, v, x);
    way.departed = moved.apart;
    resting = moved.resting;
  }
  if (steps == 0) initial -= first_kick_energy();
  book_loads();
  if (stages.settling()) see_rest();
  time += dt;
  previous_kick = 0.5 * (previous_dt + dt);
  previous_dt = dt;
  ++steps;
  if (damage.due(steps)) {
    double fastest = 0;  // squared
    for (const Node& u : v) fastest = std::max(fastest, u.squaredNorm());
    damage.look(steps, std::sqrt(fastest) / elements.slowest_wave(), elements.plastic_strain(), elements.observe(x, previous_dt).stress);
  }
  place_tools();
  most = std::max(most, work + initial - std::min(0.0, contact_dissipated));
  if (way.then) departure.step(way.departed, elements.slowest_wave(), dt);
}

// The leapfrog's energy of a swing that is let go at rest, of amplitude a, is 1/2 omega^2 a^2 (1 - (omega dt/2)^2): by dt^2/8 f.M^-1 f less than the elastic one,
// m/2 times the square of its first change of velocity. What contact, ties and boundaries hold changes its velocity by less than the elements' forces ask for, and
// what strikes or is loaded by more, which is no swing: the smaller of both, node by node, is an estimate where these come together.
double Simulation::Impl::first_kick_energy() const {
  if (std::none_of(model.bodies.begin(), model.bodies.end(), [](const BodyModel& body) { return body.formed.has_value(); })) return 0;
  NodeField f(x.size());
  sum_nodes(elements.node_team(), elements.nodal_forces(), f);
  double sum = 0;
  for (std::size_t i = 0; i < f.size(); ++i) {
    const double m = elements.nodal_mass()[i];
    sum += 0.5 * m * std::min((v[i] - v_before[i]).squaredNorm(), (0.5 * dt / m * f[i]).squaredNorm());
  }
  return sum;
}

void Simulation::Impl::book(const ContactStep& done) {
  work += done.tool_work - done.held_work;
  friction += done.friction_work;
  contact_dissipated += done.dissipated - done.soft_start_work;
  contact_potential = done.potential;
  halvings += done.halvings;
  sweeps += done.sweeps;
  swept_steps += done.sweeps > 0;
  unsettled_steps += !done.settled;
  active_pairs = done.active;
  min_gap = std::min(min_gap, done.min_gap_over_layer);
  if (done.stable_dt > 0 && (explicit_stable_dt == 0 || done.stable_dt < explicit_stable_dt)) explicit_stable_dt = done.stable_dt;
  if (done.stable_dt > 0 && done.dt > done.stable_dt && !overstepped) {
    overstepped = true;
    std::ostringstream text;
    text << "from " << time << " s on steps of " << done.dt << " s are longer than the " << done.stable_dt
         << " s up to which the explicit contact is stable: set time_step.maximum to a fifth of contact.explicit_stable_dt_s, or contact.method to implicit";
    warnings.push_back(text.str());
  }
  if (!done.told.empty() && std::find(warnings.begin(), warnings.end(), done.told) == warnings.end()) warnings.push_back(done.told);
  const double kick = 0.5 * (previous_dt + done.dt);  // in which impulses of contact act as forces do
  if (done.active > 0 || contact->ties() || pressed) mean_contact_force(kick);
  for (std::size_t k = 0; k < tools.size(); ++k) {
    ToolStatus& tool = tools[k];
    if (!tool.present) {
      tool.force = tool.moment = Vec3::Zero();
      tool.radial_force = 0;
      tool.pressed = false;
      continue;
    }
    Reaction felt{done.tool_impulse[k], done.tool_angular_impulse[k]};
    const bool lands = !tool.felt.impulse.isZero(0) && !tool.pressed && !felt.impulse.isZero(0);
    tool.pressed = !felt.impulse.isZero(0);
    if (lands && stages.drive(static_cast<int>(k))) tell_landing(static_cast<int>(k));
    tool.touched = tool.touched || tool.pressed;
    if (model.axisymmetric) felt = around_circle(felt);
    tool.felt += felt;
    const StageRunner::Line axle = stages.axle(static_cast<int>(k)) ? stages.axle_now(static_cast<int>(k), time) : StageRunner::Line();
    if (ForceDrive* drive = stages.drive(static_cast<int>(k))) drive->take(time, kick, done.dt, done.tool_push[k][0], felt.impulse.dot(drive->guide()));
    if (AxleDrive* drive = stages.axle(static_cast<int>(k))) drive->take(time, kick, done.dt, done.tool_push[k][1], axle.along.dot(felt.angular - axle.point.cross(felt.impulse)), stages.told_turn(static_cast<int>(k), time, done.dt));
    tell_fall(static_cast<int>(k));
    const auto run_on = [&](auto& mean, const auto& impulse) { mean += (impulse / kick - mean) / kForceMeanSteps; };
    run_on(tool.force, felt.impulse);
    run_on(tool.moment, model.axisymmetric ? felt.angular : Vec3(felt.angular - tool.position.cross(felt.impulse)));
    run_on(tool.radial_force, felt.radial);
    if (tool.force.squaredNorm() > tool.peak_force.squaredNorm()) tool.peak_force = tool.force;
    if (tool.moment.squaredNorm() > tool.peak_moment.squaredNorm()) tool.peak_moment = tool.moment;
    if (std::abs(tool.radial_force) > std::abs(tool.peak_radial_force)) tool.peak_radial_force = tool.radial_force;
    const double most = stages.stop_force(static_cast<int>(k));
    if (most == 0 || (tool.way.isZero(0) && goes(*model.tools[k].motion))) continue;  // it has not begun to go
    tool.most_against = std::max(tool.most_against, tool.against());
    if (tool.against() >= most) stages.stop(static_cast<int>(k), time + done.dt);
  }
}

void Simulation::Impl::mean_contact_force(double kick) {
  const std::vector<double>& area = contact->nodal_area();
  contact->add_normal_impulses(node_impulse);
  const double over_kick = 1 / kick, nothing = least_press();
  pressed = false;
  for (int n : touchable) {
    contact_force[n] += (node_impulse[n] * over_kick - contact_force[n]) * (1 / kForceMeanSteps);
    node_impulse[n] = 0;
    pressed = pressed || std::abs(contact_force[n]) > nothing * area[n];
  }
  if (!pressed)
    for (int n : touchable) contact_force[n] = 0;
}

void Simulation::Impl::tell_fall(int tool) {
  const ForceDrive* drive = stages.drive(tool);
  if (!drive || fall_told) return;
  const double fallen = drive->fallen(time);
  if (!(fallen > 0)) return;
  double thinnest = std::numeric_limits<double>::max();
  for (const BodyModel& body : model.bodies) thinnest = std::min(thinnest, body.thickness);
  if (fallen < thinnest) return;
  fall_told = true;
  std::ostringstream text;
  text << "tool " << model.tools[tool].name << ", which a force drives, pressed on the bodies no more: at " << time << " s it had gone on by " << fallen
       << " m from there, and tools do not hold each other. Until then it may have struck them: give it a motion.stop_ahead above 0, as spacers do, withdraw it or end its force before the bodies have left it, or guide it by a trajectory";
  warnings.push_back(text.str());
}

// A tool on a body is a mass on a spring, and where it rubs, its swing can feed on friction by the body's own swing along the surface.
void Simulation::Impl::tell_landing(int tool) {
  constexpr long kMany = 20;
  ToolStatus& status = tools[tool];
  if (++status.landings == 1) status.first_landing = time;
  if (status.landings != kMany) return;
  const double period = (time - status.first_landing) / (kMany - 1);
  std::ostringstream text;
  text.precision(3);
  text << "tool " << model.tools[tool].name << ", which a force drives, had lifted off the bodies and come back " << kMany << " times at " << time << " s, every " << period << " s: with " << stages.drive(tool)->mass() / mass_of_bodies()
       << " times the mass of the bodies it swings on them, and where it rubs, friction is less in the mean than its force asks for. ";
  text << "A motion.damping of " << M_PI / period << " 1/s stops such a swing, or a motion.mass of some times that of the bodies at most";
  if (model.tools[tool].turns_freely()) text << ", or a profile with a smaller chord_error";
  warnings.push_back(text.str());
}

void Simulation::Impl::book_loads() {
  const double kick = 0.5 * (previous_dt + dt), alpha = damping_rate();
  const std::vector<double>& mass = elements.nodal_mass();
  for (std::size_t i = 0; i < external.size(); ++i) work += 0.5 * kick * external[i].dot(v_before[i] + v[i]);
  if (!fading.empty())
    for (const RecedingSupports::Done& by : supports.work(kick, v_before, v)) fading.count(by.body, by.work);
  if (!fading.empty() && fading.work(kick, v_before, v)) {
    std::ostringstream text;
    text << "what had let go of the bodies was to fade, but drove them on by more than the elastic energy that they could spring back by: they gave way. At " << time
         << " s it was taken away at once; give stages[].release: sudden where nothing is to spring back slowly, move tools away instead (stages[].displacement), or give stages[].release_time less than they take to give way";
    warnings.push_back(text.str());
  }
  if (alpha > 0) {
    const auto mean = [&](int i) -> Node { return 0.5 * (v_before[i] + v[i]); };
    double lost = 0;
    for (int i = 0; i < static_cast<int>(v.size()); ++i) lost += mass[i] * mean(i).squaredNorm();
    for (std::size_t k = 0; k < boundaries.nodes().size(); ++k) {  // held directions are not damped
      const int i = boundaries.nodes()[k];
      const Vec3 whole = vec3(mean(i));
      lost -= mass[i] * (whole - boundaries.projector(static_cast<int>(k)) * whole).dot(whole);
    }
    lost *= alpha * kick;
    damping += lost;
    if (stages.settling()) settled_away += lost * settle.damping() / alpha;
  }
  book_reactions(kick);
}

// What holds or drives a node answers the forces of the elements, the loads and contact along its fixed directions, and does work.
void Simulation::Impl::book_reactions(double kick) {
  const std::vector<double>& mass = elements.nodal_mass();
  const NodalForces f = forces();
  const bool pressed_by_contact = contact && any_kept;
  if (pressed_by_contact) {
    held_impulse.assign(boundaries.nodes().size(), Vec3::Zero());
    contact->add_held_impulses(held_impulse);
  }
  double done = 0;  // against contact it is in ContactStep::held_work
  for (const Booked& b : booked) {
    const int i = boundaries.nodes()[b.held];
    const Node impulse = boundaries.reaction_impulse(b.held, force_on(i, f), mass[i], v_before[i], v[i], kick);
    if (takes_hold || boundaries.drives(b.held)) done += 0.5 * impulse.dot(v_before[i] + v[i]);
    if (b.once < 0) continue;
    Vec3 felt = vec3(impulse);
    if (pressed_by_contact) felt -= held_impulse[b.held];
    reactions[b.once].impulse += felt;
    reactions[b.once].angular += vec3(x[i]).cross(felt);
  }
  work += done;
  if (!takes_hold) return;
  takes_hold = false;
  choose_booked();
}

double Simulation::Impl::mass_of_bodies() const { return std::accumulate(elements.nodal_mass().begin(), elements.nodal_mass().end(), 0.0); }

double Simulation::Impl::kinetic() const {
  double sum = 0;
  const std::vector<double>& mass = elements.nodal_mass();
  for (std::size_t i = 0; i < v.size(); ++i) sum += 0.5 * mass[i] * v[i].squaredNorm();
  return sum;
}

double Simulation::Impl::damping_rate() const {
  return plan.time_step.damping + (stages.settling() ? settle.damping() : 0);
}

}  // namespace forming_sim
