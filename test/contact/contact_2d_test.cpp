// Cases in the plane that break simpler contact algorithms.
#include <gtest/gtest.h>

#include "contact/hard_scenes.h"

using contact_test::polyline;
using contact_test::World;
using namespace forming_sim;

namespace {

std::vector<Vec3> line(double x0, double x1, int n, double y = 0) {
  std::vector<Vec3> points;
  for (int i = 0; i <= n; ++i) points.emplace_back(x0 + (x1 - x0) * i / n, y, 0);
  return points;
}

}  // namespace

// Nodes exactly over the vertices of the tool, and halfway: the force is the same.
TEST(Contact2D, NodeOverAVertexHasOneForce) {
  double active[2];
  Vec3 impulse[2];
  for (int shifted = 0; shifted < 2; ++shifted) {
    World world;
    world.add_strip(Vec3(0, 2e-3, 0), 10, 1, .1, .1, 2700, 0);
    world.config.layer = 1e-3;
    for (auto& v : world.v) v = Node(0, -10, 0, 0);
    world.add_tool("die", polyline(line(-1, 2, 30)), 0, [shifted](double) { return Vec3(shifted * .05, 0, 0); });
    Contact contact = world.make();
    for (int i = 0; i < 5; ++i) world.step(contact, 5e-5);
    active[shifted] = world.last.active;
    impulse[shifted] = world.momentum();
    EXPECT_EQ(world.crossings, 0);
  }
  EXPECT_EQ(active[0], 11);  // node on node, each once
  EXPECT_NEAR(impulse[0].y() / impulse[1].y(), 1, 1e-3);
}

// A row of nodes under a weight slides over collinear facets: no bumps.
TEST(Contact2D, SlidingOverCollinearFacetsIsSmooth) {
  World world;
  world.add_strip(Vec3(0, 0, 0), 5, 1, .013, .013, 2700, 0);
  world.gravity = Vec3(0, -1e4, 0);
  world.config.layer = 1e-5;
  for (auto& v : world.v) v = Node(20, 0, 0, 0);
  // Only the lower row touches; the upper row is held at its height.
  for (int i = 6; i < 12; ++i) {
    Mat3 p = Mat3::Identity();
    p(1, 1) = 0;
    world.held.push_back({i, p});
    world.held_velocity.push_back(Node::Zero());
  }
  world.add_tool("die", polyline(line(-1, 3, 173)), 0, [](double) { return Vec3::Zero(); });
  Contact contact = world.make();
  const double dt = 1e-6, expected = 6 * 2700 * .013 * .013 / 2 * 5 / 6 * 1e4 * dt;
  for (int i = 0; i < 6000; ++i) world.step(contact, dt, false);  // comes to rest in the layer
  double sum = 0, sum2 = 0, side = 0;
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    world.step(contact, dt, false);
    const Vec3 j = world.last.tool_impulse[0];
    sum += -j.y() / expected;
    sum2 += std::pow(-j.y() / expected - 1, 2);
    side = std::max(side, std::abs(j.x() / expected));
  }
  EXPECT_NEAR(sum / n, 1, 1e-3);
  EXPECT_LT(std::sqrt(sum2 / n), 1e-3);
  EXPECT_LT(side, 1e-3);
  EXPECT_EQ(contact.count_crossings(world.x, world.motion(0, 0)), 0);
  EXPECT_GT(world.x[0][0], .4);  // it did pass facets
}

// The point of a groove, reached at speed, over many depths of layer.
TEST(Contact2D, GrooveHoldsAFastNode) {
  for (double half_angle : {15., 30., 60.})
    for (double layer : {1e-2, 1e-3, 1e-5}) {
      World world = contact_test::groove(half_angle, layer);
      Contact contact = world.make();
      for (int i = 0; i < 400; ++i) world.step(contact, 5e-6);
      EXPECT_EQ(world.crossings, 0) << half_angle << " " << layer;
      EXPECT_GT(world.least_gap, 0);
      EXPECT_NEAR(world.closure(), 0, 1e-12 * world.exchanged);
    }
}

