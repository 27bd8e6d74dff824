#include "forming_sim/simulation/simulation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

#include "forming_sim/contact/contact.h"
#include "forming_sim/loads/boundary.h"
#include "forming_sim/loads/gravity.h"
#include "forming_sim/loads/pressure.h"
#include "simulation/archive.h"
#include "simulation/settle.h"
#include "simulation/stages.h"
#include "simulation/step_control.h"

namespace forming_sim {

namespace {

constexpr double kForceMeanSteps = 50;  ///< tool forces are running means over about this many steps
constexpr int kCrossingChecks = 200;    ///< independent crossing checks over a run

NodeField initial_positions_of(const Model& model) {
  NodeField x;
  for (const BodyModel& body : model.bodies)
    for (const Vec3& X : body.mesh.nodes) x.push_back(node(X));
  return x;
}

/// Twice the volume over the surface: the thickness of a thin sheet.
double thickness_of(const BodyModel& body) {
  double volume = 0, area = 0;
  const auto& X = body.mesh.nodes;
  for (const auto& s : body.mesh.simplices()) {
    Mat3 edges = Mat3::Identity();
    for (int m = 0; m < body.mesh.dimension; ++m) edges.col(m) = X[s[m + 1]] - X[s[0]];
    volume += edges.determinant() / (body.mesh.dimension == 2 ? 2 : 6);
  }
  for (const Facet& f : body.mesh.surface) {
    const Vec3 a = X[f.nodes[1]] - X[f.nodes[0]];
    area += body.mesh.dimension == 2 ? a.norm() : 0.5 * a.cross(X[f.nodes[2]] - X[f.nodes[0]]).norm();
  }
  return 2 * volume / area;
}

}  // namespace

struct Simulation::Impl {
  RunPlan plan;
  Model model;
  int threads;
  NodeField X;                      ///< initial positions
  NodeField x, v, v_before, f;      ///< v at the half step
  Elements elements;
  std::vector<Facet> surface;       ///< joined
  std::vector<double> physical_mass;
  BoundarySet boundaries;
  PressureSet pressures;
  StageRunner stages;
  std::optional<Contact> contact;
  std::vector<ToolStatus> tools;
  std::vector<std::string> warnings;
  std::vector<Observer*> observers;

  double time = 0, dt = 0, previous_dt = 0;
  long steps = 0;
  StepControl control;
  StepLimit limit, smallest;
  double first_dt = 0;
  Settle settle;
  bool settled = true;              ///< false once a settle stage has run into its limit
  double wall = 0;

  // the ledger's running sums, J
  double work = 0, damping = 0, friction = 0, contact_dissipated = 0, contact_potential = 0, initial = 0, most = 0;
  long halvings = 0;
  double min_gap = 1;
  long active_pairs = 0;
  long crossings = 0;
  double next_crossing_check = 0;
  std::string last_warning;

  mutable Energies energies;
  mutable long energies_step = -1;

  Impl(const RunPlan& p, Model m, int n)
      : plan(p), model(std::move(m)), threads(std::max(1, n)), X(initial_positions_of(model)), x(X),
        v(X.size(), Node::Zero()), v_before(v), f(v),
        elements(model.bodies, model.dimension, X,
                 {p.time_step.mass_scaling, p.time_step.linear_viscosity, p.time_step.quadratic_viscosity}, threads),
        stages(plan.stages, model) {
    set_up_loads();
    set_up_contact();
    double kinetic = 0;
    for (std::size_t i = 0; i < v.size(); ++i) kinetic += 0.5 * elements.nodal_mass()[i] * v[i].squaredNorm();
    initial = most = kinetic;
    begin_stage();
  }

