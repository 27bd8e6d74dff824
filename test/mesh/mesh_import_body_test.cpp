// Bodies from .msh files and inline.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <thread>

#include "forming_sim/mesh/import.h"
#include "forming_sim/mesh/measure.h"
#include "mesh/mesh_test_tools.h"
#include "mesh/msh_texts.h"
#include "support/bodies.h"

namespace forming_sim {
namespace {

MeshConfig file(const std::string& url, double unit_scale = 1) {
  MeshConfig c;
  c.url = url, c.unit_scale = unit_scale;
  return c;
}

MeshConfig given(const std::string& cell_type, std::vector<Vec3> points, std::vector<int> cells) {
  MeshConfig c;
  c.unit_scale = 1, c.cell_type = cell_type, c.points = std::move(points), c.cells = std::move(cells);
  return c;
}

std::string error_of_file(const std::string& name, const std::string& text, const std::string& group = "") {
  const TempDir dir;
  dir.write(name, text);
  MeshConfig config = file(name);
  config.group = group;
  return error_of([&] { body_mesh(config, dir.str()); });
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

std::vector<int> nodes_where(const Mesh& mesh, const std::function<bool(const Vec3&)>& inside) {
  std::vector<int> chosen;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (inside(mesh.nodes[n])) chosen.push_back(int(n));
  return chosen;
}

// Two unit cubes side by side along x, in millimetres.
void expect_two_cubes(const Mesh& mesh) {
  EXPECT_EQ(mesh.dimension, 3);
  ASSERT_EQ(mesh.cells.size(), 1u);
  EXPECT_EQ(mesh.cells[0].kind, CellKind::hex24);
  EXPECT_EQ(mesh.cells[0].count(), 2);
  EXPECT_EQ(mesh.nodes.size(), 12u + 11u + 2u);
  EXPECT_NEAR(volume(mesh), 2e-9, 1e-20);
  EXPECT_NEAR(area(mesh), 10e-6, 1e-16);
  EXPECT_LT(sum_of_areas(mesh).norm(), 1e-17);
  EXPECT_EQ(euler_characteristic(mesh), 2);
  ASSERT_EQ(mesh.sets.size(), 4u);
  EXPECT_EQ(mesh.sets.at("body").size(), 25u);
  EXPECT_EQ(mesh.sets.at("bottom face"), nodes_where(mesh, [](const Vec3& x) { return x.z() == 0; }));
  EXPECT_EQ(mesh.sets.at("bottom face").size(), 8u);  // six corners, two face centres
  EXPECT_EQ(mesh.sets.at("group_7"), nodes_where(mesh, [](const Vec3& x) { return x.x() == 0; }));
  EXPECT_EQ(mesh.sets.at("edge").size(), 3u);
}

// A mesh generator numbers nodes and cells as it makes them.
TEST(MeshImportBody, NeighboursComeNearToEachOther) {
  const Mesh mesh = block_of(CellKind::tetrahedron, 10);
  const int nodes = static_cast<int>(mesh.nodes.size()), count = mesh.cells[0].count();
  std::mt19937 random(1);
  std::vector<int> number(nodes), order(count), corners;
  std::iota(number.begin(), number.end(), 0);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(number.begin(), number.end(), random);
  std::shuffle(order.begin(), order.end(), random);
  std::vector<Vec3> points(nodes);
  for (int n = 0; n < nodes; ++n) points[number[n]] = mesh.nodes[n];
  for (int cell : order)
    for (int a = 0; a < 4; ++a) corners.push_back(number[mesh.cells[0].nodes[cell * 4 + a]]);
  const TempDir dir;
  dir.write("scattered.msh", msh::tetrahedra(points, corners));
  const Mesh read = body_mesh(file("scattered.msh"), dir.str());
  ASSERT_EQ(read.nodes.size(), mesh.nodes.size());
  EXPECT_NEAR(volume(read), volume(mesh), 1e-4 * volume(mesh));  // six digits in the file
  EXPECT_NEAR(area(read), area(mesh), 1e-4 * area(mesh));
  double span = 0;
  for (int i = 0; i < count; ++i) {
    const auto [low, high] = std::minmax_element(read.cells[0].nodes.begin() + i * 4, read.cells[0].nodes.begin() + i * 4 + 4);
    span += *high - *low;
  }
  EXPECT_LT(span / count, 0.2 * nodes);  // of four random numbers 3/5
}

TEST(MeshImportBody, BothFormatsKeepPhysicalGroups) {
  const TempDir dir;
  dir.write("two22.msh", msh::kTwoCubes22);
  dir.write("two41.msh", msh::kTwoCubes41);
  const Mesh old_format = body_mesh(file("two22.msh", 1e-3), dir.str());
  const Mesh new_format = body_mesh(file("two41.msh", 1e-3), dir.str());
  expect_two_cubes(old_format);
  expect_two_cubes(new_format);
  EXPECT_EQ(old_format.nodes, new_format.nodes);
  EXPECT_EQ(old_format.sets, new_format.sets);
}

TEST(MeshImportBody, AGroupIsTakenAsTheBody) {
  const TempDir dir;
  dir.write("two.msh", msh::kTwoCubes22);
  MeshConfig config = file("two.msh");
  config.group = "bottom face";
  const Mesh mesh = body_mesh(config, dir.str());
  EXPECT_EQ(mesh.dimension, 2);
  EXPECT_EQ(mesh.cells[0].kind, CellKind::crossed);
  EXPECT_EQ(mesh.nodes.size(), 8u);
  EXPECT_NEAR(volume(mesh), 2, 1e-14);  // the file turns them clockwise seen from above
  EXPECT_EQ(mesh.sets.at("bottom face").size(), 8u);
  EXPECT_EQ(mesh.sets.at("edge").size(), 3u);
  EXPECT_FALSE(mesh.sets.count("body"));
  config.group = "lid";
  const std::string text = error_of([&] { body_mesh(config, dir.str()); });
  EXPECT_TRUE(has(text, "no such physical group; it has edge, group_7, bottom face, body")) << text;
  config.group = "edge";
  EXPECT_TRUE(has(error_of([&] { body_mesh(config, dir.str()); }), "so it is no body"));
  config.group = "group_7";
  EXPECT_TRUE(has(error_of([&] { body_mesh(config, dir.str()); }), "a body of dimension 2 lies in z = 0, and a solid one needs tetrahedra or hexahedra: groups of these are body"));
}

TEST(MeshImportBody, ASectionOfTrianglesAndQuadrilaterals) {
  const TempDir dir;
  dir.write("section.msh", msh::section("0"));
  const Mesh mesh = body_mesh(file("section.msh", .5), dir.str());
  EXPECT_EQ(mesh.dimension, 2);
  ASSERT_EQ(mesh.cells.size(), 2u);
  EXPECT_EQ(mesh.cells[0].kind, CellKind::triangle);
  EXPECT_EQ(mesh.cells[1].kind, CellKind::crossed);
  EXPECT_EQ(mesh.nodes.size(), 6u);  // node 6 of the file belongs to no cell
  EXPECT_NEAR(volume(mesh), .25 * 1.5, 1e-15);
  EXPECT_NEAR(enclosed(mesh), .25 * 1.5, 1e-15);
  EXPECT_EQ(mesh.sets.at("group_3").size(), 2u);
  MeshConfig whole = file("section.msh", .5);
  whole.pattern = "one_point";
  const Mesh one_point = body_mesh(whole, dir.str());
  EXPECT_EQ(one_point.cells[0].kind, CellKind::triangle);
  EXPECT_EQ(one_point.cells[1].kind, CellKind::quad1);
  EXPECT_EQ(one_point.nodes.size(), 5u);
  EXPECT_NEAR(enclosed(one_point), .25 * 1.5, 1e-15);
  EXPECT_TRUE(has(error_of_file("s.msh", msh::section("1e-3")), "node 5 of a mesh of triangles"));
}

TEST(MeshImportBody, Tetrahedra) {
  const TempDir dir;
  dir.write("tet.msh", msh::cells("1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n", 5,
                                  "41 4 2 1 1 1 2 3 4\n42 4 2 1 1 2 3 4 5\n", 2));
  const Mesh mesh = body_mesh(file("tet.msh"), dir.str());
  EXPECT_EQ(mesh.cells[0].kind, CellKind::tetrahedron);
  EXPECT_EQ(mesh.surface.size(), 6u);
  EXPECT_NEAR(volume(mesh), 1. / 6 + 1. / 3, 1e-15);
  EXPECT_EQ(mesh.sets.at("group_1").size(), 5u);
}

// Tags and names of groups are one for each dimension alone.
TEST(MeshImportBody, GroupsOfSeveralDimensionsAreToldApart) {
  const std::string nodes = "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n";
  const TempDir dir;
  dir.write("two.msh", msh::cells(nodes, 4, "1 1 2 1 1 1 4\n2 1 2 2 2 2 3\n3 3 2 1 1 1 2 3 4\n", 3));
  const Mesh mesh = body_mesh(file("two.msh"), dir.str());
  EXPECT_EQ(mesh.sets.count("group_1"), 0u);
  EXPECT_EQ(mesh.sets.at("group_1_curve").size(), 2u);
  EXPECT_EQ(mesh.sets.at("group_1_surface").size(), 5u);
  EXPECT_EQ(mesh.sets.at("group_2").size(), 2u);
}

// Format 2.2 writes a cell once for each group that it is in.
TEST(MeshImportBody, ACellInTwoGroupsIsOneCell) {
  const TempDir dir;
  dir.write("two.msh", msh::cells("1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n", 4, "1 3 2 1 1 1 2 3 4\n2 3 2 2 1 1 2 3 4\n", 2));
  const Mesh mesh = body_mesh(file("two.msh"), dir.str());
  EXPECT_EQ(mesh.cells[0].count(), 1);
  EXPECT_EQ(mesh.sets.at("group_1").size(), 5u);
  EXPECT_EQ(mesh.sets.at("group_2").size(), 5u);
}

TEST(MeshImportBody, OfCellsOfSecondOrderTheCornersAreTaken) {
  const TempDir dir;
  dir.write("t6.msh", msh::cells("1 0 0 0\n2 1 0 0\n3 0 1 0\n4 .5 -.1 0\n5 .5 .5 0\n6 0 .5 0\n", 6, "1 8 2 7 1 1 2 4\n2 9 2 8 1 1 2 3 4 5 6\n", 2));
  std::vector<std::string> notes;
  const Mesh mesh = load_body_mesh(file("t6.msh"), dir.str(), notes);
  EXPECT_EQ(mesh.cells[0].kind, CellKind::triangle);
  EXPECT_EQ(mesh.nodes.size(), 3u);
  EXPECT_NEAR(volume(mesh), 0.5, 1e-15);
  EXPECT_EQ(mesh.sets.at("group_7").size(), 2u);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_TRUE(has(notes[0], "cells of order 2")) << notes[0];
}

TEST(MeshImportBody, InvertedCellsAreNamedByTheirNumbers) {
  const std::string text =
      error_of_file("t.msh", msh::cells("1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n", 5,
                                        "41 4 2 1 1 1 2 3 4\n42 4 2 1 1 2 4 3 5\n", 2));
  EXPECT_TRUE(has(text, "1 of 2 cells are inverted, flat or not convex: 42;")) << text;
}

TEST(MeshImportBody, WhatCannotBeUsedSaysWhatToDo) {
  const std::string nodes = "1 0 0 0\n2 1 0 0\n3 0 1 0\n4 .5 0 0\n5 .5 .5 0\n6 0 .5 0\n7 0 0 1\n8 1 0 1\n";
  std::string text = error_of_file("t.msh", msh::cells(nodes, 8, "1 1 2 1 1 1 2\n", 1));
  EXPECT_TRUE(has(text, "mesh it first")) << text;
  text = error_of_file("t.msh", msh::cells("1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n9 .5 .5 2\n", 9,
                                           "1 5 2 1 1 1 2 3 4 5 6 7 8\n2 4 2 1 1 5 6 7 9\n", 2));
  EXPECT_TRUE(has(text, "tetrahedron 2 lies on a face with four corners of a hexahedron")) << text;
}

TEST(MeshImportBody, BrokenFilesAreRefused) {
  const std::string whole = msh::kTwoCubes22, whole41 = msh::kTwoCubes41;
  for (const std::string& text : {whole, whole41})
    for (const char* section : {"$Nodes", "$Elements"}) {
      SCOPED_TRACE(text.substr(11, 5) + section);
      const auto at = text.find(section);
      const std::string sentence = error_of_file("cut.msh", text.substr(0, at + text.substr(at).size() / 2));
      EXPECT_TRUE(has(sentence, "cut.msh\": gmsh cannot read it")) << sentence;
    }
  EXPECT_TRUE(has(error_of_file("empty.msh", ""), "the file or its first line is empty"));
  // not run as a script of gmsh, either
  EXPECT_TRUE(has(error_of_file("noise.msh", "Exit;\n"), "a .msh begins with $MeshFormat"));
  EXPECT_TRUE(has(error_of_file("nan.msh", replaced(whole, "7 2 1 1", "7 2 nan 1")), "finite number"));
  EXPECT_TRUE(has(error_of_file("far.msh", replaced(whole, "10 11 6 7 12", "10 11 6 7 99")), "Wrong node index 99"));
  EXPECT_TRUE(has(error_of_file("body.step", "x"), "the ending \".step\" is not known; a body needs a .msh"));
  EXPECT_TRUE(has(error_of_file("body.stl", "x"), "mesh its volume with gmsh"));
  EXPECT_TRUE(has(error_of([] { body_mesh(file("none.msh"), "/nowhere"); }), "there is no file /nowhere/none.msh"));
  const TempDir dir;  // a good file is read after all the bad ones
  dir.write("two.msh", whole);
  expect_two_cubes(body_mesh(file("two.msh", 1e-3), dir.str()));
}

TEST(MeshImportBody, ThreadsReadOneAfterTheOther) {
  const TempDir dir;
  dir.write("two.msh", msh::kTwoCubes22);
  dir.write("section.msh", msh::section("0"));
  std::vector<Mesh> meshes(6);
  std::vector<std::thread> threads;
  for (int t = 0; t < 6; ++t)
    threads.emplace_back([&, t] { meshes[t] = body_mesh(file(t % 2 ? "two.msh" : "section.msh", 1e-3), dir.str()); });
  for (std::thread& thread : threads) thread.join();
  for (int t = 0; t < 6; ++t) {
    if (t % 2) expect_two_cubes(meshes[t]);
    else EXPECT_EQ(meshes[t].nodes.size(), 6u);
  }
}

const std::vector<Vec3> kCube = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

// A hexahedron, a wedge beside it, and tetrahedra on the wedge's upper end.
TEST(MeshImportBody, WedgesStandBesideHexahedraAndUnderTetrahedra) {
  const TempDir dir;
  const std::string nodes = "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n9 2 0 0\n10 2 0 1\n11 1.3 .3 2\n";
  const std::string hex = "1 5 2 1 1 1 2 3 4 5 6 7 8\n", wedge = "2 6 2 1 1 2 9 3 6 10 7\n", tetrahedron = "3 4 2 1 1 6 10 7 11\n", face = "4 3 2 7 7 2 9 10 6\n";
  dir.write("mixed.msh", msh::cells(nodes, 11, hex + wedge + tetrahedron + face, 4));
  const Mesh mesh = body_mesh(file("mixed.msh", 1), dir.str());
  ASSERT_EQ(mesh.cells.size(), 3u);
  EXPECT_EQ(mesh.cells[2].kind, CellKind::wedge14);
  EXPECT_EQ(mesh.nodes.size(), 11u + 6 + 1 + 2 + 1);  // centres of the faces, of which two cells share one, and of the cells
  EXPECT_NEAR(volume(mesh), 1 + .5 + 1. / 6, 1e-14);
  EXPECT_NEAR(enclosed(mesh), volume(mesh), 1e-14);
  EXPECT_EQ(euler_characteristic(mesh), 2);
  EXPECT_EQ(mesh.sets.at("group_7").size(), 5u);
  MeshConfig whole = file("mixed.msh", 1);
  whole.pattern = "one_point";
  EXPECT_TRUE(has(error_of([&] { body_mesh(whole, dir.str()); }), "wedges, which are split, do not fit beside them"));
  dir.write("on_side.msh", msh::cells(nodes, 11, wedge + "3 4 2 1 1 2 9 6 1\n", 2));
  EXPECT_TRUE(has(error_of([&] { body_mesh(file("on_side.msh", 1), dir.str()); }), "four corners of a wedge"));
}

// A pyramid on a hexahedron, and a tetrahedron on its side.
TEST(MeshImportBody, PyramidsStandOnHexahedraAndUnderTetrahedra) {
  const TempDir dir;
  const std::string nodes = "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n9 .5 .5 2\n10 2 .5 1.6\n";
  dir.write("mixed.msh", msh::cells(nodes, 10, "1 5 2 1 1 1 2 3 4 5 6 7 8\n2 7 2 1 1 5 6 7 8 9\n3 4 2 1 1 6 7 9 10\n", 3));
  const Mesh mesh = body_mesh(file("mixed.msh", 1), dir.str());
  ASSERT_EQ(mesh.cells.size(), 3u);
  EXPECT_EQ(mesh.cells[2].kind, CellKind::pyramid8);
  EXPECT_EQ(mesh.nodes.size(), 10u + 6 + 1 + 1);  // the base is the upper face of the hexahedron
  EXPECT_NEAR(enclosed(mesh), volume(mesh), 1e-14);
  EXPECT_EQ(euler_characteristic(mesh), 2);
  MeshConfig whole = file("mixed.msh", 1);
  whole.pattern = "one_point";
  EXPECT_TRUE(has(error_of([&] { body_mesh(whole, dir.str()); }), "pyramids, which are split, do not fit beside them"));
  EXPECT_EQ(body_mesh(given("pyramid", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 1, 2, 3, 4}), "").nodes.size(), 7u);
}

TEST(MeshImportBody, InlineWedges) {
  const Mesh mesh = body_mesh(given("wedge", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, {0, 1, 2, 3, 4, 5}), "");
  EXPECT_EQ(mesh.cells[0].kind, CellKind::wedge14);
  EXPECT_EQ(mesh.nodes.size(), 10u);
}

TEST(MeshImportBody, InlineCells) {
  MeshConfig config = given("hexahedron", kCube, {0, 1, 2, 3, 4, 5, 6, 7});
  config.unit_scale = .1;
  Mesh mesh = body_mesh(config, "");
  EXPECT_EQ(mesh.cells[0].kind, CellKind::hex24);
  EXPECT_NEAR(volume(mesh), 1e-3, 1e-17);
  config.pattern = "one_point";
  mesh = body_mesh(config, "");
  EXPECT_EQ(mesh.cells[0].kind, CellKind::hex1);
  EXPECT_EQ(mesh.nodes.size(), 8u);
  EXPECT_EQ(mesh.surface.size(), 12u);
  EXPECT_NEAR(enclosed(mesh), 1e-3, 1e-17);
  config.pattern = "coarse";
  EXPECT_TRUE(has(error_of([&] { body_mesh(config, ""); }), "mesh.pattern"));
  // A quadrilateral whose corner points inwards has no place for its point.
  config = given("quadrilateral", {{0, 0, 0}, {1, 0, 0}, {.2, .2, 0}, {0, 1, 0}}, {0, 1, 2, 3});
  config.pattern = "one_point";
  EXPECT_TRUE(has(error_of([&] { body_mesh(config, ""); }), "not convex"));
  mesh = body_mesh(given("quadrilateral", {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}}, {0, 1, 2, 3}), "");
  EXPECT_EQ(mesh.cells[0].nodes, (std::vector<int>{0, 3, 2, 1, 4}));  // turned counter-clockwise
  EXPECT_NEAR(volume(mesh), 1, 1e-15);
  mesh = body_mesh(given("tetrahedron", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 1, 2, 3}), "");
  EXPECT_EQ(mesh.surface.size(), 4u);
  mesh = body_mesh(given("triangle", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2}), "");
  EXPECT_EQ(mesh.dimension, 2);
}

