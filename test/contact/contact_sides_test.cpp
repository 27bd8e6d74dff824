// Tools whose facets do not agree on what is outside: they do as their outline does, set back by the layer and no more.
#include <gtest/gtest.h>

#include "contact/point_bodies.h"

using contact_test::polyline;
using contact_test::sheet;
using contact_test::triangles;
using contact_test::World;
using namespace forming_sim;

namespace {

constexpr double h0 = 1e-3;

Vec3 at(double x, double y) { return Vec3(x, y, 0); }

/// A block of 1 x .2 at rest under a tool that comes down by .02, `lift` above it at the start.
World pressed(const Mesh& tool, double lift, std::string& warnings) {
  World world;
  world.config.layer = h0;
  world.add_strip(at(-.5, -.2), 20, 4, .05, .05, 2700, 2e9);
  for (int i = 0; i <= 20; ++i) world.held.push_back({i, Mat3::Zero()}), world.held_velocity.push_back(Node::Zero());
  world.add_tool("punch", tool, .2, [lift](double t) { return Vec3(0, lift - 10 * t, 0); });
  Contact contact = world.make();
  for (const std::string& warning : contact.warnings()) warnings += warning;
  for (int i = 0; i < 400; ++i) world.step(contact, 5e-6);
  return world;
}

/// The largest distance of nodes between two runs, in layers.
double apart(const World& a, const World& b) {
  double most = 0;
  for (size_t i = 0; i < a.x.size(); ++i) most = std::max(most, (a.x[i] - b.x[i]).norm());
  return most / h0;
}

void expect_the_same(const Mesh& tool, const Mesh& outline) {
  for (double lift : {0., 10 * h0}) {
    std::string wanted_warnings, warnings;
    const World wanted = pressed(outline, lift, wanted_warnings), found = pressed(tool, lift, warnings);
    EXPECT_GT(wanted.exchanged, 0);
    EXPECT_EQ(found.crossings, 0);
    EXPECT_LT(apart(found, wanted), .02) << "layers, with a lift of " << lift;
    EXPECT_EQ(warnings.find("both sides"), std::string::npos) << warnings;
  }
}

}  // namespace

TEST(ContactSides, AProfileThatRetracesItsWay) {
  const Mesh outline = polyline({at(-.3, .3), at(-.3, .05), at(-.25, 0), at(.25, 0), at(.3, .05), at(.3, .3)});
  // up into the tool and down again; back along the bottom and once more over it
  expect_the_same(polyline({at(-.3, .3), at(-.3, .05), at(-.25, 0), at(.01, 0), at(.01, .2), at(.01, 0), at(.25, 0), at(.3, .05), at(.3, .3)}), outline);
  expect_the_same(polyline({at(-.3, .3), at(-.3, .05), at(-.25, 0), at(.2, 0), at(-.1, 0), at(.25, 0), at(.3, .05), at(.3, .3)}), outline);
}

// What is to the left of the way on one lobe is to its right on the other.
TEST(ContactSides, AProfileThatCrossesItselfBetweenTwoLobes) {
  const Mesh outline = polyline({at(-.3, 0), at(-.1, 0), at(0, .1), at(.1, 0), at(.3, 0), at(.3, .2), at(.1, .2), at(0, .1 + 2 * h0), at(-.1, .2), at(-.3, .2)}, true);
  expect_the_same(polyline({at(-.3, 0), at(-.1, 0), at(.1, .2), at(.3, .2), at(.3, 0), at(.1, 0), at(-.1, .2), at(-.3, .2)}, true), outline);
}

// A wall inside a tool hangs on its lower edge, where the body touches it.
TEST(ContactSides, AWallInsideATool) {
  const auto prism = [](bool with_wall) {
    std::vector<Vec3> points;
    std::vector<std::array<int, 3>> corners;
    const Vec3 outline[4] = {Vec3(0, 0, 0), Vec3(.3, 0, .15), Vec3(0, 0, .3), Vec3(-.3, 0, .15)};
    for (double y : {-.5, .5})
      for (const Vec3& p : outline) points.push_back(p + Vec3(0, y, 0));
    for (int k = 0; k < 4; ++k) {
      const int l = (k + 1) % 4;
      corners.push_back({k, l, l + 4});
      corners.push_back({k, l + 4, k + 4});
    }
    for (int end : {0, 4}) {
      corners.push_back({end, end + 1, end + 2});
      corners.push_back({end, end + 2, end + 3});
    }
    if (with_wall) {
      corners.push_back({0, 2, 6});
      corners.push_back({0, 6, 4});
    }
    return triangles(points, corners);
  };
  const auto run = [&](bool with_wall) {
    World world;
    world.dimension = 3;
    world.config.layer = h0;
    world.add_box(Vec3(-.4, -.3, -.2), 8, 6, 2, .1, 2700, 2e8);
    world.add_tool("punch", prism(with_wall), 0, [](double t) { return Vec3(0, 0, -20 * t); });
    Contact contact = world.make();
    EXPECT_TRUE(contact.warnings().empty()) << contact.warnings()[0];
    for (int i = 0; i < 200; ++i) world.step(contact, 1e-5, i % 20 == 0);
    EXPECT_EQ(world.crossings, 0);
    EXPECT_GT(world.exchanged, 0);
    return world;
  };
  EXPECT_LT(apart(run(true), run(false)), .02);
}

// A blade without thickness may stand on a body at the start, and its edge is where it was given.
TEST(ContactSides, ABladeEndsAtItsEdge) {
  std::string warnings;
  EXPECT_EQ(pressed(polyline({at(.013, 0), at(.013, .3)}), 0, warnings).crossings, 0);
  World flat;
  flat.config.layer = h0;
  flat.add_strip(at(-.5, -.2), 20, 4, .05, .05, 2700, 2e9);
  flat.add_tool("blade", polyline({at(.013, 0), at(.013, .3)}), 0, [](double) { return Vec3::Zero(); });
  Contact on_edge = flat.make();
  flat.step(on_edge, 1e-6);
  EXPECT_NEAR(flat.last.min_gap_over_layer, 1, 1e-6) << "the layer ends on the edge";
  // In space the same: the end of a plate on a box.
  World world;
  world.dimension = 3;
  world.config.layer = h0;
  world.add_box(Vec3(-.2, -.2, -.2), 4, 4, 2, .1, 2700, 2e8);
  world.add_tool("blade", triangles({Vec3(.013, -1, 0), Vec3(.013, 1, 0), Vec3(.013, 1, .5), Vec3(.013, -1, .5)}, {{0, 1, 2}, {0, 2, 3}}), 0, [](double) { return Vec3::Zero(); });
  Contact contact = world.make();
  world.step(contact, 1e-6);
  EXPECT_NEAR(world.last.min_gap_over_layer, 1, 1e-6);
  for (auto& v : world.v) v = Node(0, 0, 10, 0);
  for (int i = 0; i < 200; ++i) world.step(contact, 1e-5, i % 20 == 0);
  EXPECT_EQ(world.crossings, 0);
}
