// Joints of tools that stand side by side (contact/flush.h): no edges, as long as they stand so.
#include <gtest/gtest.h>

#include <map>

#include "contact/point_bodies.h"
#include "forming_sim/contact/flush.h"
#include "forming_sim/contact/tools.h"

using contact_test::triangles;
using contact_test::World;
using namespace forming_sim;

namespace {

constexpr double kLayer = 1e-3;

/// A closed box of twelve triangles; in dimension 2 of four segments.
Mesh block(const Vec3& low, const Vec3& high, int dimension = 3) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(), i & 4 ? high.z() : low.z());
  if (dimension == 3)
    return triangles(corners, {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}});
  Mesh mesh;
  mesh.dimension = 2;
  for (const int i : {0, 1, 3, 2}) mesh.nodes.emplace_back(corners[i].x(), corners[i].y(), 0);
  for (int i = 0; i < 4; ++i) mesh.surface.push_back({{i, (i + 1) % 4, -1}, -1});
  return mesh;
}

/// A body above the tools.
World world_of(int dimension, const std::vector<Mesh>& tools, double friction = 0) {
  World world;
  world.dimension = dimension;
  world.config.layer = kLayer;
  if (dimension == 3) world.add_box(Vec3(-.62, -.3, 2 * kLayer), 2, 2, 1, .3, 2700, 5e9);
  else world.add_strip(Vec3(-.62, 2 * kLayer, 0), 2, 1, .3, .3, 2700, 5e9);
  for (std::size_t t = 0; t < tools.size(); ++t) world.add_tool("tool " + std::to_string(t), tools[t], friction, [](double) { return Vec3::Zero(); });
  return world;
}

struct Found {
  Features f;
  Flush flush;
};
Found find(const World& world) {
  Found found{build_features(world.setup(), world.x), {}};
  const auto motion = world.motion(0, 0);
  found.flush = Flush(kLayer, found.f, find_sides(kLayer, found.f, world.x, motion).of_facet, world.x, motion);
  find_level_parts(found.f);
  found.flush.mark(motion, found.f);
  return found;
}

/// Per surface how many edges are joints, all of them or in part.
std::map<int, int> joints_of(const Features& f, bool whole) {
  std::map<int, int> count;
  for (const Features::Edge& edge : f.edges)
    if (edge.joints > 0 && edge.level == whole) ++count[edge.surface];
  return count;
}
int joint_vertices(const Features& f) {
  int count = 0;
  for (const int joint : f.joint_vertex) count += joint >= 0;
  return count;
}
bool at_height(const Features& f, const Features::Edge& edge, double z) { return f.place[edge.node[0] - f.body_nodes][2] == z && f.place[edge.node[1] - f.body_nodes][2] == z; }

const Mesh kLeft = block(Vec3(-1, -.5, -.5), Vec3(0, .5, 0)), kRight = block(Vec3(0, -.5, -.5), Vec3(1, .5, 0));

}  // namespace

TEST(ContactFlush, BlocksSideBySideAreOneWhereBodiesAre) {
  const Found found = find(world_of(3, {kLeft, kRight}));
  EXPECT_EQ(joints_of(found.f, true), (std::map<int, int>{{1, 1}, {2, 1}}));  // above; no body is below or beside them
  EXPECT_TRUE(joints_of(found.f, false).empty());
  EXPECT_EQ(joint_vertices(found.f), 0);  // its ends are corners
  EXPECT_EQ(found.flush.together(0), (std::vector<int>{0, 1}));
  int facing = 0;
  for (std::size_t i = 0; i < found.f.facets.size(); ++i)
    for (const int v : found.f.facets[i]) facing += found.flush.faces_joint(static_cast<int>(i), v);
  EXPECT_EQ(facing, 2 * 3);  // the two triangles of each face that looks at the other, at the ends of its edge above
  for (const Features::Edge& edge : found.f.edges)
    for (int j = 0; j < edge.joints; ++j) {
      const Features::JointPart& part = found.f.joint_parts[edge.first_joint + j];
      EXPECT_TRUE(at_height(found.f, edge, 0));
      EXPECT_NEAR(part.way[0], edge.surface == 1 ? 1 : -1, 1e-12);  // out of its tool
      EXPECT_LT(part.slack, .05 * kLayer);
    }
}

