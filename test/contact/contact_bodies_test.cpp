// Deformable bodies that meet each other and themselves.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "contact/point_bodies.h"

namespace contact_test {
namespace {

void fly(World& world, size_t first, size_t last, const Vec3& velocity) {
  for (size_t i = first; i < last; ++i) world.v[i] = node(velocity);
}

/// Steps until `duration`; the stable step of the springs is the caller's to know.
void run(World& world, Contact& contact, double dt, int steps) {
  for (int i = 0; i < steps; ++i) world.step(contact, dt, i % 5 == 0);
}

}  // namespace

// Two blocks fly at each other, meshes that do not match, tilted: momentum and
// angular momentum to rounding, energy closed, nothing crosses, they part again.
TEST(ContactBodies, TwoBlocksBounce) {
  for (double speed : {5., 500.})
    for (double layer : {1e-3, 1e-5}) {
      World world;
      world.config.layer = layer;
      world.add_strip(Vec3(0, 0, 0), 10, 10, .1, .1, 2800, 2e10);
      const size_t split = world.x.size();
      world.add_strip(Vec3(.13, 1.06, 0), 7, 9, .11, .1, 2800, 2e10, .04);
      fly(world, 0, split, Vec3(0, speed, 0));
      fly(world, split, world.x.size(), Vec3(0, -speed, 0));
      const Vec3 p = world.momentum(), l = world.angular_momentum();
      double scale = 0, energy = 0;
      for (size_t i = 0; i < world.x.size(); ++i) {
        scale += world.mass[i] * speed;
        energy += .5 * world.mass[i] * world.v[i].squaredNorm();
      }
      Contact contact = world.make();
      EXPECT_TRUE(contact.warnings().empty());
      run(world, contact, 5e-6, static_cast<int>(.06 / speed / 5e-6) + 300);
      EXPECT_GT(world.exchanged, 0.01 * energy);
      EXPECT_EQ(world.crossings, 0) << speed << " " << layer;
      EXPECT_LT((world.momentum() - p).norm(), 1e-12 * scale);
      // Without friction the impulses act along the line that joins their points.
      EXPECT_LT((world.angular_momentum() - l).norm(), 1e-12 * scale);
      EXPECT_NEAR(world.closure(), 0, 1e-10 * world.exchanged);
      EXPECT_GE(world.dissipated, -1e-6 * world.exchanged);
    }
}

// Bodies that touch at the start are moved apart by no more than the layer, and rest.
TEST(ContactBodies, AStackThatTouchesIsPartedAndRests) {
  World world;
  world.config.layer = 1e-4;
  for (int k = 0; k < 4; ++k) world.add_strip(Vec3(0, .2 * k, 0), k % 2 ? 3 : 4, 2, k % 2 ? .4 / 3 : .1, .1, 2800, 1e9);
  Contact contact = world.make();
  ASSERT_EQ(contact.body_shifts().size(), 4u);
  EXPECT_GE(contact.warnings().size(), 3u);
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(contact.body_shifts()[k].x(), 0, 1e-9);
    if (k > 0) {
      EXPECT_NEAR(contact.body_shifts()[k].y() - contact.body_shifts()[k - 1].y(), 1e-4, 1e-8);
    }
  }
  world.take_shifts(contact);
  run(world, contact, 1e-5, 200);
  double fastest = 0;
  for (const Node& v : world.v) fastest = std::max(fastest, v.norm());
  EXPECT_LT(fastest, 1e-5);
  EXPECT_EQ(world.crossings, 0);
}

TEST(ContactBodies, BodiesThatOverlapAreRefused) {
  World world;
  world.add_strip(Vec3(0, 0, 0), 4, 2, .1, .1, 2800, 0);
  world.add_strip(Vec3(.05, .15, 0), 4, 2, .1, .1, 2800, 0);
  world.config.layer = 1e-3;
  try {
    world.make();
    FAIL() << "should be refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::initial_penetration);
    EXPECT_NE(std::string(error.what()).find("body1"), std::string::npos) << error.what();
  }
}

// The force between two bodies does not ask which is named first.
TEST(ContactBodies, TheOrderOfTheBodiesDoesNotMatter) {
  Vec3 mean[2];
  for (int order = 0; order < 2; ++order) {
    World world;
    world.config.layer = 1e-3;
    for (int k = 0; k < 2; ++k) {
      const size_t first = world.x.size();
      const bool upper = k != order;
      world.add_strip(Vec3(upper ? .02 : 0, upper ? .31 : 0, 0), upper ? 5 : 4, 3, .1, .1, upper ? 900 : 2800, 1e9);
      fly(world, first, world.x.size(), Vec3(0, upper ? -5 : 5, 0));
    }
    Contact contact = world.make();
    run(world, contact, 1e-5, 800);
    const size_t split = order == 0 ? 20 : 24;
    Vec3 p = Vec3::Zero();
    double m = 0;
    for (size_t i = order == 0 ? 0 : split; i < (order == 0 ? split : world.x.size()); ++i) p += world.mass[i] * vec3(world.v[i]), m += world.mass[i];
    mean[order] = p / m;
    EXPECT_EQ(world.crossings, 0);
  }
  EXPECT_LT((mean[0] - mean[1]).norm(), 0.05 * 5) << mean[0].transpose() << " / " << mean[1].transpose();
}

