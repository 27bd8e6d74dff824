// Many bodies pressed together, bodies of unequal mass and stiffness, steps that have to be halved.
#include <gtest/gtest.h>

#include <random>

#include "contact/point_bodies.h"

using contact_test::polyline;
using contact_test::World;
using namespace forming_sim;

namespace {

/// 16 polygons in a box whose lid comes down; what is left of the box when it stops.
World crowd(unsigned seed, const std::string& method, double layer) {
  World world;
  world.config.method = method;
  world.config.layer = layer;
  world.config.friction = .2;
  world.modulus = 1e9;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> some(0, 1);
  for (int i = 0; i < 16; ++i) {
    const int corners = 3 + static_cast<int>(5 * some(random));
    const Vec3 middle(.15 + .3 * (i % 4), .15 + .3 * (i / 4), 0);
    const double radius = .08 + .06 * some(random), turn = 6 * some(random);
    std::vector<Vec3> outline;
    for (int k = 0; k < corners; ++k) {
      const double a = turn + 2 * M_PI * (k + .4 * some(random)) / corners;
      outline.push_back(middle + radius * Vec3(std::cos(a), std::sin(a), 0));
    }
    const size_t first = world.x.size();
    world.add_polygon(outline, 10, 1e8);
    const Node velocity(50 * (2 * some(random) - 1), 50 * (2 * some(random) - 1), 0, 0);
    for (size_t n = first; n < world.x.size(); ++n) world.v[n] = velocity;
  }
  world.add_tool("box", polyline({Vec3(0, 3, 0), Vec3(0, 0, 0), Vec3(1.2, 0, 0), Vec3(1.2, 3, 0)}), .2, [](double) { return Vec3::Zero(); });
  world.add_tool("lid", polyline({Vec3(.01, 0, 0), Vec3(1.19, 0, 0)}), .2, [](double t) { return Vec3(0, 1.3 - 20 * std::min(t, .033), 0); });
  return world;
}

}  // namespace

// Nothing crosses, whatever the bodies do; the printed explicit law with the same layer and step lets them through.
TEST(ContactCrowd, SixteenBodiesAreCrushed) {
  for (unsigned seed : {1u, 2u, 3u})
    for (double layer : {1e-3, 1e-4}) {
      World world = crowd(seed, "implicit", layer);
      Contact contact = world.make();
      for (int i = 0; i < 4000; ++i) world.step(contact, 1e-5);
      std::cout << "  seed " << seed << ", layer " << layer << ": halvings " << world.halvings << ", sweeps at most " << world.most_sweeps << ", least gap " << world.least_gap << "\n";
      EXPECT_EQ(world.crossings, 0) << seed << " " << layer;
      EXPECT_GT(world.friction, 0);
      EXPECT_NEAR(world.closure(), 0, 1e-10 * world.exchanged);
      EXPECT_GE(world.dissipated, -1e-6 * world.exchanged);
    }
}

TEST(ContactCrowd, TheExplicitLawLetsThemThrough) {
  World world = crowd(1, "explicit", 1e-3);
  Contact contact = world.make();
  bool blown_up = false;
  try {
    for (int i = 0; i < 4000 && world.crossings == 0; ++i) world.step(contact, 1e-5);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), Code::contact_error);
    blown_up = true;
  }
  EXPECT_TRUE(blown_up || world.crossings > 0);
}

