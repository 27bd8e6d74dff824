// What `pairs` says of two surfaces: sliding, frictionless, sticking, tied, none.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <set>

#include "contact/point_bodies.h"
#include "forming_sim/contact/closest.h"
#include "forming_sim/contact/crossing.h"

namespace contact_test {
namespace {

/// Two strips of springs, the upper with other cells on the lower; no gap between them.
World two_strips(double gap = 0) {
  World world;
  world.config.layer = 1e-4;
  world.add_strip(Vec3(0, 0, 0), 10, 4, .1, .1, 2800, 2e9);
  world.add_strip(Vec3(.15, .4 + gap, 0), 10, 3, .07, .1, 2800, 2e9);
  return world;
}

PairConfig pair(const std::string& first, const std::string& second, const std::string& kind, double friction = 0) {
  PairConfig config;
  config.first = first;
  config.second = second;
  config.kind = kind;
  config.friction = friction;
  return config;
}

/// A block slides on a plane at 1 m/s under gravity for .02 s: tangential over normal impulse, and how fast it is then.
std::pair<double, double> slides(const std::vector<PairConfig>& pairs, double of_the_tool) {
  World world;
  world.config.layer = 1e-3;
  world.config.pairs = pairs;
  world.gravity = Vec3(0, -9.81, 0);
  world.add_strip(Vec3(0, 1e-3, 0), 6, 3, .1, .1, 2800, 2e9);
  world.add_plane("floor", Vec3::Zero(), Vec3::UnitY(), of_the_tool, [](double) { return Vec3::Zero(); });
  for (Node& v : world.v) v = Node(1, 0, 0, 0);
  Contact contact = world.make();
  Vec3 impulse = Vec3::Zero();
  while (world.time < .02) {
    world.step(contact, 5e-6, false);
    impulse += world.last.tool_impulse[0];
  }
  return {-impulse.x() / impulse.y(), world.mean_velocity().x()};
}

/// Edges of one body and facets of another that were farther apart than `near` at the start.
class FarApart {
 public:
  FarApart(const World& world, int a, int b, double near) {
    std::set<std::pair<int, int>> edges;
    for (const Facet& f : world.bodies[a].facets)
      for (int k = 0; k < 3; ++k) edges.insert(std::minmax(f.nodes[k], f.nodes[(k + 1) % 3]));
    for (const auto& [p, q] : edges)
      for (const Facet& f : world.bodies[b].facets) {
        const Node c[3] = {world.x[f.nodes[0]], world.x[f.nodes[1]], world.x[f.nodes[2]]};
        double squared = std::min(closest_on_triangle(world.x[p], c[0], c[1], c[2]).squared, closest_on_triangle(world.x[q], c[0], c[1], c[2]).squared);
        for (int k = 0; k < 3; ++k) squared = std::min(squared, closest_on_edges(world.x[p], world.x[q], c[k], c[(k + 1) % 3]).squared);
        if (squared > near * near) pairs_.push_back({p, q, f.nodes[0], f.nodes[1], f.nodes[2]});
      }
  }
  long crossings(const NodeField& x) const {
    long count = 0;
    for (const auto& n : pairs_) count += pierces(x[n[0]], x[n[1]], x[n[2]], x[n[3]], x[n[4]], true);
    return count;
  }

