// Plane parts of tools: their inner edges and vertices need not be met (find_level_parts).
#include <gtest/gtest.h>

#include <set>

#include "contact/point_bodies.h"
#include "forming_sim/contact/list.h"

using contact_test::sheet;
using contact_test::World;
using namespace forming_sim;

namespace {

constexpr int kCells = 24;

/// Plane on both sides of a ridge at x = 0, which stands `high` above the rims.
Mesh roof(double high) {
  return sheet(kCells, 1, [high](double a, double) { return high * (1 - std::abs(a)); });
}

/// A box of few cells, whose edges and facets are much larger than those of the roof.
World box_on_roof(double high, double speed) {
  World world;
  world.dimension = 3;
  world.add_box(Vec3(-.41, -.37, high + .02), 2, 2, 1, .4, 2700, 5e9);
  world.config.layer = 1e-3;
  for (auto& v : world.v) v = Node(0, 0, -speed, 0);
  world.add_tool("roof", roof(high), .1, [](double) { return Vec3::Zero(); });
  return world;
}

}  // namespace

TEST(ContactLevel, EdgesInsideOfPlaneParts) {
  World world = box_on_roof(.3, 0);
  Features f = build_features(world.setup(), world.x);
  find_level_parts(f);
  const auto at = [&](int v) { return f.place[v - f.body_nodes]; };
  int level = 0, ridge = 0, border = 0;
  for (const Features::Edge& e : f.edges) {
    if (!f.rigid(e.node[0])) {
      EXPECT_FALSE(e.level);  // bodies bend
      continue;
    }
    const bool on_ridge = at(e.node[0])[0] == 0 && at(e.node[1])[0] == 0;
    EXPECT_EQ(e.level, !on_ridge && e.facets == 2);
    level += e.level, ridge += on_ridge, border += e.facets == 1;
  }
  EXPECT_EQ(ridge, kCells);
  EXPECT_EQ(border, 4 * kCells);
  EXPECT_EQ(level, kCells * (3 * kCells + 2) - 4 * kCells - kCells);
  long inner = 0;
  for (std::size_t i = 0; i < f.level_vertex.size(); ++i) inner += f.level_vertex[i];
  EXPECT_EQ(inner, (kCells - 1) * (kCells - 2));
}

// A slope of 2e-6 is none that may be passed over; facets that lie on each other are no plane part.
TEST(ContactLevel, NoMoreThanAPlane) {
  for (const auto& [high, expected] : {std::pair(0., true), std::pair(2e-6, false)}) {
    World world = box_on_roof(high, 0);
    Features f = build_features(world.setup(), world.x);
    find_level_parts(f);
    for (const Features::Edge& e : f.edges)
      if (f.rigid(e.node[0]) && e.facets == 2 && f.place[e.node[0] - f.body_nodes][0] == 0 && f.place[e.node[1] - f.body_nodes][0] == 0) {
        EXPECT_EQ(e.level, expected) << high;
      }
  }
  World world;
  world.dimension = 3;
  world.add_box(Vec3(-.5, -.5, 1), 1, 1, 1, .5, 2700, 5e9);
  world.add_tool("folded", contact_test::triangles({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(.4, .5, 0), Vec3(.6, .7, 0)}, {{0, 1, 2}, {0, 1, 3}}), 0, [](double) { return Vec3::Zero(); });
  Features f = build_features(world.setup(), world.x);
  find_level_parts(f);
  for (const Features::Edge& e : f.edges) EXPECT_FALSE(e.level);
}

// The list lacks what is level, and nothing else.
TEST(ContactLevel, IsLeftOutOfTheList) {
  World world = box_on_roof(.3, 0);
  Features f = build_features(world.setup(), world.x);
  const auto list = [&] {
    Workspace work;
    return build_list(f, world.x, {ToolIndex(f, f.place, {true}), std::vector<ToolMotion>(1), {true}, {false}, {PlanePose()}}, {}, .1, work);
  };
  const NearList whole = list();
  find_level_parts(f);
  const NearList less = list();
  const auto edges_of = [](const NearList& of) {
    std::set<std::pair<int, int>> edges;
    for (const auto& e : of.edges) edges.insert({e.first, e.second});
    return edges;
  };
  const auto facets_of = [](const NearList& of) {
    std::set<std::pair<int, int>> facets;
    for (const auto& g : of.groups)
      for (int i = g.first; i < g.last; ++i) facets.insert({g.vertex, of.facets[i].facet});
    return facets;
  };
  std::set<std::pair<int, int>> edges, facets;
  for (const auto& pair : edges_of(whole))
    if (!f.edges[pair.second].level) edges.insert(pair);
  for (const auto& pair : facets_of(whole))
    if (!f.rigid(pair.first) || !f.level_vertex[pair.first - f.body_nodes]) facets.insert(pair);
  EXPECT_EQ(edges_of(less), edges);
  EXPECT_EQ(facets_of(less), facets);
  EXPECT_LT(5 * edges.size(), edges_of(whole).size());
  EXPECT_GT(edges.size(), 5u);
}

// Large facets and long edges fall on the ridge, and slide down plane sides of small facets, on which nothing but their vertices is met.
TEST(ContactLevel, NothingPasses) {
  for (double high : {0., .05, .6})
    for (double speed : {5., 100.}) {
      World world = box_on_roof(high, speed);
      world.gravity = Vec3(0, 0, -1e4);
      Contact contact = world.make();
      long active = 0;
      for (int i = 0; i < 2000; ++i) {
        world.step(contact, 1e-5);
        active += world.last.active;
      }
      EXPECT_GT(active, 0);
      EXPECT_EQ(world.crossings, 0) << high << " " << speed;
      EXPECT_NEAR(world.closure(), 0, 1e-12 * world.exchanged);
    }
}
