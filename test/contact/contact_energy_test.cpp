// Momentum, energy, friction, held nodes, and runs that must repeat bit for bit.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cstring>

#include "contact/point_bodies.h"

using contact_test::polyline;
using contact_test::sheet;
using contact_test::World;
using namespace forming_sim;

namespace {

// A body thrown at a rough tool that shakes.
World thrown(int dimension, bool reversed = false) {
  World world;
  world.dimension = dimension;
  world.config.layer = 1e-3;
  Mesh mesh;
  if (dimension == 2) {
    world.add_strip(Vec3(-.5, .06, 0), 9, 2, .1, .1, 2700, 2e9, .1);
    std::vector<Vec3> line;
    for (int i = 0; i <= 37; ++i) line.emplace_back(-2 + .11 * i, .05 * std::sin(2.0 * i), 0);
    mesh = polyline(line);
  } else {
    world.add_box(Vec3(-.3, -.3, .12), 4, 4, 1, .15, 2700, 2e9);
    mesh = sheet(8, 1.5, [](double x, double y) { return .06 * std::sin(4 * x) * std::cos(5 * y); });
  }
  if (reversed)
    for (size_t i = 0; i < mesh.surface.size(); ++i)
      if (i % 3 != 1) std::swap(mesh.surface[i].nodes[0], mesh.surface[i].nodes[1]);
  for (auto& v : world.v) v = dimension == 2 ? Node(20, -60, 0, 0) : Node(20, 10, -60, 0);
  world.add_tool("die", mesh, .2, [dimension](double t) {
    const double a = .02 * std::sin(700 * t), b = .02 * (std::cos(900 * t) - 1);
    return dimension == 2 ? Vec3(a, b, 0) : Vec3(a, -a, b);
  });
  return world;
}

bool same(const NodeField& a, const NodeField& b) { return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Node)) == 0; }

}  // namespace

TEST(ContactEnergy, LedgerClosesAndNothingIsCreated) {
  for (int dimension : {2, 3}) {
    World world = thrown(dimension);
    Contact contact = world.make();
    for (int i = 0; i < 800; ++i) {
      world.step(contact, 1e-5);
      ASSERT_NEAR(world.closure(), 0, 1e-12 * world.exchanged + 1e-300);
    }
    EXPECT_GT(world.exchanged, 0);
    EXPECT_GT(world.friction, 0);
    EXPECT_GT(world.dissipated, -1e-6 * world.exchanged);
    EXPECT_EQ(world.crossings, 0);
  }
}

// What the bodies gain in momentum the tools lose; frictionless also angular.
TEST(ContactEnergy, MomentumIsKept) {
  for (int dimension : {2, 3})
    for (double layer : {1e-3, 1e-6}) {  // the thin one halves steps
      World world = thrown(dimension);
      world.tools[0].friction = 0;
      world.config.layer = layer;
      Contact contact = world.make();
      Vec3 given = Vec3::Zero(), spun = Vec3::Zero();
      const auto spin = [&](const NodeField& x) {
        Vec3 sum = Vec3::Zero();
        for (size_t i = 0; i < world.x.size(); ++i) sum += world.mass[i] * vec3(x[i]).cross(vec3(world.v[i]));
        return sum;
      };
      const Vec3 p0 = world.momentum(), l0 = spin(world.x);
      for (int i = 0; i < 500; ++i) {
        world.step(contact, 2e-5, false);
        given += world.last.tool_impulse[0];
        spun += world.last.tool_angular_impulse[0];
      }
      EXPECT_GT(given.norm(), .1 * p0.norm());
      EXPECT_LT((world.momentum() + given - p0).norm(), 1e-12 * p0.norm()) << dimension << " " << layer;
      EXPECT_LT((spin(world.x) + spun - l0).norm(), 1e-11 * p0.norm()) << dimension << " " << layer;
    }
}

