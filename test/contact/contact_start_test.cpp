// How a run may start: resting on a tool, overlapping a little, or not at all.
#include <gtest/gtest.h>

#include "contact/point_bodies.h"
#include "contact/wedges.h"
#include "forming_sim/contact/tools.h"

using contact_test::polyline;
using contact_test::sheet;
using contact_test::triangles;
using contact_test::World;
using namespace forming_sim;

namespace {

constexpr double h0 = 1e-3;

// A blank 1 x .2 on y = 0 above a die of the given outline.
World blank_on(Mesh die, const Vec3& at = Vec3::Zero()) {
  World world;
  world.add_strip(Vec3(0, 0, 0), 10, 2, .1, .1, 2700, 0);
  world.config.layer = h0;
  world.add_tool("die", std::move(die), 0, [at](double) { return at; });
  return world;
}
Mesh die_profile() { return polyline({Vec3(-1, 0, 0), Vec3(.5, 0, 0), Vec3(.5866, -.0134, 0), Vec3(.65, -.05, 0), Vec3(.7, -.15, 0), Vec3(.7, -1, 0)}); }
Mesh die_block() { return polyline({Vec3(-1, 0, 0), Vec3(-1, -1, 0), Vec3(.7, -1, 0), Vec3(.7, 0, 0)}, true); }

// A step at rest: what force acts, and does anything move?
double force_at_rest(World& world, Contact& contact) {
  world.step(contact, 1e-6);
  double most = 0;
  for (const Node& v : world.v) most = std::max(most, v.norm());
  return most;
}

void expect_backed_off_by_the_layer(const Contact& contact) {
  ASSERT_EQ(contact.warnings().size(), 1u);
  EXPECT_NE(contact.warnings()[0].find("backed off by the contact layer"), std::string::npos) << contact.warnings()[0];
}

}  // namespace

TEST(ContactStart, BlankRestingOnItsDieIsNormal) {
  for (int kind = 0; kind < 3; ++kind) {
    World world = kind == 2 ? World() : blank_on(kind == 0 ? die_profile() : die_block());
    if (kind == 2) {
      world.add_strip(Vec3(0, 0, 0), 10, 2, .1, .1, 2700, 0);
      world.config.layer = h0;
      world.add_plane("die", Vec3::Zero(), Vec3(0, 1, 0), 0, [](double) { return Vec3::Zero(); });
    }
    Contact contact = world.make();
    expect_backed_off_by_the_layer(contact);
    EXPECT_LT(force_at_rest(world, contact), 1e-6) << kind;
    EXPECT_NEAR(world.last.min_gap_over_layer, 1, 1e-9);
    EXPECT_EQ(world.crossings, 0);
  }
}

// The end face of a sheet lies against a wall, the corner in the corner of a die.
TEST(ContactStart, BlankInACornerIsNormal) {
  World world = blank_on(polyline({Vec3(0, 1, 0), Vec3(0, 0, 0), Vec3(2, 0, 0)}));
  Contact contact = world.make();
  expect_backed_off_by_the_layer(contact);
  EXPECT_LT(force_at_rest(world, contact), 1e-6);
}

TEST(ContactStart, SmallOverlapsAreBackedOff) {
  for (double overlap : {.3, 1., 1.9})
    for (int kind = 0; kind < 3; ++kind) {
      World world = kind == 2 ? World() : blank_on(kind == 0 ? die_profile() : die_block(), Vec3(0, overlap * h0, 0));
      if (kind == 2) {
        world.dimension = 3;
        world.add_box(Vec3(-.1, -.1, -overlap * h0), 2, 2, 1, .1, 2700, 0);
        world.config.layer = h0;
        world.add_tool("die", sheet(3, 1, [](double, double) { return 0.; }), 0, [](double) { return Vec3(.013, .007, 0); });
      }
      Contact contact = world.make();
      ASSERT_EQ(contact.warnings().size(), 1u) << overlap << " " << kind;
      EXPECT_NE(contact.warnings()[0].find("die"), std::string::npos);
      EXPECT_LT(force_at_rest(world, contact), 1e-3);
      EXPECT_NEAR(world.last.min_gap_over_layer, 1, 2e-3);
      EXPECT_EQ(world.crossings, 0);
    }
}

