// Waves of shear that leave where surfaces rub: what is steady is not braked, what swings is, a strike keeps Coulomb's impulse.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "contact/point_bodies.h"

using contact_test::World;
using namespace forming_sim;

namespace {

constexpr double kImpedance = 1e6;

/// Eight corners of a box of 2 x 1 x .5 m, and their masses.
struct Box {
  NodeField X;
  std::vector<double> inverse_mass;
  Box() {
    for (int k = 0; k < 8; ++k) {
      X.emplace_back(k & 1 ? 2 : 0, k & 2 ? 1 : 0, k & 4 ? .5 : 0, 0);
      inverse_mass.push_back(1 / (1 + .3 * k));
    }
  }
  ShearWaves waves(double time) const {
    ShearWaves waves({{kImpedance, time, 0, 8}}, 8, 6);
    waves.hold(inverse_mass, {});
    return waves;
  }
  static Team& team() {
    static Team one(1);
    return one;
  }
};

double phi_of(const ShearWaves& waves, int node) { return waves.steady(node, 0, Node::Zero())[3]; }

RubbedNode rubbed(int node) {
  RubbedNode of;
  of.node = node;
  return of;
}

/// A strip above a rough plane, with waves that leave.
World strip_over_plane(double mu, double impedance, double time) {
  World world;
  world.config.layer = 1e-4;
  world.add_strip(Vec3(0, 2e-4, 0), 12, 4, .01, .01, 2700, 2e9);
  world.bodies[0].waves = {impedance, time, 0, static_cast<int>(world.x.size())};
  world.add_plane("table", Vec3::Zero(), Vec3::UnitY(), mu, [](double) -> Vec3 { return Vec3::Zero(); });
  return world;
}

}  // namespace

