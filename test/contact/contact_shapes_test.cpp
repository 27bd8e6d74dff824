// Shapes that leave a contact no good direction, dropped onto one another; narrow fits.
#include <gtest/gtest.h>

#include "contact/point_bodies.h"

using contact_test::polyline;
using contact_test::triangles;
using contact_test::World;
using namespace forming_sim;

namespace {

constexpr double h0 = 1e-3;

Mesh shape(const std::string& name) {
  const double w = .02;  // of what is thin
  if (name == "spike") return polyline({Vec3(-1, -1, 0), Vec3(-w, -1, 0), Vec3(0, 0, 0), Vec3(w, -1, 0), Vec3(1, -1, 0)});
  if (name == "wedge") return polyline({Vec3(-1, -.5, 0), Vec3(0, 0, 0), Vec3(1, -.5, 0)});
  if (name == "cliff") return polyline({Vec3(-1, 0, 0), Vec3(0, 0, 0), Vec3(0, -.5, 0), Vec3(1, -.5, 0)});
  if (name == "overhang") return polyline({Vec3(-1, 0, 0), Vec3(0, 0, 0), Vec3(-.3, -.5, 0), Vec3(1, -.5, 0)});
  if (name == "crack") return polyline({Vec3(-1, 0, 0), Vec3(-w / 2, 0, 0), Vec3(0, -.5, 0), Vec3(w / 2, 0, 0), Vec3(1, 0, 0)});
  if (name == "hole") return polyline({Vec3(-1, 0, 0), Vec3(-.09, 0, 0), Vec3(-.09, -.3, 0), Vec3(.09, -.3, 0), Vec3(.09, 0, 0), Vec3(1, 0, 0)});
  // flat, of facets from a tenth of the layer on
  return polyline({Vec3(-1, 0, 0), Vec3(-.1, 0, 0), Vec3(-1e-4, 0, 0), Vec3(0, 0, 0), Vec3(1e-4, 0, 0), Vec3(3e-4, 0, 0), Vec3(.05, 0, 0), Vec3(1, 0, 0)});
}

/// A body whose underside has the shape too, its corners kept off the sides.
void add_body(World& world, const std::string& name, double x, double y) {
  std::vector<Vec3> outline;
  if (name == "spike") outline = {Vec3(-.2, .4, 0), Vec3(-.02, .4, 0), Vec3(0, 0, 0), Vec3(.02, .4, 0), Vec3(.2, .4, 0), Vec3(.2, .6, 0), Vec3(-.2, .6, 0)};
  if (name == "wedge") outline = {Vec3(-.3, .3, 0), Vec3(0, 0, 0), Vec3(.3, .3, 0), Vec3(0, .6, 0)};
  if (name == "cliff") outline = {Vec3(-.3, .25, 0), Vec3(0, .25, 0), Vec3(0, 0, 0), Vec3(.3, 0, 0), Vec3(.3, .6, 0), Vec3(-.3, .6, 0)};
  if (name == "overhang") outline = {Vec3(-.3, .25, 0), Vec3(.1, .25, 0), Vec3(0, 0, 0), Vec3(.3, 0, 0), Vec3(.3, .6, 0), Vec3(-.3, .6, 0)};
  if (name == "crack") outline = {Vec3(-.3, 0, 0), Vec3(-.01, 0, 0), Vec3(0, .3, 0), Vec3(.01, 0, 0), Vec3(.3, 0, 0), Vec3(.3, .6, 0), Vec3(-.3, .6, 0)};
  if (name == "hole") outline = {Vec3(-.3, 0, 0), Vec3(-.1, 0, 0), Vec3(-.1, .3, 0), Vec3(.1, .3, 0), Vec3(.1, 0, 0), Vec3(.3, 0, 0), Vec3(.3, .6, 0), Vec3(-.3, .6, 0)};
  if (name == "facets") outline = {Vec3(-.3, 0, 0), Vec3(-1e-4, 0, 0), Vec3(0, 0, 0), Vec3(2e-4, 0, 0), Vec3(.3, 0, 0), Vec3(.3, .6, 0), Vec3(-.3, .6, 0)};
  for (Vec3& p : outline) p += Vec3(x, y, 0);
  world.add_polygon(outline, 10, 1e8);
}

constexpr const char* kShapes[] = {"spike", "wedge", "cliff", "overhang", "crack", "hole", "facets"};

}  // namespace

