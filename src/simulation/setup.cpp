// From plan and model to the state at the start.
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "forming_sim/config/formula_field.h"
#include "forming_sim/config/words.h"
#include "forming_sim/mesh/axis.h"
#include "forming_sim/mesh/measure.h"
#include "forming_sim/parallel/interrupt.h"
#include "forming_sim/simulation/release.h"
#include "simulation/impl.h"

namespace forming_sim {

namespace {

constexpr double kLightest = 1e-3;  ///< mass of a tool that moves as it is pushed, over that of all bodies; inertia likewise
constexpr double kRoundings = 1e4;  ///< of the farthest place, that a contact layer is to be thick at least
constexpr double kQuick = 40;       ///< T of contact/shear_waves.h: a press that takes less feels by percents what keeps swings down

/// Of all bodies, in the joined numbering. places_of: a body's nodes, m.
template <class PlacesOf> NodeField joined(const Model& model, PlacesOf&& places_of) {
  NodeField x;
  for (const BodyModel& body : model.bodies)
    for (const Vec3& X : places_of(body)) x.push_back(node(X));
  return x;
}
NodeField initial_positions_of(const Model& model) {
  return joined(model, [](const BodyModel& body) -> const std::vector<Vec3>& { return body.mesh.nodes; });
}
NodeField references_of(const Model& model) {
  return joined(model, [](const BodyModel& body) -> const std::vector<Vec3>& { return body.reference(); });
}

/// What lies on the axis of symmetry does not move away from it.
void hold_at_axis(const BodyModel& body, std::vector<ResolvedBoundary>& held) {
  ResolvedBoundary axis;
  axis.config.set = "on the axis of symmetry";
  axis.config.kind = "symmetric";
  axis.config.normal = Vec3::UnitX();
  axis.path = "axisymmetric";
  axis.body = body.name;
  for (int n : axis_nodes(body.mesh)) axis.nodes.push_back(body.first_node + n);
  if (!axis.nodes.empty()) held.push_back(axis);
}

/// What the step is taken from where the scene leaves it open. The energy of what is thrown at something is in the fastest
/// swings of its mesh, and there the error of the ledger grows with the square of the step: an impact takes the shorter one.
std::string default_limit(const RunPlan& plan, const Model& model) {
  if (model.without_tangent()) return "node";
  for (const BodyLoads& loads : plan.bodies)
    if (loads.moves_at_first()) return "element";
  return "global";
}

RunPlan with_limit(RunPlan plan, const Model& model) {
  if (plan.time_step.limit.empty()) plan.time_step.limit = default_limit(plan, model);
  return plan;
}

}  // namespace

namespace {

WaveBody waves_of(const BodyModel& body, double mass_scaling) {
  const double density = body.material.density * mass_scaling, shear_speed = std::sqrt(body.material.mu() / density);
  return {density * shear_speed, kSteadyTime * body.thickness / shear_speed, body.first_node, body.node_count};
}

}  // namespace

Simulation::Impl::Impl(const RunPlan& p, Model m, int n)
    : plan(with_limit(p, m)), model(std::move(m)), X(initial_positions_of(model)), reference(references_of(model)), x(X),
      v(X.size(), Node::Zero()), v_before(v),
      elements(model.bodies, model.dimension, reference,
               {p.time_step.mass_scaling, p.time_step.linear_viscosity, p.time_step.quadratic_viscosity,
                !by_cells(), model.axisymmetric}, n),
      damage(model, elements, x),
      stages(plan.stages, model), contact_force(X.size(), 0.0), node_impulse(contact_force) {
  for (BodyModel& body : model.bodies)
    if (body.formed) body.formed->cells.clear(), body.formed->edges = {};  // the elements have them
  for (const Node& n : x) farthest = std::max(farthest, n.cwiseAbs().maxCoeff());
  check_interrupt();
  set_up_loads();
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    BodyModel& body = model.bodies[b];
    body.cut = cut_facets(body.mesh, symmetry_planes(plan.bodies[b].boundaries, model.axisymmetric));
    body.thickness = thickness_of(body.mesh, model.axisymmetric, body.cut);
  }
  check_interrupt();
  raise_step();
  give_tools_inertia();
  check_interrupt();
  set_up_contact();
  initial = most = kinetic() + elements.stored_energy(x);  // of a formed part, which is under stress
  check_interrupt();
  elements.find_rates(x, v, rates);
  first_element_dt = elements.slowest_cell(rates).dt;
  for (const BodyModel& body : model.bodies) resting_bodies.push_back(resting_body(body));
  check_interrupt();
  begin_stage();
  choose_dt();
  told_at_start = warnings.size();
}