  void set_up_loads() {
    std::vector<ResolvedBoundary> held;
    std::vector<ResolvedPressure> pressed;
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      const BodyModel& body = model.bodies[b];
      const BodyLoads& loads = plan.bodies[b];
      const Vec3 spin = loads.initial_spin_deg_s * (M_PI / 180);
      for (int i = body.first_node; i < body.first_node + body.node_count; ++i)
        v[i] = node(loads.initial_velocity + spin.cross(vec3(X[i]) - loads.spin_centre));
      for (const BoundaryConfig& c : loads.boundaries) held.push_back(resolve(c, body.name, body.mesh, body.first_node));
      for (const PressureConfig& c : loads.pressures) pressed.push_back(resolve(c, body.name, body.mesh, body.first_node));
      for (Facet facet : body.mesh.surface) {
        for (int a = 0; a < model.dimension; ++a) facet.nodes[a] += body.first_node;
        facet.element += body.first_element;
        surface.push_back(facet);
      }
    }
    boundaries = BoundarySet(held, model.dimension);
    pressures = PressureSet(std::move(pressed), model.dimension);
    boundaries.apply_velocity(0, v);
    physical_mass = elements.nodal_mass();
    for (double& m : physical_mass) m /= plan.time_step.mass_scaling;
  }

  void set_up_contact() {
    for (std::size_t k = 0; k < model.tools.size(); ++k) {
      ToolStatus status;
      const ToolPose pose = stages.pose(static_cast<int>(k), 0);
      status.position = pose.position;
      status.rotation = pose.rotation;
      status.velocity = pose.velocity;
      tools.push_back(status);
    }
    if (model.tools.empty()) return;
    ContactSetup setup;
    setup.dimension = model.dimension;
    setup.config = plan.contact;
    setup.softest_modulus = setup.thinnest = setup.wave_speed = std::numeric_limits<double>::infinity();
    std::size_t first_facet = 0;
    for (const BodyModel& body : model.bodies) {
      ContactSurface s;
      s.name = body.name;
      s.dimension = model.dimension;
      const std::size_t count = body.mesh.surface.size();
      s.facets.assign(surface.begin() + first_facet, surface.begin() + first_facet + count);
      first_facet += count;
      setup.bodies.push_back(std::move(s));
      const MaterialConfig& m = body.material;
      setup.softest_modulus = std::min(setup.softest_modulus, m.youngs_modulus);
      setup.thinnest = std::min(setup.thinnest, thickness_of(body));
      setup.wave_speed = std::min(
          setup.wave_speed, std::sqrt((m.bulk_modulus() + 4. / 3 * m.shear_modulus()) / m.density / plan.time_step.mass_scaling));
    }
    for (const ToolModel& tool : model.tools) {
      ContactSurface s;
      s.name = tool.name;
      s.dimension = model.dimension;
      s.rigid = true;
      s.facets = tool.mesh.surface;
      s.friction = tool.friction;
      s.plane = tool.is_plane();
      s.point = tool.point;
      s.normal = tool.normal;
      setup.tools.push_back(std::move(s));
      setup.tool_meshes.push_back(&tool.mesh);
    }
    contact.emplace(setup, x, tool_motions(0, 0));
    std::vector<double> inverse_mass;
    for (double m : elements.nodal_mass()) inverse_mass.push_back(1 / m);
    std::vector<HeldNode> held;
    for (std::size_t k = 0; k < boundaries.nodes().size(); ++k)
      held.push_back({boundaries.nodes()[k], boundaries.projector(static_cast<int>(k))});
    contact->set_masses(inverse_mass, held);
    warnings = contact->warnings();
  }

  std::vector<ToolMotion> tool_motions(double from, double to) const {
    std::vector<ToolMotion> motions;
    for (int k = 0; k < static_cast<int>(model.tools.size()); ++k) {
      const ToolPose a = stages.pose(k, from), b = stages.pose(k, to);
      motions.push_back({a.position, b.position, a.rotation, b.rotation, stages.present(k)});
    }
    return motions;
  }

  // ------------------------------------------------------------------ the step

  /// dt of the coming step: the elements' bound, the user's limit, the stage's end.
  void choose_dt() {
    if (control.due()) {
      double stable = 0;
      int element = -1;
      elements.stable_step(x, v, stable, element);
      control.update(stable, element);
    }
    --control.until_next;
    const TimeStepConfig& config = plan.time_step;
    dt = config.safety * control.element_dt;
    limit = {dt, control.element, {}};
    if (config.maximum > 0 && config.maximum < dt) dt = config.maximum, limit = {dt, -1, "time_step.maximum"};
    if (steps == 0) first_dt = dt;
    if (smallest.dt == 0 || limit.dt < smallest.dt) smallest = limit;
    const double left = stages.remaining(time);
    if (left < 2 * dt) dt = left > dt * (1 + 1e-9) ? 0.5 * left : left;
  }