// The halves of a warped face look more than a right angle apart, and the cells on either side of it are sound.
TEST(MeshImportBody, HexahedraMayShareAWarpedFace) {
  const double w = .08, h = .1;
  const std::vector<Vec3> points{{0, -1, 0}, {1, -1, 0}, {1, -w, 0}, {0, w, 0}, {0, -1, h}, {1, -1, h}, {1, w, h}, {0, -w, h}, {0, 1, 0}, {1, 1, 0}, {0, 1, h}, {1, 1, h}};
  MeshConfig config = given("hexahedron", points, {0, 1, 2, 3, 4, 5, 6, 7, 3, 2, 9, 8, 7, 6, 11, 10});
  config.pattern = "one_point";
  EXPECT_NEAR(volume(body_mesh(config, "")), 2 * h, 1e-12);
  std::vector<Vec3> folded = points;
  for (int n = 8; n < 12; ++n) folded[n].y() = -.7;  // the second on the side of the first
  EXPECT_NE(error_of([&] { body_mesh(given("hexahedron", folded, config.cells), ""); }), "");
}

// Cells that lie against each other and share no node there: two quadrilaterals one over the other, whose meeting sides
// have nodes of their own; half joined; two over one of twice the length; and apart by a gap that contact can keep.
TEST(MeshImportBody, CellsThatTouchAreJoined) {
  const auto load = [](std::vector<Vec3> points, std::vector<int> cells, const char* kind = "quadrilateral") {
    return body_mesh(given(kind, std::move(points), std::move(cells)), "");
  };
  const auto error = [&](auto... mesh) { return error_of([&] { load(mesh...); }); };
  const std::vector<Vec3> low{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const auto with = [&](std::initializer_list<Vec3> more) {
    std::vector<Vec3> points = low;
    points.insert(points.end(), more);
    return points;
  };
  EXPECT_NO_THROW(load(with({{1, 2, 0}, {0, 2, 0}}), {0, 1, 2, 3, 3, 2, 4, 5}));
  const std::string doubled = error(with({{0, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}), std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7});
  EXPECT_TRUE(has(doubled, "at 4 nodes")) << doubled;
  EXPECT_TRUE(has(doubled, "node 2 at (1, 1, 0) m")) << doubled;
  EXPECT_TRUE(has(doubled, "merge")) << doubled;
  EXPECT_TRUE(has(error(with({{1, 1, 0}, {1, 2, 0}, {0, 2, 0}}), std::vector<int>{0, 1, 2, 3, 3, 4, 5, 6}), "at 2 nodes"));
  EXPECT_TRUE(has(error(with({{.5, 1, 0}, {.5, 2, 0}, {0, 2, 0}, {1, 2, 0}}), std::vector<int>{0, 1, 2, 3, 3, 4, 5, 6, 4, 2, 7, 5}), "at 1 node of the surface: the first is node 4"));
  EXPECT_NO_THROW(load(with({{0, 1 + 1e-6, 0}, {1, 1 + 1e-6, 0}, {1, 2, 0}, {0, 2, 0}}), {0, 1, 2, 3, 4, 5, 6, 7}));
  std::vector<Vec3> tower = kCube;
  for (const Vec3& p : kCube) tower.push_back(p + Vec3(0, 0, 1));
  EXPECT_TRUE(has(error(tower, std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}, "hexahedron"), "cells touch without being joined, at 10 nodes"));
  tower.erase(tower.begin() + 8, tower.begin() + 12);
  EXPECT_NO_THROW(load(tower, {0, 1, 2, 3, 4, 5, 6, 7, 4, 5, 6, 7, 8, 9, 10, 11}, "hexahedron"));
}