// A block meets one of other mass or stiffness, askew, meshes that do not match.
TEST(ContactCrowd, UnequalMassesAndStiffnesses) {
  struct Case {
    double mass, stiffness;
  };
  for (const Case& ratio : {Case{1e2, 1}, Case{1e4, 1}, Case{1e6, 1}, Case{1, 1e-3}, Case{1, 1e-4}, Case{1e3, 1e3}}) {
    World world;
    world.config.layer = 1e-3;
    world.modulus = 70e9 * std::min(1., ratio.stiffness);
    world.add_strip(Vec3(0, 0, 0), 10, 5, .1, .1, 2800, 2e10);
    const size_t split = world.x.size();
    world.add_strip(Vec3(.13, .57, 0), 7, 5, .11, .1, 2800 * ratio.mass, 2e10 * ratio.stiffness, .1);
    double scale = 0, energy = 0;
    for (size_t i = 0; i < world.x.size(); ++i) {
      world.v[i] = Node(0, i < split ? 50 : -50, 0, 0);
      scale += world.mass[i] * 50;
      energy += .5 * world.mass[i] * 50 * 50;
    }
    const Vec3 p = world.momentum(), l = world.angular_momentum();
    Contact contact = world.make();
    for (int i = 0; i < 1200; ++i) world.step(contact, 5e-6);
    EXPECT_GT(world.exchanged, 0);
    EXPECT_EQ(world.crossings, 0) << ratio.mass << " " << ratio.stiffness;
    EXPECT_EQ(world.halvings, 0) << ratio.mass << " " << ratio.stiffness;
    EXPECT_LT((world.momentum() - p).norm(), 1e-12 * scale) << ratio.mass << " " << ratio.stiffness;
    EXPECT_LT((world.angular_momentum() - l).norm(), 1e-12 * scale) << ratio.mass << " " << ratio.stiffness;
    EXPECT_NEAR(world.closure(), 0, 1e-10 * world.exchanged);
    EXPECT_GE(world.dissipated, -1e-6 * energy);
  }
}

// Layers a hundred thousandth of the way of a step: steps are halved, momentum stays, and a run whose list is built
// anew after every halved step is the same bit for bit.
TEST(ContactCrowd, HalvedStepsKeepMomentumAndTheList) {
  World world;
  world.config.layer = 1e-7;
  world.add_strip(Vec3(0, 0, 0), 10, 5, .1, .1, 2800, 2e10);
  const size_t split = world.x.size();
  world.add_strip(Vec3(.13, .56, 0), 7, 5, .11, .1, 2800, 2e10, .1);
  double scale = 0;
  for (size_t i = 0; i < world.x.size(); ++i) {
    world.v[i] = Node(0, i < split ? 500 : -500, 0, 0);
    scale += world.mass[i] * 500;
  }
  const Vec3 p = world.momentum(), l = world.angular_momentum();
  Contact contact = world.make();
  const World start = world;
  World anew = world;
  for (int i = 0; i < 400; ++i) {
    const std::vector<char> saved = contact.save();
    world.step(contact, 1e-5);
    Contact fresh = start.make();
    fresh.restore(saved);
    anew.step(fresh, 1e-5, false);
    for (size_t n = 0; n < world.x.size(); ++n) ASSERT_TRUE(world.x[n] == anew.x[n] && world.v[n] == anew.v[n]) << "step " << i;
  }
  std::cout << "  " << world.halvings << " halvings\n";
  EXPECT_GT(world.halvings, 20);
  EXPECT_EQ(world.crossings, 0);
  EXPECT_LT((world.momentum() - p).norm(), 1e-12 * scale);
  EXPECT_LT((world.angular_momentum() - l).norm(), 1e-12 * scale);
  EXPECT_NEAR(world.closure(), 0, 1e-10 * world.exchanged);
}

// The tip of a needle in a narrow groove: short steps stop it with forces that a step a thousand times longer does not
// need, and walls that face each other so squarely take more sweeps than there are to take an impulse back.
TEST(ContactCrowd, ALongStepAfterShortOnesThrowsNothingOut) {
  World world;
  world.config.layer = 1e-5;
  const double half = .005;
  world.add_polygon({Vec3(0, .1, 0), Vec3(.1 * half, 1, 0), Vec3(-.1 * half, 1, 0)}, 1, 1e7);
  world.add_tool("groove", polyline({Vec3(-half, 1, 0), Vec3(0, 0, 0), Vec3(half, 1, 0)}), 0, [](double) { return Vec3::Zero(); });
  for (Node& v : world.v) v = Node(0, -50, 0, 0);
  Contact contact = world.make();
  for (int i = 0; i < 20000 && world.last.active == 0; ++i) world.step(contact, 1e-7, false);
  ASSERT_GT(world.last.active, 0);
  for (int i = 0; i < 200; ++i) world.step(contact, 1e-8, false);
  for (int i = 0; i < 5; ++i) world.step(contact, 1e-5, false);
  double fastest = 0;
  for (const Node& v : world.v) fastest = std::max(fastest, v.norm());
  EXPECT_LT(fastest, 50.5);
}