  /// v* = v + (dt_previous + dt)/2 f/m with damping and prescribed motion; f is complete.
  void predict(double step_dt, NodeField& v_star) const {
    const double kick = 0.5 * (previous_dt + step_dt);
    const double a = 0.5 * plan.time_step.damping * kick;
    const std::vector<double>& mass = elements.nodal_mass();
    const int nodes = static_cast<int>(v.size());
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1 && nodes > 4000)
    for (int i = 0; i < nodes; ++i) v_star[i] = ((1 - a) * v_before[i] + kick / mass[i] * f[i]) / (1 + a);
    boundaries.apply_velocity(time + 0.5 * step_dt, v_star);
  }

  void take_step() {
    const bool loaded = !pressures.empty() || !plan.gravity.isZero();
    v_before = v;
    choose_dt();
    elements.forces(x, v, dt, f);
    NodeField external;
    if (loaded) {
      external.assign(x.size(), Node::Zero());
      pressures.add(time, x, external);
      if (!plan.gravity.isZero()) add_gravity(plan.gravity, physical_mass, external);
      for (std::size_t i = 0; i < f.size(); ++i) f[i] += external[i];
    }
    if (contact) {
      const ContactStep done = contact->advance(
          time, dt, x, v, [&](double step_dt, NodeField& v_star) { predict(step_dt, v_star); },
          [&](double step_dt) { return tool_motions(time, time + step_dt); });
      dt = done.dt;
      book(done);
    } else {
      predict(dt, v);
      for (std::size_t i = 0; i < x.size(); ++i) x[i] += dt * v[i];
    }
    book_loads(external);
    time += dt;
    previous_dt = dt;
    ++steps;
    for (std::size_t k = 0; k < tools.size(); ++k) {
      const ToolPose pose = stages.pose(static_cast<int>(k), time);
      tools[k].position = pose.position;
      tools[k].rotation = pose.rotation;
      tools[k].velocity = pose.velocity;
      tools[k].present = stages.present(static_cast<int>(k));
    }
    most = std::max(most, work + initial);
  }

  void book(const ContactStep& done) {
    work += done.tool_work + done.soft_start_work - done.held_work;
    friction += done.friction_work;
    contact_dissipated += done.dissipated;
    contact_potential = done.potential;
    halvings += done.halvings;
    active_pairs = done.active;
    min_gap = std::min(min_gap, done.min_gap_over_layer);
    for (std::size_t k = 0; k < tools.size(); ++k) {
      ToolStatus& tool = tools[k];
      tool.impulse += done.tool_impulse[k];
      const Vec3 about = done.tool_angular_impulse[k] - tool.position.cross(done.tool_impulse[k]);
      tool.force += (done.tool_impulse[k] / done.dt - tool.force) / kForceMeanSteps;
      tool.moment += (about / done.dt - tool.moment) / kForceMeanSteps;
      if (tool.force.squaredNorm() > tool.peak_force.squaredNorm()) tool.peak_force = tool.force;
    }
  }

  /// Work of prescribed motion, pressure, gravity and damping over the kick.
  void book_loads(const NodeField& external) {
    const double kick = 0.5 * (previous_dt + dt), alpha = plan.time_step.damping;
    const std::vector<double>& mass = elements.nodal_mass();
    for (std::size_t i = 0; i < external.size(); ++i) work += 0.5 * kick * external[i].dot(v_before[i] + v[i]);
    if (alpha > 0) {
      NodeField v_star(v.size());
      predict(dt, v_star);
      for (std::size_t i = 0; i < v.size(); ++i) {
        const Node drag = alpha * kick * 0.5 * mass[i] * (v_before[i] + v_star[i]);
        const int k = boundaries.find(static_cast<int>(i));
        const Vec3 free = k < 0 ? vec3(drag) : Vec3(boundaries.projector(k) * vec3(drag));
        damping += 0.5 * free.dot(vec3(v_before[i] + v[i]));
      }
    }
    work += boundaries.work(f, mass, v_before, v, kick);
  }

  double kinetic() const {
    double sum = 0;
    const std::vector<double>& mass = elements.nodal_mass();
    for (std::size_t i = 0; i < v.size(); ++i) sum += 0.5 * mass[i] * v[i].squaredNorm();
    return sum;
  }

  // ---------------------------------------------------------------- the stages

  void begin_stage() {
    if (!stages.settling()) return;
    double size = 0, thin = 1e300, speed = 1e300;
    for (const BodyModel& body : model.bodies) {
      Eigen::AlignedBox3d box;
      for (const Vec3& X_i : body.mesh.nodes) box.extend(X_i);
      size = std::max(size, box.diagonal().norm());
      thin = std::min(thin, thickness_of(body));
      speed = std::min(speed, std::sqrt(body.material.youngs_modulus / body.material.density / plan.time_step.mass_scaling));
    }
    const double elastic = elements.observe(x).stored_energy;
    settle = Settle(time, size * size / (thin * speed), stages.stage().kinetic_fraction, elastic);
  }

  /// True when the running stage has come to its end.
  bool stage_over() {
    if (stages.settling()) {
      const double energy = kinetic();
      const Settle::Verdict verdict = settle.observe(time, energy);
      if (verdict.stop_motion) {
        damping += energy;
        std::fill(v.begin(), v.end(), Node::Zero());
        boundaries.apply_velocity(time, v);
      }
      if (verdict.at_rest) return true;
      if (stages.remaining(time) <= 0) {
        settled = false;
        return true;
      }
      return false;
    }
    return stages.remaining(time) <= 1e-12 * (time + stages.stage().duration);
  }

  void check_crossings() {
    if (!contact) return;
    crossings += contact->count_crossings(x, tool_motions(time, time));
    next_crossing_check = stages.progress(time) + 1.0 / kCrossingChecks;
  }

  template <class Archive> void exchange(Archive& a);
};