// Cells of a strain pull a node by c^2 strain/h, h = c dt: of a strain of 1e-14, and of four times what rounding of their places is for the smallest.
RestingBody Simulation::Impl::resting_body(const BodyModel& body) const {
  const MaterialConfig& m = body.material;
  const double c = std::sqrt((m.K() + 4. / 3 * m.mu()) / (m.density * plan.time_step.mass_scaling)), h = c * elements.slowest_cell(rates, &body).dt;
  double far = 0;
  for (int n = body.first_node; n < body.first_node + body.node_count; ++n) far = std::max(far, x[n].cwiseAbs().maxCoeff());
  return {body.first_node, body.node_count, (1e-14 + 4 * std::numeric_limits<double>::epsilon() * far / h) * c * c / h};
}

void Simulation::Impl::set_up_loads() {
  std::vector<ResolvedBoundary>& held = all_boundaries;
  std::vector<ResolvedPressure> pressed;
  std::vector<ResolvedLoad> loaded;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    const BodyLoads& loads = plan.bodies[b];
    const Vec3 spin = loads.initial_spin_deg_s * (M_PI / 180);
    const FormulaField field(loads.initial_velocity_field);
    for (int i = body.first_node; i < body.first_node + body.node_count; ++i)
      v[i] = node(loads.initial_velocity + spin.cross(vec3(X[i]) - loads.spin_centre) + field.at(vec3(X[i])));
    for (std::size_t k = 0; k < loads.boundaries.size(); ++k) {
      const BoundaryConfig& c = loads.boundaries[k];
      const int stage = first_stage(c.since, plan.stages);
      held.push_back(resolve(c, body.name, body.mesh, body.first_node));
      held.back().path = "bodies[" + std::to_string(b) + "].boundaries[" + std::to_string(k) + "]";
      held.back().clock = CourseClock(stage);
    }
    if (model.axisymmetric) hold_at_axis(body, held);
    for (const PressureConfig& c : loads.pressures) {
      pressed.push_back(resolve(c, body.name, body.mesh, body.first_node));
      pressed.back().clock = CourseClock(first_stage(c.since, plan.stages));
    }
    for (const LoadConfig& c : loads.loads) {
      loaded.push_back(resolve(c, body.name, body.mesh, body.first_node, model.axisymmetric));
      loaded.back().clock = CourseClock(first_stage(c.since, plan.stages));
    }
    for (Face face : faces_of(body.mesh)) {
      for (int k = 0; k < face.corners; ++k) face.nodes[k] += body.first_node;
      faces.push_back(face);
    }
    for (Facet facet : body.mesh.surface) {
      for (int a = 0; a < model.dimension; ++a) facet.nodes[a] += body.first_node;
      facet.element += body.first_element;
      surface.push_back(facet);
    }
  }
  // Those of every stage, so that what contradicts itself in a later one is told now, whenever that begins; those of the first remain.
  for (const auto when : {latest_begin, earliest_begin}) {
    for (ResolvedBoundary& boundary : held) boundary.clock.begin(first_stage(boundary.config.since, plan.stages), when(boundary.config.since, plan.stages));
    std::vector<std::size_t> last{held.size()};  // none is like it
    for (int stage = static_cast<int>(plan.stages.size()) - 1; stage >= 0; --stage)
      if (std::vector<std::size_t> those = holding_in(stage); those != last) hold(last = std::move(those));
  }
  pressures = PressureSet(std::move(pressed), model.axisymmetric);
  dead_loads = DeadLoadSet(std::move(loaded));
  boundaries.apply_velocity(0, 0, x, v);
  for (const ResolvedBoundary& boundary : held) once_held.insert(once_held.end(), boundary.nodes.begin(), boundary.nodes.end());
  std::sort(once_held.begin(), once_held.end());
  once_held.erase(std::unique(once_held.begin(), once_held.end()), once_held.end());
  reactions.resize(once_held.size());
  kept.assign(once_held.size(), true);
  choose_booked();
  physical_mass = elements.nodal_mass();
  for (double& m : physical_mass) m /= plan.time_step.mass_scaling;
}