// Two cubes on each other, each cut into tetrahedra or wedges, along the same diagonal of the face between them and along different ones.
TEST(MeshImportBody, CellsOnBothSidesCutAFaceAlike) {
  std::vector<Vec3> tower = kCube;
  for (int k = 4; k < 8; ++k) tower.push_back(kCube[k] + Vec3(0.1, 0, 1));
  tower[6] += Vec3(0, 0, 0.1);  // not quite flat
  const auto wedges = [](int from, bool other) {  // of the cube whose lower corners begin at `from`
    std::vector<int> cells;
    for (int k : other ? std::vector<int>{1, 2, 3, 1, 3, 0} : std::vector<int>{0, 1, 2, 0, 2, 3}) cells.push_back(from + k);
    std::vector<int> both;
    for (int w = 0; w < 2; ++w)
      for (int above : {0, 4})
        for (int k = 0; k < 3; ++k) both.push_back(cells[3 * w + k] + above);
    return both;
  };
  const auto tetrahedra = [&](int from, bool other) {
    std::vector<int> cells;
    const std::vector<int> of = wedges(from, other);
    for (int w = 0; w < 2; ++w)
      for (int k : {0, 1, 2, 3, 1, 2, 3, 4, 2, 3, 4, 5}) cells.push_back(of[6 * w + k]);
    for (std::size_t t = 0; t < cells.size(); t += 4)
      if ((tower[cells[t + 1]] - tower[cells[t]]).cross(tower[cells[t + 2]] - tower[cells[t]]).dot(tower[cells[t + 3]] - tower[cells[t]]) < 0) std::swap(cells[t], cells[t + 1]);
    return cells;
  };
  const auto load = [&](const char* kind, std::vector<int> low, const std::vector<int>& high) {
    low.insert(low.end(), high.begin(), high.end());
    return body_mesh(given(kind, tower, low), "");
  };
  for (bool other : {false, true}) {
    EXPECT_NO_THROW(load("wedge", wedges(0, other), wedges(4, other)));
    EXPECT_NO_THROW(load("tetrahedron", tetrahedra(0, other), tetrahedra(4, other)));
    for (const std::string& text : {error_of([&] { load("wedge", wedges(0, other), wedges(4, !other)); }), error_of([&] { load("tetrahedron", tetrahedra(0, other), tetrahedra(4, !other)); })}) {
      EXPECT_TRUE(has(text, "cut it along different diagonals, once: the first time with the nodes 4 ")) << text;
      EXPECT_TRUE(has(text, "(0, 0, 1)")) << text;
    }
  }
}