// Coulomb friction of a block that slides on another with more mass: it slows by mu g.
TEST(ContactBodies, FrictionBetweenBodies) {
  World world;
  world.config.layer = 1e-4;
  world.config.friction = .3;
  world.add_strip(Vec3(0, 0, 0), 20, 1, .1, .1, 2.8e6, 0);
  const size_t split = world.x.size();
  world.add_strip(Vec3(.5, .1001, 0), 4, 2, .1, .1, 2800, 0);
  for (size_t i = 0; i < split; ++i) {
    HeldNode held;
    held.node = static_cast<int>(i);
    world.held.push_back(held);
    world.held_velocity.push_back(Node::Zero());
  }
  world.gravity = Vec3(0, -10, 0);
  fly(world, split, world.x.size(), Vec3(1, 0, 0));
  // Without springs every node of the sliding block must have its own floor: keep its lowest row only.
  Contact contact = world.make();
  const double dt = 1e-5;
  run(world, contact, dt, 4000);
  // The lowest row carries its own weight only, the others fall freely beside it.
  double v = 0;
  for (size_t i = split; i < split + 5; ++i) v += world.v[i][0] / 5;
  EXPECT_NEAR(1 - v, .3 * 10 * 4000 * dt, .02 * .3 * 10 * 4000 * dt);
}

// A strip bent to a U closes on itself: the legs meet and do not cross. Without
// self contact they do.
TEST(ContactBodies, AFoldMeetsItself) {
  long crossings[2];
  for (int on = 0; on < 2; ++on) {
    World world;
    world.config.layer = 1e-4;
    // Legs along x at y = 0 and y = .1, joined at the left.
    world.add_strip(Vec3(0, 0, 0), 20, 1, .05, .05, 2800, 1e8);
    const auto bend = [&](Node& n) {  // arc length along the middle line s, across r
      const double s = n[0], r = n[1] - .025, gap = .06, turn = M_PI * gap;
      const double leg = (1 - turn) / 2;
      if (s < leg) n = Node(leg - s, -gap + -r, 0, 0);
      else if (s > leg + turn) n = Node(s - leg - turn, gap + r, 0, 0);
      else {
        const double a = -M_PI / 2 - (s - leg) / gap;
        n = Node((gap + r) * std::cos(a), (gap + r) * std::sin(a), 0, 0);
      }
    };
    for (Node& n : world.x) bend(n);
    for (auto& spring : world.springs) spring.length = (world.x[spring.a] - world.x[spring.b]).norm();
    world.bodies[0].meets_itself = on;
    for (size_t i = 0; i < world.x.size(); ++i)
      if (world.x[i][0] > .05) world.v[i] = Node(0, world.x[i][1] > 0 ? -5 : 5, 0, 0);
    Contact contact = world.make();
    // Count with an observer that always knows of the body itself.
    World watched = world;
    watched.bodies[0].meets_itself = true;
    const Contact counter = watched.make();
    crossings[on] = 0;
    for (int i = 0; i < 3000; ++i) {
      world.step(contact, 1e-5, false);
      if (i % 20 == 0) crossings[on] += counter.count_crossings(world.x, {});
    }
    if (on) {
      EXPECT_GT(world.exchanged, 0);
      EXPECT_NEAR(world.closure(), 0, 1e-10 * world.exchanged);
    }
  }
  EXPECT_EQ(crossings[1], 0);
  EXPECT_GT(crossings[0], 0) << "the control should cross";
}

// Boxes in 3D at random places and velocities, edge against edge and corner against face.
TEST(ContactBodies, BoxesInThreeDimensions) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> some(-1, 1);
  long met = 0;
  for (int trial = 0; trial < 6; ++trial) {
    World world;
    world.dimension = 3;
    world.config.layer = 1e-4;
    world.add_box(Vec3(-.2, -.2, -.2), 2, 2, 2, .2, 2800, 3e8);
    const size_t split = world.x.size();
    world.add_box(Vec3(-.2, -.2, -.2), 3, 2, 2, .15, 900, 3e8);
    const Mat3 turn = Eigen::AngleAxisd(2 * some(random), Vec3(some(random), some(random), some(random)).normalized()).toRotationMatrix();
    for (size_t i = split; i < world.x.size(); ++i) world.x[i] = node(Vec3(turn * vec3(world.x[i]) + Vec3(0, 0, .75)));
    fly(world, split, world.x.size(), Vec3(0, 0, -60));
    const Vec3 p = world.momentum();
    Contact contact = world.make();
    run(world, contact, 1e-5, 1500);
    met += world.exchanged > 0;
    EXPECT_EQ(world.crossings, 0) << trial;
    EXPECT_LT((world.momentum() - p).norm(), 1e-11 * p.norm());
    EXPECT_NEAR(world.closure(), 0, 1e-9 * std::max(1e-300, world.exchanged));
  }
  EXPECT_EQ(met, 6);
}

}  // namespace contact_test