void Simulation::Impl::tell_quick_press() {
  if (plan.contact.method != "implicit" || plan.contact.swing != "damped") return;
  if (std::none_of(model.tools.begin(), model.tools.end(), [](const ToolModel& t) { return t.motion.has_value(); })) return;
  double all = 0;
  for (const StageConfig& stage : plan.stages)
    if (stage.kind == "form") all += stage.duration;
  if (all == 0) return;
  const std::vector<SurfacePair> pairs = contact->surface_pairs();
  for (const BodyModel& body : model.bodies) {
    const auto rubs = [&](const SurfacePair& p) { return (p.first == body.name || p.second == body.name) && p.friction > 0; };
    const double T = waves_of(body, plan.time_step.mass_scaling).time, share = all / T;
    if (share >= kQuick || std::none_of(pairs.begin(), pairs.end(), rubs)) continue;
    std::ostringstream text;
    text.precision(2);
    text << "the tools form body " << body.name << " in " << all << " s, " << share << " times the " << T << " s within which its shear waves leave at surfaces that rub: below "
         << kQuick << " times contact.swing damped changes force and work by percents; swing free does not, nor does a slower motion";
    warnings.push_back(text.str());
  }
}

void Simulation::Impl::set_up_contact() {
  warnings.insert(warnings.end(), model.notes.begin(), model.notes.end());
  tools.resize(model.tools.size());
  place_tools();
  // What can meet: a body and a tool, two bodies, a body and itself.
  if (model.tools.empty() && model.bodies.size() < 2 && !model.bodies.front().self_contact) return;
  ContactSetup setup;
  setup.dimension = model.dimension;
  setup.axisymmetric = model.axisymmetric;
  setup.config = plan.contact;
  setup.team = &elements.team();
  setup.softest_modulus = setup.thinnest = setup.wave_speed = std::numeric_limits<double>::infinity();
  std::size_t first_facet = 0;
  for (const BodyModel& body : model.bodies) {
    ContactSurface s;
    s.name = body.name;
    s.dimension = model.dimension;
    s.meets_itself = body.self_contact;
    const std::size_t count = body.mesh.surface.size();
    s.facets.assign(surface.begin() + first_facet, surface.begin() + first_facet + count);
    first_facet += count;
    const MaterialConfig& m = body.material;
    const double density = m.density * plan.time_step.mass_scaling;
    s.waves = waves_of(body, plan.time_step.mass_scaling);
    setup.bodies.push_back(std::move(s));
    setup.softest_modulus = std::min(setup.softest_modulus, m.E());
    setup.thinnest = std::min(setup.thinnest, body.thickness);
    setup.soft = setup.soft || body.material.law == "hyperelastic";
    setup.wave_speed = std::min(
        setup.wave_speed, std::sqrt((m.K() + 4. / 3 * m.mu()) / density));
  }
  if (plan.contact.layer > setup.thinnest)
    throw SceneError({{Code::invalid_scene, "contact.layer", number_text(plan.contact.layer), "give less than the thickness of the thinnest body, " + three_digits(setup.thinnest) + " m (twice its volume over its surface, planes of symmetry left out), or leave it out"}});
  for (std::size_t i = 0; i < plan.contact.pairs.size(); ++i) {
    const PairConfig& pair = plan.contact.pairs[i];
    for (const BodyModel& body : model.bodies)
      if ((body.name == pair.first || body.name == pair.second) && pair.tie_distance > 0.5 * body.thickness)
        throw SceneError({{Code::invalid_scene, "contact.pairs[" + std::to_string(i) + "].tie_distance", number_text(pair.tie_distance), "give at most " + three_digits(0.5 * body.thickness) + " m, half the thickness of body " + body.name + ", so that its other side is not tied too"}});
  }
  for (const ToolModel& tool : model.tools) {
    ContactSurface s;
    s.name = tool.name;
    s.dimension = model.dimension;
    s.rigid = true;
    s.facets = tool.mesh.surface;
    s.friction = tool.friction;
    s.friction_limit = tool.friction_limit;
    s.plane = tool.is_plane();
    s.point = tool.point;
    s.normal = tool.normal;
    setup.tools.push_back(std::move(s));
    setup.tool_meshes.push_back(&tool.mesh);
  }
  contact.emplace(setup, x, tools_now());
  if (const double least = kRoundings * std::numeric_limits<double>::epsilon() * farthest; contact->layer() < least)
    throw SceneError({{Code::invalid_scene, "contact.layer", three_digits(contact->layer()) + " m", "give at least " + three_digits(least) + " m: places of nodes that are up to " + three_digits(farthest) + " m from the origin are not known as exactly as so thin a layer asks for. Put the scene nearer to the origin where that is too much"}});
  for (std::size_t k = 0; k < tools.size(); ++k) tools[k].touched = contact->touches_at_start(static_cast<int>(k));
  for (std::size_t n = 0; n < x.size(); ++n)
    if (contact->nodal_area()[n] > 0) touchable.push_back(static_cast<int>(n));
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    const Node shift = node(contact->body_shifts()[b]);
    for (int n = body.first_node; n < body.first_node + body.node_count; ++n) x[n] += shift, X[n] += shift;
  }
  tell_contact_what_is_held();
  warnings.insert(warnings.end(), contact->warnings().begin(), contact->warnings().end());
  tell_quick_press();
}