TEST(ContactStart, DeepOverlapsAreRefusedWithPairsAndDepths) {
  const auto refused = [](const World& world, const std::string& part) {
    try {
      world.make();
      ADD_FAILURE() << "not refused";
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), Code::initial_penetration);
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find("die"), std::string::npos) << e.what();
    }
  };
  refused(blank_on(die_profile(), Vec3(0, 2.5 * h0, 0)), "node 0 of body body0");
  refused(blank_on(die_profile(), Vec3(0, .05, 0)), "pierces");
  refused(blank_on(die_block(), Vec3(0, .05, 0)), "pierces");
  refused(blank_on(polyline({Vec3(-1, -1, 0), Vec3(2, -1, 0), Vec3(2, 1, 0), Vec3(-1, 1, 0)}, true)), "inside tool die");
  refused(blank_on(polyline({Vec3(.42, .05, 0), Vec3(.47, .05, 0), Vec3(.45, .08, 0)}, true)), "inside body body0");

  World plane;
  plane.add_strip(Vec3(0, 0, 0), 10, 2, .1, .1, 2700, 0);
  plane.config.layer = h0;
  plane.add_plane("die", Vec3(0, .05, 0), Vec3(0, 1, 0), 0, [](double) { return Vec3::Zero(); });
  refused(plane, "11 pairs");

  World box;
  box.dimension = 3;
  box.add_box(Vec3(-.3, -.3, -.05), 6, 6, 2, .1, 2700, 0);
  box.config.layer = h0;
  box.add_tool("die", sheet(3, 1, [](double, double) { return 0.; }), 0, [](double) { return Vec3(.013, .007, 0); });
  refused(box, "pierces");
}

// Crossed ridges that touch or overlap between their nodes: no vertex is near the other's surface, only edges are.
TEST(ContactStart, EdgesThatTouchOrOverlapALittleAreParted) {
  for (double gap : {.5, 0., -.5, -1.9})
    for (int other_is_tool = 0; other_is_tool < 2; ++other_is_tool) {
      World world;
      world.dimension = 3;
      world.config.layer = h0;
      contact_test::add_wedge(world, .5, 0, 1e9);
      if (other_is_tool)
        world.add_tool("ridge", contact_test::ridge(2, .5, .5, M_PI / 2), 0, [gap](double) { return Vec3(.13, .04, -gap * h0); });
      else
        contact_test::add_wedge(world, .5, -gap * h0, 1e9, true);
      Contact contact = world.make();
      world.take_shifts(contact);
      for (int i = 0; i < 100; ++i) EXPECT_LT(force_at_rest(world, contact), 1e-3) << gap << " " << other_is_tool;
      EXPECT_EQ(world.crossings, 0);
      EXPECT_EQ(world.halvings, 0);
    }
}

TEST(ContactStart, EdgesThatOverlapMoreAreRefused) {
  World world;
  world.dimension = 3;
  world.config.layer = h0;
  contact_test::add_wedge(world, .5, 0, 1e9);
  world.add_tool("ridge", contact_test::ridge(2, .5, .5, M_PI / 2), 0, [](double) { return Vec3(.13, .04, 3 * h0); });
  try {
    world.make();
    FAIL() << "not refused";
  } catch (const Error& e) {
    const std::string text = e.what();
    EXPECT_EQ(e.code(), Code::initial_penetration);
    EXPECT_NE(text.find("node 0 of body wedge0"), std::string::npos) << text;
    EXPECT_NE(text.find("edge that lies 0.00"), std::string::npos) << text;
    EXPECT_NE(text.find("tool ridge"), std::string::npos) << text;
  }
}

// The surface the user gave is where the layer ends: facets are set back by h0,
// also at a corner, whatever way they are listed.
TEST(ContactStart, ToolsAreSetBackByTheLayer) {
  for (int reversed = 0; reversed < 2; ++reversed)
    for (double gap : {1.01, .99}) {
      Mesh corner = polyline({Vec3(0, 1, 0), Vec3(0, 0, 0), Vec3(2, 0, 0)});
      if (reversed) std::swap(corner.surface[1].nodes[0], corner.surface[1].nodes[1]);
      World world = blank_on(corner, Vec3(-h0, -h0, 0));  // one layer of room on either side
      Contact contact = world.make();
      EXPECT_TRUE(contact.warnings().empty());
      // Fly one layer and a bit: contact begins one layer from the set-back wall.
      for (auto& v : world.v) v = Node(-1, -1, 0, 0);
      const double dt = 1e-6;
      long first = -1;
      for (int i = 0; i < 1100 && first < 0; ++i) {
        world.step(contact, dt, false);
        if (world.last.active > 0) first = i;
      }
      EXPECT_NEAR(first * dt, h0, 2 * dt) << gap;
    }
}

// Two parts of one tool, one above and one below: each is set back to its own side.
TEST(ContactStart, PartsOnEitherSideOfTheBlank) {
  Mesh both = polyline({Vec3(-1, 0, 0), Vec3(2, 0, 0)});
  both.nodes.push_back(Vec3(-1, .2, 0));
  both.nodes.push_back(Vec3(2, .2, 0));
  Facet f;
  f.nodes = {2, 3, -1};
  both.surface.push_back(f);
  World world = blank_on(both);
  Contact contact = world.make();
  expect_backed_off_by_the_layer(contact);
  EXPECT_LT(force_at_rest(world, contact), 1e-6);
}

