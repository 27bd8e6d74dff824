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
  ContactSetup setup;
  setup.dimension = world.dimension;
  setup.bodies = world.bodies;
  setup.tools = world.tools;
  for (const Mesh& mesh : world.meshes) setup.tool_meshes.push_back(&mesh);
  Found found{build_features(setup, world.x), {}};
  const auto motion = world.motion(0, 0);
  found.flush = Flush(kLayer, found.f, find_sides(kLayer, found.f, world.x, motion).of_facet, motion);
  find_level_parts(found.f);
  found.flush.mark(motion, found.f);
  return found;
}

std::map<int, int> joints_of(const Features& f, bool level) {  // per surface
  std::map<int, int> count;
  for (const Features::Edge& edge : f.edges)
    if (!edge.joint.isZero(0) && edge.level == level) ++count[edge.surface];
  return count;
}

const Mesh kLeft = block(Vec3(-1, -.5, -.5), Vec3(0, .5, 0)), kRight = block(Vec3(0, -.5, -.5), Vec3(1, .5, 0));

}  // namespace

TEST(ContactFlush, BlocksSideBySideAreOne) {
  const World world = world_of(3, {kLeft, kRight});
  Found found = find(world);
  EXPECT_EQ(joints_of(found.f, true), (std::map<int, int>{{1, 4}, {2, 4}}));  // the four sides of the face that each has on the other
  EXPECT_TRUE(joints_of(found.f, false).empty());
  int covered = 0, inside = 0;
  for (std::size_t i = 0; i < found.f.facets.size(); ++i) covered += found.flush.covers(static_cast<int>(i));
  for (const Node& way : found.f.joint_vertex) {
    inside += !way.isZero(0);
    EXPECT_NEAR(std::abs(way[0]), way.isZero(0) ? 0 : 1, 1e-12);
  }
  EXPECT_EQ(covered, 4);
  EXPECT_EQ(inside, 8);
  EXPECT_EQ(found.flush.together(0), (std::vector<int>{0, 1}));
  for (const Features::Edge& edge : found.f.edges) EXPECT_GE(edge.joint[0] * (edge.surface == 1 ? 1 : -1), 0);  // out of its tool
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
  EXPECT_TRUE(joints_of(found.f, true).empty());
  EXPECT_TRUE(joints_of(found.f, false).empty());
  for (const Node& way : found.f.joint_vertex) EXPECT_TRUE(way.isZero(0));
  motion[1].position1.z() = 5;
  EXPECT_TRUE(found.flush.mark(motion, found.f));
  EXPECT_EQ(joints_of(found.f, true).size(), 2u);
  motion[0].present = false;
  EXPECT_TRUE(found.flush.mark(motion, found.f));
  EXPECT_TRUE(joints_of(found.f, true).empty());
}

TEST(ContactFlush, BesideANarrowerOnePartOfTheEdge) {
  const World world = world_of(3, {kLeft, block(Vec3(0, -.25, -.5), Vec3(1, .25, 0))});
  const Found found = find(world);
  EXPECT_EQ(joints_of(found.f, true), (std::map<int, int>{{2, 2}}));  // above and below; its sides are edges beside the other's face
  EXPECT_EQ(joints_of(found.f, false), (std::map<int, int>{{1, 2}}));
  for (const Features::Edge& edge : found.f.edges)
    if (!edge.joint.isZero(0) && edge.surface == 1) {
      EXPECT_NEAR(edge.joint_first, .25, 2 * kLayer);
      EXPECT_NEAR(edge.joint_last, .75, 2 * kLayer);
    }
  for (const Node& way : found.f.joint_vertex) EXPECT_TRUE(way.isZero(0));
}

TEST(ContactFlush, NotWithAStepNorAGap) {
  const Found stepped = find(world_of(3, {kLeft, block(Vec3(0, -.5, -.5), Vec3(1, .5, -.2 * kLayer))}));
  EXPECT_EQ(joints_of(stepped.f, true), (std::map<int, int>{{1, 3}, {2, 3}}));  // bottoms and sides go on in each other
  const auto is_low = [&](int v) { return stepped.f.place[v - stepped.f.body_nodes][2] == -.5; };
  for (const Features::Edge& edge : stepped.f.edges) {
    EXPECT_TRUE(edge.joint.isZero(0) || is_low(edge.node[0]) || is_low(edge.node[1]));
  }
  EXPECT_FALSE(find(world_of(3, {kLeft, block(Vec3(.2 * kLayer, -.5, -.5), Vec3(1, .5, 0))})).flush.any());
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
  int inside = 0;
  for (std::size_t v = 0; v < found.f.joint_vertex.size(); ++v)
    if (!found.f.joint_vertex[v].isZero(0)) {
      ++inside;
      EXPECT_EQ(found.f.place[v][1], 0);  // of the ridge; the rims end there
    }
  EXPECT_EQ(inside, 2);
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
