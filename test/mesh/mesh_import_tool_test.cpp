// Surfaces of tools: the same box from every kind of file.
#include <cmath>
#include <cstring>

#include "forming_sim/mesh/import.h"
#include "mesh/mesh_test_tools.h"

namespace forming_sim {
namespace {

using Triangle = std::array<int, 3>;
const std::vector<Vec3> kCorners = {{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}, {0, 0, 1}, {3, 0, 1}, {3, 2, 1}, {0, 2, 1}};
const std::vector<Triangle> kBox = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                    {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};

std::string number(const Vec3& x) {
  return std::to_string(x.x()) + " " + std::to_string(x.y()) + " " + std::to_string(x.z());
}

std::string ascii_stl(const std::vector<Vec3>& x = kCorners, const std::vector<Triangle>& triangles = kBox) {
  std::string text = "solid box\n";
  for (const Triangle& t : triangles) {
    text += "facet normal 0 0 0\n outer loop\n";
    for (int n : t) text += "  vertex " + number(x[n]) + "\n";
    text += " endloop\nendfacet\n";
  }
  return text + "endsolid box\n";
}

std::string binary_stl(const std::vector<Vec3>& x = kCorners, const std::vector<Triangle>& triangles = kBox) {
  std::string bytes(80, ' ');
  const std::uint32_t count = std::uint32_t(triangles.size());
  bytes.append(reinterpret_cast<const char*>(&count), 4);
  for (const Triangle& t : triangles) {
    float record[12] = {};
    for (int k = 0; k < 9; ++k) record[3 + k] = float(x[t[k / 3]][k % 3]);
    bytes.append(reinterpret_cast<const char*>(record), 48).append(2, '\0');
  }
  return bytes;
}

std::string obj() {
  std::string text;
  for (const Vec3& x : kCorners) text += "v " + number(x) + "\n";
  return text + "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";  // quadrilaterals
}

std::string ply() {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 12\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& x : kCorners) text += number(x) + "\n";
  for (const Triangle& t : kBox) text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
  return text;
}

// The box moved by its node, which `transform` says.
std::string dae(const std::string& meter, const std::string& up, const std::string& transform, const Vec3& moved = Vec3::Zero()) {
  std::string x, p;
  for (const Vec3& corner : kCorners) x += number(corner - moved) + " ";
  for (const Triangle& t : kBox)
    for (int n : t) p += std::to_string(n) + " ";
  return "<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">"
         "<asset><unit name=\"u\" meter=\"" + meter + "\"/><up_axis>" + up + "</up_axis></asset>"
         "<library_geometries><geometry id=\"g\"><mesh><source id=\"s\"><float_array id=\"a\" count=\"24\">" + x +
         "</float_array><technique_common><accessor source=\"#a\" count=\"8\" stride=\"3\"><param name=\"X\" type=\"float\"/>"
         "<param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor></technique_common></source>"
         "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#s\"/></vertices><triangles count=\"12\">"
         "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>" + p + "</p></triangles></mesh></geometry></library_geometries>"
         "<library_visual_scenes><visual_scene id=\"w\"><node id=\"n\">" + transform +
         "<instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes>"
         "<scene><instance_visual_scene url=\"#w\"/></scene></COLLADA>\n";
}

MeshConfig file(const std::string& url, double unit_scale = 1e-3) {
  MeshConfig c;
  c.url = url, c.unit_scale = unit_scale;
  return c;
}

Mesh load(const std::string& name, const std::string& text, std::vector<std::string>* notes = nullptr) {
  const TempDir dir;
  dir.write(name, text);
  std::vector<std::string> said;
  Mesh mesh = load_tool_surface(file(name), dir.str(), said);
  if (notes) *notes = said;
  else EXPECT_TRUE(said.empty()) << said[0];
  return mesh;
}

std::string error_of_file(const std::string& name, const std::string& text) {
  const TempDir dir;
  dir.write(name, text);
  return error_of([&] { tool_surface(file(name), dir.str()); });
}

void expect_box(const Mesh& mesh) {
  EXPECT_EQ(mesh.dimension, 3);
  EXPECT_TRUE(mesh.cells.empty());
  ASSERT_EQ(mesh.nodes.size(), 8u);
  ASSERT_EQ(mesh.surface.size(), 12u);
  for (const Facet& f : mesh.surface) EXPECT_EQ(f.element, -1);
  EXPECT_NEAR((bounds(mesh).min()).norm(), 0, 1e-10);
  EXPECT_NEAR((bounds(mesh).max() - Vec3(3e-3, 2e-3, 1e-3)).norm(), 0, 1e-9);
  EXPECT_NEAR(enclosed(mesh), 6e-9, 1e-15);
  EXPECT_LT(sum_of_areas(mesh).norm(), 1e-12);
  EXPECT_EQ(euler_characteristic(mesh), 2);
}

TEST(MeshImportTool, EveryFormatGivesTheSameBox) {
  for (const auto& [name, text] : std::map<std::string, std::string>{{"box.stl", ascii_stl()},
                                                                     {"binary.STL", binary_stl()},
                                                                     {"box.obj", obj()},
                                                                     {"box.ply", ply()},
                                                                     {"box.dae", dae("1", "Y_UP", "")}}) {
    SCOPED_TRACE(name);
    expect_box(load(name, text));
  }
}

// As exporters write them, and as files become by being put together and edited.
TEST(MeshImportTool, StlFilesOfAllSorts) {
  const auto replaced = [](std::string text, const std::string& what, const std::string& by) {
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size()) text.replace(at, what.size(), by);
    return text;
  };
  const std::string text = ascii_stl();
  std::string upper = text;
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  const std::vector<Triangle> first(kBox.begin(), kBox.begin() + 5), rest(kBox.begin() + 5, kBox.end());
  std::string second = ascii_stl(kCorners, rest);
  for (char& c : second) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  for (const auto& [name, file] : std::map<std::string, std::string>{{"upper", upper},
                                                                     {"mark", "\xEF\xBB\xBF" + text},
                                                                     {"blank", "\n \n" + text + std::string(5000, '\n')},
                                                                     {"crlf", replaced(text, "\n", "\r\n")},
                                                                     {"cr", replaced(text, "\n", "\r")},
                                                                     {"normals", replaced(text, "normal 0 0 0", "normal -nan(ind) nan 0")},
                                                                     {"names", replaced(text, "solid box", "solid x endsolid facet y endfacet")},
                                                                     {"two", ascii_stl(kCorners, first) + second},
                                                                     {"longer", binary_stl() + "more"},
                                                                     {"solid", "solid" + binary_stl().substr(5) + "more"}}) {
    SCOPED_TRACE(name);
    expect_box(load(name + ".stl", file));
  }
}

