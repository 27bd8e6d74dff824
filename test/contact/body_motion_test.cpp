// The motion of a body as a whole: by its masses where it is free, and by what holds it.
#include "forming_sim/contact/body_motion.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

using namespace forming_sim;

namespace {

struct Cloud {
  NodeField x, v;
  std::vector<double> inverse_mass;
  /// Nodes at random, with a motion of their own.
  Cloud(int nodes, int dimension, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> in(-1, 1);
    for (int n = 0; n < nodes; ++n) {
      x.emplace_back(in(random), in(random), dimension == 3 ? in(random) : 0, 0);
      v.emplace_back(in(random), in(random), dimension == 3 ? in(random) : 0, 0);
      inverse_mass.push_back(1 / (2 + in(random)));
    }
  }
  BodyMotion motion(const MovingBody& body, std::vector<Hold> holds = {}) const {
    Team team(1);
    return body.motion(body.masses(team, x, v, 0), v, [&](int n) { return x[n]; }, holds);
  }
  MovingBody body(int first, int nodes, int modes, const std::vector<HeldNode>& held = {}) const {
    MovingBody body(first, nodes, modes);
    body.hold(inverse_mass, held);
    return body;
  }
};

Node turning(const Vec3& v, const Vec3& w, const Node& x) { return node(v + w.cross(vec3(x))); }

}  // namespace

TEST(BodyMotion, OfAFreeBodyHasItsMomentum) {
  for (const int dimension : {2, 3}) {
    const Cloud cloud(40, dimension, 1);
    const BodyMotion motion = cloud.motion(cloud.body(0, 40, rigid_modes(dimension, false)));
    Vec3 p = Vec3::Zero(), L = Vec3::Zero();
    for (int n = 0; n < 40; ++n) {
      const Vec3 rest = vec3(cloud.v[n] - motion.at(cloud.x[n])) / cloud.inverse_mass[n];
      p += rest;
      L += vec3(cloud.x[n]).cross(rest);
    }
    EXPECT_LT(p.norm(), 1e-11);
    EXPECT_LT(L.norm(), 1e-10);
  }
}

TEST(BodyMotion, OfARigidOneIsItsOwn) {
  Cloud cloud(5000, 3, 2);
  const Vec3 v(3, -2, 1), w(.5, .7, -.2);
  for (int n = 0; n < 5000; ++n) cloud.v[n] = turning(v, w, cloud.x[n]);
  const BodyMotion motion = cloud.motion(cloud.body(0, 5000, 6));
  for (int n = 0; n < 5000; n += 7) EXPECT_LT((motion.at(cloud.x[n]) - cloud.v[n]).norm(), 1e-10);
}

// Half a body moves as the whole one, whose other half is its mirror image.
TEST(BodyMotion, OfHalfABodyIsThatOfTheWhole) {
  const int half = 20;
  Cloud whole(2 * half, 3, 3);
  for (int n = 0; n < 3; ++n) whole.x[n][0] = whole.v[n][0] = 0;
  for (int n = 0; n < half; ++n) {
    whole.x[half + n] = whole.x[n];
    whole.v[half + n] = whole.v[n];
    whole.x[half + n][0] *= -1;
    whole.v[half + n][0] *= -1;
    whole.inverse_mass[half + n] = whole.inverse_mass[n];
  }
  const BodyMotion exact = whole.motion(whole.body(0, 2 * half, 6));
  std::vector<HeldNode> held;
  for (int n = 0; n < 3; ++n) held.push_back({n, Mat3(Vec3(0, 1, 1).asDiagonal())});
  const BodyMotion found = whole.motion(whole.body(0, half, 6, held));
  for (int n = 0; n < half; ++n) EXPECT_LT((found.at(whole.x[n]) - exact.at(whole.x[n])).norm(), 1e-4);
}

TEST(BodyMotion, OfAGrippedBodyIsThatOfItsGrips) {
  Cloud cloud(200, 3, 4);
  const Vec3 v(3, -2, 1), w(.5, .7, -.2);
  std::vector<HeldNode> held;
  for (int n = 50; n < 60; ++n) {
    held.push_back({n, Mat3::Zero()});
    cloud.v[n] = turning(v, w, cloud.x[n]);
    cloud.inverse_mass[n] = 0;
  }
  for (const int count : {200, 60}) {
    MovingBody body = cloud.body(50, count - 50, 6, held);
    const BodyMotion motion = cloud.motion(body);
    for (int n = 50; n < 60; ++n) EXPECT_LT((motion.at(cloud.x[n]) - cloud.v[n]).norm(), 1e-5);
    body.hold(cloud.inverse_mass, {});
    if (count == 200) {
      EXPECT_GT((cloud.motion(body).at(cloud.x[50]) - cloud.v[50]).norm(), .1);
    }
  }
}

