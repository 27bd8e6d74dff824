// Gaps of the nodes of bodies against the distances of all facets and planes, one by one.
#include <gtest/gtest.h>

#include <random>

#include "contact/point_bodies.h"
#include "forming_sim/contact/closest.h"

using namespace contact_test;
using namespace forming_sim;

namespace {

constexpr double kLayer = 1e-9;  // a tool is set back by it along normals of its vertices, which of a surface that bends is nearly so

/// Distance of every node on a surface from all other surfaces, at most `reach`; 0: of a node that is on none.
std::vector<double> all_distances(const World& world, double reach) {
  const std::vector<ToolMotion> motion = world.motion(world.time, world.time);
  struct Placed {
    const ContactSurface* surface;
    std::vector<Node> x;
  };
  std::vector<Placed> all;
  for (const ContactSurface& body : world.bodies) all.push_back({&body, std::vector<Node>(world.x.begin(), world.x.end())});
  for (std::size_t t = 0; t < world.tools.size(); ++t) {
    all.push_back({&world.tools[t], {}});
    for (const Vec3& p : world.meshes[t].nodes) all.back().x.push_back(node(pose0(motion[t], p)));
  }
  std::vector<double> gap(world.x.size(), reach);
  for (std::size_t b = 0; b < world.bodies.size(); ++b)
    for (std::size_t other = 0; other < all.size(); ++other) {
      if (other == b) continue;
      const Placed& s = all[other];
      for (const Facet& own : world.bodies[b].facets)
        for (int k = 0; k < world.dimension; ++k) {
          const int n = own.nodes[k];
          const Node& p = world.x[n];
          if (s.surface->plane) gap[n] = std::min(gap[n], (vec3(p) - pose0(motion[other - world.bodies.size()], s.surface->point)).dot(s.surface->normal));
          for (const Facet& f : s.surface->facets) {
            const auto at = [&](int i) -> const Node& { return s.x[f.nodes[i]]; };
            const double squared = closest_on_facet(world.dimension, p, at(0), at(1), at(world.dimension - 1)).squared;
            gap[n] = std::min(gap[n], std::sqrt(squared));
          }
        }
    }
  return gap;
}

/// How many nodes are nearer than the reach.
int compare(const World& world) {
  const Contact contact = world.make();
  const std::vector<double> found = contact.gaps(world.x, world.motion(world.time, world.time)), right = all_distances(world, contact.gap_reach());
  EXPECT_EQ(found.size(), right.size());
  int near = 0;
  for (std::size_t n = 0; n < right.size(); ++n) {
    EXPECT_NEAR(found[n], right[n], 4 * kLayer) << n;
    near += right[n] < contact.gap_reach();
  }
  return near;
}

}  // namespace

TEST(ContactGaps, OfBoxesAboveEachOtherAndOverAWavySheet) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-.01, .01);
  for (int turn = 0; turn < 6; ++turn) {
    World world;
    world.dimension = 3;
    world.config.layer = kLayer;
    world.add_box(Vec3(-.4, -.4, .1), 8, 8, 2, .1, 2700, 0);
    world.add_box(Vec3(-.3, -.2, .33), 5, 4, 2, .13, 2700, 0);
    for (auto& p : world.x)
      for (int k = 0; k < 3; ++k) p[k] += any(random);
    // Fine facets and coarse bodies, then the other way round; the tool stands elsewhere than its mesh, and turned.
    world.add_tool("wave", sheet(turn % 2 ? 30 : 4, .8, [](double a, double b) { return .05 * std::cos(5 * a) * std::cos(4 * b); }), .1,
                   [](double) { return Vec3(.02, -.03, 0); });
    if (turn >= 4) world.add_plane("side", Vec3(-.45, 0, 0), Vec3::UnitX(), .1, [](double) { return Vec3(.01, 0, 0); });
    world.turning = 1;
    world.time = turn < 4 ? .3 * turn : 0;
    EXPECT_GT(compare(world), 60);
  }
}

TEST(ContactGaps, OfStripsInThePlane) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-.004, .004);
  for (int turn = 0; turn < 6; ++turn) {
    World world;
    world.config.layer = kLayer;
    world.add_strip(Vec3(-.4, .05, 0), 20, 3, .04, .04, 2700, 0);
    world.add_strip(Vec3(-.2, .19, 0), 9, 3, .05, .05, 2700, 0, .05 * turn);
    for (auto& p : world.x)
      for (int k = 0; k < 2; ++k) p[k] += any(random);
    std::vector<Vec3> points;
    for (int i = 0; i <= 60; ++i) points.emplace_back(.6 - .02 * i, .02 * std::cos(.7 * i), 0);
    world.add_tool("wave", polyline(points), .1, [](double) { return Vec3(0, .01, 0); });
    EXPECT_GT(compare(world), 20);
  }
}

// Nothing is near: the reach, wherever the bodies are.
TEST(ContactGaps, FarFromEverything) {
  World world;
  world.dimension = 3;
  world.config.layer = kLayer;
  world.add_box(Vec3(0, 0, 5), 2, 2, 2, .1, 2700, 0);
  world.add_tool("flat", sheet(4, .8, [](double, double) { return 0.; }), .1, [](double) { return Vec3::Zero(); });
  EXPECT_EQ(compare(world), 0);
}