std::vector<std::size_t> Simulation::Impl::holding_in(int stage) const {
  std::vector<std::size_t> those;
  for (std::size_t b = 0; b < all_boundaries.size(); ++b)
    if (holds_in(stage, all_boundaries[b].config, plan.stages)) those.push_back(b);
  return those;
}

void Simulation::Impl::hold(std::vector<std::size_t> those) {
  std::vector<ResolvedBoundary> held;
  for (std::size_t b : those) held.push_back(all_boundaries[b]);
  boundaries = BoundarySet(held, model.dimension);
  holding = std::move(those);
}

bool Simulation::Impl::change_boundaries() {
  if (stages.finished()) return false;
  std::vector<std::size_t> now = holding_in(stages.index());
  if (now == holding) return false;
  const bool ended = !std::includes(now.begin(), now.end(), holding.begin(), holding.end());
  takes_hold = takes_hold || !std::includes(holding.begin(), holding.end(), now.begin(), now.end());
  for (std::size_t b : now) {
    const int stage = first_stage(all_boundaries[b].config.since, plan.stages);
    all_boundaries[b].clock.begin(stage, stages.starts()[stage]);
  }
  hold(std::move(now));
  choose_booked();
  if (contact) tell_contact_what_is_held();
  global.forget();  // what is let go swings faster than what is held
  control.hurry();
  return ended;
}

void Simulation::Impl::begin_loads() {
  for (std::size_t stage = 0; stage < stages.starts().size(); ++stage) {
    pressures.begin(static_cast<int>(stage), stages.starts()[stage]);
    dead_loads.begin(static_cast<int>(stage), stages.starts()[stage]);
  }
}

// The nodes of both lists increase. What stands does no work.
void Simulation::Impl::choose_booked() {
  booked.clear();
  any_kept = false;
  int once = 0;
  for (int k = 0; k < static_cast<int>(boundaries.nodes().size()); ++k) {
    while (once_held[once] != boundaries.nodes()[k]) ++once;
    if (takes_hold || boundaries.drives(k) || kept[once]) booked.push_back({k, kept[once] ? once : -1});
    any_kept = any_kept || kept[once];
  }
}

void Simulation::Impl::tell_contact_what_is_held() {
  std::vector<double> inverse_mass;
  for (double m : elements.nodal_mass()) inverse_mass.push_back(1 / m);
  std::vector<HeldNode> held;
  for (std::size_t k = 0; k < boundaries.nodes().size(); ++k)
    held.push_back({boundaries.nodes()[k], boundaries.projector(static_cast<int>(k))});
  contact->set_masses(inverse_mass, held);
}

