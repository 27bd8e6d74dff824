// Nodes chosen by plane, box, cylinder and sphere.
#include "forming_sim/mesh/generate.h"
#include "forming_sim/mesh/sets.h"
#include "mesh/mesh_test_tools.h"

namespace forming_sim {
namespace {

Mesh body(const std::string& shape) {
  BlankConfig b;
  b.shape = shape;
  b.length = 4, b.width = 2, b.thickness = 1;
  b.cells_along = 4, b.cells_across = 2, b.cells_through = 2;
  return generate_blank(b);
}

SetConfig plane(const Vec3& point, const Vec3& normal) {
  SetConfig s;
  s.name = "clamp", s.choose = "plane", s.point = point, s.normal = normal;
  return s;
}

SetConfig box(const Vec3& min, const Vec3& max) {
  SetConfig s;
  s.name = "grip", s.choose = "box", s.min = min, s.max = max;
  return s;
}

TEST(MeshSets, APlaneOnAFaceIsThatFacesSet) {
  const Mesh mesh = body("plate");
  EXPECT_EQ(choose_nodes(mesh, plane({4, 9, 9}, {-7, 0, 0})), mesh.sets.at("right"));
  EXPECT_EQ(choose_nodes(mesh, plane({0, 0, 1}, {0, 0, 1e-3})), mesh.sets.at("top"));
  EXPECT_TRUE(choose_nodes(mesh, plane({4.1, 0, 0}, {1, 0, 0})).empty());
}

TEST(MeshSets, ToleranceIsAMillionthOfTheBodyUnlessGiven) {
  const Mesh mesh = body("plate");
  const double size = size_of(mesh);
  EXPECT_EQ(choose_nodes(mesh, plane({.9e-6 * size, 0, 0}, {1, 0, 0})), mesh.sets.at("left"));
  SetConfig s = plane({1.1e-6 * size, 0, 0}, {1, 0, 0});
  EXPECT_TRUE(choose_nodes(mesh, s).empty());
  s.tolerance = 1.2e-6 * size;
  EXPECT_EQ(choose_nodes(mesh, s), mesh.sets.at("left"));
}

TEST(MeshSets, ABoxTakesWhatLiesInsideAndOnItsFaces) {
  const Mesh mesh = body("plate");
  SetConfig s = box({1, 0, 0}, {2, 2, 1});
  const std::vector<int> chosen = choose_nodes(mesh, s);
  std::vector<int> expected;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (mesh.nodes[n].x() > .9 && mesh.nodes[n].x() < 2.1) expected.push_back(int(n));
  EXPECT_EQ(chosen, expected);
  s.surface_only = true;
  const std::vector<int> outside = choose_nodes(mesh, s);
  EXPECT_LT(outside.size(), chosen.size());
  for (int n : outside) {
    const Vec3& x = mesh.nodes[n];
    EXPECT_TRUE(x.y() == 0 || x.y() == 2 || x.z() == 0 || x.z() == 1) << place(x);
  }
}

TEST(MeshSets, InPlaneStrainZIsIgnored) {
  const Mesh mesh = body("strip");
  EXPECT_EQ(choose_nodes(mesh, box({-1, 1, 5}, {9, 1, 4})), mesh.sets.at("top"));
  EXPECT_EQ(choose_nodes(mesh, plane({0, 0, 7}, {2, 0, 3})), mesh.sets.at("left"));
}

SetConfig round(const std::string& choose, const Vec3& point, double radius) {
  SetConfig s;
  s.name = "rim", s.choose = choose, s.point = point, s.radius = radius;
  return s;
}

/// Of radius 2.
Mesh bar(const std::string& pattern) {
  BlankConfig b;
  b.shape = "bar";
  b.length = 3, b.radius = 2;
  b.cells_along = 2, b.cells_radius = 4;
  b.pattern = pattern;
  return generate_blank(b);
}

TEST(MeshSets, ACylinderOnTheSideOfABarIsItsSide) {
  Mesh mesh = bar("coarse");
  SetConfig s = round("cylinder", {0, 0, 7}, 2);
  EXPECT_EQ(choose_nodes(mesh, s), mesh.sets.at("side"));
  // The same bar, moved and laid along x.
  for (Vec3& X : mesh.nodes) X = Vec3(X.z() + 1, X.x() + 2, X.y() - 5);
  s = round("cylinder", {9, 2, -5}, 2);
  s.axis = Vec3(-0.5, 0, 0);
  EXPECT_EQ(choose_nodes(mesh, s), mesh.sets.at("side"));
  s.radius = 1.9;
  EXPECT_TRUE(choose_nodes(mesh, s).empty());
}

// Centres of faces lie inside the circle on which the corners are.
TEST(MeshSets, FacesOnACylinderAreThereWithTheirCentres) {
  const Mesh mesh = bar("fine");
  EXPECT_EQ(choose_nodes(mesh, round("cylinder", {0, 0, 7}, 2)), mesh.sets.at("side"));
}

TEST(MeshSets, ASphereTakesWhatIsAtItsRadius) {
  for (const char* shape : {"plate", "strip"}) {
    const Mesh mesh = body(shape);
    const Vec3 centre(4, 2, mesh.dimension == 3 ? 0.5 : 0);
    for (const char* choose : {"sphere", "cylinder"}) {
      std::vector<int> expected;
      for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
        Vec3 r = mesh.nodes[n] - centre;
        if (std::string(choose) == "cylinder") r.z() = 0;
        if (std::abs(r.norm() - 2) < 1e-9) expected.push_back(int(n));
      }
      ASSERT_FALSE(expected.empty());
      EXPECT_EQ(choose_nodes(mesh, round(choose, centre, 2)), expected) << shape << ' ' << choose;
    }
  }
}

TEST(MeshSets, NonsenseIsRefusedByTheSetsName) {
  const Mesh mesh = body("strip");
  EXPECT_TRUE(has(error_of([&] { choose_nodes(mesh, plane({0, 0, 0}, {0, 0, 1})); }), "set clamp: the normal"));
  EXPECT_TRUE(has(error_of([&] { choose_nodes(mesh, box({1, 0, 0}, {0, 1, 0})); }), "set grip: the least corner (1, 0, 0) m"));
  SetConfig s = plane({0, 0, 0}, {1, 0, 0});
  s.choose = "cone";
  EXPECT_TRUE(has(error_of([&] { choose_nodes(mesh, s); }), "\"cone\"; plane, box, cylinder or sphere"));
}

}  // namespace
}  // namespace forming_sim
