// Pairs that sleep, and edges that are not watched, are missed by none: a list that serves many steps
// gives the same pairs as one that is made for the step.
#include <gtest/gtest.h>

#include <random>

#include "contact/point_bodies.h"
#include "forming_sim/contact/narrow.h"

using namespace forming_sim;
using contact_test::World;

namespace {

struct Scene {
  World world;
  Features features;
  const std::vector<ToolMotion> motion = std::vector<ToolMotion>(1);
  const std::vector<PlanePose> planes = std::vector<PlanePose>(1);

  explicit Scene(int dimension) {
    world.dimension = dimension;
    if (dimension == 2) {
      world.add_strip(Vec3(-1, .05, 0), 23, 2, .1, .1, 1, 0, .02);
      std::vector<Vec3> line;
      for (int i = 0; i <= 40; ++i) line.emplace_back(-2 + .1 * i, .03 * std::sin(3.0 * i), 0);
      world.add_tool("die", contact_test::polyline(line), 0, [](double) { return Vec3::Zero(); });
    } else {
      world.add_box(Vec3(-.4, -.35, .07), 9, 8, 2, .1, 1, 0);
      world.add_tool("die", contact_test::sheet(9, 1.1, [](double a, double b) { return .05 * std::sin(5 * a) * std::cos(4 * b); }), 0, [](double) { return Vec3::Zero(); });
    }
    ContactSetup setup;
    setup.dimension = dimension;
    setup.bodies = world.bodies;
    setup.tools = world.tools;
    setup.tool_meshes = {&world.meshes[0]};
    features = build_features(setup, world.x);
  }

  NearList list(double radius, Workspace& work) const {
    NearList near = build_list(features, world.x, {ToolIndex(features, features.place, {true}), motion, {true}, {false}, planes}, {}, radius, work);
    gather(work);
    for (int i = 0; i < work.body_entries; ++i) work.share[i] = {1, 1, 1, 0};
    return near;
  }
  void gather(Workspace& work) const {
    for (std::size_t i = 0; i < work.vertex.size(); ++i) {
      const int v = work.vertex[i];
      work.x[i] = features.rigid(v) ? features.place[v - features.body_nodes] : world.x[v];
    }
  }
};

}  // namespace

TEST(ContactSearch, SleepingPairsAreMissedByNone) {
  for (const int dimension : {2, 3}) {
    Scene scene(dimension);
    const double reach = .03, layer = .02, radius = .2, farthest = .002;
    Workspace work, work_now;
    NearList list = scene.list(radius, work);
    Narrow near, now;
    Team one(1), two(2);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(-1, 1);
    double travel = 0;
    long steps = 0, pairs = 0, came = 0, asleep = 0, watched = 0;
    for (; travel + reach <= radius; travel += farthest, ++steps) {
      narrow_phase({scene.features, work, 1, layer}, nullptr, scene.planes, true, {reach, .9 * reach, travel}, two, list, near);
      NearList fresh = scene.list(reach, work_now);
      const std::size_t before = now.pairs.size();
      narrow_phase({scene.features, work_now, 1, layer}, nullptr, scene.planes, true, {reach, .9 * reach, 0}, one, fresh, now);
      ASSERT_EQ(near.pairs.size(), now.pairs.size()) << "step " << steps;
      for (std::size_t i = 0; i < now.pairs.size(); ++i) {
        ASSERT_EQ(near.pairs[i].key, now.pairs[i].key) << "step " << steps;
        EXPECT_EQ(near.pairs[i].gap, now.pairs[i].gap);
        EXPECT_EQ(near.pairs[i].askew, now.pairs[i].askew);
        EXPECT_EQ(near.pairs[i].w, now.pairs[i].w);
      }
      EXPECT_EQ(near.close.size(), now.close.size());
      came += now.pairs.size() > before;
      pairs += static_cast<long>(now.pairs.size());
      for (const NearList::FacetEntry& e : list.facets) asleep += e.wake > travel + reach;
      watched += static_cast<long>(list.watched.size());
      // Downwards on the whole, and each its own way.
      const Node down = dimension == 2 ? Node(.2, -.3, 0, 0) : Node(.2, .1, -.3, 0);
      for (int i = 0; i < scene.features.body_nodes; ++i)
        scene.world.x[i] += farthest * (down + .3 * Node(number(random), number(random), dimension == 3 ? number(random) : 0, 0));
      scene.gather(work);
    }
    EXPECT_GT(steps, 50);
    EXPECT_GT(came, 10);
    EXPECT_GT(pairs, 10 * steps);
    EXPECT_GT(asleep, steps * static_cast<long>(list.facets.size()) / 3);
    if (dimension == 3) {
      EXPECT_LT(watched, steps * static_cast<long>(list.edges.size()) / 2);
    }
  }
}

// A margin that is not counted: then pairs are missed.
TEST(ContactSearch, WithoutTheCountOfTheWayPairsAreMissed) {
  Scene scene(3);
  const double reach = .03;
  Workspace work, work_now;
  NearList list = scene.list(.2, work);
  Narrow near, now;
  Team one(1);
  for (int step = 0; step < 2; ++step) {
    narrow_phase({scene.features, work, 1, .02}, nullptr, scene.planes, true, {reach, .9 * reach, 0}, one, list, near);
    for (int i = 0; i < scene.features.body_nodes; ++i) scene.world.x[i] -= Node(0, 0, .04, 0);
    scene.gather(work);
  }
  NearList fresh = scene.list(reach, work_now);
  narrow_phase({scene.features, work_now, 1, .02}, nullptr, scene.planes, true, {reach, .9 * reach, 0}, one, fresh, now);
  narrow_phase({scene.features, work, 1, .02}, nullptr, scene.planes, true, {reach, .9 * reach, 0}, one, list, near);
  EXPECT_LT(near.pairs.size(), now.pairs.size());
}