 private:
  std::vector<std::array<int, 5>> pairs_;
};

}  // namespace

// Tied strips turn through half a turn and vibrate: they stay together where
// meshes do not match, with the momenta and the energy of one body.
TEST(ContactPairs, TiedBodiesStayTogether) {
  World world = two_strips();
  world.config.pairs = {pair("body0", "body1", "tied")};
  const double spin = 100;
  for (size_t i = 0; i < world.x.size(); ++i) world.v[i] = spin * Node(-world.x[i][1], world.x[i][0], 0, 0) + Node(3, 1, 0, 0);
  // One of the vertices of the upper strip that lie on the lower.
  const int lower = 11 * 5, on = lower + 4;
  const Vec3 p = world.momentum();
  const auto energy = [&] {
    double sum = 0;
    for (size_t i = 0; i < world.x.size(); ++i) sum += .5 * world.mass[i] * world.v[i].squaredNorm();
    for (const World::Spring& s : world.springs) {
      const double l = (world.x[s.b] - world.x[s.a]).norm();
      sum += .5 * s.stiffness * (l - s.length) * (l - s.length);
    }
    return sum;
  };
  Contact contact = world.make();
  EXPECT_TRUE(contact.warnings().empty());
  const double before = energy();
  double farthest = 0, l0 = 0;
  for (int i = 0; i < 6300; ++i) {
    world.step(contact, 5e-6, i % 100 == 0);
    if (i == 0) l0 = world.angular_momentum().z();
    // .15 + 4 * .07 = .43: between the vertices at .4 and .5, 3 tenths of the way.
    const Node place = .7 * world.x[11 * 4 + 4] + .3 * world.x[11 * 4 + 5];
    farthest = std::max(farthest, (world.x[on] - place).norm());
  }
  EXPECT_EQ(world.crossings, 0);
  EXPECT_LT(farthest, 1e-6);
  EXPECT_LT((world.momentum() - p).norm(), 1e-9 * p.norm());
  EXPECT_NEAR(world.angular_momentum().z() / l0, 1, 1e-3);
  EXPECT_NEAR(energy() / before, 1, 5e-3);
  EXPECT_NEAR(world.closure(), 0, 1e-9 * world.exchanged);
  EXPECT_NEAR(world.dissipated, 0, 1e-5 * before);
}

// A strip is tied below a stiff block and reaches out of it, the corner of the block in the middle of a cell of the strip; its free end
// is bent up around the corner. The cell that is tied at one of its ends only must not turn into the block.
TEST(ContactPairs, TheRimOfATieDoesNotTurnIn) {
  World world;
  world.config.layer = 1e-4;
  world.config.pairs = {pair("body0", "body1", "tied")};
  world.add_strip(Vec3(0, -.22, 0), 9, 1, .22, .22, 2800, 2e8);
  world.add_strip(Vec3(.1, 0, 0), 3, 2, .3, .3, 28000, 2e10);
  const int inside = 10 + 4, outside = 10 + 5, corner = 20 + 3;  // at .88 and 1.1 on the strip, at 1 on the block
  for (int i = 0; i < 20; ++i) world.v[i][1] = 60 * std::max(0., world.x[i][0] - 1);
  const Vec3 p = world.momentum();
  const double l = world.angular_momentum().z();
  Contact contact = world.make();
  double deepest = 0, turned = 0;
  for (int i = 0; i < 1500; ++i) {
    world.step(contact, 2e-5, i % 100 == 0);
    const Vec3 along = vec3(world.x[outside] - world.x[inside]), block = vec3(world.x[corner] - world.x[corner - 1]);
    const Vec3 up = Vec3::UnitZ().cross(along).normalized();
    deepest = std::max(deepest, -up.dot(vec3(world.x[corner] - world.x[inside])));
    turned = std::max(turned, block.cross(vec3(world.x[19] - world.x[outside])).z() / (block.norm() * .88));
  }
  EXPECT_GT(turned, .3);  // the free end, against the block
  EXPECT_LT(deepest, 1e-6);
  EXPECT_EQ(world.crossings, 0);
  EXPECT_LT((world.momentum() - p).norm(), 1e-9 * p.norm());
  EXPECT_NEAR(world.angular_momentum().z() / l, 1, 1e-3);
  EXPECT_NEAR(world.closure(), 0, 1e-9 * world.exchanged);
}

// The same in space: no vertex of the block lies over the cells of the rim, but its lower edges cross theirs.
TEST(ContactPairs, TheRimOfATieDoesNotTurnInInSpace) {
  World world;
  world.dimension = 3;
  world.config.layer = 1e-4;
  world.config.pairs = {pair("body0", "body1", "tied")};
  world.add_box(Vec3(0, 0, -.22), 9, 3, 1, .22, 2800, 1e8);
  world.add_box(Vec3(-.3, -.3, 0), 1, 1, 1, 1.3, 28000, 1e10);
  // The block ends at x = 1: strip nodes at .88 are tied, those at 1.1 are not.
  const auto top = [](int i, int j) { return 40 + j * 10 + i; };
  const int below = 80 + 1, behind = 80 + 3;  // ends of the block's lower edge at x = 1
  for (int i = 0; i < 80; ++i) world.v[i][2] = 60 * std::max(0., world.x[i][0] - 1);
  const Vec3 p = world.momentum();
  Contact contact = world.make();
  double deepest = 0, turned = 0;
  for (int i = 0; i < 1000; ++i) {
    world.step(contact, 2e-5, i % 100 == 0);
    const Vec3 edge = vec3(world.x[behind] - world.x[below]);
    for (int j = 0; j < 4; ++j) {
      const Vec3 along = vec3(world.x[top(5, j)] - world.x[top(4, j)]), apart = vec3(world.x[top(4, j)] - world.x[below]);
      const Vec3 up = along.cross(edge).normalized();
      deepest = std::max(deepest, up.dot(apart));  // of the strip's edge above the block's
      turned = std::max(turned, vec3(world.x[top(9, j)] - world.x[top(5, j)]).normalized().z());
    }
  }
  EXPECT_GT(turned, .2);
  EXPECT_LT(deepest, 1e-6);
  EXPECT_EQ(world.crossings, 0);
  EXPECT_LT((world.momentum() - p).norm(), 1e-9 * p.norm());
  EXPECT_NEAR(world.closure(), 0, 1e-9 * world.exchanged);
}

// And below a rigid tool, whose corner is a vertex that nothing moves.
TEST(ContactPairs, TheRimOfATieToAToolDoesNotTurnIn) {
  World world;
  world.config.layer = 1e-4;
  world.config.pairs = {pair("body0", "anvil", "tied")};
  world.add_strip(Vec3(0, -.22, 0), 9, 1, .22, .22, 2800, 2e8);
  world.add_tool("anvil", polyline({{-.5, 0, 0}, {1, 0, 0}, {1, .6, 0}, {-.5, .6, 0}}, true), 0, [](double t) { return Vec3(0, -2 * t, 0); });
  for (int i = 0; i < 20; ++i) world.v[i][1] = -2 + 60 * std::max(0., world.x[i][0] - 1);
  Contact contact = world.make();
  double farthest = 0, turned = 0;
  for (int i = 0; i < 1500; ++i) {
    world.step(contact, 2e-5, i % 100 == 0);
    const Vec3 corner(1, -2 * world.time, 0), along = vec3(world.x[15] - world.x[14]);
    farthest = std::max(farthest, std::abs(Vec3::UnitZ().cross(along).normalized().dot(corner - vec3(world.x[14]))));
    turned = std::max(turned, vec3(world.x[19] - world.x[15]).normalized().y());
  }
  EXPECT_GT(turned, .3);
  EXPECT_LT(farthest, 1e-6);
  EXPECT_EQ(world.crossings, 0);
  EXPECT_NEAR(world.closure(), 0, 1e-9 * world.exchanged);
}

// A strip wider than the block above it is folded up hard and askew around the block's lower edge: what did not touch at the start
// does not pass through the block, though it hangs on vertices and edges that are tied.
TEST(ContactPairs, WhatHangsOnTheRimOfATieMeetsTheOtherBody) {
  World world;
  world.dimension = 3;
  world.config.layer = 1e-4;
  world.config.pairs = {pair("body0", "body1", "tied")};
  world.add_box(Vec3(0, 0, -.22), 9, 4, 1, .22, 2800, 1e8);
  world.add_box(Vec3(.075, .197, 0), 2, 2, 1, .439, 28000, 1e10);
  const double rim = .953, width = .88;
  for (int i = 0; i < 100; ++i) {
    const double out = 1000 * std::max(0., world.x[i][0] - rim);
    world.v[i] = out * Node(0, .224, 1 - 3.3 * (world.x[i][1] - .47) / width, 0);
  }
  const Vec3 p = world.momentum();
  const FarApart strip(world, 0, 1, .022), block(world, 1, 0, .022);
  Contact contact = world.make();
  long passed = 0;
  for (int i = 0; i < 500; ++i) {
    world.step(contact, 2e-5, i % 20 == 0);
    if (i % 20 == 0) passed += strip.crossings(world.x) + block.crossings(world.x);
  }
  EXPECT_EQ(passed, 0);
  EXPECT_EQ(world.crossings, 0);
  EXPECT_LT((world.momentum() - p).norm(), 1e-9 * p.norm());
  EXPECT_NEAR(world.closure(), 0, 1e-9 * world.exchanged);
}

// The independent count leaves out what touched at the start, not all that hangs on it: by hand, the cell of the strip that follows the
// rim is laid through the wall of the tool that starts at the rim.
TEST(ContactPairs, CrossingsAtTheRimOfATieAreCounted) {
  World world;
  world.config.layer = 1e-4;
  world.config.pairs = {pair("body0", "anvil", "tied")};
  world.add_strip(Vec3(0, -.22, 0), 6, 1, .22, .22, 2800, 2e8);
  world.add_tool("anvil", polyline({{-.5, 0, 0}, {1, 0, 0}, {1, .6, 0}}), 0, [](double) { return Vec3::Zero(); });
  const Contact contact = world.make();
  EXPECT_EQ(contact.count_crossings(world.x, world.motion(0, 0)), 0);
  const int below = 5, end_below = 6, end = 13;  // the last cell of the strip, from x = 1.1 on
  NodeField x = world.x;
  x[end] = Node(.9, .3, 0, 0);
  x[end_below] = Node(.9, 1, 0, 0);  // the other sides of the cell pass above the wall
  x[below] = Node(1.6, 1, 0, 0);
  EXPECT_EQ(contact.count_crossings(x, world.motion(0, 0)), 1);
}

// A bar that crosses cells of a plate between their vertices is tied to their edges: they follow it.
TEST(ContactPairs, EdgesThatCrossWhatIsTiedAreTied) {
  World world;
  world.dimension = 3;
  world.config.layer = 1e-4;
  world.config.pairs = {pair("body0", "bar", "tied")};
  world.add_box(Vec3(0, 0, -1), 4, 1, 1, 1, 2800, 2e8);
  const Mesh bar = triangles({{-.5, -.5, 0}, {.5, -.5, 0}, {-.5, 1.5, 0}, {.5, 1.5, 0}, {.5, .4, 0}, {.5, .6, 0}, {4.5, .4, 0}, {4.5, .6, 0}},
                             {{0, 1, 4}, {0, 4, 5}, {0, 5, 2}, {2, 5, 3}, {4, 6, 5}, {6, 7, 5}});  // its head holds the vertices at x = 0
  const auto rises = [](double t) { return Vec3(0, 0, t); };
  world.add_tool("bar", bar, 0, rises);
  Contact contact = world.make();
  double farthest = 0;
  for (int i = 0; i < 1000; ++i) {
    world.step(contact, 1e-5, i % 100 == 0);
    const double height = rises(world.time).z();
    for (int k = 1; k <= 4; ++k) {
      const Node &near = world.x[10 + k], &far = world.x[15 + k];  // ends of the edge across, at y = 0 and 1
      for (double y : {.4, .6}) farthest = std::max(farthest, std::abs((1 - y) * near[2] + y * far[2] - height));
    }
  }
  EXPECT_LT(farthest, 1e-5);
  EXPECT_EQ(world.crossings, 0);
}

// Two strips without a tie fly apart.
TEST(ContactPairs, UntiedBodiesPart) {
  World world = two_strips(1e-3);
  for (size_t i = 0; i < world.x.size(); ++i) world.v[i] = 100 * Node(-world.x[i][1], world.x[i][0], 0, 0);
  const int on = 11 * 5 + 4;
  Contact contact = world.make();
  for (int i = 0; i < 6300; ++i) world.step(contact, 5e-6, false);
  EXPECT_GT((world.x[on] - world.x[11 * 4 + 4]).norm(), .1);
}

// A strip that is tied to a plane hangs from it, and follows it; the plane feels its weight.
TEST(ContactPairs, ATiedToolCarriesTheBody) {
  World world;
  world.config.layer = 1e-4;
  world.config.pairs = {pair("body0", "ceiling", "tied")};
  world.gravity = Vec3(0, -9.81, 0);
  world.add_strip(Vec3(0, 0, 0), 5, 4, .1, .1, 2800, 2e9);
  const auto rises = [](double t) { return Vec3(.5 * t, 2 * t * t, 0); };
  world.add_plane("ceiling", Vec3(0, .4, 0), -Vec3::UnitY(), 0, rises);
  for (Node& v : world.v) v = Node(.5, 0, 0, 0);
  Contact contact = world.make();
  double weight = 0, impulse = 0, from = 0;
  for (double m : world.mass) weight += m * 9.81;
  while (world.time < .2) {
    world.step(contact, 5e-6, false);
    if (world.time < .1) continue;
    if (from == 0) from = world.time;
    impulse += world.last.tool_impulse[0].y();
  }
  const Vec3 moved = rises(world.time);
  for (int i = 0; i < 6; ++i) {
    const Node& top = world.x[4 * 6 + i];
    EXPECT_NEAR(top[0], .1 * i + moved.x(), 1e-9);
    EXPECT_NEAR(top[1], .4 + moved.y(), 1e-9);
  }
  EXPECT_NEAR(-impulse / (world.time - from) / weight, (9.81 + 4) / 9.81, .02);
  EXPECT_NEAR(world.closure(), 0, 1e-9 * world.exchanged);
}

// A strip hangs on another one of other cells, that on a plane: what the ties of each pull is the weight below, whichever way the
// plane turned its strips.
TEST(ContactPairs, TiesPullAsMuchAsHangsOnThem) {
  for (const double turn : {0., 2.}) {
    World world;
    world.config.layer = 1e-4;
    world.config.pairs = {pair("body0", "body1", "tied"), pair("body0", "ceiling", "tied")};
    const Mat3 rotation = Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix();
    world.gravity = rotation * Vec3(0, -9.81, 0);
    world.add_strip(Vec3(0, 0, 0), 5, 4, .1, .1, 2800, 2e9);
    world.add_strip(Vec3(.05, -.21, 0), 4, 3, .07, .07, 2800, 2e9);
    for (Node& x : world.x) x = node(rotation * vec3(x));
    world.add_plane("ceiling", rotation * Vec3(0, .4, 0), rotation * -Vec3::UnitY(), 0, [](double) { return Vec3(Vec3::Zero()); });
    Contact contact = world.make();
    const size_t upper = 6 * 5;
    double weight = 0, lower_weight = 0, from = 0;
    for (size_t i = 0; i < world.x.size(); ++i) (i < upper ? weight : lower_weight) += world.mass[i] * 9.81;
    std::vector<double> pressed(world.x.size(), 0.0);
    while (world.time < .2) {
      world.step(contact, 5e-6, false);
      if (world.time < .1) continue;
      if (from == 0) from = world.time;
      contact.add_normal_impulses(pressed);
    }
    double top = 0, below = 0;
    for (size_t i = 0; i < pressed.size(); ++i) {
      const double height = (rotation.transpose() * vec3(world.x[i])).y();
      if (height > .3) top += pressed[i];
      if (i >= upper) below += pressed[i];
      if (i < upper && height > .05 && height < .3) {
        EXPECT_EQ(pressed[i], 0) << i;
      }
    }
    EXPECT_NEAR(-top / (world.time - from) / (weight + lower_weight), 1, .02);
    EXPECT_NEAR(-below / (world.time - from) / lower_weight, 1, .02);
  }
}

TEST(ContactPairs, ATieThatFindsNothingIsRefused) {
  World world = two_strips(.05);
  world.config.pairs = {pair("body0", "body1", "tied")};
  try {
    world.make();
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::invalid_scene);
    EXPECT_NE(std::string(error.what()).find("tie_distance"), std::string::npos) << error.what();
  }
  world.config.pairs[0].tie_distance = .051;
  EXPECT_NO_THROW(world.make());
}