// A wedge sharper than the mesh hits between two nodes.
TEST(Contact2D, TipBetweenNodes) {
  for (double speed : {50., 500.}) {
    World world;
    world.add_strip(Vec3(-1, 0, 0), 4, 2, .5, .5, 2700, 5e9);
    world.config.layer = 1e-3;
    world.add_tool("wedge", polyline({Vec3(-.02, -1, 0), Vec3(0, 0, 0), Vec3(.02, -1, 0)}), 0, [speed](double t) { return Vec3(.23, -.01 + speed * t, 0); });
    Contact contact = world.make();
    for (int i = 0; i < 400; ++i) world.step(contact, 2e-5 * 50 / speed);
    EXPECT_EQ(world.crossings, 0);
    EXPECT_EQ(world.halvings, 0);
    EXPECT_GT(world.momentum().y(), 0);  // it was pushed
    EXPECT_NEAR(world.closure(), 0, 1e-12 * world.exchanged);
  }
}

// Between two tools whose distance is t + 2 h0: free; t + h0: half the layers.
TEST(Contact2D, SqueezeFollowsTheLayer) {
  for (double room : {2., 1.}) {
    World world;
    const double h0 = 1e-4, t = .1, a = .1;
    world.add_strip(Vec3(0, 0, 0), 6, 1, a, t, 2700, 1e13);  // stiff against the layer
    world.config.layer = h0;
    world.config.stiffness = 1e7;
    const double closing = (2 - room) * h0;
    world.add_tool("die", polyline(line(-1, 2, 3)), 0, [](double) { return Vec3::Zero(); });
    world.add_tool("punch", polyline(line(-1, 2, 3)), 0, [=](double s) { return Vec3(0, t - closing * std::min(1., s / 1e-3), 0); });
    Contact contact = world.make();
    double force = 0;
    int n = 0;
    for (int i = 0; i < 12000; ++i) {
      world.step(contact, 1e-6 / 4, false);
      for (auto& v : world.v) v *= .995;  // settle
      if (i >= 8000) force += world.last.tool_impulse[1].y() / world.last.dt, ++n;
    }
    EXPECT_EQ(contact.count_crossings(world.x, world.motion(world.time, world.time)), 0);
    // Each layer is left with h0/2: the pressure is E (h0/h - 1) = E on the mean; length .6 plus two half end faces.
    const double expected = room == 2 ? 0 : 1e7 * (.6 + 2 * t / 2);
    EXPECT_NEAR(force / n, expected, room == 2 ? 1 : .01 * expected);
  }
}

// Two surfaces nearer than 2 h0 to each other with a body between: sweeps, not halvings.
TEST(Contact2D, NodeBetweenNarrowWalls) {
  World world;
  world.add_strip(Vec3(-.05, .7, 0), 1, 3, .1, .1, 2700, 4e9);
  world.config.layer = 4e-3;
  for (auto& v : world.v) v = Node(0, -200, 0, 0);
  world.add_tool("slot", polyline({Vec3(-.3, 1, 0), Vec3(-.0501, 0, 0), Vec3(.0501, 0, 0), Vec3(.3, 1, 0)}), .1, [](double) { return Vec3::Zero(); });
  Contact contact = world.make();
  for (int i = 0; i < 600; ++i) world.step(contact, 1e-5);
  EXPECT_EQ(world.crossings, 0);
  EXPECT_LT(world.halvings, 20);
  EXPECT_NEAR(world.closure(), 0, 1e-12 * world.exchanged);
}