TEST(MeshImportTool, UnitsAndAxesOfColladaAreLeftAside) {
  for (const char* up : {"X_UP", "Y_UP", "Z_UP"})
    for (const char* meter : {"1", "0.001", "0.0254"}) {
      SCOPED_TRACE(std::string(up) + meter);
      expect_box(load("box.dae", dae(meter, up, "")));
    }
}

TEST(MeshImportTool, NodesOfColladaPlaceTheirMeshes) {
  expect_box(load("box.dae", dae("0.0254", "Z_UP", "<translate>5 -1 2</translate>", {5, -1, 2})));
  const Mesh mesh = load("box.dae", dae("0.0254", "Z_UP", "<rotate>0 0 1 90</rotate><scale>2 1 1</scale>"));
  EXPECT_NEAR((bounds(mesh).min() - Vec3(-2e-3, 0, 0)).norm(), 0, 1e-9);
  EXPECT_NEAR((bounds(mesh).max() - Vec3(0, 6e-3, 1e-3)).norm(), 0, 1e-9);
}

TEST(MeshImportTool, InlineTriangles) {
  MeshConfig config;
  config.unit_scale = 1e-3, config.points = kCorners;
  for (const Triangle& t : kBox) config.cells.insert(config.cells.end(), t.begin(), t.end());
  expect_box(tool_surface(config, ""));
  config.cell_type = "triangle";
  expect_box(tool_surface(config, ""));
  config.cell_type = "tetrahedron";
  EXPECT_TRUE(has(error_of([&] { tool_surface(config, ""); }), "a tool's surface is made of triangles"));
  config.cell_type = "";
  config.cells.pop_back();
  EXPECT_TRUE(has(error_of([&] { tool_surface(config, ""); }), "given 35 indices; 3 per triangle"));
}