TEST(ContactFlush, AsLongAsTheyStandToEachOtherAsAtTheStart) {
  const World world = world_of(3, {kLeft, kRight});
  Found found = find(world);
  auto motion = world.motion(0, 0);
  EXPECT_FALSE(found.flush.mark(motion, found.f));
  for (ToolMotion& tool : motion) tool.position0 = tool.position1 = Vec3(3, 4, 5);  // both
  EXPECT_FALSE(found.flush.mark(motion, found.f));
  motion[1].position1.z() -= 0.02 * kLayer;  // one, in this step
  EXPECT_TRUE(found.flush.mark(motion, found.f));
  EXPECT_TRUE(joints_of(found.f, true).empty() && joints_of(found.f, false).empty());
  motion[1].position1.z() = 5;
  EXPECT_TRUE(found.flush.mark(motion, found.f));
  EXPECT_EQ(joints_of(found.f, true).size(), 2u);
  motion[0].present = false;
  EXPECT_TRUE(found.flush.mark(motion, found.f));
  EXPECT_TRUE(joints_of(found.f, true).empty());
  motion[0].present = true;
  motion[0].freedom[0].inverse_mass = 1;  // a force drives it from now on
  found.flush.mark(motion, found.f);
  EXPECT_TRUE(joints_of(found.f, true).empty());
}

TEST(ContactFlush, TheWayOverAJointTurnsWithTheTools) {
  const World world = world_of(3, {kLeft, kRight});
  Found found = find(world);
  auto motion = world.motion(0, 0);
  for (ToolMotion& tool : motion) tool.rotation1 = Eigen::AngleAxisd(.5, Vec3::UnitY()).toRotationMatrix();
  EXPECT_FALSE(found.flush.mark(motion, found.f));
  for (ToolMotion& tool : motion) tool.rotation0 = tool.rotation1;
  EXPECT_FALSE(found.flush.mark(motion, found.f));
  for (const Features::Edge& edge : found.f.edges)
    if (edge.joints > 0) {
      EXPECT_NEAR((vec3(found.f.joint_parts[edge.first_joint].way) - (edge.surface == 1 ? 1 : -1) * Vec3(std::cos(.5), 0, -std::sin(.5))).norm(), 0, 1e-12);
    }
}

TEST(ContactFlush, BesideANarrowerOnePartOfTheEdge) {
  const Found found = find(world_of(3, {kLeft, block(Vec3(0, -.25, -.5), Vec3(1, .25, 0))}));
  EXPECT_EQ(joints_of(found.f, true), (std::map<int, int>{{2, 1}}));
  EXPECT_EQ(joints_of(found.f, false), (std::map<int, int>{{1, 1}}));
  for (const Features::Edge& edge : found.f.edges)
    if (edge.joints > 0 && edge.surface == 1) {
      EXPECT_NEAR(found.f.joint_parts[edge.first_joint].first, .25, 2 * kLayer);
      EXPECT_NEAR(found.f.joint_parts[edge.first_joint].last, .75, 2 * kLayer);
    }
  EXPECT_EQ(joint_vertices(found.f), 2);  // corners of the narrower: what comes over the wider has that below it
  for (std::size_t v = 0; v < found.f.joint_vertex.size(); ++v) EXPECT_FALSE(found.f.joint_vertex[v] >= 0 && found.f.level_vertex[v]);
}

TEST(ContactFlush, ALongEdgeBesideTwo) {
  const Found found = find(world_of(3, {kLeft, block(Vec3(0, -.5, -.5), Vec3(1, .1, 0)), block(Vec3(0, .1, -.4), Vec3(1, .5, 0))}));
  EXPECT_EQ(joints_of(found.f, true), (std::map<int, int>{{1, 1}, {2, 2}, {3, 2}}));
  EXPECT_TRUE(joints_of(found.f, false).empty());
  EXPECT_EQ(joint_vertices(found.f), 2);  // of each of the two the corner where three meet
  EXPECT_EQ(found.flush.together(2), (std::vector<int>{0, 1, 2}));
}

TEST(ContactFlush, FourAroundAPoint) {
  std::vector<Mesh> tools;
  for (const double x : {-1., 0.})
    for (const double y : {-1., 0.}) tools.push_back(block(Vec3(x, y, -.5), Vec3(x + 1, y + 1, 0)));
  const Found found = find(world_of(3, tools));
  EXPECT_EQ(joints_of(found.f, true), (std::map<int, int>{{1, 2}, {2, 2}, {3, 2}, {4, 2}}));
  EXPECT_EQ(joint_vertices(found.f), 4);
  for (std::size_t v = 0; v < found.f.joint_vertex.size(); ++v) EXPECT_EQ(found.f.joint_vertex[v] >= 0, found.f.level_vertex[v] && found.f.place[v].norm() == 0);
}