TEST(ContactStart, ParametersAreChosenFromMeshAndMaterial) {
  World world = blank_on(die_profile(), Vec3(0, -.1, 0));
  world.config.layer = 0;
  world.thinnest = .2;
  EXPECT_NEAR(world.make().layer(), 2e-4, 1e-15);
  world.thinnest = 1e3;
  EXPECT_NEAR(world.make().layer(), 5e-3, 1e-15);
  EXPECT_EQ(world.make().stiffness(), 70e9);
  EXPECT_EQ(world.make().push_speed(), .1);
  world.wave_speed = 20;
  EXPECT_EQ(world.make().push_speed(), .02);
  world.config.stiffness = 5;
  world.config.push_speed = 7;
  EXPECT_EQ(world.make().stiffness(), 5);
  EXPECT_EQ(world.make().push_speed(), 7);
}

// Bodies that stand close meet where they meet: two rings with less than a layer between them pressed on each other from the start.
TEST(ContactStart, TheLayerLeavesBodiesTheirClearance) {
  const auto two_strips = [](double gap, double layer = 0) {
    World world;
    world.config.layer = layer;
    world.thinnest = .2;  // by itself it makes a layer of 2e-4 m
    world.add_strip(Vec3(0, 0, 0), 10, 2, .1, .1, 2700, 0);
    world.add_strip(Vec3(0, .2 + gap, 0), 7, 2, .1, .1, 2700, 0);
    return world;
  };
  for (double gap : {1.5e-5, 3e-5, 9e-5}) {
    World world = two_strips(gap);
    Contact contact = world.make();
    EXPECT_NEAR(contact.layer(), .2 * gap, 1e-12) << gap;
    EXPECT_TRUE(contact.body_shifts().empty() || contact.body_shifts()[1].isZero(0)) << gap;
    ASSERT_EQ(contact.warnings().size(), 1u);
    EXPECT_EQ(contact.warnings()[0].find("two bodies stand "), 0u) << contact.warnings()[0];
    EXPECT_EQ(force_at_rest(world, contact), 0);
  }
  for (double gap : {0., .3e-6, .6e-6, .8e-6, 1.1e-6, 1e-5}) {  // of the layer: they touch
    World world = two_strips(gap * 2e-4);
    Contact contact = world.make();
    ASSERT_EQ(contact.body_shifts().size(), 2u) << gap;
    const double apart = (contact.body_shifts()[1] - contact.body_shifts()[0]).y();
    EXPECT_NEAR(apart, 2e-4, 1e-8) << gap;
  }
  EXPECT_TRUE(two_strips(5e-3).make().warnings().empty());
  EXPECT_NEAR(two_strips(5e-3).make().layer(), 2e-5, 1e-15) << "far apart: they come together";
  EXPECT_NEAR(two_strips(0).make().layer(), 2e-4, 1e-15) << "what touches is parted";
  EXPECT_EQ(two_strips(1e-4, h0).make().layer(), h0) << "as it was asked for";
}

// Two blocks of one width, one a little in the other: their corners lie inside near two sides, and come out of the one
// that faces the other block.
TEST(ContactStart, BlocksWithSidesInLineThatOverlapALittleAreParted) {
  for (int dimension : {2, 3})
    for (double overlap : {.3, 1.2, 1.9}) {
      World world;
      world.dimension = dimension;
      world.config.layer = h0;
      for (double low : {0., .2 - overlap * h0}) {
        if (dimension == 2)
          world.add_strip(Vec3(0, low, 0), 4, 2, .1, .1, 2700, 0);
        else
          world.add_box(Vec3(0, 0, low), 4, 4, 2, .1, 2700, 0);
      }
      Contact contact = world.make();
      world.take_shifts(contact);
      EXPECT_LT(force_at_rest(world, contact), 1e-6) << dimension << ", " << overlap;
      EXPECT_EQ(world.crossings, 0);
      EXPECT_NEAR(world.last.min_gap_over_layer, 1, 1e-6);
      const Vec3 apart = contact.body_shifts()[1] - contact.body_shifts()[0];
      EXPECT_NEAR(apart[dimension - 1], (kOutside + overlap) * h0, 1e-6 * h0);
      EXPECT_NEAR(apart.norm(), apart[dimension - 1], 1e-6 * h0);
    }
}

// A strip lies on another one and reaches over its end, with a vertex on its face a layer and a half from that end: the way
// out is up, not past the end.
TEST(ContactStart, AVertexThatTouchesBesideAnEndIsPartedFromTheFaceItTouches) {
  World world;
  world.config.layer = h0;
  world.add_strip(Vec3(0, 0, 0), 10, 2, .1, .1, 2700, 0);
  world.add_strip(Vec3(1.5 * h0 - .1, .2, 0), 5, 2, .1, .1, 2700, 0);
  Contact contact = world.make();
  ASSERT_EQ(contact.warnings().size(), 2u);
  const Vec3 parted = contact.body_shifts()[1] - contact.body_shifts()[0];
  EXPECT_NEAR(parted.y(), h0, 1e-6 * h0);
  EXPECT_NEAR(parted.x(), 0, 1e-9 * h0);
}