// Its cells are all inverted; those of other meshes are told by their numbers.
TEST(MeshImportBody, AMirroredMeshIsTurnedRoundAndTold) {
  const auto turned = [](const std::string& kind, const std::vector<int>& points, const std::vector<int>& cell) {
    MeshConfig config = given(kind, {}, cell);
    for (const int p : points) config.points.push_back(kCube[p]);
    std::vector<std::string> notes;
    const double size = volume(load_body_mesh(config, "", notes));
    EXPECT_EQ(notes.size(), 1u) << kind;
    EXPECT_TRUE(!notes.empty() && has(notes[0], "mirrored")) << kind;
    return size;
  };
  EXPECT_NEAR(turned("hexahedron", {0, 1, 2, 3, 4, 5, 6, 7}, {4, 5, 6, 7, 0, 1, 2, 3}), 1, 1e-12);
  EXPECT_NEAR(turned("wedge", {0, 1, 2, 4, 5, 6}, {3, 4, 5, 0, 1, 2}), 0.5, 1e-12);
  EXPECT_NEAR(turned("pyramid", {0, 1, 2, 3, 4}, {0, 3, 2, 1, 4}), 1. / 3, 1e-12);
  EXPECT_NEAR(turned("tetrahedron", {0, 1, 2, 4}, {0, 2, 1, 3}), 1. / 6, 1e-12);
}