// Fast impacts with layers far thinner than the way of a step.
TEST(Contact2D, FastImpactNeverCrosses) {
  for (double speed : {500., 1500.})
    for (double layer : {1e-2, 1e-3, 1e-4, 1e-6}) {
      World world;
      world.add_strip(Vec3(0, .04, 0), 12, 4, .1, .1, 2800, 3e10, .1);
      world.config.layer = layer;
      for (auto& v : world.v) v = Node(40, -speed, 0, 0);
      world.add_tool("wall", polyline(line(-2, 3, 47)), .1, [](double) { return Vec3::Zero(); });
      Contact contact = world.make();
      for (int i = 0; i < 200; ++i) world.step(contact, 1e-5);
      EXPECT_EQ(world.crossings, 0) << speed << " " << layer;
      EXPECT_GT(world.least_gap, 0);
      if (layer >= .1 * speed * 1e-5) {
        EXPECT_EQ(world.halvings, 0) << speed << " " << layer;
      }
      EXPECT_GT(world.momentum().y(), 0);  // it rebounds
      EXPECT_GE(world.dissipated, -1e-6 * world.exchanged);
      EXPECT_NEAR(world.closure(), 0, 1e-12 * world.exchanged) << speed << " " << layer;
    }
}

// A pair that is born deep inside the layer (a tool appears there) pushes
// softly, not with h0/dt; without the soft start it would.
TEST(Contact2D, BirthInsideTheLayerDoesNotEject) {
  for (double fraction : {.9, .1, .001})
    for (double push : {.1, 1e3}) {
      World world;
      const double h0 = 1e-3;
      world.add_strip(Vec3(0, 0, 0), 4, 1, .1, .1, 2700, 0);
      world.add_strip(Vec3(1, -.1 - 2 * fraction * h0, 0), 4, 1, .1, .1, 2700, 0);  // on both sides: the tool is neither set back nor backed off
      world.config.layer = h0;
      world.config.push_speed = push;
      world.add_tool("foil", polyline(line(-1, 2, 3)), 0, [=](double) { return Vec3(0, -fraction * h0, 0); });
      Contact contact = world.make();
      ASSERT_EQ(contact.warnings().size(), 1u);
      double most = 0;
      const double dt = 1e-6;
      for (int i = 0; i < 3000; ++i) {
        world.step(contact, dt, false);
        for (const Node& v : world.v) most = std::max(most, v.norm());
      }
      if (push < 1)
        EXPECT_LE(most, 2 * push) << fraction;
      else
        EXPECT_GT(most, 10) << fraction;  // the control: a layer that is there at once throws the nodes
      EXPECT_NEAR(world.closure(), 0, 1e-12 * (world.exchanged + std::abs(world.soft)));
    }
}

// A node slides fast off the end of one plate onto a face that lies lower than the layer is thick.
TEST(Contact2D, SlidingOntoANewFaceDoesNotEject) {
  World world;
  const double h0 = 1e-3;
  world.add_strip(Vec3(-.5, h0 * 1.0001, 0), 3, 1, .1, .1, 2700, 0);
  world.config.layer = h0;
  for (auto& v : world.v) v = Node(300, 0, 0, 0);
  // Steps up and down by half a layer, with open ends.
  world.add_tool("steps", polyline({Vec3(-1, -h0, 0), Vec3(0, -h0, 0)}), 0, [=](double) { return Vec3(0, h0, 0); });
  world.add_tool("next", polyline({Vec3(.00001, -h0, 0), Vec3(3, -h0, 0)}), 0, [=](double) { return Vec3(0, 1.5 * h0, 0); });
  world.bodies[0].facets.resize(world.bodies[0].facets.size());
  double most = 0;
  Contact contact = world.make();
  for (int i = 0; i < 2000; ++i) {
    world.step(contact, 1e-6, false);
    for (const Node& v : world.v) most = std::max(most, std::abs(v[1]));
  }
  // Half a layer of height at this speed may be climbed over the tip's round, not shot up at h0/dt = 1000 m/s.
  EXPECT_LT(most, 300);
  EXPECT_NEAR(world.closure(), 0, 1e-12 * (world.exchanged + 1e-12));
}

