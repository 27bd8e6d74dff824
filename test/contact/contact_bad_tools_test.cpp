// Tools as files give them: any orientation, facets twice, nodes apart, needles, cracks, surfaces through each other.
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "contact/point_bodies.h"

using contact_test::polyline;
using contact_test::sheet;
using contact_test::World;
using namespace forming_sim;

namespace {

constexpr double h0 = 1e-3;

Vec3 still(double) { return Vec3::Zero(); }

Mesh clean() {
  return sheet(8, 1.5, [](double x, double y) { return .06 * std::sin(4 * x) * std::cos(5 * y); });
}

/// A box thrown at the tool, after 400 steps.
World thrown_at(const Mesh& tool, double friction = .2) {
  World world;
  world.dimension = 3;
  world.config.layer = h0;
  world.add_box(Vec3(-.3, -.3, .12), 4, 4, 1, .15, 2700, 2e9);
  for (auto& v : world.v) v = Node(20, 10, -60, 0);
  world.add_tool("die", tool, friction, still);
  Contact contact = world.make();
  for (int i = 0; i < 400; ++i) world.step(contact, 1e-5, i % 10 == 0);
  return world;
}

bool same(const World& a, const World& b) {
  return std::memcmp(a.x.data(), b.x.data(), a.x.size() * sizeof(Node)) == 0 && std::memcmp(a.v.data(), b.v.data(), a.v.size() * sizeof(Node)) == 0;
}

void add_facet(Mesh& mesh, int a, int b, int c) {
  Facet f;
  f.nodes = {a, b, c};
  mesh.surface.push_back(f);
}

/// A square falls with a corner onto the middle of a tool in the plane; `lowest`: how far the corner came.
World corner_onto(const Mesh& tool, double& lowest) {
  World world;
  world.config.layer = h0;
  world.add_strip(Vec3(-.1, .05, 0), 2, 2, .1, .1, 2700, 2e9, M_PI / 4);  // its lowest corner at x = -.1
  for (auto& v : world.v) v = Node(0, -50, 0, 0);
  world.add_tool("plate", tool, 0, [](double) { return Vec3(-.1, 0, 0); });
  Contact contact = world.make();
  lowest = 1;
  for (int i = 0; i < 300; ++i) {
    world.step(contact, 1e-5);
    lowest = std::min(lowest, world.x[0][1]);
  }
  return world;
}

Mesh plate_with_a_gap(double width) {
  Mesh mesh = polyline({Vec3(-2, 0, 0), Vec3(-width / 2, 0, 0)});
  const Mesh right = polyline({Vec3(width / 2, 0, 0), Vec3(2, 0, 0)});
  mesh.nodes.insert(mesh.nodes.end(), right.nodes.begin(), right.nodes.end());
  Facet f;
  f.nodes = {2, 3, -1};
  mesh.surface.push_back(f);
  return mesh;
}

}  // namespace

// What says the same surface gives the same bits.
TEST(ContactBadTools, TheSameSurfaceGivesTheSameBits) {
  const World wanted = thrown_at(clean());
  EXPECT_GT(wanted.exchanged, 0);
  EXPECT_EQ(wanted.crossings, 0);
  std::mt19937 random(3);

  Mesh reversed = clean(), mixed = clean(), shuffled = clean(), twice = clean(), soup = clean(), collapsed = clean(), unused = clean();
  for (Facet& f : reversed.surface) std::swap(f.nodes[0], f.nodes[1]);
  for (Facet& f : mixed.surface)
    if (random() % 2) std::swap(f.nodes[0], f.nodes[2]);
  std::shuffle(shuffled.surface.begin(), shuffled.surface.end(), random);
  for (size_t i = 0, n = twice.surface.size(); i < n; i += 3) add_facet(twice, twice.surface[i].nodes[1], twice.surface[i].nodes[0], twice.surface[i].nodes[2]);
  soup.nodes.clear();
  for (Facet& f : soup.surface)
    for (int& n : f.nodes) {
      soup.nodes.push_back(clean().nodes[n]);
      n = static_cast<int>(soup.nodes.size()) - 1;
    }
  collapsed.nodes.push_back(collapsed.nodes[40]);
  add_facet(collapsed, 40, 40, 41);
  add_facet(collapsed, 40, static_cast<int>(collapsed.nodes.size()) - 1, 41);
  unused.nodes.push_back(Vec3(.1, .1, 1));

  const std::pair<const char*, const Mesh*> meshes[] = {{"reversed", &reversed}, {"mixed", &mixed}, {"shuffled", &shuffled}, {"twice", &twice}, {"soup", &soup}, {"collapsed", &collapsed}, {"unused", &unused}};
  for (const auto& [name, mesh] : meshes) EXPECT_TRUE(same(thrown_at(*mesh), wanted)) << name;
}