// -------------------------------------------------------------------- the run

Simulation::Simulation(const RunPlan& plan, Model model, int threads)
    : impl_(std::make_unique<Impl>(plan, std::move(model), threads)) {}
Simulation::~Simulation() = default;

void Simulation::add(Observer& observer) { impl_->observers.push_back(&observer); }

bool Simulation::step() {
  Impl& s = *impl_;
  if (s.stages.finished()) return false;
  const auto start = std::chrono::steady_clock::now();
  s.take_step();
  const bool over = s.stage_over();
  s.wall += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (over || s.stages.progress(s.time) >= s.next_crossing_check) s.check_crossings();
  for (Observer* o : s.observers) o->on_step(*this);
  if (over) {
    const int ended = s.stages.index();
    for (Observer* o : s.observers) o->on_stage_end(*this, ended);
    s.stages.advance(s.time);
    s.begin_stage();
  }
  return !s.stages.finished();
}

Outcome Simulation::run(const std::atomic<bool>& cancel) {
  Impl& s = *impl_;
  Outcome outcome;
  try {
    for (Observer* o : s.observers) o->on_start(*this);
    while (!s.stages.finished()) {
      if (cancel) {
        std::ostringstream text;
        text << "cancelled at " << s.time << " s after " << s.steps << " steps";
        outcome = {Code::cancelled, text.str()};
        break;
      }
      step();
    }
    if (outcome.code == Code::none) {
      outcome = s.settled ? Outcome{Code::success, "completed"}
                          : Outcome{Code::limit_reached, "a settle stage reached its limit before the kinetic energy fell below stages[].kinetic_fraction of the elastic energy; a longer limit lets it come to rest"};
    }
  } catch (const Error& error) {
    std::ostringstream text;
    text << error.what() << " (at time " << s.time << " s, step " << s.steps << ")";
    outcome = {error.code(), text.str()};
  } catch (const std::exception& error) {
    outcome = {Code::internal_error, error.what()};
  }
  for (Observer* o : s.observers) {
    try {
      o->on_end(*this, outcome.code, outcome.message);
    } catch (const Error& error) {
      if (outcome.code == Code::success) outcome = {error.code(), error.what()};
    }
  }
  return outcome;
}