TEST(ContactFlush, NotWithAStepNorAGapNorOtherBodies) {
  EXPECT_FALSE(find(world_of(3, {kLeft, block(Vec3(0, -.5, -.5), Vec3(1, .5, -.2 * kLayer))})).flush.any());
  EXPECT_FALSE(find(world_of(3, {kLeft, block(Vec3(.2 * kLayer, -.5, -.5), Vec3(1, .5, 0))})).flush.any());
  World world = world_of(3, {kLeft, kRight});
  world.config.pairs.push_back({});
  world.config.pairs[0].first = world.bodies[0].name, world.config.pairs[0].second = "tool 1", world.config.pairs[0].kind = "none";
  EXPECT_FALSE(find(world).flush.any());
}

TEST(ContactFlush, ASliverBesideNothing) {  // shorter than two layers
  const Mesh sliver = triangles({Vec3(.5, 0, 0), Vec3(.5 + kLayer, 0, 0), Vec3(.6, .3, 0), Vec3(.5, .4, 0)}, {{0, 1, 2}, {0, 2, 3}});
  EXPECT_FALSE(find(world_of(3, {kLeft, sliver})).flush.any());
}

TEST(ContactFlush, OpenSurfacesGoOnAtTheirBorders) {
  const auto half = [](double from, double to) {  // of a roof with a ridge along x
    std::vector<Vec3> points;
    for (const double y : {-.5, 0., .5})
      for (const double x : {from, to}) points.emplace_back(x, y, -.4 * std::abs(y));
    return triangles(points, {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 5, 4}});
  };
  const Found found = find(world_of(3, {half(-1, 0), half(0, 1)}));
  EXPECT_EQ(joints_of(found.f, true), (std::map<int, int>{{1, 2}, {2, 2}}));
  EXPECT_EQ(joint_vertices(found.f), 2);
  for (std::size_t v = 0; v < found.f.joint_vertex.size(); ++v) EXPECT_TRUE(found.f.joint_vertex[v] < 0 || found.f.place[v][1] == 0);  // of the ridge; the rims end there
  EXPECT_FALSE(find(world_of(3, {half(-1, 0), half(.2 * kLayer, 1)})).flush.any());
}

TEST(ContactFlush, TheTipOfADividedPyramidIsStillATip) {
  const auto half = [](double side) {
    const std::vector<Vec3> points{Vec3(0, 0, 0), Vec3(side * .5, -.5, -.3), Vec3(side * .5, .5, -.3), Vec3(0, -.5, -.3), Vec3(0, .5, -.3)};
    return triangles(points, {{0, 1, 2}, {0, 3, 1}, {0, 2, 4}, {0, 4, 3}, {1, 3, 4}, {1, 4, 2}});
  };
  const Found found = find(world_of(3, {half(-1), half(1)}));
  EXPECT_EQ(joints_of(found.f, true), (std::map<int, int>{{1, 2}, {2, 2}}));
  EXPECT_EQ(joint_vertices(found.f), 2);
  for (std::size_t v = 0; v < found.f.level_vertex.size(); ++v) EXPECT_FALSE(found.f.level_vertex[v]);
}

// Of an exact fit between walls flush with their floor below: no joint on the side where the body is, and the walls are set back as ever.
TEST(ContactFlush, AChannelOfThreeIsSetBackAsOne) {
  World world;
  world.dimension = 3;
  world.config.layer = kLayer;
  world.add_box(Vec3(-.3, -.3, 0), 2, 2, 1, .3, 2700, 5e9);
  for (const Mesh& mesh : {block(Vec3(-.3, -.5, -.5), Vec3(.3, .5, 0)), block(Vec3(-1, -.5, -.5), Vec3(-.3, .5, .5)), block(Vec3(.3, -.5, -.5), Vec3(1, .5, .5))})
    world.add_tool("tool " + std::to_string(world.tools.size()), mesh, 0, [](double) { return Vec3::Zero(); });
  Contact contact = world.make();
  world.take_shifts(contact);
  for (int i = 0; i < 20; ++i) world.step(contact, 1e-5);
  EXPECT_EQ(world.crossings, 0);
  EXPECT_NEAR(world.exchanged, 0, 1e-12);
}

