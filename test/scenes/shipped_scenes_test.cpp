// The scenes that come with the package: valid, nothing misspelt, and the blank
// where its tools expect it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "forming_sim/loads/motion.h"
#include "forming_sim/scene/build.h"
#include "forming_sim/scene/validate.h"
#include "forming_sim/scene/yaml.h"
#include "forming_sim/simulation/release.h"
#include "forming_sim/simulation/simulation.h"

namespace forming_sim {
namespace {

const std::string kFolder = std::string(FORMING_SIM_SOURCE_DIR) + "/scenes/";

std::vector<std::string> shipped() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

class ShippedScene : public ::testing::TestWithParam<std::string> {};

TEST_P(ShippedScene, is_valid) {
  std::vector<Fault> faults;
  const Scene scene = read_scene_file(kFolder + GetParam() + ".yaml", faults);
  for (const Fault& fault : validate(scene, faults)) ADD_FAILURE() << fault.sentence();
  EXPECT_EQ(scene.name, GetParam());
}

TEST_P(ShippedScene, does_its_first_step_without_a_crossing) {
  const Scene scene = read_valid_scene(kFolder + GetParam() + ".yaml");
  Simulation simulation(build_plan(scene), build_model(scene), 1);
  EXPECT_TRUE(simulation.step());
  EXPECT_EQ(simulation.contact_status().crossings, 0);
}

/// By a motion that is known before: not at rest, not driven by a force.
bool is_moved(const ToolModel& tool) { return tool.motion && tool.motion->kind != "force"; }

TEST_P(ShippedScene, starts_with_its_tools_at_rest_in_their_places) {
  const Scene scene = read_valid_scene(kFolder + GetParam() + ".yaml");
  const Model model = build_model(scene);
  ASSERT_GT(model.element_count(), 0);
  for (const ToolModel& tool : model.tools) {
    const RigidMotion motion = is_moved(tool) ? RigidMotion(*tool.motion, model.dimension) : RigidMotion();
    const ToolPose pose = tool_pose(tool, motion.at(0));
    EXPECT_LT((pose.position - tool.position).norm() + pose.velocity.norm(), 1e-12)
        << tool.name << " should start at rest in its place";
    if (!tool.is_plane()) continue;
    for (const BodyModel& body : model.bodies)
      for (const Vec3& node : body.mesh.nodes)
        ASSERT_GE((node - tool.point).dot(tool.normal), -1e-12)
            << body.name << " starts behind " << tool.name;
  }
  // All motions are at rest whenever tools are withdrawn or the bodies settle.
  double time = 0;
  for (const StageConfig& stage : scene.stages) {
    if (stage.kind != "form")
      for (const ToolModel& tool : model.tools)
        if (is_moved(tool)) {
          const RigidMotion motion = RigidMotion(*tool.motion, model.dimension).beginning(latest_begin(tool.motion->since, named(scene.stages)));
          EXPECT_LT(motion.at(time).velocity.norm(), 1e-9)
              << tool.name << " at the start of " << stage.name;
        }
    if (stage.kind == "settle") break;  // it ends when the body rests, not at a time that is known
    time += stage.duration;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ShippedScene, ::testing::ValuesIn(shipped()),
                         [](const auto& info) { return info.param; });

TEST(ShippedScenes, none_is_missing) {
  EXPECT_EQ(shipped(), (std::vector<std::string>{"cup", "cup_3d", "cup_ears", "draw_bend", "drop_hammer", "flange", "flange_3d", "flange_3d_one_point", "folded_rubber", "hem", "hem_curved", "hem_flat", "impact", "rolling", "strip_draw", "taylor_bar", "taylor_bar_axisymmetric", "tension", "two_blocks"}));
}

TEST(ShippedScenes, flange_section_fits_the_sheet) {
  const Model model = build_model(read_valid_scene(kFolder + "flange.yaml"));
  std::map<std::string, const ToolModel*> tools;
  for (const ToolModel& tool : model.tools) tools[tool.name] = &tool;
  // The sheet lies between die (top at y = 0) and pad (bottom at y = 0.93 mm), punch above it.
  double die_top = -1, pad_bottom = 1, punch_bottom = 1, punch_face = 1, die_wall = -1;
  for (const Vec3& p : tools.at("die")->mesh.nodes)
    die_top = std::max(die_top, p.y()), die_wall = std::max(die_wall, p.x());
  for (const Vec3& p : tools.at("pad")->mesh.nodes) pad_bottom = std::min(pad_bottom, p.y());
  for (const Vec3& p : tools.at("punch")->mesh.nodes)
    punch_bottom = std::min(punch_bottom, p.y()), punch_face = std::min(punch_face, p.x());
  EXPECT_NEAR(die_top, 0, 1e-15);
  EXPECT_NEAR(pad_bottom, 0.93e-3, 1e-15);
  EXPECT_NEAR(punch_bottom, 0.93e-3, 1e-15);
  EXPECT_NEAR(punch_face - die_wall, 1.03e-3, 1e-12);
  // Every corner of an edge lies on its arc of 1 mm, none inside the material's wrap.
  for (const Vec3& p : tools.at("die")->mesh.nodes)
    if (p.x() > 9e-3 && p.y() > -1e-3) {
      EXPECT_NEAR((p - Vec3(9e-3, -1e-3, 0)).norm(), 1e-3, 2e-6);
    }
  for (const Vec3& p : tools.at("punch")->mesh.nodes)
    if (p.x() < 12.03e-3 && p.y() < 1.93e-3) {
      EXPECT_NEAR((p - Vec3(12.03e-3, 1.93e-3, 0)).norm(), 1e-3, 2e-6);
    }
}

TEST(ShippedScenes, cup_is_closed_by_its_punch_and_clears_its_die) {
  const Model model = build_model(read_valid_scene(kFolder + "cup.yaml"));
  ASSERT_TRUE(model.axisymmetric);
  std::map<std::string, const ToolModel*> tools;
  for (const ToolModel& tool : model.tools) tools[tool.name] = &tool;
  double die_wall = 1, punch_wall = 0, punch_axis = 1, holder = 1;
  for (const Vec3& p : tools.at("die")->mesh.nodes) die_wall = std::min(die_wall, p.x());
  for (const Vec3& p : tools.at("punch")->mesh.nodes) punch_wall = std::max(punch_wall, p.x()), punch_axis = std::min(punch_axis, p.x());
  for (const Vec3& p : tools.at("holder")->mesh.nodes) holder = std::min(holder, p.y());
  EXPECT_EQ(punch_axis, 0);
  EXPECT_NEAR(die_wall - punch_wall, 1.3e-3, 1e-12);
  EXPECT_NEAR(holder, 1e-3, 1e-12);
  EXPECT_TRUE(model.notes.empty());
}

TEST(ShippedScenes, impact_has_the_moduli_it_states) {
  const Scene scene = read_valid_scene(kFolder + "impact.yaml");
  EXPECT_NEAR(scene.bodies[0].material.mu(), 26.5e9, 1e3);
  EXPECT_NEAR(scene.bodies[0].material.K(), 65.1e9, 1e4);
}

}  // namespace
}  // namespace forming_sim