TEST(MeshImportBody, RepeatedCellsAreNamed) {
  const std::string text = error_of([&] { body_mesh(given("hexahedron", kCube, {0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7}), ""); });
  EXPECT_TRUE(has(text, "cells 0 and 1 have the same nodes")) << text;
}

TEST(MeshImportBody, InlineNonsenseIsRefusedByItsField) {
  const auto refused = [](const MeshConfig& c) { return error_of([&] { body_mesh(c, ""); }); };
  EXPECT_TRUE(has(refused(given("", kCube, {0, 1, 2, 3})), "mesh.cell_type: given \"\""));
  EXPECT_TRUE(has(refused(given("hexahedron", kCube, {0, 1, 2})), "mesh.cells: given 3 indices; 8 per hexahedron"));
  EXPECT_TRUE(has(refused(given("triangle", kCube, {0, 1, 8})), "mesh.cells[2]: given 8; the points are numbered from 0 to 7"));
  EXPECT_TRUE(has(refused(given("hexahedron", kCube, {0, 2, 1, 3, 4, 6, 5, 7})), "1 of 1 cells are inverted"));
  EXPECT_TRUE(has(refused(given("tetrahedron", kCube, {0, 1, 3, 4})), "inline mesh: node 2 at (1, 1, 0) m belongs to no cell"));
  MeshConfig config = given("hexahedron", kCube, {0, 1, 2, 3, 4, 5, 6, 7});
  config.points[6].z() = std::nan("");
  EXPECT_TRUE(has(refused(config), "node 6"));
  config = given("hexahedron", kCube, {0, 1, 2, 3, 4, 5, 6, 7});
  config.unit_scale = 0;
  EXPECT_TRUE(has(refused(config), "mesh.unit_scale: given 0"));
  config.unit_scale = 1, config.url = "a.msh";
  EXPECT_TRUE(has(refused(config), "given both url and points"));
  EXPECT_TRUE(has(refused(file("")), "neither url nor points"));
}

}  // namespace
}  // namespace forming_sim
