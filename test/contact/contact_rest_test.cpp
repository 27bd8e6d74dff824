// Bodies that rest: for many steps, on each other, in an arch, on an incline.
#include <gtest/gtest.h>

#include "contact/point_bodies.h"

using contact_test::polyline;
using contact_test::World;
using namespace forming_sim;

namespace {

double kinetic(const World& world) {
  double sum = 0;
  for (size_t i = 0; i < world.x.size(); ++i) sum += .5 * world.mass[i] * world.v[i].squaredNorm();
  return sum;
}

/// Takes the swing out of a body of springs, which have no damping of their own; its flight stays.
void calm(World& world, double keep) {
  const Node mean = node(world.mean_velocity());
  for (Node& v : world.v) v = mean + keep * (v - mean);
}

/// Voussoirs of a semicircular arch between radii r and r + t, the springers' lower faces at y = 0.
World arch(int blocks, double r, double t, double friction) {
  World world;
  world.config.layer = 1e-5;
  world.config.friction = friction;
  world.modulus = 1e8;
  world.gravity = Vec3(0, -9.81, 0);
  const double joint = 1e-5;  // as wide as the layer
  for (int k = 0; k < blocks; ++k) {
    const double half = joint / (2 * r), a = M_PI * k / blocks + half, b = M_PI * (k + 1) / blocks - half;
    const auto at = [&](double radius, double angle) { return Vec3(-radius * std::cos(angle), radius * std::sin(angle), 0); };
    world.add_polygon({at(r, a), at(r, b), at(r + t, b), at(r + t, a)}, 10, 4e7);
  }
  world.add_plane("ground", Vec3::Zero(), Vec3(0, 1, 0), friction, [](double) { return Vec3::Zero(); });
  return world;
}

/// How far the crown of the arch has come down when it is damped: after half of the time, and in the other half.
struct Sinking {
  double first, then;
};
Sinking sink(World world) {
  Contact contact = world.make();
  world.take_shifts(contact);
  const int crown = world.nodes_of(world.bodies[world.bodies.size() / 2]).first;
  double height[3] = {world.x[crown][1], 0, 0};
  for (int half = 1; half <= 2; ++half) {
    for (int i = 0; i < 4000; ++i) {
      world.step(contact, 1e-4, i % 100 == 0);
      for (Node& v : world.v) v *= .995;
    }
    height[half] = world.x[crown][1];
  }
  EXPECT_EQ(world.crossings, 0);
  return {height[0] - height[1], height[1] - height[2]};
}

}  // namespace

// A million steps: a block on a shaken tool, then on one that rests: its energy stays bounded, then dies away, and it does not creep.
TEST(ContactRest, AShakenBlockAndOneAtRest) {
  const int shaken = 500000, still = 500000;
  const double dt = 1e-5, end = shaken * dt, omega = 2 * M_PI * std::round(100 * end) / end;
  World world;
  world.config.layer = 1e-5;
  world.modulus = 1e9;
  world.add_strip(Vec3(0, 0, 0), 4, 2, .1, .1, 2700, 2e8);
  world.gravity = Vec3(0, -9.81, 0);
  world.add_tool("table", polyline({Vec3(-1, 0, 0), Vec3(.17, 0, 0), Vec3(2, 0, 0)}), .2,
                 [=](double t) { return t < end ? Vec3(1e-5 * (std::cos(omega * t) - 1), 1e-5 * std::sin(omega * t) * std::sin(omega * t), 0) : Vec3(Vec3::Zero()); });
  Contact contact = world.make();
  const double scale = kinetic(world) + 2700 * .08 * 9.81 * 1e-4;  // a fall of .1 mm
  double most = 0;
  for (int i = 0; i < shaken; ++i) {
    world.step(contact, dt, i % 1000 == 0);
    most = std::max(most, kinetic(world));
  }
  EXPECT_LT(most, scale);
  // Contact takes energy from the swing of the block and never gives any: the mean of each quarter falls. (The largest of a
  // quarter need not: it depends on how the swings of several frequencies happen to meet.)
  double quarter[4] = {0, 0, 0, 0}, creep = 0;
  double x = 0;
  for (int i = 0; i < still; ++i) {
    world.step(contact, dt, i % 1000 == 0);
    quarter[4 * i / still] += kinetic(world) * 4 / still;
    if (i == still / 4) x = world.x[2][0];
    if (i > still / 4) creep = std::max(creep, std::abs(world.x[2][0] - x));
  }
  std::cout << "  energy at most " << most << " J, its mean in the quarters of the rest " << quarter[0] << " " << quarter[1] << " " << quarter[2] << " " << quarter[3] << " J; moved by " << creep << " m\n";
  for (int q = 1; q < 4; ++q) EXPECT_LT(quarter[q], quarter[q - 1]);
  EXPECT_LT(creep, 1e-7);
  EXPECT_EQ(world.crossings, 0);
  EXPECT_EQ(world.halvings, 0);
}

