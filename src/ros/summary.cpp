#include "forming_sim/ros/summary.h"

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "forming_sim/config/fault.h"
#include "forming_sim/results/summary.h"
#include "forming_sim/ros/prepare.h"
#include "forming_sim/tensor/vec.h"
#include "geometry.h"

namespace forming_sim {
namespace {

using nlohmann::json;

/// The number at a path such as /energy_J/kinetic; NaN where there is none.
double number(const json& root, const char* path) {
  const json::json_pointer pointer(path);
  if (!root.contains(pointer) || !root[pointer].is_number()) return std::numeric_limits<double>::quiet_NaN();
  return root[pointer].get<double>();
}

long count(const json& root, const char* path) {
  const json::json_pointer pointer(path);
  return root.contains(pointer) && root[pointer].is_number() ? root[pointer].get<long>() : 0;
}

EnergyLedger ledger(const json& root) {
  EnergyLedger message;
  message.kinetic = number(root, "/energy_J/kinetic");
  message.elastic = number(root, "/energy_J/elastic");
  message.plastic = number(root, "/energy_J/plastic");
  message.contact = number(root, "/energy_J/contact");
  message.friction = number(root, "/energy_J/friction");
  message.damping = number(root, "/energy_J/damping");
  message.work = number(root, "/energy_J/work");
  message.initial = number(root, "/energy_J/initial");
  message.balance_error = number(root, "/energy_J/balance_error");
  return message;
}

}  // namespace

RunSummary read_summary(const std::string& directory) {
  RunSummary summary;
  summary.json = read_summary_text(directory);
  const json root = json::parse(summary.json);
  summary.scene = root.value("scene", "");
  summary.dimension = static_cast<int>(count(root, "/dimension"));
  summary.axisymmetric = root.value("axisymmetric", false);
  summary.nodes = count(root, "/nodes");
  summary.cells = count(root, "/cells");
  summary.elements = count(root, "/elements");
  summary.steps = count(root, "/steps");
  summary.sim_time_s = number(root, "/sim_time_s");
  summary.wall_time_s = number(root, "/wall_time_s");
  summary.ns_per_element_step = number(root, "/ns_per_element_step");
  summary.energies = ledger(root);
  summary.crossings = count(root, "/contact/crossings");
  summary.halvings = count(root, "/contact/halvings");
  summary.min_gap_over_layer = number(root, "/contact/min_gap_over_h0");
  summary.max_plastic_strain = number(root, "/plastic_strain/max");
  summary.max_surface_strain = number(root, "/surface_strain/max");
  summary.initial_thickness_m = number(root, "/thickness_m/initial");
  summary.min_thickness_m = number(root, "/thickness_m/min");
  summary.max_thinning = number(root, "/thinning/max");
  summary.angle_formed_deg = number(root, "/springback/angle_deg_formed");
  summary.angle_released_deg = number(root, "/springback/angle_deg_released");
  summary.springback_deg = number(root, "/springback/change_deg");
  for (const json& tool : root.value("tools", json::array())) {
    ToolState state;
    state.name = tool.value("name", "");
    state.peak_force = vector_message(Vec3(number(tool, "/peak_force/0"), number(tool, "/peak_force/1"), number(tool, "/peak_force/2")));
    if (const auto moment = tool.find("peak_moment"); moment != tool.end() && moment->is_array())
      state.peak_moment = vector_message(Vec3(number(tool, "/peak_moment/0"), number(tool, "/peak_moment/1"), number(tool, "/peak_moment/2")));
    state.turned_deg = number(tool, "/turned_deg");
    if (const auto radial = tool.find("peak_radial_force"); radial != tool.end() && radial->is_number()) state.peak_radial_force = *radial;
    state.pose.position = point_message(Vec3(number(tool, "/position/0"), number(tool, "/position/1"), number(tool, "/position/2")));
    state.pose.orientation.x = number(tool, "/orientation_xyzw/0");
    state.pose.orientation.y = number(tool, "/orientation_xyzw/1");
    state.pose.orientation.z = number(tool, "/orientation_xyzw/2");
    state.pose.orientation.w = number(tool, "/orientation_xyzw/3");
    state.present = tool.value("present", false);
    state.stopped_s = number(tool, "/stopped_s");
    summary.tools.push_back(state);
  }
  for (const json& damage : root.value("damage", json::array())) {
    BodyDamage of;
    of.body = damage.value("body", "");
    of.criterion = damage.value("criterion", "");
    of.max = number(damage, "/max");
    of.position = point_message(Vec3(number(damage, "/where/position/0"), number(damage, "/where/position/1"), number(damage, "/where/position/2")));
    of.critical = damage.at("critical").is_number() ? damage.at("critical").get<double>() : 0;
    summary.damage.push_back(of);
  }
  for (const json& limit : root.value("forming_limit", json::array())) {
    BodyFormingLimit of;
    of.body = limit.value("body", "");
    of.max = number(limit, "/max");
    of.position = point_message(Vec3(number(limit, "/where/position/0"), number(limit, "/where/position/1"), number(limit, "/where/position/2")));
    of.beyond = number(limit, "/beyond");
    summary.forming_limit.push_back(of);
  }
  summary.kinetic_over_internal_forming = number(root, "/energy_J/kinetic_over_internal_forming");
  summary.warnings = root.value("warnings", std::vector<std::string>());
  return summary;
}

std::vector<std::string> run_files(const std::string& directory, bool formed) {
  std::vector<std::string> files;
  for (const std::string name : {"result.h5", "result.xdmf", "surface.xdmf", "history.csv", "summary.json", "checkpoint.h5", "formed.h5"}) {
    if (name == "formed.h5" && !formed) continue;  // that of another run
    if (is_readable_file(directory + "/" + name)) files.push_back(name);
  }
  return files;
}

}  // namespace forming_sim
