#include "forming_sim/scene/build.h"

#include <algorithm>
#include <utility>

#include "forming_sim/simulation/release.h"
#include "geometry.h"

namespace forming_sim {

Model build_model(const Scene& scene) {
  Geometry geometry = make_geometry(scene, {});
  if (!geometry.faults.empty()) throw SceneError(geometry.faults);
  return std::move(geometry.model);
}

namespace {

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
  plan.stages = named(scene.stages);
  for (const BodyConfig& body : scene.bodies) {
    plan.bodies.push_back({body.initial_velocity, body.initial_spin_deg_s, body.spin_centre, body.initial_velocity_field, body.boundaries, body.pressures, body.loads});
    for (BoundaryConfig& boundary : plan.bodies.back().boundaries)
      if (first_stage(boundary.since, plan.stages) == 0) boundary.since.clear();
  }
  plan.gravity = scene.gravity;
  plan.contact = scene.contact;
  for (PairConfig& pair : plan.contact.pairs)  // a body is the first
    if (std::none_of(scene.bodies.begin(), scene.bodies.end(), [&](const BodyConfig& body) { return body.name == pair.first; })) std::swap(pair.first, pair.second);
  plan.time_step = scene.time_step;
  list_withdrawn_tools(scene.tools, plan.stages);
  return plan;
}

}  // namespace forming_sim
