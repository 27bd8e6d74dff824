// Cases in space: edges against edges, corners, grooves, needles, speed.
#include <gtest/gtest.h>

#include "contact/point_bodies.h"
#include "contact/hard_scenes.h"

using contact_test::add_wedge;
using contact_test::ridge;
using contact_test::sheet;
using contact_test::triangles;
using contact_test::World;
using namespace forming_sim;

namespace {

Vec3 still(double) { return Vec3::Zero(); }

}  // namespace

// Two crossed ridges touch between their nodes: only edge against edge can hold them.
TEST(Contact3D, CrossedRidgesAreHeldByTheirEdges) {
  for (double speed : {5., 100., 500.})
    for (double layer : {2e-3, 2e-5}) {
      World world = contact_test::ridges(speed, layer);
      Contact contact = world.make();
      const double dt = 2e-5 * std::min(1., 100 / speed);
      long active = 0;
      for (int i = 0; world.time < .12 / speed + 1e-3 && i < 20000; ++i) {
        world.step(contact, dt);
        active += world.last.active;
      }
      EXPECT_GT(active, 0);
      EXPECT_EQ(world.crossings, 0) << speed << " " << layer;
      EXPECT_GT(world.mean_velocity().z(), 0) << speed << " " << layer;
      EXPECT_NEAR(world.closure(), 0, 1e-12 * world.exchanged);
    }
}

// Knife on knife, parallel or nearly, a little off.
TEST(Contact3D, NearlyParallelEdges) {
  for (double angle : {0., 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1})
    for (double off : {0., 1e-4, 1e-2}) {
      World world = contact_test::knives(angle, off);
      Contact contact = world.make();
      for (int i = 0; i < 300; ++i) world.step(contact, 1e-6);
      EXPECT_EQ(world.crossings, 0) << angle << " " << off;
      EXPECT_LE(world.halvings, 6) << angle << " " << off;
      EXPECT_GT(world.momentum().norm(), 0);
      EXPECT_GT(world.mean_velocity().z(), -299);
      EXPECT_NEAR(world.closure(), 0, 1e-12 * world.exchanged);
    }
}

// A corner of the tool smaller than the body's facets hits in the middle of one.
TEST(Contact3D, CornerInsideAFacet) {
  for (double speed : {50., 500.}) {
    World world;
    world.dimension = 3;
    world.add_box(Vec3(-.5, -.5, 0), 2, 2, 1, .5, 2700, 5e9);
    world.config.layer = 1e-3;
    const double r = .02;
    world.add_tool("pyramid", triangles({Vec3(0, 0, 0), Vec3(r, 0, -.5), Vec3(0, r, -.5), Vec3(-r, -r, -.5)}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}}), .1,
                   [speed](double t) { return Vec3(.21, .33, -.01 + speed * t); });
    Contact contact = world.make();
    for (int i = 0; i < 200; ++i) world.step(contact, 4e-5 * 50 / speed);
    EXPECT_EQ(world.crossings, 0);
    EXPECT_EQ(world.halvings, 0);
    EXPECT_GT(world.momentum().z(), 0);
    EXPECT_NEAR(world.closure(), 0, 1e-12 * world.exchanged);
  }
}

// Bodies that do not match a rough tool, fast, with friction, layers down to a fraction of the step.
TEST(Contact3D, FastImpactOnARoughTool) {
  for (double speed : {50., 500.})
    for (double layer : {5e-3, 1e-4, 1e-6}) {
      World world;
      world.dimension = 3;
      world.add_box(Vec3(-.4, -.35, .08), 5, 4, 2, .15, 2700, 2e9);
      world.config.layer = layer;
      for (auto& v : world.v) v = Node(.2 * speed, .1 * speed, -speed, 0);
      world.add_tool("die", sheet(11, 2, [](double x, double y) { return .06 * std::sin(4 * x) * std::cos(5 * y); }), .15, still);
      Contact contact = world.make();
      const double dt = std::min(2e-5, .02 / speed / 4);
      for (int i = 0; i < 150; ++i) world.step(contact, dt);
      EXPECT_EQ(world.crossings, 0) << speed << " " << layer;
      EXPECT_GT(world.least_gap, 0);
      EXPECT_GT(world.exchanged, 0);
      EXPECT_NEAR(world.closure(), 0, 1e-12 * world.exchanged);
      if (layer > .1 * speed * dt) {
        EXPECT_EQ(world.halvings, 0) << speed << " " << layer;
      }
    }
}

// Needles, facets without area and doubled nodes do no harm.
TEST(Contact3D, DegenerateFacets) {
  World world;
  world.dimension = 3;
  world.add_box(Vec3(-.4, -.4, .02), 4, 4, 1, .2, 2700, 2e9);
  world.config.layer = 1e-3;
  for (auto& v : world.v) v = Node(10, 3, -100, 0);
  Mesh mesh = sheet(6, 1, [](double x, double) { return .02 * x * x; });
  const int a = static_cast<int>(mesh.nodes.size());
  const Vec3 p = mesh.nodes[20], q = mesh.nodes[21];
  mesh.nodes.push_back((p + q) / 2);
  mesh.nodes.push_back((p + q) / 2 + Vec3(0, 1e-12, 0));
  mesh.nodes.push_back(p);
  for (std::array<int, 3> c : {std::array<int, 3>{20, a, 21}, {20, a + 1, 21}, {20, 20, 21}, {a + 2, 21, 20}, {a, a + 1, a + 2}}) {
    Facet f;
    f.nodes = c;
    mesh.surface.push_back(f);
  }
  world.add_tool("die", mesh, .1, still);
  Contact contact = world.make();
  for (int i = 0; i < 200; ++i) {
    world.step(contact, 1e-5);
    for (const Node& v : world.v) ASSERT_TRUE(v.allFinite());
  }
  EXPECT_EQ(world.crossings, 0);
  EXPECT_GT(world.mean_velocity().z(), 0);
}

// A flat body lies on a flat tool of large facets and is dragged: no sideways force, no bumps.
TEST(Contact3D, SlidingOnAFlatToolIsSmooth) {
  World world;
  world.dimension = 3;
  world.add_box(Vec3(-.1, -.08, 0), 4, 3, 1, .05, 2700, 1e8);
  world.gravity = Vec3(0, 0, -2000);
  world.config.layer = 1e-4;
  for (auto& v : world.v) v = Node(7, 4, 0, 0);
  world.add_tool("table", sheet(7, 1, [](double, double) { return 0.; }), 0, still);
  Contact contact = world.make();
  double mass = 0, side = 0;
  for (double m : world.mass) mass += m;
  const double dt = 5e-6;
  for (int i = 0; i < 8000; ++i) {
    world.step(contact, dt, false);
    for (auto& v : world.v) v[2] *= .99;  // settle
    side = std::max(side, std::hypot(world.last.tool_impulse[0].x(), world.last.tool_impulse[0].y()) / (mass * 2000 * dt));
  }
  EXPECT_NEAR(-world.last.tool_impulse[0].z() / (mass * 2000 * dt), 1, .02);
  EXPECT_LT(side, 1e-3);
  EXPECT_NEAR(world.mean_velocity().x(), 7, 1e-3);
  EXPECT_EQ(contact.count_crossings(world.x, world.motion(0, 0)), 0);
}
