// The model of a scene, and what only meshes can tell.
#include "forming_sim/scene/build.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <unistd.h>

#include "forming_sim/mesh/measure.h"
#include "forming_sim/scene/validate.h"
#include "scene/scene_texts.h"
#include "support/free_mesh.h"

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

/// A scene in 3D: a small plate, and a tool of two triangles.
Scene plate_scene() {
  Scene scene;
  scene.name = "plate";
  scene.dimension = 3;
  BodyConfig body;
  body.name = "plate";
  body.blank = BlankConfig{};
  body.blank->shape = "plate";
  body.blank->length = body.blank->width = 0.02;
  body.blank->thickness = 0.001;
  body.blank->cells_along = body.blank->cells_across = 4;
  body.blank->cells_through = 1;
  body.blank->pattern = "one_point";
  body.material.density = 2700;
  body.material.youngs_modulus = 70e9;
  body.material.poissons_ratio = 0.3;
  scene.bodies.push_back(body);
  ToolConfig tool;
  tool.name = "die";
  tool.mesh = MeshConfig{};
  tool.mesh->unit_scale = 0.001;
  tool.mesh->points = {{0, 0, -10}, {20, 0, -10}, {20, 20, -10}, {0, 20, -10}};
  tool.mesh->cells = {0, 1, 2, 0, 2, 3};
  tool.mesh->cell_type = "triangle";
  scene.tools.push_back(tool);
  StageConfig stage;
  stage.kind = "form";
  stage.duration = 1e-3;
  scene.stages = {stage};
  return scene;
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
  scene.bodies[0].pressures = {{"corner", {0}, {1e6}}};
  expect_geometry_fault(scene, "bodies[0].pressures[0].set", "surface face");
  scene.bodies[0].pressures[0].set = "top";
  EXPECT_TRUE(validate(scene).empty());
}

TEST(SceneBuild, VelocitiesAreNumbersEverywhere) {
  Scene scene = plate_scene();
  scene.bodies[0].initial_velocity_field = {"0", "0", "1/(x - 0.01)"};
  expect_geometry_fault(scene, "bodies[0].initial_velocity_field", "'1/(x - 0.01)' is inf at (0.01, 0, 0) m");
}

