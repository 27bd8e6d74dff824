#include "forming_sim/results/run_record.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "forming_sim/config/fault.h"

namespace forming_sim {
namespace {

using nlohmann::json;

json of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 vector(const json& j) { return Vec3(j.at(0), j.at(1), j.at(2)); }

json of(const Reaction& r) { return {of(r.impulse), of(r.angular), r.radial}; }
Reaction reaction(const json& j) { return {vector(j.at(0)), vector(j.at(1)), j.at(2)}; }

json of(const FeltAt& f) { return {of(f.felt), of(f.position)}; }
FeltAt felt_at(const json& j) { return {reaction(j.at(0)), vector(j.at(1))}; }

json of(const Peak& peak) {
  return {{"value", peak.value}, {"element", peak.element}, {"position", of(peak.position)}, {"time", peak.time}};
}
Peak peak(const json& j) { return {j.at("value"), j.at("element"), vector(j.at("position")), j.at("time")}; }

json of(const StageRecord& stage) {
  return {{"name", stage.name},       {"kind", stage.kind},       {"end_time", stage.end_time},
          {"kinetic", stage.kinetic}, {"elastic", stage.elastic}, {"plastic", stage.plastic},
          {"kinetic_over_internal_peak", std::isfinite(stage.kinetic_over_internal_peak) ? json(stage.kinetic_over_internal_peak) : json(nullptr)}};
}
StageRecord stage(const json& j) {
  StageRecord stage{j.at("name"), j.at("kind"), j.at("end_time"), j.at("kinetic"), j.at("elastic"), j.at("plastic")};
  if (!j.at("kinetic_over_internal_peak").is_null()) stage.kinetic_over_internal_peak = j.at("kinetic_over_internal_peak");
  return stage;
}

json of(const std::optional<double>& value) { return value ? json(*value) : json(nullptr); }
std::optional<double> number(const json& j) {
  return j.is_null() ? std::nullopt : std::optional<double>(j.get<double>());
}

}  // namespace

namespace {
int level_of(double internal) { return static_cast<int>(std::floor(std::log(internal) / std::log(1.01))); }
}  // namespace

void KineticPeak::look(double kinetic, double internal) {
  if (!(internal > 0) || !std::isfinite(internal) || !std::isfinite(kinetic / internal)) return;
  double& most = levels[level_of(internal)];
  most = std::max(most, kinetic / internal);
}

double KineticPeak::at_end(double internal, double least) const {
  double most = std::numeric_limits<double>::quiet_NaN();
  if (!(internal > 0) || !std::isfinite(internal)) return most;
  for (auto level = levels.lower_bound(level_of(least * internal)); level != levels.end(); ++level) most = std::fmax(most, level->second);
  return most;
}

double StageRecord::kinetic_over_internal() const {
  const double internal = elastic + plastic;
  return internal > 0 ? kinetic / internal : std::numeric_limits<double>::quiet_NaN();
}

std::string RunRecord::to_json() const {
  json j = {{"thickness_initial", of(thickness_initial)},
            {"thickness_min", of(thickness_min)},
            {"surface_strain", of(surface_strain)},
            {"thinning", of(thinning)},
            {"pressed", of(pressed)},
            {"pressed_cells", of(pressed_cells)},
            {"spanned", {{"peak", of(spanned.peak)}, {"tool", spanned.tool}, {"length", spanned.length}, {"share", spanned.share}}},
            {"surface_strain_formed", surface_strain_formed ? of(*surface_strain_formed) : json(nullptr)},
            {"angle_formed_deg", of(angle_formed_deg)},
            {"kinetic_over_internal_formed", of(kinetic_over_internal_formed)},
            {"kinetic_over_internal_forming", of(kinetic_over_internal_forming)},
            {"kinetic_peak", json::array()},
            {"stages", json::array()},
            {"limit_ratio", json::array()},
            {"notes", notes},
            {"history_time", history_time},
            {"history_tools", json::array()},
            {"history_reactions", json::array()}};
  for (const auto& [level, most] : kinetic_peak.levels) j["kinetic_peak"].push_back({level, most});
  for (const Peak& ratio : limit_ratio) j["limit_ratio"].push_back(of(ratio));
  for (const StageRecord& s : stages) j["stages"].push_back(of(s));
  for (const FeltAt& tool : history_tools) j["history_tools"].push_back(of(tool));
  for (const FeltAt& reaction : history_reactions) j["history_reactions"].push_back(of(reaction));
  return j.dump();
}

RunRecord RunRecord::from_json(const std::string& text) {
  try {
    const json j = json::parse(text);
    RunRecord record;
    record.thickness_initial = number(j.at("thickness_initial"));
    record.thickness_min = number(j.at("thickness_min"));
    record.surface_strain = peak(j.at("surface_strain"));
    record.thinning = peak(j.at("thinning"));
    record.pressed = peak(j.at("pressed"));
    record.pressed_cells = peak(j.at("pressed_cells"));
    record.spanned = {peak(j.at("spanned").at("peak")), j.at("spanned").at("tool"), j.at("spanned").at("length"), j.at("spanned").at("share")};
    if (!j.at("surface_strain_formed").is_null()) record.surface_strain_formed = peak(j.at("surface_strain_formed"));
    record.angle_formed_deg = number(j.at("angle_formed_deg"));
    record.kinetic_over_internal_formed = number(j.at("kinetic_over_internal_formed"));
    record.kinetic_over_internal_forming = number(j.at("kinetic_over_internal_forming"));
    for (const json& level : j.at("kinetic_peak")) record.kinetic_peak.levels[level.at(0)] = level.at(1);
    for (const json& ratio : j.at("limit_ratio")) record.limit_ratio.push_back(peak(ratio));
    for (const json& s : j.at("stages")) record.stages.push_back(stage(s));
    record.notes = j.at("notes").get<std::vector<std::string>>();
    record.history_time = j.at("history_time");
    for (const json& tool : j.at("history_tools")) record.history_tools.push_back(felt_at(tool));
    for (const json& held : j.at("history_reactions")) record.history_reactions.push_back(felt_at(held));
    return record;
  } catch (const json::exception& error) {
    throw Error(Code::resume_error, std::string("the checkpoint's record of the run cannot be read: ") + error.what());
  }
}

}  // namespace forming_sim
