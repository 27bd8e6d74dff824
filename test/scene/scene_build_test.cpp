// The model of a scene, and what only meshes can tell.
#include "forming_sim/scene/build.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <unistd.h>

#include "forming_sim/mesh/measure.h"
#include "forming_sim/scene/validate.h"
#include "scene/plate_scene.h"
#include "scene/scene_texts.h"

namespace forming_sim {
namespace {

namespace fs = std::filesystem;

void expect_geometry_fault(const Scene& scene, const std::string& field, const std::string& word) {
  const std::vector<Fault> faults = validate(scene);
  ASSERT_EQ(faults.size(), 1u) << sentences(faults);
  EXPECT_EQ(faults.front().field, field) << faults.front().sentence();
  EXPECT_NE(faults.front().sentence().find(word), std::string::npos) << faults.front().sentence();
  EXPECT_THROW(build_model(scene), SceneError);
}

TEST(SceneBuild, ModelOfTheFlange) {
  const Model model = build_model(scene_of(flange_example()));
  EXPECT_EQ(model.dimension, 2);
  ASSERT_EQ(model.bodies.size(), 1u);
  EXPECT_EQ(model.bodies[0].element_count, 160 * 4 * 4);
  EXPECT_EQ(model.bodies[0].node_count, 161 * 5 + 160 * 4);
  EXPECT_EQ(model.bodies[0].mesh.sets.at("left").size(), 5u);
  const auto& leg = model.bodies[0].mesh.sets.at("leg");
  ASSERT_FALSE(leg.empty());
  for (const int n : leg) EXPECT_GE(model.bodies[0].mesh.nodes[static_cast<std::size_t>(n)].x(), 0.005 - 1e-7);
  ASSERT_EQ(model.tools.size(), 3u);
  for (const ToolModel& tool : model.tools) EXPECT_FALSE(tool.is_plane());
  EXPECT_TRUE(model.tools[2].motion);
  EXPECT_EQ(model.tools[0].friction, 0.1348);
}

// A roll that is large beside the cells of the sheet is as round as they can feel.
TEST(SceneBuild, ARollIsAsFineAsTheCellsThatMeetIt) {
  const std::string text = flange_example();
  const double edge = (2 * .04 + 2 * .93e-3) / (2 * 160 + 2 * 4);  // mean, of the surface of the sheet
  const auto longest_side = [](const ToolModel& tool) {
    double longest = 0;
    for (const Facet& side : tool.mesh.surface) longest = std::max(longest, (tool.mesh.nodes[static_cast<std::size_t>(side.nodes[1])] - tool.mesh.nodes[static_cast<std::size_t>(side.nodes[0])]).norm());
    return longest;
  };
  Scene scene = scene_of(text);
  ProfileConfig roll;
  roll.start = Vec3(0.2, 0, 0);
  roll.pieces.resize(2);
  roll.pieces[0] = {Vec3(-0.2, 0, 0), 0.2};
  roll.pieces[1] = {Vec3(0.2, 0, 0), 0.2};
  scene.tools[0].profile = roll;
  EXPECT_LE(longest_side(build_model(scene).tools[0]), 2 * edge);
  scene.tools[0].profile->chord_error = 1e-4;  // as it is said
  EXPECT_GT(longest_side(build_model(scene).tools[0]), 0.01);
}

TEST(SceneBuild, ASweptSectionIsAsFineAsTheCellsThatMeetIt) {
  Scene scene = plate_scene();
  scene.tools[0].mesh.reset();
  ProfileConfig ball;
  ball.start = Vec3(0, 0, -1);
  ball.pieces = {{Vec3(0, 0, 1), 1}};
  ball.sweep = "turned";
  scene.tools[0].profile = ball;
  scene.tools[0].position = Vec3(0, 0, 2);
  EXPECT_TRUE(validate(scene).empty()) << sentences(validate(scene));
  const Model model = build_model(scene);
  double cells = 0;
  for (const Facet& facet : model.bodies[0].mesh.surface) cells += area_vector(model.bodies[0].mesh, facet).norm();
  const double edge = std::sqrt(2 * cells / static_cast<double>(model.bodies[0].mesh.surface.size()));
  const Mesh& mesh = model.tools[0].mesh;
  for (const Facet& facet : mesh.surface)
    EXPECT_LE(std::sqrt(2 * area_vector(mesh, facet).norm()), 2 * edge);
  EXPECT_GT(static_cast<double>(mesh.surface.size()), 4 * M_PI / (2 * edge * edge));
}

TEST(SceneBuild, BodiesAreNumberedOneAfterTheOther) {
  Scene scene = plate_scene();
  scene.bodies.push_back(scene.bodies[0]);
  scene.bodies[1].name = "other";
  scene.bodies[1].blank->cells_along = 3;
  scene.tools[0].mesh.reset();
  scene.tools[0].normal = Vec3(0, 0, 5);
  EXPECT_TRUE(validate(scene).empty()) << sentences(validate(scene));
  const Model model = build_model(scene);
  EXPECT_EQ(model.bodies[0].element_count, 4 * 4 * 6);
  EXPECT_EQ(model.bodies[1].first_node, model.bodies[0].node_count);
  EXPECT_EQ(model.bodies[1].first_element, model.bodies[0].element_count);
  EXPECT_EQ(model.node_count(), 5 * 5 * 2 + 4 * 5 * 2);
  EXPECT_TRUE(model.tools[0].is_plane());
  EXPECT_EQ(model.tools[0].normal, Vec3(0, 0, 1));
}

TEST(SceneBuild, PlanNamesStagesAndListsWithdrawnTools) {
  Scene scene = scene_of(flange_example());
  scene.stages[0].name.clear();
  scene.stages.insert(scene.stages.begin() + 1, scene.stages[0]);
  scene.stages[2].tools = {"punch"};
  scene.stages.insert(scene.stages.begin() + 3, scene.stages[2]);
  scene.stages[3].name.clear();
  scene.stages[3].tools.clear();
  const RunPlan plan = build_plan(scene);
  ASSERT_EQ(plan.stages.size(), 5u);
  EXPECT_EQ(plan.stages[0].name, "form");
  EXPECT_EQ(plan.stages[1].name, "form_2");
  EXPECT_EQ(plan.stages[3].name, "withdraw");
  EXPECT_EQ(plan.stages[3].tools, (std::vector<std::string>{"die", "holder"}));
  ASSERT_EQ(plan.bodies.size(), 1u);
  EXPECT_EQ(plan.bodies[0].boundaries[0].set, "left");
}

TEST(SceneBuild, WrongUnitScaleNamesTheRightOne) {
  Scene scene = plate_scene();
  EXPECT_TRUE(validate(scene).empty()) << sentences(validate(scene));
  scene.tools[0].mesh->unit_scale = 10;
  expect_geometry_fault(scene, "tools[0].mesh.unit_scale", "with unit_scale 0.01 it would be 0.2 m");
  scene.tools[0].mesh->unit_scale = 2;  // 40 m to a plate of 0.02 m
  expect_geometry_fault(scene, "tools[0].mesh.unit_scale", "200 times larger");
  scene.tools[0].mesh->unit_scale = 0.1;  // 2 m
  EXPECT_TRUE(validate(scene).empty());
  const std::vector<std::string> notes = build_model(scene).notes;
  ASSERT_EQ(notes.size(), 2u);  // the other: the tool is open
  EXPECT_NE(notes[1].find("tool die measures 2 m, the bodies 0.02 m: with unit_scale 0.0001 it would be 0.002 m"), std::string::npos) << notes[1];
  scene.tools[0].mesh->unit_scale = 5e-7;  // 10 micrometres
  expect_geometry_fault(scene, "tools[0].mesh.unit_scale", "with unit_scale 0.0005 it would be 0.01 m");
  scene.tools[0].mesh->unit_scale = 1e-9;
  expect_geometry_fault(scene, "tools[0].mesh.unit_scale", "sizes from 1e-6 m");
  scene = plate_scene();
  scene.bodies[0].blank->length = 2000;
  expect_geometry_fault(scene, "bodies[0].blank", "2000 m");
}

TEST(SceneBuild, SetsThatChooseNothing) {
  Scene scene = plate_scene();
  SetConfig set;
  set.name = "high";
  set.choose = "plane";
  set.normal = Vec3(0, 0, 1);
  set.point = Vec3(0, 0, 0.5);
  scene.bodies[0].sets = {set};
  expect_geometry_fault(scene, "bodies[0].sets[0]", "from [0, 0, 0] to [0.02, 0.02, 0.001] m");
  scene.bodies[0].sets[0].point.z() = 0.001;
  EXPECT_TRUE(validate(scene).empty()) << sentences(validate(scene));
  EXPECT_EQ(build_model(scene).bodies[0].mesh.sets.at("high").size(), 25u);
}

TEST(SceneBuild, PressureNeedsAFace) {
  Scene scene = plate_scene();
  SetConfig edge;
  edge.name = "corner";
  edge.choose = "box";
  edge.min = Vec3(-1, -1, -1);
  edge.max = Vec3(1e-4, 1e-4, 1e-4);
  scene.bodies[0].sets = {edge};
  scene.bodies[0].pressures = {{"corner", {0}, {1e6}, "linear", ""}};
  expect_geometry_fault(scene, "bodies[0].pressures[0].set", "surface face");
  scene.bodies[0].pressures[0].set = "top";
  EXPECT_TRUE(validate(scene).empty());
}

TEST(SceneBuild, VelocitiesAreNumbersEverywhere) {
  Scene scene = plate_scene();
  scene.bodies[0].initial_velocity_field = {"0", "0", "1/(x - 0.01)"};
  expect_geometry_fault(scene, "bodies[0].initial_velocity_field", "'1/(x - 0.01)' is inf at (0.01, 0, 0) m");
}

TEST(SceneBuild, FlatCellsAndMissingFiles) {
  Scene scene = plate_scene();
  scene.bodies[0].blank.reset();
  MeshConfig mesh;
  mesh.unit_scale = 0.01;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.cells = {0, 1, 2, 3};
  mesh.cell_type = "tetrahedron";
  scene.bodies[0].mesh = mesh;
  expect_geometry_fault(scene, "bodies[0].mesh", "volume");
  EXPECT_EQ(validate(scene).front().code, Code::mesh_error);

  scene = plate_scene();
  scene.tools[0].mesh = MeshConfig{};
  scene.tools[0].mesh->unit_scale = 0.001;
  scene.tools[0].mesh->url = "no_such_die.stl";
  expect_geometry_fault(scene, "tools[0].mesh.url", "no_such_die.stl");
}

TEST(SceneBuild, SetsOfAFileAreKnownOnceItIsRead) {
  const fs::path directory = fs::temp_directory_path() / ("scene_build_test_" + std::to_string(getpid()));
  fs::create_directories(directory);
  std::ofstream(directory / "one.msh") << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"base\"\n3 2 \"block\"\n$EndPhysicalNames\n"
                                          "$Nodes\n4\n1 0 0 0\n2 10 0 0\n3 0 10 0\n4 0 0 10\n$EndNodes\n"
                                          "$Elements\n2\n1 2 2 1 1 1 2 3\n2 4 2 2 1 1 2 3 4\n$EndElements\n";
  Scene scene = plate_scene();
  scene.base_directory = directory.string();
  scene.bodies[0].blank.reset();
  scene.bodies[0].mesh = MeshConfig{};
  scene.bodies[0].mesh->url = "one.msh";
  scene.bodies[0].mesh->unit_scale = 0.001;
  BoundaryConfig boundary;
  boundary.set = "base";
  boundary.kind = "fixed";
  scene.bodies[0].boundaries = {boundary};
  EXPECT_TRUE(validate(scene).empty()) << sentences(validate(scene));
  scene.bodies[0].boundaries[0].set = "bass";
  expect_geometry_fault(scene, "bodies[0].boundaries[0].set", "block");
  EXPECT_NE(validate(scene).front().remedy.find("did you mean base?"), std::string::npos);
  scene.bodies[0].boundaries[0].set = "base";
  ProbeConfig probe;
  probe.name = "p";
  probe.set = "crown";
  scene.output.probes = {probe};
  expect_geometry_fault(scene, "output.probes[0].set", "'crown'");
  scene.output.probes.clear();
  std::ofstream(directory / "scene.yaml") << write_scene(scene);
  EXPECT_EQ(build_model(read_valid_scene((directory / "scene.yaml").string())).element_count(), 1);
  fs::remove_all(directory);
}

TEST(SceneBuild, FaultsOfReadingAndOfMeshesAreToldTogether) {
  const std::string text = replaced(replaced(flange_example(), "density: 2710", "density: -1"), "min: [0.005, -1]", "min: [0.5, -1]");
  std::vector<Fault> faults;
  const Scene scene = read_scene(text, ".", faults);
  ASSERT_EQ(faults.size(), 1u) << sentences(faults);
  faults = validate(scene, faults);
  EXPECT_EQ(faults.size(), 2u) << sentences(faults);
  EXPECT_TRUE(fault_at(faults, "bodies[0].sets[0]"));
  EXPECT_NE(faults.front().given.find("(line "), std::string::npos);
}

}  // namespace
}  // namespace forming_sim