TEST(SceneBuild, InvertedCellsAndMissingFiles) {
  Scene scene = plate_scene();
  scene.bodies[0].blank.reset();
  MeshConfig mesh;
  mesh.unit_scale = 0.01;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.cells = {0, 2, 1, 3};
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

// What a body without self contact does where it has more parts than one is told.
TEST(SceneBuild, FlatCellsOfTetrahedraAreTold) {
  Scene scene = plate_scene();  // cells of 5 x 5 x 1 mm
  scene.tools.clear();
  for (const char* pattern : {"fine", "coarse", "one_point"}) {
    scene.bodies[0].blank->pattern = pattern;
    const std::vector<std::string> notes = build_model(scene).notes;
    ASSERT_EQ(notes.size(), pattern == std::string("one_point") ? 0u : 1u) << pattern;
    for (const std::string& note : notes) EXPECT_NE(note.find("body plate are 5 times as long and as wide as they are thick"), std::string::npos) << note;
  }
  scene.bodies[0].blank->pattern = "fine";
  scene.bodies[0].blank->cells_along = 20;  // as thick as long: it bends along x
  EXPECT_TRUE(build_model(scene).notes.empty());
}

TEST(SceneBuild, SheetsWithOneFreeTetrahedronThroughTheirThicknessAreTold) {
  Scene scene = plate_scene();
  scene.tools.clear();
  scene.bodies[0].blank.reset();
  const auto told = [&](const Vec3& size, double edge) {
    scene.bodies[0].mesh = inline_mesh(free_box(size, edge));
    const std::vector<std::string> notes = build_model(scene).notes;
    return std::any_of(notes.begin(), notes.end(), [](const std::string& note) { return note.find("the tetrahedra of body plate have edges") != std::string::npos; });
  };
  EXPECT_TRUE(told(Vec3(12e-3, 6e-3, 1e-3), 1e-3));
  EXPECT_FALSE(told(Vec3(12e-3, 6e-3, 1e-3), 0.5e-3));
  EXPECT_FALSE(told(Vec3(12e-3, 1e-3, 1e-3), 0.5e-3)) << "a bar";
  EXPECT_FALSE(told(Vec3(3e-3, 3e-3, 3e-3), 2e-3)) << "a block";
}

// A polygon of n sides with its corners on the circle has less area by 1 - n sin(2 pi/n)/(2 pi): 2.6 % at 16.
TEST(SceneBuild, PolygonalBarsAreTold) {
  Scene scene = plate_scene();
  scene.tools.clear();
  BlankConfig& blank = *scene.bodies[0].blank;
  blank.shape = "bar";
  blank.radius = 3e-3, blank.length = 0.02;
  blank.cells_along = 4;
  const auto told = [&](int cells, const char* portion) {
    blank.cells_radius = cells, blank.portion = portion;
    const std::vector<std::string> notes = build_model(scene).notes;
    for (const std::string& note : notes)
      if (note.find("is a polygon") != std::string::npos) return note;
    return std::string();
  };
  for (const char* portion : {"full", "half", "quarter"}) {
    EXPECT_NE(told(4, portion).find("has 2.55 % less area"), std::string::npos) << told(4, portion);
    EXPECT_EQ(told(8, portion), "") << portion;
  }
}

// Crossed triangles are too soft where a sheet's cells are higher than long, and about the axis.
TEST(SceneBuild, SoftStripsAreTold) {
  Scene scene = plate_scene();
  scene.tools.clear();
  scene.dimension = 2;
  BlankConfig& blank = *scene.bodies[0].blank;
  blank.shape = "strip";
  blank.length = 0.02, blank.thickness = 0.001;
  const auto notes = [&](int along, int through, const char* pattern, bool axisymmetric, double x) {
    blank.cells_along = along, blank.cells_through = through, blank.pattern = pattern;
    blank.origin = Vec3(x, 0, 0);
    scene.axisymmetric = axisymmetric;
    std::vector<std::string> all = build_model(scene).notes;
    all.erase(std::remove_if(all.begin(), all.end(), [](const std::string& note) { return note.find("in bending") == std::string::npos; }), all.end());
    return all;
  };
  EXPECT_TRUE(notes(20, 1, "fine", false, 0).empty());
  ASSERT_EQ(notes(80, 2, "fine", false, 0).size(), 1u);
  EXPECT_NE(notes(80, 2, "fine", false, 0)[0].find("2 times as high as they are long: it lacks some 13 % of its stiffness in bending"), std::string::npos) << notes(80, 2, "fine", false, 0)[0];
  EXPECT_TRUE(notes(80, 2, "one_point", false, 0).empty());
  EXPECT_TRUE(notes(320, 4, "fine", false, 0).empty());  // 3 %
  ASSERT_EQ(notes(40, 2, "fine", true, 0).size(), 1u);
  EXPECT_NE(notes(40, 2, "fine", true, 0)[0].find("reaches the axis"), std::string::npos);
  EXPECT_TRUE(notes(40, 2, "fine", true, 0.02).empty());
}

// Values that are taken but look like wrong units, and what lies behind the end of the stages.
TEST(SceneBuild, OddValuesAreTold) {
  const auto notes_of = [](auto&& change) {
    Scene scene = plate_scene();
    scene.bodies[0].blank->pattern = "one_point";
    HardeningConfig hardening;
    hardening.curve = "perfect";
    hardening.yield_stress = 2e8;
    scene.bodies[0].material.hardening = hardening;
    change(scene);
    std::vector<std::string> all = build_model(scene).notes;
    all.erase(std::remove_if(all.begin(), all.end(), [](const std::string& note) { return note.find("the surface is open") != std::string::npos; }), all.end());
    return all;
  };
  EXPECT_TRUE(notes_of([](Scene&) {}).empty());
  const auto told = [&](const std::string& text, auto&& change) {
    const std::vector<std::string> notes = notes_of(change);
    ASSERT_EQ(notes.size(), 1u) << text;
    EXPECT_NE(notes[0].find(text), std::string::npos) << notes[0];
  };
  told("the density of body plate is 7.85 kg/m3: steel has 7850", [](Scene& s) { s.bodies[0].material.density = 7.85; });
  told("the yield stress of body plate is 200 Pa", [](Scene& s) { s.bodies[0].material.hardening->yield_stress = 200; });
  told("the yield stress of body plate is 2e+10 Pa", [](Scene& s) { s.bodies[0].material.hardening->yield_stress = 2e10; });
  told("body plate begins with 10000 m/s, where waves in it have", [](Scene& s) { s.bodies[0].initial_velocity = Vec3(0, 0, 1e4); });
  told("time_step.mass_scaling 1000000 makes waves 1000 times as slow", [](Scene& s) { s.time_step.mass_scaling = 1e6; });
  told("output.interval is 50 s and the stages end at", [](Scene& s) { s.output.interval = 50; });
  told("probe tip is put 100 m outside body plate", [](Scene& s) {
    ProbeConfig probe;
    probe.name = "tip";
    probe.point = Vec3(100, 0, 0);
    s.output.probes.push_back(probe);
  });
  told("goes on to 1000 s and the stages end at", [](Scene& s) {
    MotionConfig motion;
    motion.kind = "velocity";
    motion.times = {0, 1000};
    motion.velocities = {Vec3::Zero(), Vec3::UnitZ()};
    s.tools[0].motion = motion;
  });
  told("tool " + plate_scene().tools[0].name + " moves with 2000 m/s, where waves in the bodies have", [](Scene& s) {
    MotionConfig motion;
    motion.kind = "trajectory";
    motion.times = {0, 1e-5};
    motion.positions = {Vec3::Zero(), Vec3(0, 0, 0.02)};
    s.tools[0].motion = motion;
  });
  const auto driven = [](double speed, double until) {
    BoundaryConfig drive;
    drive.set = "left";
    drive.kind = "velocity";
    drive.times = {0, until};
    drive.velocities = {Vec3::Zero(), Vec3(speed, 0, 0)};
    return drive;
  };
  told("set left of body plate is driven with 2000 m/s", [&](Scene& s) { s.bodies[0].boundaries.push_back(driven(2000, 1e-6)); });
  told("the motion of set left of body plate goes on to 1000 s", [&](Scene& s) { s.bodies[0].boundaries.push_back(driven(1, 1000)); });
  told("the pressure on set top of body plate goes on to 1000 s", [](Scene& s) {
    PressureConfig pressure;
    pressure.set = "top";
    pressure.times = {0, 1000};
    pressure.values = {0, 1e6};
    s.bodies[0].pressures.push_back(pressure);
  });
  EXPECT_TRUE(notes_of([](Scene& s) {  // level: nothing is missed
    PressureConfig pressure;
    pressure.set = "top";
    pressure.times = {0, 1000};
    pressure.values = {1e6, 1e6};
    s.bodies[0].pressures.push_back(pressure);
  }).empty());
}

// A body that measures 20 m is more often one in millimetres.
TEST(SceneBuild, ABodyOfManyMetresIsTold) {
  Scene scene = plate_scene();
  scene.tools.clear();
  scene.bodies[0].blank.reset();
  MeshConfig mesh;
  mesh.unit_scale = 1;
  mesh.cell_type = "tetrahedron";
  mesh.points = {Vec3(0, 0, 0), Vec3(20, 0, 0), Vec3(0, 20, 0), Vec3(0, 0, 20)};
  mesh.cells = {0, 1, 2, 3};
  scene.bodies[0].mesh = mesh;
  const auto tells = [&] {
    const std::vector<std::string> notes = build_model(scene).notes;
    return std::any_of(notes.begin(), notes.end(), [](const std::string& note) { return note.find("measures 20 m: with unit_scale 0.001 it would be 0.02 m") != std::string::npos; });
  };
  EXPECT_TRUE(tells());
  scene.bodies[0].mesh->unit_scale = 0.1;
  EXPECT_FALSE(tells());
}

TEST(SceneBuild, ABodyInTwoPartsIsTold) {
  Scene scene = plate_scene();
  scene.tools.clear();
  scene.bodies[0].blank.reset();
  MeshConfig mesh;
  mesh.unit_scale = 1e-2;
  mesh.cell_type = "tetrahedron";
  for (double x : {0.0, 2.0})
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) mesh.points.push_back(p + x * Vec3::UnitX());
  mesh.cells = {0, 1, 2, 3, 4, 5, 6, 7};
  scene.bodies[0].mesh = mesh;
  const std::vector<std::string> notes = build_model(scene).notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("body plate consists of 2 parts that share no node"), std::string::npos) << notes[0];
  scene.bodies[0].self_contact = true;
  EXPECT_TRUE(build_model(scene).notes.empty());
  scene.bodies[0].self_contact = false;
  scene.bodies[0].mesh->cells = {0, 1, 2, 3};
  scene.bodies[0].mesh->points.resize(4);
  EXPECT_TRUE(build_model(scene).notes.empty());
}

}  // namespace
}  // namespace forming_sim