TEST(MeshImportTool, FlatAndRepeatedTrianglesAreRemovedAndCounted) {
  std::vector<Vec3> x = kCorners;
  x.push_back({1.5, 0, 0});
  std::vector<Triangle> triangles = kBox;
  triangles.push_back({0, 8, 1});  // three points of one line
  triangles.push_back({4, 4, 5});
  triangles.push_back({6, 5, 4});  // a repeated one, turned round
  std::vector<std::string> notes;
  expect_box(load("box.stl", ascii_stl(x, triangles), &notes));
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_TRUE(has(notes[0], "2 triangles without area removed")) << notes[0];
  EXPECT_TRUE(has(notes[1], "1 repeated triangles removed")) << notes[1];
}

// Every triangle with corners of its own, rounded differently: the box is closed nevertheless. A gap that can be seen stays one.
TEST(MeshImportTool, SeamsThatDifferByRoundingAreJoined) {
  for (const auto& [rounding, closed] : {std::pair(3e-7, true), std::pair(3e-4, false)}) {
    MeshConfig config;
    config.unit_scale = 1;
    for (const Triangle& t : kBox)
      for (int n : t) {
        const double sign = config.points.size() % 2 == 0 ? 1 : -1;
        config.points.push_back(kCorners[n] + sign * rounding * Vec3(1, -1, 1));
        config.cells.push_back(static_cast<int>(config.cells.size()));
      }
    std::vector<std::string> notes;
    const Mesh mesh = load_tool_surface(config, "", notes);
    EXPECT_EQ(mesh.surface.size(), 12u);
    EXPECT_NEAR(area(mesh), 22, 1e-2);
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_EQ(has(notes[0], "vertices along seams joined"), closed) << notes[0];
    EXPECT_EQ(has(notes[0], "the surface is open"), !closed) << notes[0];
  }
}

TEST(MeshImportTool, AnOpenSurfaceIsSaid) {
  std::vector<std::string> notes;
  load("box.stl", ascii_stl(kCorners, {kBox.begin() + 2, kBox.end()}), &notes);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_TRUE(has(notes[0], "the surface is open, 4 edges belong to one triangle only")) << notes[0];
}

std::string binary_ply() {
  std::string text =
      "ply\nformat binary_little_endian 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 12\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& x : kCorners) {
    const Eigen::Vector3f at = x.cast<float>();
    text.append(reinterpret_cast<const char*>(at.data()), 12);
  }
  for (const Triangle& t : kBox) text.append(1, '\3').append(reinterpret_cast<const char*>(t.data()), 12);
  return text;
}

