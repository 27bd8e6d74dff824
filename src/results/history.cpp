#include "forming_sim/results/history.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "forming_sim/config/words.h"
#include "forming_sim/loads/rotation.h"
#include "forming_sim/material/damage.h"

namespace forming_sim {
namespace {

const char* const kAxes[] = {"x", "y", "z"};

void add(std::vector<std::string>& values, const Vec3& vector) {
  for (int axis = 0; axis < 3; ++axis) values.push_back(csv_number(vector[axis]));
}

}  // namespace

std::vector<std::string> history_columns(const Model& model, const std::vector<Probe>& probes) {
  const std::string per_width = model.per_width() ? "_per_m" : "";
  std::vector<std::string> columns{"time_s", "step", "dt_s", "stage"};
  for (const char* name : {"kinetic", "elastic", "plastic", "contact", "friction", "damping", "work", "initial"})
    columns.push_back(std::string(name) + "_J" + per_width);
  columns.push_back("balance_error");
  for (const ToolModel& tool : model.tools) {
    for (const char* axis : kAxes) columns.push_back("tool_" + tool.name + "_force_" + axis + "_N" + per_width);
    for (const char* axis : kAxes) columns.push_back("tool_" + tool.name + "_position_" + axis + "_m");
    if (model.axisymmetric)
      columns.push_back("tool_" + tool.name + "_radial_force_N");
    else
      for (const char* axis : kAxes) columns.push_back("tool_" + tool.name + "_moment_" + axis + "_N_m" + per_width);
    if (tool.turns_freely()) columns.push_back("tool_" + tool.name + "_turned_deg");
  }
  for (const char* name : {"max_plastic_strain", "max_surface_strain", "min_thickness_m", "max_thinning", "min_gap_over_h0"})
    columns.push_back(name);
  for (const BodyModel* body : with_damage(model)) columns.push_back("max_damage_" + body->name + (std::string(damage_unit(body->material.damage->criterion)) == "Pa" ? "_Pa" : ""));
  for (const BodyModel* body : with_forming_limit(model)) columns.push_back("max_limit_ratio_" + body->name);
  for (const Probe& probe : probes) {
    for (const char* axis : kAxes) columns.push_back("probe_" + probe.name + "_position_" + axis + "_m");
    for (const char* axis : kAxes) columns.push_back("probe_" + probe.name + "_velocity_" + axis + "_m_per_s");
    for (const char* component : {"xx", "yy", "zz", "xy", "yz", "zx"})
      columns.push_back("probe_" + probe.name + "_stress_" + component + "_Pa");
    if (!probe.held) continue;
    for (const char* axis : kAxes) columns.push_back("probe_" + probe.name + "_reaction_force_" + axis + "_N" + per_width);
    if (model.axisymmetric)
      columns.push_back("probe_" + probe.name + "_reaction_radial_force_N");
    else
      for (const char* axis : kAxes) columns.push_back("probe_" + probe.name + "_reaction_moment_" + axis + "_N_m" + per_width);
  }
  return columns;
}

std::string stage_name(const Simulation& simulation) {
  const auto& stages = simulation.plan().stages;
  if (stages.empty()) return "";
  const StageConfig& stage = stages[std::min<std::size_t>(simulation.stage(), stages.size() - 1)];
  return stage.title();
}

void History::on_start(const Simulation& simulation) {
  schedule_.start(simulation.time());
  quiet_ = simulation.quiet();
  const std::vector<std::string> columns = history_columns(simulation.model(), gauge_.probes());
  if (resumed_) {
    double until = 0;
    file_ = CsvFile::resume(path_, columns, record_.history_time, &until);
    if (file_ && until < record_.history_time)
      record_.notes.push_back("history.csv holds no rows between " + number_text(until) + " s and " + number_text(record_.history_time) + " s: it is that of a shorter first part");
    if (file_) return;
    record_.notes.push_back("history.csv begins at the checkpoint: the directory held no history of the earlier part");
  }
  file_ = std::make_unique<CsvFile>(path_, columns);
  if (!resumed_) write(simulation);
}

void History::on_step(const Simulation& simulation) {
  // The last row of a settle stage shall tell what is felt at rest, and nothing of the way there.
  const bool calms = simulation.quiet() && !quiet_;
  quiet_ = simulation.quiet();
  if (schedule_.due(simulation.time()) || calms) write(simulation);
}

void History::on_stage_end(const Simulation& simulation, int) { write(simulation); }

void History::on_end(const Simulation& simulation, Code code, const std::string&) {
  // A row at a cancel would be one that an unbroken run does not have.
  if (file_ && code != Code::output_error && code != Code::cancelled) write(simulation);
}

void History::write(const Simulation& simulation) {
  if (simulation.steps() == last_step_) return;
  last_step_ = simulation.steps();
  const Measures& measures = gauge_.at(simulation);
  const Energies& e = simulation.energies();
  const double elapsed = simulation.time() - record_.history_time;
  const auto rate_of = [elapsed](const Reaction& before, const Reaction& now) {
    const double rate = elapsed > 0 ? 1 / elapsed : 0;
    return Reaction{rate * (now.impulse - before.impulse), rate * (now.angular - before.angular), rate * (now.radial - before.radial)};
  };
  // What is pushed goes on between the rows: about the place that it has at the end alone, a force across its way would turn it.
  const auto about_place = [](const Reaction& felt, const Vec3& from, const Vec3& to) { return Vec3(felt.angular - (0.5 * (from + to)).cross(felt.impulse)); };
  std::vector<std::string> values{csv_number(simulation.time()), std::to_string(simulation.steps()),
                                  csv_number(simulation.dt()), csv_text(stage_name(simulation))};
  for (double energy : {e.kinetic, e.elastic, e.plastic, e.contact, e.friction, e.damping, e.work, e.initial})
    values.push_back(csv_number(energy));
  values.push_back(csv_number(simulation.balance_error()));
  record_.history_tools.resize(simulation.tools().size());
  for (std::size_t i = 0; i < simulation.tools().size(); ++i) {
    const ToolStatus& tool = simulation.tools()[i];
    FeltAt& before = record_.history_tools[i];
    const Reaction felt = rate_of(before.felt, tool.felt);
    const Vec3 force = elapsed > 0 ? felt.impulse : tool.force;
    add(values, force);
    add(values, tool.position);
    if (simulation.model().axisymmetric)
      values.push_back(csv_number(elapsed > 0 ? felt.radial : tool.radial_force));
    else
      add(values, elapsed > 0 ? about_place(felt, before.position, tool.position) : tool.moment);
    if (simulation.model().tools[i].turns_freely()) values.push_back(csv_number(tool.turned / kRadiansPerDegree));
    before = {tool.felt, tool.position};
  }
  values.push_back(csv_number(measures.plastic_strain.value));
  values.push_back(csv_number(measures.surface_strain.value));
  values.push_back(measures.thickness ? csv_number(*measures.thickness) : "");
  values.push_back(measures.thickness ? csv_number(measures.thinning.value) : "");
  values.push_back(csv_number(simulation.contact_status().min_gap_over_layer));
  for (const Peak& damage : measures.damage) values.push_back(csv_number(damage.value));
  for (const Peak& ratio : measures.limits.greatest) values.push_back(csv_number(ratio.value));
  record_.history_reactions.resize(measures.probes.size());
  for (std::size_t i = 0; i < measures.probes.size(); ++i) {
    const ProbeValue& probe = measures.probes[i];
    add(values, probe.position);
    add(values, probe.velocity);
    for (int k = 0; k < 6; ++k) values.push_back(csv_number(probe.stress[k]));
    if (!gauge_.probes()[i].held) continue;
    const Reaction now = simulation.reaction(gauge_.probes()[i].nodes);
    FeltAt& before = record_.history_reactions[i];
    const Reaction felt = rate_of(before.felt, now);
    add(values, felt.impulse);
    if (simulation.model().axisymmetric)
      values.push_back(csv_number(felt.radial));
    else
      add(values, about_place(felt, before.position, probe.position));
    before = {now, probe.position};
  }
  record_.history_time = simulation.time();
  file_->append(values);
}

}  // namespace forming_sim
