#include "forming_sim/scene/build.h"

#include <algorithm>
#include <map>

#include "geometry.h"

namespace forming_sim {

Model build_model(const Scene& scene) {
  Geometry geometry = make_geometry(scene, {});
  if (!geometry.faults.empty()) throw SceneError(geometry.faults);
  return std::move(geometry.model);
}

namespace {

/// Every stage by its own name: unnamed ones take their kind, "form", then "form 2".
void name_stages(std::vector<StageConfig>& stages) {
  std::map<std::string, int> count;
  for (const StageConfig& stage : stages) {
    if (!stage.name.empty()) count[stage.name] = 1;
  }
  for (StageConfig& stage : stages) {
    if (!stage.name.empty()) continue;
    const int number = ++count[stage.kind];
    stage.name = number == 1 ? stage.kind : stage.kind + "_" + std::to_string(number);
  }
}

/// A withdrawal without a list takes all tools that are left.
void list_withdrawn_tools(const std::vector<ToolConfig>& tools, std::vector<StageConfig>& stages) {
  std::vector<std::string> left;
  for (const ToolConfig& tool : tools) left.push_back(tool.name);
  for (StageConfig& stage : stages) {
    if (stage.kind != "withdraw") continue;
    if (stage.tools.empty()) stage.tools = left;
    for (const std::string& tool : stage.tools) left.erase(std::remove(left.begin(), left.end(), tool), left.end());
  }
}

}  // namespace

RunPlan build_plan(const Scene& scene) {
  RunPlan plan;
  for (const BodyConfig& body : scene.bodies) {
    plan.bodies.push_back({body.initial_velocity, body.initial_spin_deg_s, body.spin_centre, body.initial_velocity_field, body.boundaries, body.pressures, body.loads});
  }
  plan.gravity = scene.gravity;
  plan.contact = scene.contact;
  plan.time_step = scene.time_step;
  plan.stages = scene.stages;
  name_stages(plan.stages);
  list_withdrawn_tools(scene.tools, plan.stages);
  return plan;
}

}  // namespace forming_sim