// ------------------------------------------------------------------ accessors

const Model& Simulation::model() const { return impl_->model; }
const RunPlan& Simulation::plan() const { return impl_->plan; }
const std::vector<std::array<int, 4>>& Simulation::elements() const { return impl_->elements.simplices(); }
const std::vector<Facet>& Simulation::surface() const { return impl_->surface; }
const std::vector<double>& Simulation::nodal_mass() const { return impl_->elements.nodal_mass(); }
double Simulation::time() const { return impl_->time; }
long Simulation::steps() const { return impl_->steps; }
double Simulation::dt() const { return impl_->dt; }
int Simulation::stage() const { return impl_->stages.index(); }
double Simulation::progress() const { return impl_->stages.progress(impl_->time); }
double Simulation::wall_time() const { return impl_->wall; }
const NodeField& Simulation::initial_positions() const { return impl_->X; }
const NodeField& Simulation::positions() const { return impl_->x; }
const NodeField& Simulation::velocities() const { return impl_->v; }
double Simulation::first_dt() const { return impl_->first_dt; }
const std::vector<ToolStatus>& Simulation::tools() const { return impl_->tools; }
const std::vector<std::string>& Simulation::warnings() const { return impl_->warnings; }

namespace {
StepLimit described(StepLimit limit, const Model& model) {
  if (limit.element >= 0)
    for (const BodyModel& body : model.bodies)
      if (limit.element < body.first_element + body.element_count) {
        limit.reason = "element " + std::to_string(limit.element) + " of body " + body.name;
        break;
      }
  return limit;
}
}  // namespace

StepLimit Simulation::step_limit() const { return described(impl_->limit, impl_->model); }
StepLimit Simulation::smallest_step() const { return described(impl_->smallest, impl_->model); }

const Energies& Simulation::energies() const {
  const Impl& s = *impl_;
  if (s.energies_step == s.steps) return s.energies;
  NodeField half = s.x;
  if (s.steps > 0)
    for (std::size_t i = 0; i < half.size(); ++i) half[i] -= 0.5 * s.dt * s.v[i];
  Energies& e = s.energies;
  e.kinetic = s.kinetic();
  e.elastic = s.elements.observe(half).stored_energy;
  e.plastic = s.elements.plastic_work();
  e.contact = s.contact_potential + s.contact_dissipated;
  e.friction = s.friction;
  e.damping = s.damping + s.elements.viscous_work();
  e.work = s.work;
  e.initial = s.initial;
  s.energies_step = s.steps;
  return e;
}

double Simulation::balance_error() const {
  const double scale = impl_->most;
  const double residual = std::fabs(energies().residual());
  return scale > 0 ? residual / scale : residual;
}

ContactStatus Simulation::contact_status() const {
  const Impl& s = *impl_;
  ContactStatus c;
  c.halvings = s.halvings;
  c.crossings = s.crossings;
  c.min_gap_over_layer = s.min_gap;
  c.active_pairs = s.active_pairs;
  if (s.contact) {
    c.layer = s.contact->layer();
    c.listed_pairs = s.contact->listed_pairs();
  }
  return c;
}

std::vector<double> Simulation::plastic_strain() const { return impl_->elements.plastic_strain(); }
std::vector<Sym> Simulation::stress() const { return impl_->elements.observe(impl_->x).stress; }
std::vector<double> Simulation::volume_ratio() const { return impl_->elements.observe(impl_->x).volume_ratio; }