// Two halves of a die, closed by half a layer more than what lies in it is wide: as one they have no way out.
TEST(ContactFlush, HalvesThatHaveToPartAreBackedOffAlone) {
  World world;
  world.dimension = 2;
  world.config.layer = kLayer;
  world.add_strip(Vec3(-.3, 3 * kLayer, 0), 2, 1, .3, .3, 2700, 5e9);
  const double wall = .3 - .5 * kLayer;
  const auto half = [&](double side) { return contact_test::polyline({Vec3(side, -.5, 0), Vec3(0, -.5, 0), Vec3(0, 0, 0), Vec3(side * wall, 0, 0), Vec3(side * wall, .6, 0), Vec3(side, .6, 0)}, true); };
  world.add_tool("left", half(-1), 0, [](double) { return Vec3::Zero(); });
  world.add_tool("right", half(1), 0, [](double) { return Vec3::Zero(); });
  EXPECT_TRUE(find(world).flush.any());
  const Contact contact = world.make();
  ASSERT_EQ(contact.warnings().size(), 2u);
  EXPECT_EQ(contact.warnings()[0].find("tool left touches or overlaps a body at the start: it was backed off by "), 0u) << contact.warnings()[0];
  EXPECT_EQ(contact.warnings()[1].find("tool right touches or overlaps a body at the start: it was backed off by "), 0u) << contact.warnings()[1];
}

// Over a slit that a file's digits leave there.
TEST(ContactFlush, NothingSinksIntoASlit) {
  for (const int dimension : {2, 3}) {
    const double half = .04 * kLayer;
    const Vec3 low(-1, -.5, -.5), high(1, dimension == 2 ? 0 : .5, 0);
    World world;
    world.dimension = dimension;
    world.config.layer = kLayer;
    if (dimension == 3) world.add_box(Vec3(-.3, -.3, 1.5 * kLayer), 2, 2, 1, .3, 2700, 5e9);
    else world.add_strip(Vec3(-.3, 1.5 * kLayer, 0), 2, 1, .3, .3, 2700, 5e9);
    world.add_tool("left", block(low, Vec3(-half, high.y(), high.z()), dimension), 0, [](double) { return Vec3::Zero(); });
    world.add_tool("right", block(Vec3(half, low.y(), low.z()), high, dimension), 0, [](double) { return Vec3::Zero(); });
    EXPECT_TRUE(find(world).flush.any());
    world.gravity = dimension == 2 ? Vec3(0, -1e4, 0) : Vec3(0, 0, -1e4);
    Contact contact = world.make();
    world.take_shifts(contact);
    double lowest = 1;
    for (int i = 0; i < 3000; ++i) {
      world.step(contact, 1e-5);
      for (const Node& x : world.x) lowest = std::min(lowest, x[dimension - 1]);
    }
    EXPECT_EQ(world.crossings, 0) << dimension;
    EXPECT_GT(lowest, -kLayer) << dimension;  // where they are set back
  }
}

TEST(ContactFlush, WhatSlidesOverAJointFeelsOneTool) {
  for (const int dimension : {2, 3})
    for (const double speed : {10., 200.}) {  // m/s: to two layers a step
      const Vec3 low(-1, -.5, -.5), high(1, dimension == 2 ? 0 : .5, 0);
      const auto tool = [&](double from, double to) { return block(Vec3(from, low.y(), low.z()), Vec3(to, high.y(), high.z()), dimension); };
      double end[2][2];
      for (const bool parted : {false, true}) {
        World world = world_of(dimension, parted ? std::vector<Mesh>{tool(-1, 0), tool(0, 1)} : std::vector<Mesh>{tool(-1, 1)}, .1);
        world.gravity = dimension == 2 ? Vec3(0, -1e3, 0) : Vec3(0, 0, -1e3);
        for (auto& v : world.v) v = Node(speed, 0, 0, 0);
        Contact contact = world.make();
        world.take_shifts(contact);
        while (world.time < .2 / speed) world.step(contact, 1e-5);
        EXPECT_EQ(world.crossings, 0);
        double x = 0, v = 0;
        for (std::size_t n = 0; n < world.x.size(); ++n) x += world.x[n][0] / world.x.size(), v += world.v[n][0] / world.x.size();
        end[parted][0] = x, end[parted][1] = v;
      }
      EXPECT_NEAR(end[1][0], end[0][0], 1e-4) << dimension << " " << speed;
      EXPECT_NEAR(end[1][1], end[0][1], 5e-4 * speed) << dimension << " " << speed;
    }
}