void Simulation::Impl::give_tools_inertia() {
  const double all = mass_of_bodies();
  bool given = false;
  for (std::size_t k = 0; k < model.tools.size(); ++k) {
    ToolModel& tool = model.tools[k];
    // value: 0 where the scene says none; usual: what it has then, in words `of_what`.
    const auto give = [&](const char* field, double& value, double usual, const char* unit, const std::string& of_what, const std::string& told) {
      std::ostringstream text;
      if (value > 0) {
        if (value >= kLightest * usual) return;
        text << "give at least " << kLightest * usual << unit << ", " << kLightest << " of " << of_what << ", or leave it out: what contact leaves open would throw a lighter one about";
        throw SceneError({{Code::invalid_scene, "tools[" + std::to_string(k) + "].motion." + field, number_text(value) + unit, text.str()}});
      }
      value = usual;
      given = true;
      text << "tool " << tool.name << ", " << told << ", has " << of_what << ", " << usual << unit << ": set its motion." << field << " where it matters how soon it goes and stops";
      warnings.push_back(text.str());
    };
    if (tool.motion && tool.motion->by_force()) give("mass", tool.motion->mass, all, model.per_width() ? " kg/m" : " kg", "the mass of the bodies", "which a force drives");
    if (!tool.turns_freely()) continue;
    const double farthest = reach_from_axle(tool);
    give("inertia", tool.motion->inertia, all * farthest * farthest, model.per_width() ? " kg m" : " kg m2", "the inertia of the mass of the bodies at its radius of " + three_digits(farthest) + " m", "which turns freely about its axle");
  }
  if (given) stages = StageRunner(plan.stages, model);  // so that it knows
}

std::vector<ToolMotion> Simulation::Impl::tools_now() const {
  std::vector<ToolMotion> motions;
  tool_motions(0, motions);
  return motions;
}

void Simulation::Impl::tool_motions(double step_dt, std::vector<ToolMotion>& motions) const {
  motions.clear();
  for (int k = 0; k < static_cast<int>(model.tools.size()); ++k) {
    const ToolPose a = stages.pose(k, time);
    ToolMotion motion{a.position, a.position, a.rotation, a.rotation, stages.present(k), {}};
    const double kick = 0.5 * (previous_dt + step_dt);
    const auto give_way = [&](const Drive& drive, ToolFreedom& freedom) {
      freedom.inverse_mass = drive.inverse_mass(kick);
      freedom.speed = drive.free_speed(time, kick);
      freedom.last_speed = drive.speed();
    };
    if (const ForceDrive* drive = stages.drive(k)) {
      motion.freedom[0].guide = drive->guide();
      give_way(*drive, motion.freedom[0]);
    }
    if (const AxleDrive* drive = stages.axle(k)) {
      const StageRunner::Line line = stages.axle_now(k, time);
      motion.freedom[1].axle = line.along;
      motion.freedom[1].centre = line.point;
      give_way(*drive, motion.freedom[1]);
    }
    if (step_dt > 0) {
      const ToolPose b = stages.pushed_by_none(k, time, kick, step_dt);
      motion.position1 = b.position;
      motion.rotation1 = b.rotation;
    }
    motions.push_back(motion);
  }
}

void Simulation::Impl::place_tools() {
  for (std::size_t k = 0; k < tools.size(); ++k) {
    const ToolPose pose = stages.pose(static_cast<int>(k), time);
    tools[k].position = pose.position;
    tools[k].rotation = pose.rotation;
    tools[k].velocity = pose.velocity;
    if (model.tools[k].turns_freely()) tools[k].turned = stages.turned(static_cast<int>(k));
    if (!pose.travel.isZero(0)) tools[k].way = pose.travel.stableNormalized();
    tools[k].present = stages.present(static_cast<int>(k));
    if (const double stop = stages.stops()[k]; !std::isnan(stop)) tools[k].stopped = stop;
  }
}

}  // namespace forming_sim