// A row of nodes under a weight slides at 300 m/s off a cliff, onto a face that lies a part of a layer or two below. Its
// distance to the tool changes steadily, so that no pair is born deep inside its layer: a soft start or none gives the same.
TEST(Contact2D, SlidingOffACliffDoesNotEject) {
  for (double depth : {.2, .5, .9, 2.})
    for (double pressed : {.9, .3}) {  // of the layer
      double thrown[2];
      for (int soft = 0; soft < 2; ++soft) {
        World world;
        const double h0 = 1e-3, pressure = 1e6 * (1 / pressed - 1);
        world.config.layer = h0;
        world.config.push_speed = soft ? .1 : 1e6;
        world.modulus = 1e6;
        world.add_strip(Vec3(-.35, h0, 0), 3, 1, .1, .1, 2700, 0);
        world.gravity = Vec3(0, -pressure * .1 / (2700 * .1 * .05), 0);
        for (auto& v : world.v) v = Node(300, 0, 0, 0);
        world.add_tool("cliff", polyline({Vec3(-1, 0, 0), Vec3(0, 0, 0), Vec3(0, -depth * h0, 0), Vec3(3, -depth * h0, 0)}), 0, [](double) { return Vec3::Zero(); });
        Contact contact = world.make();
        thrown[soft] = 0;
        for (int i = 0; i < 2000; ++i) {
          world.step(contact, 1e-6);
          for (int n = 0; n < 4; ++n) thrown[soft] = std::max(thrown[soft], world.v[n][1]);
        }
        EXPECT_GT(world.x[0][0], .1) << "all nodes are beyond the cliff";
        EXPECT_EQ(world.crossings, 0) << depth << " " << pressed;
        EXPECT_LT(thrown[soft], .02 * h0 / 1e-6) << depth << " " << pressed;
      }
      EXPECT_NEAR(thrown[0], thrown[1], 1e-3 * thrown[0]) << depth << " " << pressed;
    }
}

// A plane that turns fast about a far point, in long steps: its normal at the end of a step is not that of the beginning.
TEST(Contact2D, APlaneThatTurnsFastLetsNothingThrough) {
  World world;
  world.add_strip(Vec3(0, -.1, 0), 10, 5, .02, .02, 2700, 0);
  world.config.layer = 1e-5;
  world.turning = -600;
  world.add_plane("press", Vec3(.5, 1e-3, 0), Vec3(0, -1, 0), .3, [](double) { return Vec3(-.5, 0, 0); });
  Contact contact = world.make();
  for (int i = 0; i < 8; ++i) world.step(contact, 7e-5);
  EXPECT_EQ(world.crossings, 0);
  EXPECT_GT(world.least_gap, 0);
  EXPECT_GT(world.last.active, 5);
  EXPECT_NEAR(world.closure(), 0, 1e-9 * world.exchanged);
}

// A lid that is at once below the ground, however short the step: none is found, and those that the steps before were
// halved by count too.
TEST(Contact2D, HalvingsOfStepsInARowCountTogether) {
  for (const auto& [halved_before, tries] : {std::pair{0, 32}, std::pair{25, 7}}) {  // 30 or 5 halvings; the first step is tried twice
    World world;
    world.config.max_halvings = 30;
    world.add_strip(Vec3(0, .05, 0), 2, 1, .1, .1, 2700, 0);
    world.add_plane("ground", Vec3::Zero(), Vec3::UnitY(), 0, [](double) { return Vec3(Vec3::Zero()); });
    world.add_plane("lid", Vec3(0, .3, 0), -Vec3::UnitY(), 0, [](double t) { return Vec3(0, t > 0 ? -.4 : 0, 0); });
    Contact contact = world.make();
    const double dt = 1e-6;
    int tried = 0;
    NodeField v_before;
    const auto predict = [&](double, NodeField& v_star) { v_star = world.v; };
    const auto move = [](double, const NodeField&, NodeField&) {};
    const auto tools = [&](double h, std::vector<ToolMotion>& motion) {
      ++tried;
      motion = world.motion(0, h);
    };
    try {
      contact.advance(0, dt, world.x, world.v, v_before, predict, move, tools, std::ldexp(dt, halved_before));
      ADD_FAILURE() << "a step was found";
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), Code::contact_error) << e.what();
    }
    EXPECT_EQ(tried, tries);
  }
}
