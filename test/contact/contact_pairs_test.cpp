// What `pairs` says of two surfaces: sliding, frictionless, sticking, tied, none.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "contact/point_bodies.h"

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

Vec3 angular_momentum(const World& w) {
  Vec3 l = Vec3::Zero();
  for (size_t i = 0; i < w.x.size(); ++i) l += w.mass[i] * vec3(w.x[i]).cross(vec3(w.v[i]));
  return l;
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
    if (i == 0) l0 = angular_momentum(world).z();
    // .15 + 4 * .07 = .43: between the vertices at .4 and .5, 3 tenths of the way.
    const Node place = .7 * world.x[11 * 4 + 4] + .3 * world.x[11 * 4 + 5];
    farthest = std::max(farthest, (world.x[on] - place).norm());
  }
  EXPECT_EQ(world.crossings, 0);
  EXPECT_LT(farthest, 1e-6);
  EXPECT_LT((world.momentum() - p).norm(), 1e-9 * p.norm());
  EXPECT_NEAR(angular_momentum(world).z() / l0, 1, 1e-3);
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

}  // namespace contact_test