// Facets without area on the surface, and needles in it, bring vertices of their own and change nothing else.
TEST(ContactBadTools, FacetsWithoutAreaAndNeedlesDoNoHarm) {
  const World wanted = thrown_at(clean(), 0);
  Mesh flat = clean(), needles = clean();
  const auto middle = [](Mesh& mesh, int a, int b, const Vec3& off) {
    mesh.nodes.push_back((mesh.nodes[a] + mesh.nodes[b]) / 2 + off);
    return static_cast<int>(mesh.nodes.size()) - 1;
  };
  for (int a : {30, 39, 40, 41, 48, 49}) add_facet(flat, a, middle(flat, a, a + 1, Vec3::Zero()), a + 1);
  for (int a : {30, 39, 40, 41, 48, 49}) add_facet(needles, a, middle(needles, a, a + 1, Vec3(0, 1e-9, 0)), a + 1);
  for (const Mesh* mesh : {&flat, &needles}) {
    const World found = thrown_at(*mesh, 0);
    EXPECT_EQ(found.crossings, 0);
    EXPECT_EQ(found.halvings, wanted.halvings);
    for (const Node& v : found.v) ASSERT_TRUE(v.allFinite());
    EXPECT_LT((found.mean_velocity() - wanted.mean_velocity()).norm(), .02 * 60) << found.mean_velocity().transpose() << " / " << wanted.mean_velocity().transpose();
  }
}

// A crack narrower than the layer is closed; a hole is a hole.
TEST(ContactBadTools, CracksAreTightAndHolesAreNot) {
  for (double width : {0., 1e-6 * h0, .5 * h0, h0}) {
    double lowest;
    const World world = corner_onto(plate_with_a_gap(width), lowest);
    EXPECT_EQ(world.crossings, 0) << width;
    EXPECT_GT(lowest, -2 * h0) << width << ": the node went through the crack";
    EXPECT_GT(world.mean_velocity().y(), 0) << width;
  }
  double lowest;
  const World world = corner_onto(plate_with_a_gap(.02), lowest);
  EXPECT_LT(lowest, -2 * h0) << "the control: a gap of 20 layers lets the corner in";
  EXPECT_EQ(world.crossings, 0) << "and its rim holds the sides";
}

TEST(ContactBadTools, AHoleOfThreeFacetsLetsACornerIn) {
  double lowest[2];
  for (int with_hole = 0; with_hole < 2; ++with_hole) {
    Mesh mesh = sheet(6, 1.2, [](double, double) { return 0.; });
    // Facets around the node 16 at (-.4, -.4): three of the six.
    if (with_hole) {
      std::vector<Facet> left;
      int gone = 0;
      for (const Facet& f : mesh.surface) {
        const bool at = f.nodes[0] == 16 || f.nodes[1] == 16 || f.nodes[2] == 16;
        if (at && gone < 3)
          ++gone;
        else
          left.push_back(f);
      }
      mesh.surface = left;
    }
    World world;
    world.dimension = 3;
    world.config.layer = h0;
    world.add_box(Vec3(-.05, -.05, -.05), 1, 1, 1, .1, 2700, 1e8);
    // Stand it on a corner.
    const Mat3 turn = Eigen::Quaterniond::FromTwoVectors(Vec3(-1, -1, -1), Vec3(0, 0, -1)).toRotationMatrix();
    for (Node& x : world.x) x = node(Vec3(turn * vec3(x) + Vec3(-.55, -.47, .1)));
    for (auto& v : world.v) v = Node(0, 0, -50, 0);
    world.add_tool("die", mesh, 0, still);
    Contact contact = world.make();
    lowest[with_hole] = 1;
    for (int i = 0; i < 300; ++i) {
      world.step(contact, 1e-5);
      for (const Node& x : world.x) lowest[with_hole] = std::min(lowest[with_hole], x[2]);
    }
    EXPECT_EQ(world.crossings, 0);
  }
  EXPECT_GT(lowest[0], -2 * h0);
  EXPECT_LT(lowest[1], -.02);
}

// A tool whose parts go through each other: the body sees the nearer of both.
TEST(ContactBadTools, AToolThatGoesThroughItself) {
  Mesh cross = polyline({Vec3(-1, -.3, 0), Vec3(1, .3, 0)});
  const Mesh other = polyline({Vec3(-1, .3, 0), Vec3(1, -.3, 0)});
  cross.nodes.insert(cross.nodes.end(), other.nodes.begin(), other.nodes.end());
  Facet f;
  f.nodes = {2, 3, -1};
  cross.surface.push_back(f);
  World world;
  world.config.layer = h0;
  world.add_strip(Vec3(-.3, .3, 0), 6, 2, .1, .1, 2700, 2e9);
  for (auto& v : world.v) v = Node(10, -60, 0, 0);
  world.add_tool("cross", cross, .1, still);
  Contact contact = world.make();
  for (int i = 0; i < 1500; ++i) world.step(contact, 1e-5, i % 3 == 0);
  EXPECT_EQ(world.crossings, 0);
  EXPECT_GT(world.mean_velocity().y(), 0);
}