// Five cubes that touch, one on the other, come to rest; each carries those above it.
TEST(ContactRest, FiveCubesInAStack) {
  World world;
  world.dimension = 3;
  world.config.layer = 1e-5;
  world.config.friction = .3;
  world.modulus = 1e9;
  for (int k = 0; k < 5; ++k) world.add_box(Vec3(.003 * (k % 2), .002 * (k % 3), .2 * k), 2, 2, 2, .1, 2700, 1e8);
  world.gravity = Vec3(0, 0, -9.81);
  world.add_plane("ground", Vec3::Zero(), Vec3(0, 0, 1), .3, [](double) { return Vec3::Zero(); });
  Contact contact = world.make();
  world.take_shifts(contact);
  const NodeField start = world.x;
  for (int i = 0; i < 4000; ++i) {
    world.step(contact, 2e-5, i % 200 == 0);
    for (Node& v : world.v) v *= .998;  // the springs have no damping of their own
  }
  double weight = 0, moved = 0;
  for (double m : world.mass) weight += 9.81 * m;
  for (size_t i = 0; i < world.x.size(); ++i) moved = std::max(moved, (world.x[i] - start[i]).norm());
  double carried = 0;
  for (int i = 0; i < 200; ++i) {
    world.step(contact, 2e-5, false);
    carried += -world.last.tool_impulse[0].z() / world.last.dt / 200;
    for (Node& v : world.v) v *= .998;
  }
  std::cout << "  moved by " << moved << " m, kinetic energy " << kinetic(world) << " J, carried / weight " << carried / weight << "\n";
  EXPECT_NEAR(carried / weight, 1, .01);
  EXPECT_LT(moved, 1e-4);
  EXPECT_LT(kinetic(world), 1e-6 * weight * 1e-3);
  EXPECT_EQ(world.crossings, 0);
  EXPECT_EQ(world.halvings, 0);
}

// 25 voussoirs with friction .5 and t/r = .2 stand: the thinnest semicircle that stands has t/r = .1075 of the mean
// radius (Milankovitch). Without friction they slide apart, and a thinner ring folds.
TEST(ContactRest, AnArchStands) {
  const Sinking stands = sink(arch(25, .9, .2, .5)), slides = sink(arch(25, .9, .2, .05)), folds = sink(arch(25, .97, .06, .5));
  std::cout << "  the crown sinks by " << stands.first << " m, then " << stands.then << "; with friction .05 " << slides.first << ", " << slides.then << "; thin "
            << folds.first << ", " << folds.then << "\n";
  EXPECT_LT(stands.first, 2e-3);  // the joints close and the springs give
  EXPECT_LT(std::abs(stands.then), 1e-5);
  EXPECT_GT(slides.then, .02);
  EXPECT_GT(folds.then, .02);
}

// A row of nodes on an incline at angles about that of friction .3 (16.699 degrees): sticks without creep below it,
// slides with a = g (sin - mu cos) above.
TEST(ContactRest, InclineAboutTheAngleOfFriction) {
  for (double degrees : {10., 16.5, 17., 18., 25.}) {
    const double mu = .3, g = 9.81, angle = degrees * M_PI / 180;
    World world;
    world.add_strip(Vec3(.05, 0, 0), 6, 2, .1, .1, 2700, 2e8);
    world.config.layer = 1e-5;
    world.modulus = 1e9;
    world.add_tool("slope", polyline({Vec3(-3, 0, 0), Vec3(-.22, 0, 0), Vec3(.31, 0, 0), Vec3(.77, 0, 0), Vec3(3, 0, 0)}), mu, [](double) { return Vec3::Zero(); });
    Contact contact = world.make();
    const double dt = 2e-5;
    const int n = 3000;
    for (int i = 0; i < 5 * n; ++i) {
      // The weight grows along the normal first, then turns, then the swing that this started dies away.
      const double grown = std::min(1., double(i) / n), turned = std::min(1., std::max(0., double(i) / n - 1));
      world.gravity = g * Vec3(turned * std::sin(angle), -grown * std::cos(angle), 0);
      world.step(contact, dt, false);
      calm(world, .995);
    }
    const double v0 = world.mean_velocity().x(), t0 = world.time;
    double normal = 0, tangent = 0, creep = 0;
    for (int i = 0; i < 5000; ++i) {
      world.step(contact, dt, false);
      calm(world, .995);
      normal -= world.last.tool_impulse[0].y();
      tangent += world.last.tool_impulse[0].x();
      creep = std::max(creep, std::abs(world.mean_velocity().x()));
    }
    const double a = (world.mean_velocity().x() - v0) / (world.time - t0), theory = std::max(0., std::sin(angle) - mu * std::cos(angle));
    std::cout << "  " << degrees << " degrees: a/g " << a / g << " (" << theory << "), f_t/f_n " << tangent / normal << ", creep " << creep << " m/s\n";
    if (theory == 0) {
      EXPECT_LT(creep, 1e-6) << degrees;
      EXPECT_NEAR(tangent / normal, std::tan(angle), 1e-5) << degrees;
    } else {
      EXPECT_NEAR(a / g, theory, .03 * theory + 1e-5) << degrees;
      EXPECT_NEAR(tangent / normal, mu, 1e-5) << degrees;
    }
  }
}