TEST(ContactPairs, FrictionIsOfThePair) {
  EXPECT_NEAR(slides({}, .3).first, .3, 1e-6);
  EXPECT_NEAR(slides({pair("body0", "floor", "sliding", .3)}, .1).first, .3, 1e-6);
  EXPECT_DOUBLE_EQ(slides({pair("body0", "floor", "frictionless")}, .3).second, 1);
  EXPECT_LT(std::abs(slides({pair("body0", "floor", "sticking")}, .3).second), .5);
}

// A tool that a body does not see goes through it.
TEST(ContactPairs, NoneIsNoContact) {
  for (const bool sees : {true, false}) {
    World world;
    world.config.layer = 1e-3;
    if (!sees) world.config.pairs = {pair("body0", "wall", "none")};
    world.add_strip(Vec3(0, .01, 0), 6, 3, .1, .1, 2800, 2e9);
    world.add_plane("wall", Vec3::Zero(), Vec3::UnitY(), 0, [](double) { return Vec3::Zero(); });
    for (Node& v : world.v) v = Node(0, -10, 0, 0);
    Contact contact = world.make();
    for (int i = 0; i < 2000; ++i) world.step(contact, 5e-6, i % 100 == 0);
    EXPECT_EQ(world.crossings, 0);
    if (sees)
      EXPECT_GT(world.mean_velocity().y(), 0);
    else
      EXPECT_NEAR(world.mean_velocity().y(), -10, 1e-12);
  }
}

// A soft plate tied on a larger one whose mesh does not match: what is tied at its rim is no more than can be held, and
// takes energy only.
TEST(ContactPairs, TiesAtARimGiveNoEnergy) {
  World world;
  world.dimension = 3;
  world.config.layer = 1e-4;
  world.add_box(Vec3(0, 0, 0), 10, 6, 1, .12, 2700, 2e9);
  world.add_box(Vec3(.1, .12, .12), 7, 5, 1, .14, 2700, 2e7);
  world.config.pairs = {pair("body0", "body1", "tied")};
  Contact contact = world.make();
  for (size_t i = 0; i < world.x.size(); ++i) {
    const double x = world.x[i][0] - .6, y = world.x[i][1] - .36;
    world.v[i] = Node(0, 0, 40 * (3 * x * x - 2 * y * y + x * y), 0);
  }
  const double given = world.kinetic();
  double most = 0;
  for (int i = 0; i < 1500; ++i) {
    world.step(contact, 1e-5, i % 100 == 0);
    most = std::max(most, world.kinetic());
    ASSERT_LT(most, 1.01 * given) << "at step " << i;
  }
}

}  // namespace contact_test
