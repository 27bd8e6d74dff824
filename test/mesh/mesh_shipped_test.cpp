// The files in meshes/ are what scripts/make_meshes.py, make_hem_meshes.py and make_cup_meshes.py say of them.
#include <algorithm>
#include <cmath>

#include "forming_sim/mesh/import.h"
#include "mesh/mesh_test_tools.h"

namespace forming_sim {
namespace {

const std::string kMeshes = FORMING_SIM_SOURCE_DIR "/meshes";
constexpr double mm = 1e-3;

MeshConfig file(const std::string& name) {
  MeshConfig c;
  c.url = name, c.unit_scale = mm;
  return c;
}

// x and z are such that the point lies on one of the plane faces or on the arc.
double distance_from_die(const Vec3& x) {
  const double arc = x.x() > 9 * mm && x.z() > -mm ? std::abs(std::hypot(x.x() - 9 * mm, x.z() + mm) - mm) : 1;
  return std::min({std::abs(x.x() + 2 * mm), std::abs(x.x() - 10 * mm), std::abs(x.z()), std::abs(x.z() + 12 * mm), arc});
}

TEST(MeshShipped, TheSheetIsAStripOfHexahedraWithItsSets) {
  MeshConfig config = file("sheet_strip.msh");
  config.group = "sheet";
  const Mesh mesh = body_mesh(config, kMeshes);
  ASSERT_EQ(mesh.cells.size(), 1u);
  EXPECT_EQ(mesh.cells[0].kind, CellKind::hex24);
  EXPECT_EQ(mesh.cells[0].count(), 42 * 5 * 3);
  EXPECT_NEAR(volume(mesh), 20 * 10 * .93 * 1e-9, 1e-16);
  EXPECT_NEAR(area(mesh), 2 * (200 + 18.6 + 9.3) * 1e-6, 1e-14);
  EXPECT_EQ(euler_characteristic(mesh), 2);
  const std::map<std::string, std::pair<int, double>> faces = {{"clamped", {0, 0}},   {"free_end", {0, 20 * mm}},
                                                               {"front", {1, 0}},     {"back", {1, 10 * mm}},
                                                               {"bottom", {2, 0}},    {"top", {2, .93 * mm}}};
  for (const auto& [name, plane] : faces) {
    std::vector<int> expected;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
      if (std::abs(mesh.nodes[n][plane.first] - plane.second) < 1e-9) expected.push_back(int(n));
    EXPECT_EQ(mesh.sets.at(name), expected) << name;
  }
  EXPECT_EQ(mesh.sets.at("sheet").size(), mesh.nodes.size());
}

TEST(MeshShipped, ToolsAreClosedAndPointOutwards) {
  for (const char* name : {"die.stl", "punch.stl"}) {
    SCOPED_TRACE(name);
    std::vector<std::string> notes;
    const Mesh mesh = load_tool_surface(file(name), kMeshes, notes);
    EXPECT_TRUE(notes.empty());
    EXPECT_EQ(euler_characteristic(mesh), 2);
    EXPECT_LT(sum_of_areas(mesh).norm(), 1e-9 * area(mesh));
    const Vec3 extent = bounds(mesh).sizes();
    // a box with one edge of radius 1 mm rounded by 16 segments
    const double corner = (1 - 8 * std::sin(M_PI / 32)) * mm * mm;
    EXPECT_NEAR(enclosed(mesh), (extent.x() * extent.z() - corner) * extent.y(), 1e-12);
    EXPECT_NEAR(bounds(mesh).min().y(), -2 * mm, 1e-9);
    EXPECT_NEAR(bounds(mesh).max().y(), 12 * mm, 1e-9);
  }
  const Mesh die = tool_surface(file("die.stl"), kMeshes);
  for (const Vec3& x : die.nodes) EXPECT_LT(distance_from_die(x), 1e-9);
  EXPECT_NEAR(bounds(die).max().x(), 10 * mm, 1e-9);
  EXPECT_NEAR(bounds(die).max().z(), 0, 1e-9);
  const Mesh punch = tool_surface(file("punch.stl"), kMeshes);
  EXPECT_NEAR(bounds(punch).min().x(), (10 + .93 + .1) * mm, 1e-9);
  EXPECT_NEAR(bounds(punch).min().z(), .93 * mm, 1e-9);
}

// ---- the curved hem: sections turned about the z axis

double radius(const Vec3& x) { return std::hypot(x.x(), x.y()); }

TEST(MeshShipped, ThePanelsOfTheHemAreSectorsWithTheirSets) {
  struct Panel {
    const char* name;
    double to, low, thickness;
    int cells, around;
  };
  for (const Panel& panel : {Panel{"hem_outer.msh", 34.5 * mm, 0, .93 * mm, 25 * 7 * 3, 7}, Panel{"hem_inner.msh", 28.4 * mm, .93 * mm, 1 * mm, 9 * 6 * 2, 6}}) {
    SCOPED_TRACE(panel.name);
    const Mesh mesh = body_mesh(file(panel.name), kMeshes);
    ASSERT_EQ(mesh.cells.size(), 1u);
    EXPECT_EQ(mesh.cells[0].kind, CellKind::hex24);
    EXPECT_EQ(mesh.cells[0].count(), panel.cells);
    // Plane cells between radii: a polygon in place of the arc.
    const double half = 8 * M_PI / 180, sector = .5 * panel.around * std::sin(2 * half / panel.around);
    const double plan = sector * (panel.to * panel.to - 23 * 23 * mm * mm);
    EXPECT_NEAR(volume(mesh), plan * panel.thickness, 1e-6 * plan * panel.thickness);
    EXPECT_EQ(euler_characteristic(mesh), 2);
    const std::map<std::string, double> angle = {{"start", -half}, {"end", half}}, height = {{"bottom", panel.low}, {"top", panel.low + panel.thickness}};
    std::map<std::string, std::vector<int>> expected;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
      const Vec3& x = mesh.nodes[n];
      for (const auto& [name, a] : angle)
        if (std::abs(x.x() * std::sin(a) - x.y() * std::cos(a)) < 1e-9) expected[name].push_back(int(n));
      for (const auto& [name, z] : height)
        if (std::abs(x.z() - z) < 1e-9) expected[name].push_back(int(n));
    }
    for (const char* name : {"start", "end", "bottom", "top"}) EXPECT_EQ(mesh.sets.at(name), expected[name]) << name;
  }
}

TEST(MeshShipped, TheToolsOfTheHemAreClosedAndLeaveRoomForTheFlange) {
  std::map<std::string, Mesh> tools;
  for (const char* name : {"anvil", "die", "flange_punch", "steel", "punch"}) {
    SCOPED_TRACE(name);
    std::vector<std::string> notes;
    tools[name] = load_tool_surface(file(std::string("hem_") + name + ".stl"), kMeshes, notes);
    const Mesh& mesh = tools[name];
    EXPECT_TRUE(notes.empty());
    EXPECT_EQ(euler_characteristic(mesh), 2);
    EXPECT_LT(sum_of_areas(mesh).norm(), 1e-9 * area(mesh));
    EXPECT_GT(enclosed(mesh), 0);  // points outwards
    for (const Vec3& x : mesh.nodes) EXPECT_LT(std::abs(std::atan2(x.y(), x.x())), 10.001 * M_PI / 180);
  }
  double wall = 0, face = 1, cone = 1;
  for (const Vec3& x : tools["die"].nodes) wall = std::max(wall, radius(x));
  for (const Vec3& x : tools["flange_punch"].nodes) face = std::min(face, radius(x));
  for (const Vec3& x : tools["steel"].nodes) cone = std::min(cone, radius(x) + x.z());
  EXPECT_NEAR(wall, (30 - .93) * mm, 1e-9);
  EXPECT_NEAR(face, 30.1 * mm, 1e-9);
  EXPECT_NEAR(cone, 39 * mm, 1e-9);
  EXPECT_NEAR(bounds(tools["anvil"]).max().z(), 0, 1e-9);
  EXPECT_NEAR(bounds(tools["die"]).min().z(), .93 * mm, 1e-9);
  EXPECT_NEAR(bounds(tools["punch"]).min().z(), 8.5 * mm, 1e-9);
}

// ---- the cup in 3D: the same, over a quarter and some more

TEST(MeshShipped, TheToolsOfTheCupAreClosedAndHaveTheSectionsOfItsPlaneScene) {
  struct Tool {
    const char* name;
    double wall, face, edge, inner;  ///< radius of the wall; z of the face; of its edge; where the axis of that lies
    int up;                          ///< the face looks up, or down
  };
  for (const Tool& tool : {Tool{"cup_die.stl", 21.3, 0, 5, 26.3, 1}, Tool{"cup_holder.stl", 22, 1, 2, 24, -1}, Tool{"cup_punch.stl", 20, 1, 4, 16, -1}}) {
    SCOPED_TRACE(tool.name);
    std::vector<std::string> notes;
    const Mesh mesh = load_tool_surface(file(tool.name), kMeshes, notes);
    EXPECT_TRUE(notes.empty());
    EXPECT_EQ(euler_characteristic(mesh), 2);
    EXPECT_LT(sum_of_areas(mesh).norm(), 1e-9 * area(mesh));
    EXPECT_GT(enclosed(mesh), 0);  // points outwards
    int on_edge = 0, on_face = 0, on_wall = 0;
    for (const Vec3& x : mesh.nodes) {
      const double angle = std::atan2(x.y(), x.x()) * 180 / M_PI, deep = tool.up * (tool.face * mm - x.z());
      EXPECT_TRUE(radius(x) < 1e-9 || (angle > -6.001 && angle < 96.001)) << angle;
      EXPECT_GT(deep, -1e-9);  // nothing before the face
      on_face += deep < 1e-9;
      on_wall += std::abs(radius(x) - tool.wall * mm) < 1e-9;
      const bool beside = tool.inner > tool.wall ? radius(x) < (tool.inner - .01) * mm : radius(x) > (tool.inner + .01) * mm;
      if (!beside || deep > tool.edge * mm) continue;
      EXPECT_NEAR(std::hypot(radius(x) - tool.inner * mm, deep - tool.edge * mm), tool.edge * mm, 1e-9);
      ++on_edge;
    }
    EXPECT_EQ(on_edge, 9 * 35);
    EXPECT_GE(on_face, 35);
    EXPECT_EQ(on_wall, 2 * 35);
  }
}

}  // namespace
}  // namespace forming_sim
