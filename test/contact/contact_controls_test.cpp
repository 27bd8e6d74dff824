// Each safeguard of the contact, and what happens without it.
#include <gtest/gtest.h>

#include "contact/reduced.h"
#include "contact/hard_scenes.h"

using contact_test::groove;
using contact_test::knives;
using contact_test::polyline;
using contact_test::Reduced;
using contact_test::ridges;
using contact_test::World;
using namespace forming_sim;

namespace {

/// Crossings in `steps` steps of dt with the pairs that `reduce` leaves.
struct Count {
  long crossings, active;
};
Count run(World world, const Reduced::Reduce& reduce, double dt, int steps) {
  Reduced contact(world, reduce);
  for (int i = 0; i < steps; ++i) contact.step(world, dt);
  return {contact.crossings, contact.active};
}

}  // namespace

// Two crossed ridges touch between their nodes: vertices and faces alone do not see each other.
TEST(ContactControls, RidgesNeedTheirEdges) {
  for (double speed : {5., 100., 500.})
    for (double layer : {2e-3, 2e-5}) {
      const double dt = 2e-5 * std::min(1., 100 / speed);
      const int steps = static_cast<int>((.12 / speed + 1e-3) / dt);
      const Count whole = run(ridges(speed, layer), nullptr, dt, steps), less = run(ridges(speed, layer), contact_test::without_edges, dt, steps);
      EXPECT_EQ(whole.crossings, 0) << speed << " m/s, layer " << layer;
      EXPECT_GT(whole.active, 0);
      EXPECT_GT(less.crossings, 0) << speed << " m/s, layer " << layer;
    }
}

// Knife on knife, the pairs of edges left out that are parallel to a hundredth: vertices and edges do not make up for them.
TEST(ContactControls, KnivesNeedNearlyParallelEdges) {
  for (double angle : {1e-4, 1e-3, 3e-3})
    for (double off : {0., 1e-4, 1e-2}) {
      const Count whole = run(knives(angle, off), nullptr, 1e-6, 300), less = run(knives(angle, off), contact_test::without_parallel_edges(1e-2), 1e-6, 300);
      EXPECT_EQ(whole.crossings, 0) << angle << " rad, off by " << off;
      // Where the knives are off by more than the angle makes up for, they slide past each other on their faces.
      EXPECT_EQ(less.crossings > 0, off <= .5 * angle) << angle << " rad, off by " << off << ": " << less.crossings;
    }
}

// The point of a groove: held by both walls, not by the nearer alone.
TEST(ContactControls, AGrooveNeedsBothWalls) {
  long less = 0;
  for (double half : {15., 30., 60.})
    for (double layer : {1e-2, 1e-3, 1e-5}) {
      EXPECT_EQ(run(groove(half, layer), nullptr, 5e-6, 400).crossings, 0) << half << " degrees, layer " << layer;
      less += run(groove(half, layer), contact_test::nearest_only, 5e-6, 400).crossings;
    }
  EXPECT_GT(less, 0);
}

// A wedge sharper than the mesh hits between two nodes: only its own node sees the body.
TEST(ContactControls, ATipNeedsTheToolsNodes) {
  for (double speed : {50., 500.}) {
    World world;
    world.add_strip(Vec3(-1, 0, 0), 4, 2, .5, .5, 2700, 5e9);
    world.config.layer = 1e-3;
    world.add_tool("wedge", polyline({Vec3(-.02, -1, 0), Vec3(0, 0, 0), Vec3(.02, -1, 0)}), 0, [speed](double t) { return Vec3(.23, -.01 + speed * t, 0); });
    const double dt = 2e-5 * 50 / speed;
    EXPECT_EQ(run(world, nullptr, dt, 400).crossings, 0);
    EXPECT_GT(run(world, contact_test::without_tool_nodes, dt, 400).crossings, 0);
  }
}