// Each shape onto each, exactly aligned and a little off, at 5 and 200 m/s.
TEST(ContactShapes, EachOntoEach) {
  long most = 0;
  for (const char* below : kShapes)
    for (const char* above : kShapes)
      for (double off : {0., 1e-9, 3e-4})
        for (double speed : {5., 200.}) {
          World world;
          world.config.layer = h0;
          world.modulus = 1e9;
          add_body(world, above, off, .012);
          for (auto& v : world.v) v = Node(0, -speed, 0, 0);
          world.add_tool("tool", shape(below), .2, [](double) { return Vec3::Zero(); });
          world.gravity = Vec3(0, -1000, 0);
          const double dt = 1e-5;
          try {
            Contact contact = world.make();
            for (int i = 0; i < 1000; ++i) world.step(contact, dt, i % 4 == 0);
          } catch (const Error& e) {
            ADD_FAILURE() << above << " onto " << below << ", off " << off << ", " << speed << " m/s: " << e.what();
            continue;
          }
          EXPECT_EQ(world.crossings, 0) << above << " onto " << below << ", off " << off << ", " << speed << " m/s";
          if (speed > 100) {
            EXPECT_GT(world.exchanged, 0) << "it must have got there";
          }
          EXPECT_NEAR(world.closure(), 0, 1e-10 * world.exchanged);
          for (const Node& v : world.v) EXPECT_TRUE(v.allFinite());
          most = std::max(most, world.halvings);
        }
  std::cout << "  halvings at most " << most << "\n";
}

// Two boxes whose faces are split along other diagonals, dropped flat: the edges inside the faces bring no sideways push.
TEST(ContactShapes, InnerEdgesOfFlatFaces) {
  World world;
  world.dimension = 3;
  world.config.layer = 1e-4;
  world.modulus = 1e9;
  world.add_box(Vec3(0, 0, 0), 4, 4, 1, .1, 2700, 1e8);
  const size_t split = world.x.size();
  world.add_box(Vec3(.013, .007, .1005), 3, 5, 1, .09, 2700, 1e8);
  for (size_t i = split; i < world.x.size(); ++i) world.v[i] = Node(0, 0, -2, 0);
  const Vec3 p = world.momentum();
  Contact contact = world.make();
  double side = 0;
  for (int i = 0; i < 500; ++i) {
    world.step(contact, 1e-5, i % 5 == 0);
    Vec3 upper = Vec3::Zero();
    for (size_t n = split; n < world.x.size(); ++n) upper += world.mass[n] * vec3(world.v[n]);
    side = std::max(side, std::hypot(upper.x(), upper.y()));
  }
  EXPECT_GT(world.exchanged, 0);
  EXPECT_LT(side, 2e-3 * p.norm());
  EXPECT_EQ(world.crossings, 0);
  EXPECT_EQ(world.halvings, 0);
  EXPECT_LT((world.momentum() - p).norm(), 1e-12 * p.norm());
}

// A block falls into a slot wider by a millionth of its size: the layer is thinner than the room on either side.
TEST(ContactShapes, ASlotWiderByAMillionth) {
  for (double tilt : {0., 1e-7}) {
    World world;
    const double size = .2, room = 1e-6 * size;
    world.config.layer = .1 * room;
    world.modulus = 1e9;
    world.add_strip(Vec3(-size / 2, .5, 0), 2, 2, .1, .1, 2700, 1e9, tilt);
    for (Node& v : world.v) v = Node(0, -5, 0, 0);
    const double half = size / 2 + room / 2;
    world.add_tool("slot", polyline({Vec3(-half - .5, 1, 0), Vec3(-half, .45, 0), Vec3(-half, 0, 0), Vec3(half, 0, 0), Vec3(half, .45, 0), Vec3(half + .5, 1, 0)}), 0,
                   [](double) { return Vec3::Zero(); });
    Contact contact = world.make();
    double lowest = 1;
    for (int i = 0; i < 12000; ++i) {
      world.step(contact, 1e-5, i % 10 == 0);
      lowest = std::min(lowest, world.x[0][1]);
    }
    EXPECT_EQ(world.crossings, 0) << tilt;
    EXPECT_LT(lowest, 1e-3) << tilt << ": it reaches the ground of the slot";
    EXPECT_LT(world.halvings, 100) << tilt;
    EXPECT_NEAR(world.closure(), 0, 1e-10 * world.exchanged);
  }
}

// A box through a hole of a plate that is wider than it by a hundredth.
TEST(ContactShapes, ThroughAHole) {
  World world;
  world.dimension = 3;
  world.config.layer = 1e-4;
  world.modulus = 1e9;
  world.add_box(Vec3(-.1, -.1, .05), 2, 2, 2, .1, 2700, 1e8);
  for (Node& v : world.v) v = Node(.05, -.03, -10, 0);
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> corners;
  const double inner = .101, outer = .5;
  for (double r : {inner, outer})
    for (int k = 0; k < 4; ++k) points.emplace_back(k == 0 || k == 3 ? -r : r, k < 2 ? -r : r, 0);
  for (int k = 0; k < 4; ++k) {
    const int l = (k + 1) % 4;
    corners.push_back({k, l, 4 + l});
    corners.push_back({k, 4 + l, 4 + k});
  }
  world.add_tool("plate", triangles(points, corners), .1, [](double) { return Vec3::Zero(); });
  Contact contact = world.make();
  for (int i = 0; i < 4000; ++i) world.step(contact, 1e-5, i % 5 == 0);
  double highest = -1;
  for (const Node& x : world.x) highest = std::max(highest, x[2]);
  EXPECT_LT(highest, 0) << "it went through the hole";
  EXPECT_EQ(world.crossings, 0) << "and through nothing else";
  EXPECT_NEAR(world.closure(), 0, 1e-10 * (world.exchanged + 1e-12));
}
