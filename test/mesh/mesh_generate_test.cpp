// Generated blanks: volumes, conforming cells, sets.
#include <array>
#include <cmath>
#include <set>

#include "forming_sim/mesh/generate.h"
#include "mesh/mesh_test_tools.h"

namespace forming_sim {
namespace {

BlankConfig strip() {
  BlankConfig b;
  b.shape = "strip";
  b.origin = {.5, -1, 0};
  b.length = 3, b.thickness = .5, b.cells_along = 6, b.cells_through = 2;
  return b;
}

BlankConfig plate() {
  BlankConfig b;
  b.shape = "plate";
  b.origin = {-1, 2, 3};
  b.length = 4, b.width = 2, b.thickness = .5;
  b.cells_along = 4, b.cells_across = 3, b.cells_through = 2;
  return b;
}

BlankConfig bar(const std::string& portion, int cells) {
  BlankConfig b;
  b.shape = "bar";
  b.origin = {1, 2, 3};
  b.radius = .1, b.length = .5, b.portion = portion, b.cells_radius = cells, b.cells_along = 3;
  return b;
}

// The surface must be the boundary and nothing else: cells that do not match
// their neighbours leave facets inside, which add area.
void expect_sound(const Mesh& mesh, double expected_area) {
  EXPECT_LT(sum_of_areas(mesh).norm(), 1e-12 * expected_area);
  EXPECT_NEAR(area(mesh), expected_area, 1e-9 * expected_area);
  EXPECT_NEAR(enclosed(mesh), volume(mesh), 1e-9 * volume(mesh));
  if (mesh.dimension == 3) { EXPECT_EQ(euler_characteristic(mesh), 2); }
  for (const auto& s : mesh.simplices()) ASSERT_GT(signed_volume(mesh.nodes, s, mesh.dimension), 0);
}

TEST(MeshGenerate, StripFillsItsRectangle) {
  for (const char* pattern : {"fine", "coarse", "one_point"}) {
    BlankConfig b = strip();
    b.pattern = pattern;
    const Mesh mesh = generate_blank(b);
    EXPECT_EQ(mesh.dimension, 2);
    EXPECT_EQ(mesh.simplex_count(), b.pattern == "fine" ? 48 : 24);
    EXPECT_EQ(mesh.nodes.size(), b.pattern == "fine" ? 21u + 12u : 21u);
    EXPECT_NEAR(volume(mesh), 1.5, 1e-14);
    expect_sound(mesh, 7);
    EXPECT_EQ(bounds(mesh).min(), Vec3(.5, -1, 0));
    EXPECT_EQ(bounds(mesh).max(), Vec3(3.5, -.5, 0));
    EXPECT_EQ(mesh.sets.at("left").size(), 3u);
    EXPECT_EQ(mesh.sets.at("top").size(), 7u);
    for (int n : mesh.sets.at("right")) EXPECT_EQ(mesh.nodes[n].x(), 3.5);
    for (int n : mesh.sets.at("bottom")) EXPECT_EQ(mesh.nodes[n].y(), -1);
  }
}

TEST(MeshGenerate, PlateFillsItsBoxAndItsSetsHoldTheFaceCentres) {
  for (const char* pattern : {"fine", "coarse", "one_point"}) {
    BlankConfig b = plate();
    b.pattern = pattern;
    const bool fine = b.pattern == "fine";
    const Mesh mesh = generate_blank(b);
    EXPECT_EQ(mesh.simplex_count(), 24 * (fine ? 24 : 6));
    // corners; cell centres; faces along x, y and z
    EXPECT_EQ(int(mesh.nodes.size()), 5 * 4 * 3 + (fine ? 24 + 5 * 3 * 2 + 4 * 4 * 2 + 4 * 3 * 3 : 0));
    EXPECT_NEAR(volume(mesh), 4, 1e-13);
    expect_sound(mesh, 2 * (8 + 2 + 1));
    const std::map<std::string, std::pair<int, double>> planes = {
        {"left", {0, -1}}, {"right", {0, 3}}, {"front", {1, 2}}, {"back", {1, 4}}, {"bottom", {2, 3}}, {"top", {2, 3.5}}};
    ASSERT_EQ(mesh.sets.size(), planes.size());
    for (const auto& [name, plane] : planes) {
      std::vector<int> expected;
      for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
        if (std::abs(mesh.nodes[n][plane.first] - plane.second) < 1e-12) expected.push_back(int(n));
      EXPECT_EQ(mesh.sets.at(name), expected) << name;
    }
  }
}

class Bar : public testing::TestWithParam<std::tuple<const char*, const char*, int>> {};

TEST_P(Bar, IsConformingAndItsSurfaceIsTheBoundary) {
  const auto [portion, pattern, cells] = GetParam();
  BlankConfig b = bar(portion, cells);
  b.pattern = pattern;
  const Mesh mesh = generate_blank(b);
  const double share = b.portion == "full" ? 1 : b.portion == "half" ? .5 : .25;
  // The circle is a polygon of nodes on it, whose chords give the boundary exactly.
  const int core = std::max(1, std::min(cells - 1, int(std::lround(.55 * cells))));
  const int sides = int(8 * core * share);
  const double turn = 2 * M_PI / (8 * core), r = b.radius;
  const double section = sides * r * r * std::sin(turn) / 2;
  const double outline = sides * 2 * r * std::sin(turn / 2) + (share < 1 ? 2 * r : 0);
  EXPECT_NEAR(volume(mesh), section * b.length, 1e-12 * b.length);
  expect_sound(mesh, 2 * section + outline * b.length);

  EXPECT_EQ(mesh.sets.size(), b.portion == "full" ? 3u : b.portion == "half" ? 4u : 5u);
  const auto expect_set = [&](const char* name, auto&& inside) {
    std::vector<int> expected;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
      if (inside(Vec3(mesh.nodes[n] - b.origin))) expected.push_back(int(n));
    EXPECT_EQ(mesh.sets.at(name), expected) << name;
    EXPECT_FALSE(expected.empty());
  };
  expect_set("bottom", [&](const Vec3& x) { return std::abs(x.z()) < 1e-9; });
  expect_set("top", [&](const Vec3& x) { return std::abs(x.z() - b.length) < 1e-9; });
  // face centres lie on the chords, at least cos(turn / 2) of the radius away
  expect_set("side", [&](const Vec3& x) { return x.head<2>().norm() > r * std::cos(turn / 2) * (1 - 1e-9); });
  if (share < 1) expect_set("symmetry_x", [&](const Vec3& x) { return std::abs(x.x()) < 1e-9; });
  if (b.portion == "quarter") expect_set("symmetry_y", [&](const Vec3& x) { return std::abs(x.y()) < 1e-9; });
}

INSTANTIATE_TEST_SUITE_P(MeshGenerate, Bar,
                         testing::Combine(testing::Values("full", "half", "quarter"),
                                          testing::Values("fine", "coarse", "one_point"), testing::Values(2, 3, 7, 10)));

TEST(MeshGenerate, VolumeOfABarConvergesWithTheSquareOfTheCellSize) {
  double error[2];
  for (int i = 0; i < 2; ++i) {
    const BlankConfig b = bar("quarter", i ? 40 : 20);
    error[i] = 1 - volume(generate_blank(b)) / (M_PI / 4 * b.radius * b.radius * b.length);
  }
  EXPECT_GT(error[1], 0);
  EXPECT_LT(error[0], 1e-3);
  EXPECT_NEAR(error[0] / error[1], 4, .01);
}

TEST(MeshGenerate, CellsOfABarAreWellShaped) {
  BlankConfig b = bar("full", 10);
  b.length = .03;  // cells as high as the radius over cells_radius
  b.pattern = "coarse";
  const Mesh mesh = generate_blank(b);
  const double h = b.radius / b.cells_radius;
  for (const Cells& block : mesh.cells)
    for (int c = 0; c < block.count(); ++c)
      for (int k = 0; k < 4; ++k) {  // corners of the bottom face
        const int* n = &block.nodes[8 * c];
        const Vec3 x = mesh.nodes[n[k]], a = mesh.nodes[n[(k + 1) % 4]] - x, d = mesh.nodes[n[(k + 3) % 4]] - x;
        const double angle = std::acos(a.dot(d) / a.norm() / d.norm()) * 180 / M_PI;
        EXPECT_GT(angle, 50);
        EXPECT_LT(angle, 145);
        EXPECT_GT(a.norm(), .5 * h);
        EXPECT_LT(a.norm(), 1.6 * h);
      }
}

BlankConfig tube(const std::string& portion, int around) {
  BlankConfig b;
  b.shape = "tube";
  b.origin = {1, 2, 3};
  b.radius = .1, b.thickness = .02, b.length = .5, b.portion = portion, b.cells_around = around, b.cells_along = 3, b.cells_through = 2;
  return b;
}

class Tube : public testing::TestWithParam<std::tuple<const char*, const char*, int>> {};

TEST_P(Tube, FillsItsWallAndItsSetsAreItsSides) {
  const auto [portion, pattern, around] = GetParam();
  BlankConfig b = tube(portion, around);
  b.pattern = pattern;
  const bool full = b.portion == "full", quarter = b.portion == "quarter";
  const double share = full ? 1 : quarter ? .25 : .5;
  if (std::fmod(around * share, 1) != 0) {
    EXPECT_TRUE(has(error_of([&] { generate_blank(b); }, Code::invalid_scene), "blank.cells_around: given"));
    return;
  }
  const Mesh mesh = generate_blank(b);
  const double turn = 2 * M_PI / around, sides = around * share, r = b.radius, i = b.radius - b.thickness;
  const double section = sides * (r * r - i * i) * std::sin(turn) / 2, outline = sides * 2 * (r + i) * std::sin(turn / 2) + (full ? 0 : 2 * b.thickness);
  EXPECT_NEAR(volume(mesh), section * b.length, 1e-12 * b.length);
  const double whole = 2 * section + outline * b.length;
  EXPECT_LT(sum_of_areas(mesh).norm(), 1e-12 * whole);
  if (full || b.pattern != "fine") { EXPECT_NEAR(area(mesh), whole, 1e-9 * whole); }
  EXPECT_NEAR(enclosed(mesh), volume(mesh), 1e-9 * volume(mesh));
  EXPECT_EQ(euler_characteristic(mesh), full ? 0 : 2);
  EXPECT_EQ(mesh.sets.size(), full ? 4u : quarter ? 6u : 5u);
  const auto expect_set = [&](const char* name, auto&& there) {
    std::vector<int> expected;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
      if (there(Vec3(mesh.nodes[n] - b.origin))) expected.push_back(int(n));
    EXPECT_EQ(mesh.sets.at(name), expected) << name;
    EXPECT_FALSE(expected.empty());
  };
  const double chord = std::cos(turn / 2) * (1 - 1e-9);
  expect_set("start", [](const Vec3& x) { return std::abs(x.z()) < 1e-12; });
  expect_set("end", [&](const Vec3& x) { return std::abs(x.z() - b.length) < 1e-12; });
  if (around > 8) {  // where chords do not cut into the layer below
    expect_set("outside", [&](const Vec3& x) { return x.head<2>().norm() > r * chord; });
    expect_set("inside", [&](const Vec3& x) { return x.head<2>().norm() < i * (1 + 1e-9); });
  }
  if (!full) expect_set("symmetry_x", [](const Vec3& x) { return x.x() == 0; });
  if (quarter) expect_set("symmetry_y", [](const Vec3& x) { return x.y() == 0; });
}

INSTANTIATE_TEST_SUITE_P(MeshGenerate, Tube,
                         testing::Combine(testing::Values("full", "half", "quarter"), testing::Values("fine", "coarse", "one_point"), testing::Values(3, 8, 14, 20)));

TEST(MeshGenerate, WholeFacesOfATubeMirrorAboutItsPlanesOfSymmetry) {
  BlankConfig b = tube("full", 16);
  b.origin.setZero();
  b.cells_along = 4;
  b.pattern = "one_point";
  const Mesh mesh = generate_blank(b);
  std::set<std::array<long, 9>> facets;
  const auto key = [](const Mesh& m, const Facet& facet, const Vec3& flip, double shift) {
    std::array<std::array<long, 3>, 3> corners;
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < 3; ++k) corners[c][k] = std::lround(1e9 * (flip[k] * m.nodes[facet.nodes[c]][k] + (k == 2 ? shift : 0)));
    std::sort(corners.begin(), corners.end());
    std::array<long, 9> all;
    for (int c = 0; c < 3; ++c) std::copy(corners[c].begin(), corners[c].end(), all.begin() + 3 * c);
    return all;
  };
  for (const Facet& facet : mesh.surface) facets.insert(key(mesh, facet, {1, 1, 1}, 0));
  for (const Facet& facet : mesh.surface) {
    EXPECT_EQ(facets.count(key(mesh, facet, {-1, 1, 1}, 0)), 1u);
    EXPECT_EQ(facets.count(key(mesh, facet, {1, -1, 1}, 0)), 1u);
    // The ends have no mirrored diagonals of their own: they lie on the mirrored ones.
    EXPECT_EQ(facets.count(key(mesh, facet, {1, 1, -1}, b.length)), 1u);
  }
}

TEST(MeshGenerate, NonsenseIsRefusedByItsField) {
  const auto refused = [](BlankConfig b) { return error_of([&] { generate_blank(b); }, Code::invalid_scene); };
  BlankConfig b = strip();
  b.length = 0;
  EXPECT_TRUE(has(refused(b), "blank.length: given 0"));
  b = strip();
  b.length = std::nan("");
  EXPECT_TRUE(has(refused(b), "blank.length: given nan"));
  b = strip();
  b.origin.z() = 1;
  EXPECT_TRUE(has(refused(b), "blank.origin"));
  b = plate();
  b.cells_across = 0;
  EXPECT_TRUE(has(refused(b), "blank.cells_across: given 0"));
  b = plate();
  b.pattern = "medium";
  EXPECT_TRUE(has(refused(b), "\"medium\""));
  b = bar("third", 4);
  EXPECT_TRUE(has(refused(b), "\"third\""));
  b = bar("full", 1);
  EXPECT_TRUE(has(refused(b), "blank.cells_radius: given 1"));
  b = tube("full", 2);
  EXPECT_TRUE(has(refused(b), "blank.cells_around: given 2"));
  b = tube("full", 8);
  b.thickness = b.radius;
  EXPECT_TRUE(has(refused(b), "blank.thickness: given 0.1"));
  b.shape = "cone";
  EXPECT_TRUE(has(refused(b), "\"cone\""));
}

}  // namespace
}  // namespace forming_sim