// Nodes on an incline of tan = .5: below the angle of friction they rest, above
// it they slide at g (sin - mu cos).
TEST(ContactFriction, NodesOnAnIncline) {
  for (int with_mesh = 0; with_mesh < 2; ++with_mesh)
    for (double mu : {.5, .49, .3, 0.}) {
      World world;
      world.add_strip(Vec3(.05, 0, 0), 6, 1, .1, .1, 2700, 0);
      world.config.layer = 1e-4;
      const double g = 9.81, angle = std::atan(.5);
      for (int i = 7; i < 14; ++i) {  // the upper row is held out of the way
        world.held.push_back({i, Mat3::Zero()});
        world.held_velocity.push_back(Node::Zero());
      }
      if (with_mesh)
        world.add_tool("slope", polyline({Vec3(-3, 0, 0), Vec3(-.22, 0, 0), Vec3(.31, 0, 0), Vec3(.77, 0, 0), Vec3(3, 0, 0)}), mu, [](double) { return Vec3::Zero(); });
      else
        world.add_plane("slope", Vec3::Zero(), Vec3(0, 1, 0), mu, [](double) { return Vec3::Zero(); });
      Contact contact = world.make();
      const double dt = 2e-5;
      world.gravity = Vec3(0, -g * std::cos(angle), 0);
      for (int i = 0; i < 1000; ++i) world.step(contact, dt, false);  // into the layer
      world.gravity = g * Vec3(std::sin(angle), -std::cos(angle), 0);
      double normal = 0, tangent = 0;
      const int n = 2000;
      for (int i = 0; i < n; ++i) {
        world.step(contact, dt, false);
        normal -= world.last.tool_impulse[0].y();
        tangent += world.last.tool_impulse[0].x();
      }
      for (int i = 0; i < 7; ++i) {
        if (mu == .5) {
          EXPECT_LT(std::abs(world.v[i][0]), 1e-8);
        } else {
          EXPECT_NEAR(world.v[i][0] / (n * dt), g * (std::sin(angle) - mu * std::cos(angle)), 1e-4 * g) << mu;
        }
      }
      EXPECT_NEAR(tangent / normal, mu, 1e-6);
    }
}

// An elastic block: it sticks, and slides, as a whole.
TEST(ContactFriction, BlockOnAnIncline) {
  for (double mu : {.6, .3}) {
    World world;
    world.add_strip(Vec3(.05, 0, 0), 6, 2, .1, .1, 2700, 2e9);
    world.config.layer = 1e-4;
    const double g = 9.81, angle = std::atan(.5);
    world.gravity = g * Vec3(std::sin(angle), -std::cos(angle), 0);
    world.add_tool("slope", polyline({Vec3(-3, 0, 0), Vec3(-.22, 0, 0), Vec3(.31, 0, 0), Vec3(.77, 0, 0), Vec3(3, 0, 0)}), mu, [](double) { return Vec3::Zero(); });
    Contact contact = world.make();
    const double dt = 2e-5;
    for (int i = 0; i < 4000; ++i) {
      world.step(contact, dt, false);
      for (auto& v : world.v) v *= .99;
    }
    const double v0 = world.mean_velocity().x(), t0 = world.time, x0 = world.x[3][0];
    for (int i = 0; i < 4000; ++i) world.step(contact, dt, false);
    const double a = (world.mean_velocity().x() - v0) / (world.time - t0);
    if (mu == .6)
      EXPECT_LT(std::abs(world.x[3][0] - x0), 1e-8);
    else
      EXPECT_NEAR(a, g * (std::sin(angle) - mu * std::cos(angle)), .03 * g * std::sin(angle));
  }
}

// A node free in one direction only takes the impulse in that direction.
TEST(ContactHeld, HeldDirectionsStayAndTheLedgerCloses) {
  World world = thrown(2);
  for (int i : {0, 3, 9, 19}) {
    Mat3 p = Mat3::Identity();
    const Vec3 n = Vec3(1, .4 * i, 0).normalized();
    p -= n * n.transpose();
    world.held.push_back({i, p});
    world.held_velocity.push_back(node(n * 3.0));
  }
  Contact contact = world.make();
  for (int i = 0; i < 800; ++i) {
    world.step(contact, 1e-5);
    for (size_t k = 0; k < world.held.size(); ++k) {
      const Vec3 v = vec3(world.v[world.held[k].node]), wanted = vec3(world.held_velocity[k]);
      ASSERT_NEAR(v.dot(wanted.normalized()), 3, 1e-9);
    }
  }
  EXPECT_NEAR(world.closure(), 0, 1e-12 * world.exchanged);
  EXPECT_EQ(world.crossings, 0);
}

