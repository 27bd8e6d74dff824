#include "forming_sim/results/summary.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "forming_sim/config/words.h"
#include "forming_sim/loads/rotation.h"
#include "forming_sim/material/damage.h"
#include "forming_sim/mesh/measure.h"
#include "forming_sim/results/body_measures.h"
#include "forming_sim/results/text_file.h"
#include "forming_sim/results/unfinished.h"
#include "forming_sim/results/version.h"
#include "forming_sim/simulation/body_of_element.h"

namespace forming_sim {
namespace {

using Json = nlohmann::ordered_json;

/// JSON knows no NaN and no infinity.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }
Json vector(const Vec3& v) { return Json::array({number(v.x()), number(v.y()), number(v.z())}); }
double ratio(double a, double b) { return b > 0 ? a / b : NAN; }

Json head(const Scene& scene, Code code, const std::string& message) {
  Json j;
  j["status"] = {{"code", static_cast<int>(code)}, {"name", name_of(code)}, {"message", message}};
  j["version"] = package_version();
  j["scene"] = scene.name;
  j["dimension"] = scene.dimension;
  j["axisymmetric"] = scene.axisymmetric;
  return j;
}

Json place(const Peak& peak, const Model& model) {
  if (peak.element < 0) return nullptr;
  return {{"element", peak.element}, {"body", body_of_element(model, peak.element).name}, {"position", vector(peak.position)}, {"time_s", number(peak.time)}};
}

Json maximum(const Peak& peak, const Model& model) {
  return {{"max", peak.element < 0 ? Json(nullptr) : number(peak.value)}, {"where", place(peak, model)}};
}

Json energies(const Simulation& simulation, const RunRecord& record) {
  const Energies& e = simulation.energies();
  return {{"kinetic", number(e.kinetic)},
          {"elastic", number(e.elastic)},
          {"plastic", number(e.plastic)},
          {"contact", number(e.contact)},
          {"friction", number(e.friction)},
          {"damping", number(e.damping)},
          {"work", number(e.work)},
          {"initial", number(e.initial)},
          {"balance_error", number(simulation.balance_error())},
          {"kinetic_over_internal", number(ratio(e.kinetic, e.elastic + e.plastic))},
          {"kinetic_over_internal_formed", number(record.kinetic_over_internal_formed)},
          {"kinetic_over_internal_forming", number(record.kinetic_over_internal_forming)}};
}

/// The numerical options of the scene and what each took from the run or added to it.
Json options(const Simulation& simulation, const Scene& scene) {
  const Energies& e = simulation.energies();
  const TimeStepConfig& c = scene.time_step;
  const AddedMass& added = simulation.added_mass();
  const StepLimitCost cost = simulation.step_limit_cost();
  double mass = -added.total;
  for (double m : simulation.nodal_mass()) mass += m;
  Json raised = nullptr;
  if (c.raise_to > 0) {
    const Model& model = simulation.model();
    raised = {{"to_s", number(c.raise_to)}, {"added_mass_kg", number(added.total)}, {"fraction", number(added.fraction)}, {"bodies", Json::array()}, {"most", nullptr}};
    for (std::size_t b = 0; b < model.bodies.size(); ++b)
      raised["bodies"].push_back({{"name", model.bodies[b].name}, {"added_mass_kg", number(added.bodies[b])}});
    if (added.node >= 0)
      raised["most"] = {{"node", added.node}, {"added_mass_kg", number(added.most)}, {"position", vector(vec3(simulation.initial_positions()[added.node]))}};
  }
  return {{"bulk_viscosity", {{"linear", number(c.linear_viscosity)}, {"quadratic", number(c.quadratic_viscosity)}, {"dissipated_J", number(e.viscosity)}}},
          {"damping", {{"rate_1_s", number(c.damping)}, {"dissipated_J", number(e.damping - e.viscosity - e.settling)}}},
          {"settling", {{"dissipated_J", number(e.settling)}}},
          {"mass_scaling", {{"factor", number(c.mass_scaling)}, {"added_mass_kg", number(mass * (1 - 1 / c.mass_scaling))}}},
          {"time_step", {{"limit", simulation.plan().time_step.limit}, {"estimates", cost.estimates}, {"products", cost.products}, {"share_of_longer_steps", number(cost.share)}}},
          {"raised_step", raised}};
}

Json bodies(const Simulation& simulation) {
  Json list = Json::array();
  for (const BodyModel& body : simulation.model().bodies) {
    const BodyMeasures measures = measure_body(body.first_node, body.node_count, simulation.model().axisymmetric, simulation.nodal_mass(),
                                               simulation.positions(), simulation.velocities());
    list.push_back({{"name", body.name},
                    {"mass", number(measures.mass)},
                    {"centre", vector(measures.centre)},
                    {"momentum", vector(measures.momentum)},
                    {"angular_momentum", vector(measures.angular_momentum)},
                    {"bounding_box", {{"min", vector(measures.box.min())}, {"max", vector(measures.box.max())}}}});
  }
  return list;
}

Json orientation(const Mat3& rotation) {
  const Eigen::Quaterniond turned(rotation);
  return {number(turned.x()), number(turned.y()), number(turned.z()), number(turned.w())};
}

Json tools(const Simulation& simulation) {
  Json list = Json::array();
  for (std::size_t i = 0; i < simulation.tools().size(); ++i) {
    const ToolStatus& tool = simulation.tools()[i];
    list.push_back({{"name", simulation.model().tools[i].name},
                    {"peak_force", vector(tool.peak_force)},
                    {"peak_radial_force", simulation.model().axisymmetric ? number(tool.peak_radial_force) : Json(nullptr)},
                    {"unit", simulation.model().per_width() ? "N/m" : "N"},
                    {"peak_moment", simulation.model().axisymmetric ? Json(nullptr) : vector(tool.peak_moment)},
                    {"moment_unit", simulation.model().per_width() ? "N" : "N m"},
                    {"turned_deg", number(tool.turned / kRadiansPerDegree)},
                    {"position", vector(tool.position)},
                    {"orientation_xyzw", orientation(tool.rotation)},
                    {"present", tool.present},
                    {"stopped_s", tool.stopped ? number(*tool.stopped) : Json(nullptr)}});
  }
  return list;
}

bool came_to_its_end(Code code) { return code == Code::success || code == Code::limit_reached; }

/// Tools that were there for nothing, in a run that came to its end.
void tell_idle_tools(const Simulation& simulation, std::vector<std::string>& warnings) {
  for (std::size_t i = 0; i < simulation.tools().size(); ++i)
    if (!simulation.tools()[i].touched)
      warnings.push_back("tool " + simulation.model().tools[i].name + " has touched nothing in the whole run: look at its position, unit_scale and motion, or leave it out");
}

/// What contact promises not to happen.
void tell_crossings(const ContactStatus& contact, std::vector<std::string>& warnings) {
  if (contact.crossings == 0) return;
  warnings.push_back("surfaces passed through each other: " + std::to_string(contact.crossings) + " crossings of an edge and a facet were found, and forces where they are mean nothing. With contact.method implicit, and contact.layer left out, they stay apart");
}

/// Layers that bodies leave no room: what is shut in by tools that stand almost h0 too far out is too soft.
void tell_flat_layers(const ContactStatus& contact, std::vector<std::string>& warnings) {
  constexpr double kFlat = 0.1;  // of h0: p = 9 E, by far more than metals bear
  if (contact.min_gap_over_layer >= kFlat) return;
  warnings.push_back("contact layers were pressed to " + three_digits(contact.min_gap_over_layer) + " of their thickness h0, " + three_digits(contact.layer) + " m, by pressures far above their stiffness: a body that is shut in is too soft by that much room; give contact.stiffness its bulk modulus, or a smaller contact.layer");
}

/// One-point cells that have lost their shape: what keeps them from turning inside out bears load.
void tell_pressed_cells(const Simulation& simulation, const Peak& cells, std::vector<std::string>& warnings) {
  if (cells.element < 0) return;
  std::ostringstream text;
  text.precision(3);
  text << "at " << cells.time << " s " << cells.value << " one-point cells had a corner with less than a fifth of its share in the cell, one of them with element " << cells.element << " of body "
       << body_of_element(simulation.model(), cells.element).name << " at (" << cells.position.transpose() << ") m: "
       << (simulation.model().axisymmetric ? "such cells fold, and forces can be up to twice too large. " : "what keeps such cells from turning inside out bears load, and forces can be many times too large. ")
       << "Take pattern fine for this body, cells of another shape, finer ones, or give concave corners of tools a radius";
  warnings.push_back(text.str());
}

/// Corners of tools that cells are too large for.
void tell_spanned_corner(const Simulation& simulation, const SpannedCorner& spanned, std::vector<std::string>& warnings) {
  if (spanned.peak.element < 0) return;
  warnings.push_back("at " + three_digits(spanned.peak.time) + " s a face of body " + body_of_element(simulation.model(), spanned.peak.element).name + ", " + three_digits(spanned.length) + " m long, spanned a corner of tool " + spanned.tool +
                     " at " + forming_sim::place(spanned.peak.position) + " and stood off it by " + three_digits(100 * spanned.peak.value) +
                     " % of that: metal flows around the corner as if cells had rounded it. Such places bore " + three_digits(100 * spanned.share) + " % of the force of the tool, which is then too large; smaller cells there, or a radius of the tool of about a cell, show by how much");
}

/// Metals that are pressed as forming never does: what cannot flow out and is pushed on, or corners of tools that hold a node of it.
void tell_jams(const Simulation& simulation, const Peak& pressed, std::vector<std::string>& warnings) {
  constexpr double kMuch = 0.1;  // of the bulk modulus: 16 GPa in steel
  if (!(pressed.value > kMuch)) return;
  const BodyModel& body = body_of_element(simulation.model(), pressed.element);
  std::ostringstream text;
  text.precision(3);
  text << "at " << pressed.time << " s body " << body.name << " was pressed by " << pressed.value * body.material.K() << " Pa, " << 100 * pressed.value << " % of its bulk modulus, in element "
       << pressed.element << " at (" << pressed.position.transpose() << ") m: metal that is formed is not, that of a fast impact may be. Look whether it has room to flow to, and whether a concave corner of a tool holds one of its nodes: give such corners a radius, or finer cells there";
  warnings.push_back(text.str());
}

/// Does a tool or a boundary let go of the bodies?
bool anything_leaves(const RunPlan& plan) {
  const auto ends = [](const BoundaryConfig& boundary) { return !boundary.until.empty(); };
  return std::any_of(plan.stages.begin(), plan.stages.end(), [](const StageConfig& stage) { return stage.kind == "withdraw"; }) ||
         std::any_of(plan.bodies.begin(), plan.bodies.end(), [&](const auto& body) { return std::any_of(body.boundaries.begin(), body.boundaries.end(), ends); });
}

/// Bodies that went on flowing when forming was over: they may not have sprung back as they would, let go slowly.
void tell_late_flow(const Simulation& simulation, const RunRecord& record, std::vector<std::string>& warnings) {
  constexpr double kMuch = 0.05;  // of the energy that they could spring back by
  const auto& stages = record.stages;
  const auto formed = std::find_if(stages.rbegin(), stages.rend(), [](const StageRecord& stage) { return stage.kind == "form"; });
  if (formed == stages.rbegin() || formed == stages.rend()) return;
  const double flow = simulation.energies().plastic - formed->plastic;
  if (!(flow > kMuch * formed->elastic)) return;
  warnings.push_back("after the stage " + formed->name + " the plastic work grew by " + three_digits(flow) + (simulation.model().per_width() ? " J/m, " : " J, ") + three_digits(100 * flow / formed->elastic) +
                     " % of the elastic energy that the bodies then had: " +
                     (anything_leaves(simulation.plan()) ? "tools that leave dragged on them, or they flowed as they sprang back or as what had pressed on them faded. Move the tools away (stages[].displacement), and let another stages[].duration or stages[].release_time show whether springback depends on how they are let go"
                                                                          : "they still flowed under what loads them when the stage ended. A longer stages[].duration of forming lets them come to rest, unless a velocity drives them on"));
}

/// The released angle is that of a run that came to its end.
Json springback(const Simulation& simulation, const Scene& scene, const RunRecord& record, Gauge& gauge, Code code) {
  if (!scene.output.springback) return nullptr;
  const SpringbackConfig& config = *scene.output.springback;
  const double formed = record.angle_formed_deg.value_or(NAN);
  const bool ended = came_to_its_end(code);
  const double released = ended ? springback_angle_deg(config, simulation.model().dimension, gauge.probes(),
                                                       gauge.at(simulation).probes)
                                : NAN;
  Json probes{{"from", config.from}, {"to", config.to}};
  if (config.has_reference()) probes.update({{"reference_from", config.reference_from}, {"reference_to", config.reference_to}});
  const Energies& e = simulation.energies();
  return {{"angle_deg_formed", number(formed)},
          {"angle_deg_released", number(released)},
          {"change_deg", number(std::isfinite(formed) && std::isfinite(released) ? angle_change_deg(formed, released) : NAN)},
          {"probe", probes},
          {"kinetic_over_internal", number(ended ? ratio(e.kinetic, e.elastic + e.plastic) : NAN)}};
}

Json stages(const RunRecord& record) {
  Json list = Json::array();
  for (const StageRecord& stage : record.stages)
    list.push_back({{"name", stage.name},
                    {"kind", stage.kind},
                    {"end_time_s", number(stage.end_time)},
                    {"kinetic_J", number(stage.kinetic)},
                    {"internal_J", number(stage.elastic + stage.plastic)},
                    {"elastic_J", number(stage.elastic)},
                    {"plastic_J", number(stage.plastic)},
                    {"kinetic_over_internal", number(stage.kinetic_over_internal())},
                    {"kinetic_over_internal_peak", number(stage.kinetic_over_internal_peak)}});
  return list;
}

Json damages(const Model& model, const Measures& now) {
  Json list = Json::array();
  const std::vector<const BodyModel*> bodies = with_damage(model);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const DamageConfig& config = *bodies[k]->material.damage;
    Json of{{"body", bodies[k]->name}, {"criterion", config.criterion}, {"unit", damage_unit(config.criterion)}};
    of.update(maximum(now.damage[k], model));
    of["critical"] = config.critical > 0 ? Json(config.critical) : Json(nullptr);
    list.push_back(of);
  }
  return list;
}

Json forming_limits(const Model& model, const std::vector<Peak>& before, const FormingLimits::State& now) {
  Json list = Json::array();
  const std::vector<const BodyModel*> bodies = with_forming_limit(model);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    Peak most = k < before.size() ? before[k] : Peak();
    most.rise_to(now.greatest[k]);
    Json of{{"body", bodies[k]->name}};
    of.update(maximum(most, model));
    of["at_end"] = maximum(now.greatest[k], model);
    of["beyond"] = number(now.beyond[k]);
    list.push_back(of);
  }
  return list;
}