// A body that is held at one point turns about it.
TEST(BodyMotion, OfAPinnedBodyIsATurnAboutThePin) {
  Cloud cloud(64, 2, 5);
  cloud.v[7] = Node::Zero();
  cloud.inverse_mass[7] = 0;
  const MovingBody body = cloud.body(0, 64, 3, {{7, Mat3::Zero()}});
  const BodyMotion motion = cloud.motion(body);
  double L = 0, J = 0;
  for (int n = 0; n < 64; ++n) {
    if (n == 7) continue;
    const Vec3 r = vec3(cloud.x[n] - cloud.x[7]);
    L += r.cross(vec3(cloud.v[n])).z() / cloud.inverse_mass[n];
    J += r.squaredNorm() / cloud.inverse_mass[n];
  }
  EXPECT_NEAR(motion.own.w.z(), L / J, 1e-5);
  EXPECT_LT(motion.at(cloud.x[7]).norm(), 1e-5);
}

// A block on a plane that rises: as the plane across it, by its masses along it.
TEST(BodyMotion, OfABodyOnAToolIsTheToolsAcrossIt) {
  const Cloud cloud(64, 2, 7);
  const MovingBody body = cloud.body(0, 64, 3);
  std::vector<Hold> holds;
  for (int n = 0; n < 5; ++n) holds.push_back({cloud.x[n], Node(0, 1, 0, 0), 3});
  const BodyMotion motion = cloud.motion(body, holds);
  double p = 0, m = 0;
  for (int n = 0; n < 64; ++n) {
    p += cloud.v[n][0] / cloud.inverse_mass[n];
    m += 1 / cloud.inverse_mass[n];
    EXPECT_NEAR(motion.at(cloud.x[n])[1], 3, 1e-4);
    EXPECT_NEAR(motion.at(cloud.x[n])[0], motion.own.v[0], 1e-4);
  }
  EXPECT_NEAR(motion.own.v[0], p / m, 1e-10);
}

// However holds lie, the own motion has no more energy than that of the free body.
TEST(BodyMotion, OfItsOwnHasNoMoreThanTheMassesHave) {
  std::mt19937 random(11);
  std::normal_distribution<double> some;
  for (unsigned seed = 0; seed < 50; ++seed) {
    const Cloud cloud(64, 3, seed);
    const MovingBody body = cloud.body(0, 64, 6);
    const auto energy = [&](const BodyMotion& motion) {
      double sum = 0;
      for (int n = 0; n < 64; ++n) sum += motion.own.at(cloud.x[n]).squaredNorm() / cloud.inverse_mass[n];
      return sum;
    };
    std::vector<Hold> holds;
    const double free = energy(cloud.motion(body));
    for (int k = 0; k < 6; ++k) {
      const Vec3 n = Vec3(1e-3 * some(random), 1e-3 * some(random), 1).normalized();
      holds.push_back({cloud.x[k], node(n), some(random)});
      EXPECT_LT(energy(cloud.motion(body, holds)), free * (1 + 1e-9)) << seed << ' ' << k;
    }
  }
}

// A punch between two dies that rest moves no rigid body; by least squares a sheet on surfaces inclined by 1e-3 would be thrown along them at 200 times the punch's speed.
TEST(BodyMotion, ToolsThatDoNotAgreeTellNothing) {
  Cloud cloud(64, 2, 8);
  for (Node& v : cloud.v) v = Node::Zero();
  const MovingBody body = cloud.body(0, 64, 3);
  const auto across = [](double slope) { return Node(slope, 1, 0, 0).normalized(); };
  const std::vector<Hold> holds = {{Node(-1, -.1, 0, 0), across(1e-3), 0}, {Node(1, -.1, 0, 0), across(0), 0}, {Node(0, .1, 0, 0), across(0), -1}};
  const BodyMotion motion = cloud.motion(body, holds);
  EXPECT_EQ(motion.agreed, 0);
  for (const Node& x : cloud.x) EXPECT_LT(motion.told.at(x).norm(), 2);
}