TEST(ShearWaves, ABodyThatGathersSpeedAndTurnsIsSteady) {
  const Box box;
  ShearWaves waves = box.waves(.002);
  const double dt = 1e-3;
  const auto place = [&](double t, int n) -> Node {
    const Mat3 turn = Eigen::AngleAxisd(30 * t + 200 * t * t, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    return node(turn * vec3(box.X[n]) + Vec3(5 * t * t, 40 * t * t * t, t));
  };
  NodeField before(8), after(8), x(8);
  std::vector<RubbedNode> all;
  for (int n = 0; n < 8; ++n) all.push_back(rubbed(n));
  for (int step = 0; step < 100; ++step) {
    for (int n = 0; n < 8; ++n) {
      x[n] = place((step + 1) * dt, n);
      after[n] = (x[n] - place(step * dt, n)) / dt;
    }
    if (step > 0) waves.follow(box.team(), dt, dt, x, before, after, all);
    const auto steady = [&](int n, double steps) -> Node {
      Node v = waves.steady(n, steps, after[n]);
      v[3] = 0;
      return v;
    };
    for (int n = 0; n < 8; ++n) EXPECT_LT((steady(n, 0) - after[n]).norm(), 1e-9 * after[n].norm());
    if (step == 50) {
      for (int n = 0; n < 8; ++n) EXPECT_LT((steady(n, 1) - (place((step + 2) * dt, n) - x[n]) / dt).norm(), 5e-3 * after[n].norm());  // what is to come
    }
    before = after;
  }
  EXPECT_GT(phi_of(waves, 7), .9);
}

// A box that swings on a tool that gathers speed: across the tool its steady motion is the tool's.
TEST(ShearWaves, FollowsAToolAcrossItsSurface) {
  const Box box;
  ShearWaves waves = box.waves(1);
  NodeField before(8), after(8);
  for (int n = 0; n < 8; ++n) {
    before[n] = Node(.1 * n, .3 * n * n, -.2 * n, 0);
    after[n] = Node(-.2 * n * n, 1 - n, .1 * n, 0);
  }
  std::vector<RubbedNode> base;
  for (const int n : {0, 1, 4, 5}) {
    base.push_back(rubbed(n));
    base.back().by_tools = Node(0, 2 + n, 0, 0);
    base.back().told_before = (2 + n) * .5;
    base.back().told = (2 + n) * .7;
  }
  waves.follow(box.team(), 1e-9, 1e-9, box.X, before, after, base);
  for (const int n : {0, 1, 4, 5}) {
    const Node change = waves.steady(n, 1, after[n]) - waves.steady(n, 0, after[n]);
    EXPECT_NEAR(change[1], .2, 1e-4) << n;
  }
}

// Of a vertex that swings as sin(w t) in a body that does not move otherwise: (w T)^2/(1 + (w T)^2) of z v^2 at every frequency, and no impulse over time.
TEST(ShearWaves, WhatSwingsLosesEnergyAtEveryFrequency) {
  Box box;
  box.inverse_mass.assign(8, 0);  // held: no motion of the body as a whole
  const double T = 1e-3, area = .2;
  for (const double w : {100., 300., 1000., 1e4, 1e5}) {
    ShearWaves waves = box.waves(T);
    const double dt = 2e-3 / std::max(w, 1 / T);
    const long round = std::lround(2 * M_PI / (w * dt));
    NodeField v(8, Node::Zero());
    double taken = 0, all = 0, impulse = 0, most = 0;
    const long settled = static_cast<long>(std::ceil(20 * T / dt / round)) * round;
    for (long step = 0; step < settled + round; ++step) {
      const NodeField before = v;
      v[3][0] = std::sin(w * dt * static_cast<double>(step));
      const Node steady = waves.steady(3, 1, before[3]);
      const Node e = -kImpedance * area * steady[3] * dt * Node(v[3][0] - steady[0], 0, 0, 0);
      RubbedNode now = rubbed(3);
      now.area = area;
      now.radiated = e;
      waves.follow(box.team(), dt, dt, box.X, before, v, {now});
      if (step < settled) continue;
      taken -= e[0] * v[3][0] / (kImpedance * area * dt);
      all += v[3][0] * v[3][0];
      impulse += e[0];
      most += std::abs(e[0]);
    }
    const double exact = w * T * w * T / (1 + w * T * w * T);
    EXPECT_NEAR(taken / all, exact, .01 * exact) << w;
    EXPECT_LT(std::abs(impulse), .01 * most) << w;
  }
}

TEST(ShearWaves, CountsHowLongContactLasts) {
  const Box box;
  ShearWaves waves = box.waves(1);
  const NodeField v(8, Node::Zero());
  const auto phi = [&](int n) { return phi_of(waves, n); };
  for (int step = 0; step < 1000; ++step) waves.follow(box.team(), 1e-3, 1e-3, box.X, v, v, {rubbed(2), rubbed(5)});
  for (int n = 0; n < 8; ++n) EXPECT_NEAR(phi(n), n == 2 || n == 5 ? 1 - std::exp(-1.) : 0, 1e-3) << n;
  for (int step = 0; step < 1000; ++step) waves.follow(box.team(), 1e-3, 1e-3, box.X, v, v, {rubbed(5)});
  EXPECT_NEAR(phi(2), std::exp(-1.) * (1 - std::exp(-1.)), 1e-3);
  EXPECT_NEAR(phi(5), 1 - std::exp(-2.), 1e-3);
}

/// A box of which the nodes 0, 1, 4, 5 are pressed, that changes its speed by `part` of what presses it: phi of node 1 after 3 T.
double phi_where_pressed(double part, const Node& across) {
  const Box box;
  ShearWaves waves = box.waves(1);
  double mass = 0;
  for (double w : box.inverse_mass) mass += 1 / w;
  NodeField v(8, Node(7, 0, 0, 0));
  std::vector<RubbedNode> base;
  for (const int n : {0, 1, 4, 5}) {
    base.push_back(rubbed(n));
    base.back().normal = (1 + .1 * n) * across;
  }
  const Node change = part * 5 * across / mass;  // 4 and .1 (0 + 1 + 4 + 5)
  for (int step = 0; step < 3000; ++step) {
    const NodeField before = v;
    for (Node& of : v) of += change;
    waves.follow(Box::team(), 1e-3, 1e-3, box.X, before, v, base);
  }
  return phi_of(waves, 1);
}

TEST(ShearWaves, OfAStrikeNothing) {
  for (const Node& across : {Node(0, 2, 0, 0), Node(.3, 1, -.4, 0)}) {
    EXPECT_LT(phi_where_pressed(1, across), 1e-9) << "thrown back";
    EXPECT_NEAR(phi_where_pressed(0, across), 1 - std::exp(-3.), 1e-3) << "at rest";
    EXPECT_NEAR(phi_where_pressed(.5, across), 1 - std::exp(-3.), 1e-3);
    EXPECT_NEAR(phi_where_pressed(.75, across), .5 * (1 - std::exp(-3.)), 1e-3);
    EXPECT_NEAR(phi_where_pressed(-1, across), 1 - std::exp(-3.), 1e-3) << "pushed into it";
  }
}

TEST(ShearWaves, WhatIsSavedGoesOnTheSame) {
  const Box box;
  NodeField v(8, Node(1, 2, 3, 0));
  const NodeField later(8, Node(2, -1, 4, 0));
  ShearWaves waves = box.waves(1), resumed = box.waves(1);
  RubbedNode pressed = rubbed(6);
  pressed.normal = Node(0, 30, 0, 0);
  for (int step = 0; step < 120; ++step) {
    const NodeField before = v;
    for (Node& of : v) of += Node(0, .9, 0, 0);
    waves.follow(box.team(), .1, .1, box.X, before, v, {rubbed(1), pressed});
  }
  waves.follow(box.team(), .1, .1, box.X, v, later, {pressed});
  resumed.follow(box.team(), .1, .1, box.X, v, v, {rubbed(3)});  // what it knew is gone
  resumed.restore(waves.save());
  for (ShearWaves* both : {&waves, &resumed})
    for (int step = 0; step < 30; ++step) both->follow(box.team(), .1, .1, box.X, later, later, {pressed});
  EXPECT_GT(phi_of(waves, 6), .5);
  for (int n = 0; n < 8; ++n) EXPECT_EQ(waves.steady(n, .5, later[n]), resumed.steady(n, .5, later[n])) << n;
}

TEST(ShearWaves, ANodeThatIsNoneIsRefused) {
  const Box box;
  ShearWaves waves = box.waves(1);
  const NodeField v(8, Node::Zero());
  waves.follow(box.team(), .1, .1, box.X, v, v, {rubbed(3)});
  std::vector<double> saved = waves.save();
  saved.insert(saved.end(), {2e5, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_THROW(box.waves(1).restore(saved), Error);
}

TEST(ShearWaves, OfTwoBodiesTheSofterTakesThem) {
  const ShearWaves waves({{3e6, 1, 0, 4}, {2e6, 2, 4, 4}}, 8, false);
  EXPECT_EQ(waves.of_pair(0, 1).impedance, 2e6);
  EXPECT_EQ(waves.of_pair(1, 0).impedance, 2e6);
  EXPECT_EQ(waves.of_pair(0, 2).impedance, 3e6);  // a tool
  EXPECT_EQ(waves.of_pair(2, 0).impedance, 3e6);
}

// A strip thrown at a plane at an angle: friction is mu times the normal impulse, whether it is over in a thousandth of T or in many T.
TEST(ShearWaves, AStrikeKeepsCoulombsImpulse) {
  for (const double time : {1., 3e-5, 1e-6}) {
    World world = strip_over_plane(.1, 3e6, time);
    for (Node& v : world.v) v = Node(40, -10, 0, 0);
    Contact contact = world.make();
    const Vec3 p0 = world.momentum();
    double pressed = 0;
    for (int i = 0; i < 3000; ++i) {
      world.step(contact, 5e-7, false);
      ASSERT_NEAR(world.closure(), 0, 1e-11 * world.exchanged + 1e-300);
      if (world.last.active > 0) pressed += world.last.dt;
    }
    const Vec3 change = world.momentum() - p0;
    EXPECT_GT(change.y(), 0);
    const double ratio = -change.x() / change.y();
    std::printf("  T %g s: pressed for %.1e s, friction over normal impulse %.5f\n", time, pressed, ratio);
    EXPECT_GT(pressed, 6e-5);
    EXPECT_LT(pressed, 1e-3);
    EXPECT_NEAR(ratio, .1, 2e-4);
  }
}

// Two strips come together on a third, which so is pressed and not thrown back, and rub on it: what leaves the one goes to the other.
TEST(ShearWaves, BetweenBodiesMomentumIsKept) {
  World world;
  world.config.layer = 1e-4;
  world.config.friction = .3;
  world.add_strip(Vec3(0, 0, 0), 12, 3, .01, .01, 2700, 2e9);
  const auto nodes = [&] { return static_cast<int>(world.x.size()); };
  const int first = nodes();
  world.add_strip(Vec3(.013, .0302, 0), 7, 3, .012, .01, 5000, 3e9);
  const int second = nodes();
  world.add_strip(Vec3(.017, -.0302, 0), 7, 3, .012, .01, 5000, 3e9);
  world.bodies[0].waves = {3e6, 1e-5, 0, first};
  world.bodies[1].waves = {4e6, 2e-5, first, second - first};
  world.bodies[2].waves = {4e6, 2e-5, second, nodes() - second};
  for (int n = 0; n < nodes(); ++n) world.v[n] = n < first ? Node(3, 0, 0, 0) : n < second ? Node(-4, -2, 0, 0) : Node(-4, 2, 0, 0);
  Contact contact = world.make();
  const Vec3 p0 = world.momentum();
  double scale = 0;
  for (std::size_t n = 0; n < world.x.size(); ++n) scale += world.mass[n] * world.v[n].norm();
  for (int i = 0; i < 2000; ++i) {
    world.step(contact, 5e-7, false);
    ASSERT_NEAR(world.closure(), 0, 1e-11 * world.exchanged + 1e-14);
    ASSERT_LT((world.momentum() - p0).norm(), 1e-12 * scale);
  }
  EXPECT_GT(world.friction, 0);
}