std::optional<double> smaller(const std::optional<double>& a, const std::optional<double>& b) {
  if (!a || !b) return a ? a : b;
  return std::min(*a, *b);
}

}  // namespace

Json summarize(const Simulation& simulation, const Scene& scene, const RunRecord& record, Gauge& gauge, Code code,
               const std::string& message) {
  const Model& model = simulation.model();
  const Measures& now = gauge.at(simulation);
  long cells = 0, stepped = 0;
  for (const GroupPlan& group : simulation.groups()) {
    cells += group.cells;
    stepped += group.elements;
  }
  const double element_steps = static_cast<double>(stepped) * static_cast<double>(simulation.steps());
  const StepLimit smallest = simulation.smallest_step();
  const ContactStatus contact = simulation.contact_status();
  const auto swept = static_cast<double>(contact.swept_steps);

  Json j = head(scene, code, message);
  j["per_metre_of_width"] = model.per_width();
  j["nodes"] = model.node_count();
  j["cells"] = cells;
  j["elements"] = model.element_count();
  j["steps"] = simulation.steps();
  j["sim_time_s"] = number(simulation.time());
  j["wall_time_s"] = number(simulation.wall_time());
  j["output_time_s"] = number(simulation.observed_time());
  j["ns_per_element_step"] = number(ratio(1e9 * simulation.wall_time(), element_steps));
  j["time_step_s"] = {{"first", number(simulation.first_dt())},
                      {"min", number(smallest.dt)},
                      {"limited_by", smallest.reason}};
  j["energy_J"] = energies(simulation, record);
  j["options"] = options(simulation, scene);
  j["contact"] = {{"crossings", contact.crossings},
                  {"halvings", contact.halvings},
                  {"min_gap_over_h0", number(contact.min_gap_over_layer)},
                  {"h0_m", number(contact.layer)},
                  {"sweeps_per_step", number(ratio(static_cast<double>(contact.sweeps), swept))},
                  {"share_at_max_sweeps", number(ratio(static_cast<double>(contact.unsettled_steps), swept))},
                  {"explicit_stable_dt_s", contact.explicit_stable_dt > 0 ? number(contact.explicit_stable_dt) : Json(nullptr)}};
  j["plastic_strain"] = maximum(now.plastic_strain, model);
  j["damage"] = damages(model, now);
  j["forming_limit"] = forming_limits(model, record.limit_ratio, now.limits);
  Peak strain = record.surface_strain, thinning = record.thinning;
  strain.rise_to(now.surface_strain);
  thinning.rise_to(now.thinning);
  j["surface_strain"] = maximum(strain, model);
  j["surface_strain"]["at_end_of_forming"] =
      record.surface_strain_formed ? maximum(*record.surface_strain_formed, model) : Json(nullptr);
  j["surface_strain"]["at_end"] = maximum(now.surface_strain, model);
  j["thickness_m"] = {{"initial", number(record.thickness_initial)},
                      {"min", number(smaller(record.thickness_min, now.thickness))}};
  j["thinning"] = maximum(thinning, model);
  j["thinning"]["at_end"] = maximum(now.thinning, model);
  j["bodies"] = bodies(simulation);
  j["tools"] = tools(simulation);
  j["springback"] = springback(simulation, scene, record, gauge, code);
  j["stages"] = stages(record);
  std::vector<std::string> warnings = simulation.warnings();
  tell_crossings(contact, warnings);
  tell_jams(simulation, record.pressed, warnings);
  tell_pressed_cells(simulation, record.pressed_cells, warnings);
  tell_spanned_corner(simulation, record.spanned, warnings);
  if (came_to_its_end(code)) {
    tell_idle_tools(simulation, warnings);
    tell_unfinished(simulation, record, warnings);
    tell_late_flow(simulation, record, warnings);
    if (simulation.plan().contact.method == "implicit") tell_flat_layers(contact, warnings);
  }
  warnings.insert(warnings.end(), record.notes.begin(), record.notes.end());
  j["warnings"] = warnings;
  return j;
}