TEST(ContactHeld, ANodeThatCannotGiveWayIsNamed) {
  World world;
  world.add_strip(Vec3(0, 0, 0), 2, 1, .1, .1, 2700, 0);
  world.config.layer = 1e-3;
  for (int i = 0; i < 6; ++i) {
    world.held.push_back({i, Mat3::Zero()});
    world.held_velocity.push_back(Node::Zero());
  }
  world.add_plane("punch", Vec3(0, .11, 0), Vec3(0, -1, 0), 0, [](double t) { return Vec3(0, -t, 0); });
  Contact contact = world.make();
  try {
    for (int i = 0; i < 200; ++i) world.step(contact, 1e-4);
    FAIL() << "the punch went through";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), Code::contact_error);
    const std::string text = e.what();
    EXPECT_NE(text.find("node 3"), std::string::npos) << text;
    EXPECT_NE(text.find("punch"), std::string::npos) << text;
    EXPECT_NE(text.find("time"), std::string::npos) << text;
  }
  EXPECT_NEAR(world.time, .011, 2e-4);
}

// The orientation of a tool's facets has no effect, not in the last bit.
TEST(ContactRepeat, ReversedFacetsGiveTheSameBits) {
  for (int dimension : {2, 3}) {
    World a = thrown(dimension), b = thrown(dimension, true);
    Contact ca = a.make(), cb = b.make();
    for (int i = 0; i < 500; ++i) {
      a.step(ca, 1e-5, false);
      b.step(cb, 1e-5, false);
    }
    EXPECT_GT(a.exchanged, 0);
    EXPECT_TRUE(same(a.x, b.x) && same(a.v, b.v)) << dimension;
  }
}

// Saved and restored at any step, a run goes on to the same bits, though its list is built anew.
TEST(ContactRepeat, ResumedRunGivesTheSameBits) {
  for (int dimension : {2, 3}) {
    World a = thrown(dimension);
    Contact ca = a.make();
    World b = a;
    int builds_differ = 0;
    for (int i = 0; i < 500; ++i) {
      a.step(ca, 1e-5, false);
      if (i % 37 != 5) continue;
      World fresh = thrown(dimension);
      Contact cb = fresh.make();
      b = a;
      cb.restore(ca.save());
      // 20 steps with the new list; the old one goes on in `a` below.
      for (int k = 0; k < 20; ++k) b.step(cb, 1e-5, false);
      for (int k = 0; k < 20; ++k, ++i) a.step(ca, 1e-5, false);
      builds_differ += ca.list_builds() != cb.list_builds();
      ASSERT_TRUE(same(a.x, b.x) && same(a.v, b.v)) << dimension << " step " << i;
      ASSERT_EQ(a.last.dissipated, b.last.dissipated);
      ASSERT_EQ(ca.save(), cb.save());
    }
    EXPECT_GT(builds_differ, 0);
    EXPECT_GT(a.exchanged, 0);
    std::vector<char> data = ca.save();
    data.pop_back();
    EXPECT_THROW(ca.restore(data), Error);
  }
}

// A body far from its tool is not looked at: no list is built while it stays away.
TEST(ContactRepeat, FarToolsCostNothing) {
  World world = thrown(3);
  for (Node& p : world.x) p[2] += 50;
  Contact contact = world.make();
  for (int i = 0; i < 300; ++i) world.step(contact, 1e-5, false);
  EXPECT_EQ(contact.listed_pairs(), 0);
  EXPECT_EQ(contact.list_builds(), 1);
}