// What moves on in addition, bodies and tools alike, is no agreement: it once was, of what rests beside it. And what a body does together with its tools agrees, up to rounding.
TEST(BodyMotion, AgreementIsTheSameInAnyFrame) {
  for (const double drift : {0., 1., 100.}) {
    Cloud cloud(64, 2, 8);
    for (Node& v : cloud.v) v = Node(drift, drift, 0, 0) + .1 * v;
    const MovingBody body = cloud.body(0, 64, 3);
    const Node up(0, 1, 0, 0), along(1, 0, 0, 0);
    const std::vector<Hold> apart = {{Node(-1, -.1, 0, 0), up, drift}, {Node(1, -.1, 0, 0), up, drift}, {Node(0, .1, 0, 0), up, drift - 1}, {Node(0, .1, 0, 0), along, drift}};
    EXPECT_EQ(cloud.motion(body, apart).agreed, 0) << drift;
    const std::vector<Hold> together = {{Node(-1, -.1, 0, 0), up, drift + 1}, {Node(1, -.1, 0, 0), up, drift + 1}, {Node(0, .1, 0, 0), along, drift}};
    EXPECT_GT(cloud.motion(body, together).agreed, .99) << drift;
    for (Node& v : cloud.v) v = Node(drift, drift, 0, 0);  // as its tools
    const std::vector<Hold> same = {{Node(-1, -.1, 0, 0), up, drift}, {Node(1, -.1, 0, 0), up, drift}, {Node(0, .1, 0, 0), along, drift}};
    if (drift > 0) {
      EXPECT_GT(cloud.motion(body, same).agreed, .99) << drift;
    }
  }
}

// In the plane the other three of the six modes are still.
TEST(BodyMotion, OfThreeModesInThePlaneIsThatOfSix) {
  const Cloud cloud(64, 2, 9);
  MovingBody flat = cloud.body(0, 64, 3), solid = cloud.body(0, 64, 6);
  const auto compare = [&](const std::vector<Hold>& holds) {
    const auto motion = [&](const MovingBody& body) { return cloud.motion(body, holds); };
    const BodyMotion three = motion(flat), six = motion(solid);
    EXPECT_NEAR(three.agreed, six.agreed, 1e-12);
    for (int n = 0; n < 64; n += 5) {
      EXPECT_LT((three.own.at(cloud.x[n]) - six.own.at(cloud.x[n])).norm(), 1e-10);
      EXPECT_LT((three.told.at(cloud.x[n]) - six.told.at(cloud.x[n])).norm(), 1e-10);
    }
    EXPECT_GT(three.own.v.norm() + three.told.v.norm(), .01);
  };
  const std::vector<Hold> on_tool = {{cloud.x[9], Node(1, 2, 0, 0).normalized(), std::sqrt(5)}, {cloud.x[20], Node(0, 1, 0, 0), .3}};
  compare({});
  compare(on_tool);
  for (MovingBody* body : {&flat, &solid}) body->hold(cloud.inverse_mass, {{4, Mat3(Vec3(0, 1, 1).asDiagonal())}, {5, Mat3(Vec3(0, 0, 1).asDiagonal())}});
  compare({});
  compare(on_tool);
}

// Off the axis nothing moves as a rigid body.
TEST(BodyMotion, TurnedAboutAnAxisItIsAlongIt) {
  Cloud cloud(30, 2, 6);
  MovingBody body = cloud.body(0, 30, 1);
  double p = 0, m = 0;
  for (int n = 0; n < 30; ++n) {
    p += cloud.v[n][1] / cloud.inverse_mass[n];
    m += 1 / cloud.inverse_mass[n];
  }
  for (const bool at_axis : {false, true}) {
    if (at_axis) body.hold(cloud.inverse_mass, {{0, Mat3(Vec3(0, 1, 1).asDiagonal())}});
    const Node v = cloud.motion(body).at(cloud.x[3]);
    EXPECT_NEAR(v[1], p / m, 1e-12);
    EXPECT_EQ(v[0], 0);
  }
  body.hold(cloud.inverse_mass, {{0, Mat3(Vec3(1, 0, 1).asDiagonal())}});
  EXPECT_NEAR(cloud.motion(body).at(cloud.x[3])[1], cloud.v[0][1], 1e-5);
}