Json summarize_refusal(const Scene& scene, const std::vector<Fault>& faults, Code code, const std::string& message) {
  Json j = head(scene, code, message);
  j["faults"] = Json::array();
  for (const Fault& fault : faults)
    j["faults"].push_back({{"field", fault.field}, {"given", fault.given}, {"remedy", fault.remedy}});
  return j;
}

void write_summary(const std::string& directory, const Json& summary) {
  // Names may hold bytes that are not UTF-8: they are replaced, never thrown over.
  const std::string text = summary.dump(2, ' ', false, Json::error_handler_t::replace);
  replace_file(in_directory(directory, "summary.json"), text + "\n");
}

std::string read_summary_text(const std::string& directory) {
  const std::string path = in_directory(directory, "summary.json");
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  if (!file || !Json::parse(text.str(), nullptr, false).is_object()) throw Error(Code::output_error, "cannot read the summary " + path);
  return text.str();
}

void SummaryFile::on_start(const Simulation& simulation) { start_time_ = simulation.time(); }

void SummaryFile::on_end(const Simulation& simulation, Code code, const std::string& message) {
  Json summary = summarize(simulation, scene_, record_, gauge_, code, message);
  summary["resumed_at_s"] = start_time_ > 0 ? number(start_time_) : Json(nullptr);
  write_summary(directory_, summary);
}

}  // namespace forming_sim
