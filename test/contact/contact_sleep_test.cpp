// Pairs that sleep, and edges that are not watched, are missed by none: a list that serves many steps
// gives the same pairs as one that is made for the step.
#include <gtest/gtest.h>

#include <random>

#include "contact/point_bodies.h"
#include "forming_sim/contact/closest.h"
#include "forming_sim/contact/impulse.h"
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
    features = build_features(world.setup(), world.x);
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

// Pairs that are out of their layers at both ends of the step are set aside, and no others; with them nothing is lost.
TEST(ContactSearch, PairsThatStayOutOfTheirLayersAreSetAside) {
  for (const int dimension : {2, 3}) {
    const Scene scene(dimension);
    const double reach = .09, layer = .02, ceiling = .05, dt = 1;
    Workspace work;
    NearList list = scene.list(.2, work);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> number(-1, 1);
    work.v.resize(work.x.size());
    for (int i = 0; i < static_cast<int>(work.v.size()); ++i) {
      const double down = i < work.body_entries ? -.04 : 0;
      work.v[i] = .03 * Node(number(random), number(random), dimension == 3 ? number(random) : 0, 0) + (dimension == 3 ? Node(0, 0, down, 0) : Node(0, down, 0, 0));
    }
    const PairRecords none;
    const Layers layers(none, none, work, dt, dt, layer, ceiling);
    Narrow all, some;
    Team two(2);
    const auto find = [&](double step, Narrow& into) { narrow_phase({scene.features, work, 1, layer}, &layers, scene.planes, false, {reach, .9 * reach, 0, layer, step}, two, list, into); };
    find(0, all);
    find(dt, some);
    EXPECT_EQ(all.aside.size(), 0u);
    std::size_t kept = 0;
    for (const ContactPair& pair : all.pairs) {
      const double end = pair.gap + dt * dot3(pair.normal, relative(pair, work.v));
      const bool is_kept = kept < some.pairs.size() && some.pairs[kept].key == pair.key;
      const double own = std::max(layer, layers.raised(std::max(0., pair.gap - end)));
      EXPECT_EQ(is_kept, pair.gap <= own || end <= own + 1e-3 * layer) << pair.gap << ' ' << end;
      if (is_kept) EXPECT_EQ(some.pairs[kept++].layer, pair.layer);
      else EXPECT_TRUE(std::any_of(some.aside.begin(), some.aside.end(), [&](const AsidePair& a) { return a.gap == pair.gap && a.normal == pair.normal && a.layer >= layer; }));
    }
    EXPECT_EQ(kept, some.pairs.size());
    EXPECT_GT(kept, 10u);
    EXPECT_GT(all.pairs.size(), kept + 10);
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

namespace {

/// The left part of a strip lies clamped between a die and a pad, its right end beats on the die. creep: velocity with which the clamp is told to move, m/s.
World clamped(double creep, const std::function<Vec3(double)>& die, int cells = 20) {
  World world;
  world.config.layer = 1e-3;
  world.add_strip(Vec3(0, 1, 0), cells, 2, 1. / cells, .05, 2700, 5e9);
  world.add_tool("die", contact_test::polyline({Vec3(-.2, 1, 0), Vec3(.8, 1, 0)}), .1, die);
  world.add_tool("pad", contact_test::polyline({Vec3(.35, 1.1, 0), Vec3(-.2, 1.1, 0)}), .1, [](double) { return Vec3::Zero(); });
  for (int n = 0; n < static_cast<int>(world.x.size()); ++n) {
    const double along = world.x[n][0] - .31;
    if (along < 0) world.held.push_back({n, Mat3::Zero()});
    else world.v[n] = Node(0, -30 * along, 0, 0);
  }
  world.held_velocity.assign(world.held.size(), Node(0, creep, 0, 0));
  return world;
}

}  // namespace

// Some nodes stand, and in each seventh step none: no pair is missed but those at rest.
TEST(ContactSearch, OnlyWhatStandsOutOfItsLayerIsPassedOver) {
  for (const int dimension : {2, 3}) {
    Scene scene(dimension);
    const double reach = .08, layer = .02, radius = .3, farthest = .002;
    Workspace work, work_now;
    NearList list = scene.list(radius, work);
    Narrow near, now;
    Team one(1);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(-1, 1);
    const auto stands = [&](int n) { return scene.features.rigid(n) || scene.world.x[n][0] < 0; };
    long passed = 0, passed_edges = 0, met = 0;
    int step = 0;
    for (double travel = 0; travel + reach <= radius; travel += farthest, ++step) {
      const bool all_move = step % 7 == 6;
      for (std::size_t i = 0; i < work.vertex.size(); ++i) work.stands[i] = !all_move && stands(work.vertex[i]);
      narrow_phase({scene.features, work, 1, layer}, nullptr, scene.planes, true, {reach, 0, travel, layer}, one, list, near);
      NearList fresh = scene.list(reach, work_now);
      narrow_phase({scene.features, work_now, 1, layer}, nullptr, scene.planes, true, {reach, 0, 0}, one, fresh, now);
      // A list that has looked at nothing yet finds the same.
      Narrow same;
      NearList new_one = scene.list(reach, work_now);
      for (std::size_t i = 0; i < work_now.vertex.size(); ++i) work_now.stands[i] = !all_move && stands(work_now.vertex[i]);
      narrow_phase({scene.features, work_now, 1, layer}, nullptr, scene.planes, true, {reach, 0, 0, layer}, one, new_one, same);
      ASSERT_EQ(same.pairs.size(), near.pairs.size()) << "step " << step;
      for (std::size_t i = 0; i < same.pairs.size(); ++i) EXPECT_EQ(same.pairs[i].key, near.pairs[i].key) << "step " << step;
      std::size_t i = 0;
      for (const ContactPair& pair : now.pairs) {
        if (i < near.pairs.size() && near.pairs[i].key == pair.key) {
          EXPECT_EQ(near.pairs[i].gap, pair.gap);
          ++i, ++met;
          continue;
        }
        EXPECT_FALSE(all_move) << "step " << step;
        EXPECT_GT(pair.gap, layer) << "step " << step;
        for (int k = 0; k < pair.nodes; ++k) EXPECT_TRUE(stands(work_now.vertex[pair.node[k]])) << "step " << step;
        ++passed;
        passed_edges += pair.key.kind() == PairKey::edge_edge;
      }
      EXPECT_EQ(i, near.pairs.size()) << "step " << step;
      const Node down = dimension == 2 ? Node(.2, -.3, 0, 0) : Node(.2, .1, -.3, 0);
      for (int n = 0; n < scene.features.body_nodes; ++n)
        if (all_move || !stands(n)) scene.world.x[n] += farthest * (down + .3 * Node(number(random), number(random), dimension == 3 ? number(random) : 0, 0));
      scene.gather(work);
    }
    EXPECT_GT(met, 10 * step);
    EXPECT_GT(passed, 3 * step);
    if (dimension == 3) {
      EXPECT_GT(passed_edges, step);
    }
  }
}

// A clamp that creeps by less than a place can tell does not stand: all of its pairs are looked at, and no bit is another
// where they are so few that the order of the others is the same.
TEST(ContactSearch, WhatStandsChangesNothing) {
  const auto rest = [](double) { return Vec3::Zero(); };
  World standing = clamped(0, rest), creeping = clamped(1e-300, rest);
  Contact of_standing = standing.make(), of_creeping = creeping.make();
  long active = 0;
  for (int i = 0; i < 1500; ++i) {
    standing.step(of_standing, 2e-6, i % 100 == 0);
    creeping.step(of_creeping, 2e-6, false);
    active += standing.last.active;
    ASSERT_EQ(standing.last.potential, creeping.last.potential) << "step " << i;
    ASSERT_EQ(standing.last.dissipated, creeping.last.dissipated) << "step " << i;
    for (int t = 0; t < 2; ++t) ASSERT_EQ(standing.last.tool_impulse[t], creeping.last.tool_impulse[t]) << "step " << i;
  }
  EXPECT_GT(active, 100);
  EXPECT_EQ(standing.crossings, 0);
  for (std::size_t n = 0; n < standing.x.size(); ++n) EXPECT_EQ(standing.x[n], creeping.x[n]);
}

// What has been looked at is not saved, and tells nothing: there are so many pairs here that the order of the others would tell if those at rest were among them.
TEST(ContactSearch, AResumedClampIsTheUnbrokenOne) {
  const World start = clamped(0, [](double) { return Vec3::Zero(); }, 1200);
  World world = start;
  Contact contact = world.make();
  long active = 0;
  for (int save = 0; save < 12; ++save) {
    for (int i = 0; i < 37; ++i) world.step(contact, 2e-6, false);
    World other = world;
    Contact resumed = start.make();
    resumed.restore(contact.save());
    for (int i = 0; i < 60; ++i) {
      world.step(contact, 2e-6, false);
      other.step(resumed, 2e-6, false);
      active += world.last.active;
      ASSERT_EQ(world.last.potential, other.last.potential) << "save " << save << ", step " << i;
      ASSERT_EQ(world.last.dissipated, other.last.dissipated) << "save " << save << ", step " << i;
      ASSERT_EQ(world.last.friction_work, other.last.friction_work) << "save " << save << ", step " << i;
    }
    for (std::size_t n = 0; n < world.x.size(); ++n) ASSERT_EQ(world.x[n], other.x[n]) << "save " << save;
    EXPECT_GT(contact.listed_pairs(), 500);
  }
  EXPECT_GT(active, 1000);
}

// A die that has stood for long comes up under the clamp.
TEST(ContactSearch, AToolThatStartsAgainIsSeenByWhatIsClamped) {
  World world = clamped(0, [](double t) { return Vec3(0, 5 * std::max(0., t - 1e-3), 0); });
  Contact contact = world.make();
  std::string told;
  try {
    for (int i = 0; i < 1000; ++i) world.step(contact, 2e-6, false);
  } catch (const Error& error) {
    told = error.what();
  }
  EXPECT_NE(told.find("tool die runs over node"), std::string::npos) << told;
  EXPECT_NE(told.find("of body body0"), std::string::npos) << told;
  EXPECT_NEAR(world.time, 1.2e-3, 1e-5);  // the layer of 1 mm at 5 m/s
}
