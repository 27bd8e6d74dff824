// The largest shear stress of friction: what slides under it feels it on the area that touches, whatever presses and
// whatever the other surface is made of.
#include <gtest/gtest.h>

#include <cmath>

#include "point_bodies.h"

namespace contact_test {
namespace {

constexpr double kWeight = 9.81, kDensity = 2800, kSide = .1, kLayer = 1e-3;

Vec3 still(double) { return Vec3::Zero(); }

/// The lower faces of a block, 6 cells long and in 3D 4 wide: their nodes are free and press by their own weight, all others are held.
World block(int dimension) {
  World world;
  world.dimension = dimension;
  world.config.layer = kLayer;
  world.modulus = 1e6;  // a thousand times the pressure: what is pressed stays so in every step
  world.gravity = -kWeight * (dimension == 2 ? Vec3::UnitY() : Vec3::UnitZ());
  if (dimension == 2) world.add_strip(Vec3::Zero(), 6, 1, kSide, kSide, kDensity, 0);
  else world.add_box(Vec3::Zero(), 6, 4, 1, kSide, kDensity, 0);
  return world;
}
double area_below(int dimension) { return 6 * kSide * (dimension == 2 ? 1 : 4 * kSide); }
double pressure() { return kDensity * kWeight * kSide / 2; }

// Next to level, with corners where the block has none.
Mesh segments() { return polyline({Vec3(-3, 0, 0), Vec3(-.22, 0, 0), Vec3(.31, 0, 0), Vec3(.345, 0, 0), Vec3(.77, 0, 0), Vec3(3, 0, 0)}); }
Mesh facets() {
  return sheet(11, 2, [](double x, double y) { return 1e-5 * std::sin(9 * x) * std::cos(7 * y); });
}

/// Lays the block down, then lets its lower nodes slide at 1 m/s for .02 s: the mean of friction over their area, Pa.
double shear_of(World world) {
  std::vector<int> below;
  for (std::size_t i = 0; i < world.x.size(); ++i) {
    const bool of_block = static_cast<int>(i) <= world.nodes_of(world.bodies[0]).second;
    if (of_block && world.x[i][world.dimension - 1] < world.x[0][world.dimension - 1] + .5 * kSide) {
      below.push_back(static_cast<int>(i));
      continue;
    }
    world.held.push_back({static_cast<int>(i), Mat3::Zero()});
    world.held_velocity.push_back(Node::Zero());
  }
  Contact contact = world.make();
  world.take_shifts(contact);
  for (int i = 0; i < 4000; ++i) {
    world.step(contact, 5e-6, false);
    for (Node& v : world.v) v *= .99;
  }
  for (int i : below) world.v[i] += Node(1, 0, 0, 0);
  const auto momentum = [&] {
    double sum = 0;
    for (int i : below) sum += world.mass[i] * world.v[i][0];
    return sum;
  };
  const double start = world.time, potential = world.last.potential, before = momentum();
  world.change = world.friction = world.dissipated = world.work = world.soft = world.exchanged = 0;
  while (world.time < start + .02) world.step(contact, 5e-6, false);
  EXPECT_LT(std::abs(world.closure() - potential), 1e-9 * world.exchanged);
  return (before - momentum()) / (world.time - start) / area_below(world.dimension);
}

}  // namespace

TEST(ShearLimit, IsFeltOnTheAreaThatTouches) {
  const double limit = .2 * pressure();
  for (int dimension : {2, 3})
    for (bool plane : {true, false}) {
      World world = block(dimension);
      if (plane) world.add_plane("floor", Vec3::Zero(), dimension == 2 ? Vec3::UnitY() : Vec3::UnitZ(), 10, still);
      else world.add_tool("floor", dimension == 2 ? segments() : facets(), 10, still);
      world.tools[0].friction_limit = limit;
      EXPECT_NEAR(shear_of(world), limit, 1e-3 * limit) << dimension << (plane ? " plane" : " mesh");
    }
}

// The lower body is longer, with cells that do not match, finer or coarser, or one that is longer than the block.
TEST(ShearLimit, OfTwoBodiesIsOfTheAreaThatTouches) {
  const double limit = .2 * pressure();
  for (const double cell : {.03, .075, .1, .25, 1.}) {
    World world = block(2);
    const int cells = static_cast<int>(std::ceil(1.4 / cell));
    world.add_strip(Vec3(.315 - cell * (cells / 2 + .3), -.1, 0), cells, 1, cell, .1, kDensity, 0);
    world.config.friction = 10;
    world.config.friction_limit = limit;
    const double shear = shear_of(world);
    std::printf("  cells of %g below those of .1: %.4f of the limit\n", cell, shear / limit);
    EXPECT_NEAR(shear, limit, 1e-3 * limit) << cell;
  }
}

// The baseline finds its pairs anew.
TEST(ShearLimit, IsOfTheExplicitMethodToo) {
  const double limit = .2 * pressure();
  World world = block(2);
  world.config.method = "explicit";
  world.add_plane("floor", Vec3::Zero(), Vec3::UnitY(), 10, still);
  world.tools[0].friction_limit = limit;
  EXPECT_NEAR(shear_of(world), limit, 2e-2 * limit);
}

TEST(ShearLimit, AboveWhatFrictionPassesOnChangesNothing) {
  World world = block(2);
  world.add_plane("floor", Vec3::Zero(), Vec3::UnitY(), .3, still);
  const double shear = shear_of(world);
  EXPECT_NEAR(shear, .3 * pressure(), 1e-3 * pressure());
  world.tools[0].friction_limit = 2 * pressure();
  EXPECT_EQ(shear_of(world), shear);
}

// A pair that sticks up to a limit takes no notice of how hard it is pressed.
TEST(ShearLimit, StickingPairsSlideUnderIt) {
  World world = block(2);
  world.add_plane("floor", Vec3::Zero(), Vec3::UnitY(), 0, still);
  PairConfig pair;
  pair.first = "body0";
  pair.second = "floor";
  pair.kind = "sticking";
  pair.friction_limit = 3 * pressure();
  world.config.pairs = {pair};
  EXPECT_NEAR(shear_of(world), pair.friction_limit, 1e-3 * pair.friction_limit);
}

}  // namespace contact_test