std::vector<double> Simulation::surface_strain() const {
  const Impl& s = *impl_;
  std::vector<double> strain;
  strain.reserve(s.surface.size());
  for (const Facet& f : s.surface) {
    const Vec3 A = vec3(s.X[f.nodes[1]] - s.X[f.nodes[0]]), a = vec3(s.x[f.nodes[1]] - s.x[f.nodes[0]]);
    if (s.model.dimension == 2) {
      strain.push_back(std::log(a.norm() / A.norm()));
      continue;
    }
    const Vec3 B = vec3(s.X[f.nodes[2]] - s.X[f.nodes[0]]), b = vec3(s.x[f.nodes[2]] - s.x[f.nodes[0]]);
    // C = E^-T (edges now) E^-1 in the facet's initial plane; its larger eigenvalue is the square of the stretch
    Eigen::Matrix2d initial, now;
    initial << A.dot(A), A.dot(B), A.dot(B), B.dot(B);
    now << a.dot(a), a.dot(b), a.dot(b), b.dot(b);
    const Eigen::Matrix2d C = initial.inverse() * now;
    const double half = 0.5 * C.trace();
    strain.push_back(0.5 * std::log(half + std::sqrt(std::max(0.0, half * half - C.determinant()))));
  }
  return strain;
}

// ----------------------------------------------------------------- checkpoint

template <class Archive> void Simulation::Impl::exchange(Archive& a) {
  a.numbers(x.data()->data(), x.size() * 4);
  a.numbers(v.data()->data(), v.size() * 4);
  for (double* value : {&time, &dt, &previous_dt, &work, &damping, &friction, &contact_dissipated, &contact_potential,
                        &initial, &most, &min_gap, &first_dt, &smallest.dt, &next_crossing_check, &wall})
    a.number(*value);
  for (long* value : {&steps, &halvings, &active_pairs, &crossings}) a.number(*value);
  a.raw(control);
  a.number(smallest.element);
  a.text(smallest.reason);
  a.raw(settle);
  a.number(settled);
  for (ToolStatus& tool : tools)
    for (Vec3* value : {&tool.force, &tool.moment, &tool.impulse, &tool.peak_force}) a.numbers(value->data(), 3);
}

std::vector<char> Simulation::save() const {
  Impl& s = *impl_;
  Writer out;
  out.number(s.elements.simplices().size());
  out.number(s.x.size());
  out.number(s.tools.size());
  out.list(s.stages.starts());
  s.exchange(out);
  std::vector<double> memory;
  s.elements.append_state(memory);
  out.list(memory);
  out.list(s.contact ? s.contact->save() : std::vector<char>());
  return out.take();
}

void Simulation::restore(const std::vector<char>& data) {
  Impl& s = *impl_;
  Reader in(data);
  std::size_t simplices = 0, nodes = 0, tools = 0;
  in.number(simplices);
  in.number(nodes);
  in.number(tools);
  if (simplices != s.elements.simplices().size() || nodes != s.x.size() || tools != s.tools.size()) {
    std::ostringstream what;
    what << "the checkpoint holds " << simplices << " elements, " << nodes << " nodes and " << tools
         << " tools, the scene " << s.elements.simplices().size() << ", " << s.x.size() << " and " << s.tools.size()
         << "; resume with the scene that wrote it";
    throw Error(Code::resume_error, what.str());
  }
  std::vector<double> starts, memory;
  in.list(starts);
  s.stages = StageRunner(s.plan.stages, s.model);
  s.stages.replay(starts);
  s.exchange(in);
  in.list(memory);
  std::vector<double> expected;
  s.elements.append_state(expected);
  if (memory.size() != expected.size())
    throw Error(Code::resume_error, "the checkpoint's element memory has another size than the scene's; resume with the scene that wrote it");
  s.elements.read_state(memory.data());
  std::vector<char> contact;
  in.list(contact);
  if (s.contact) s.contact->restore(contact);
  s.energies_step = -1;
  for (std::size_t k = 0; k < s.tools.size(); ++k) {
    const ToolPose pose = s.stages.pose(static_cast<int>(k), s.time);
    s.tools[k].position = pose.position;
    s.tools[k].rotation = pose.rotation;
    s.tools[k].velocity = pose.velocity;
    s.tools[k].present = s.stages.present(static_cast<int>(k));
  }
}

}  // namespace forming_sim