// assimp breaks over some of these files, reads others for ever or takes all memory: in a process of its own.
TEST(MeshImportTool, FilesThatBreakTheirReaderAreRefused) {
  const std::string whole = binary_ply(), text = ply();
  load("box.ply", whole, nullptr);
  int broken = 0;
  for (std::size_t cut = whole.size() - 150; cut < whole.size(); cut += 7)
    broken += has(error_of_file("cut.ply", whole.substr(0, cut)), "the file is damaged or cut short: write it again");
  EXPECT_GT(broken, 10);
  std::string many = text, far = text;
  many.replace(many.find("vertex 8"), 8, "vertex 800000000");
  far.replace(far.rfind(" 7\n"), 3, " 99\n");
  EXPECT_TRUE(has(error_of_file("many.ply", many), "many.ply"));
  EXPECT_TRUE(has(error_of_file("few.ply", text.substr(0, text.find("3 4 6 7"))), "9 are there already, more than the rest"));  // of a missing face assimp makes a copy
  EXPECT_TRUE(has(error_of_file("far.ply", far), "face 11 names vertex 99 of 8"));
  EXPECT_TRUE(has(error_of_file("head.ply", text.substr(0, text.find("element vertex 8") + 20)), "did not end"));
}

// Vertices that are missing are all one to assimp: what is left is no tool.
TEST(MeshImportTool, ASurfaceThatIsMostlyFlatIsRefused) {
  std::vector<Vec3> x(8, kCorners[0]);
  x[1] = kCorners[1];
  x[2] = kCorners[2];
  EXPECT_TRUE(has(error_of_file("cut.stl", ascii_stl(x)), "are there already, more than the rest"));
}

TEST(MeshImportTool, BrokenFilesAreRefused) {
  EXPECT_TRUE(has(error_of_file("empty.stl", ""), "the file is empty"));
  EXPECT_TRUE(has(error_of_file("none.stl", "solid none\nendsolid none\n"), "none.stl"));
  EXPECT_TRUE(has(error_of_file("none.stl", binary_stl(kCorners, {})), "none.stl"));
  EXPECT_TRUE(has(error_of_file("points.obj", "v 0 0 0\nv 1 0 0\n"), "points.obj"));
  EXPECT_TRUE(has(error_of_file("noise.ply", "no ply at all\n"), "noise.ply"));
  EXPECT_TRUE(has(error_of_file("noise.dae", "<no collada"), "noise.dae"));
  EXPECT_TRUE(has(error_of_file("cut.stl", binary_stl().substr(0, 300)), "684 bytes for the 12 triangles that it announces, not 300"));
  const std::string text = ascii_stl();
  const std::string damaged = error_of_file("damaged.stl", std::string(text).replace(text.find("endfacet"), 200, 200, '\0'));
  EXPECT_TRUE(has(damaged, "triangles; it is damaged")) << damaged;
  EXPECT_TRUE(has(error_of_file("cut.stl", text.substr(0, text.rfind("endsolid"))), "does not end with endsolid"));
  EXPECT_TRUE(has(error_of_file("two.stl", text + text.substr(0, text.size() / 2)), "does not end with endsolid"));
  EXPECT_TRUE(has(error_of_file("flat.stl", ascii_stl(std::vector<Vec3>(8, Vec3(1, 2, 3)))), "none of its 12 triangles has an area"));
  std::vector<Vec3> x = kCorners;
  x[6].y() = std::nan("");
  EXPECT_TRUE(has(error_of_file("nan.stl", binary_stl(x)), "every coordinate must be a finite number"));
  EXPECT_TRUE(has(error_of_file("nan.stl", ascii_stl(x)), "every coordinate must be a finite number"));
  EXPECT_TRUE(has(error_of_file("die.step", "x"), "the ending \".step\" is not known for a tool"));
  EXPECT_TRUE(has(error_of_file("die.msh", "x"), ".stl, .obj, .ply or .dae is needed"));
  EXPECT_TRUE(has(error_of([] { tool_surface(file("none.stl"), "/nowhere"); }), "there is no file /nowhere/none.stl"));
  EXPECT_TRUE(has(error_of([] { tool_surface(file("die.stl", -1), ""); }), "mesh.unit_scale: given -1"));
  EXPECT_TRUE(has(error_of([] { tool_surface(file(""), ""); }), "neither url nor points"));
}

}  // namespace
}  // namespace forming_sim
