// Probes: which nodes and elements they follow, and their means.
#include <gtest/gtest.h>

#include "forming_sim/config/fault.h"
#include "forming_sim/results/probe.h"

namespace forming_sim {
namespace {

/// A unit square of two triangles of area 1/2, moved by an offset of 3 nodes and 5 elements.
struct Square {
  Model model;
  std::vector<std::array<int, 4>> elements;
  Square() {
    model.dimension = 2;
    BodyModel ahead, body;
    ahead.name = "ahead";
    ahead.node_count = 3;
    ahead.mesh.nodes.assign(3, Vec3(100, 0, 0));
    body.name = "sheet";
    body.first_node = 3;
    body.node_count = 4;
    body.mesh.nodes = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
    body.mesh.sets = {{"all", {0, 1, 2, 3}}, {"lower", {0, 1, 2}}, {"corner", {1}}, {"empty", {}}};
    model.bodies = {ahead, body};
    elements = {{0, 1, 2, -1}, {3, 4, 5, -1}, {3, 5, 6, -1}};
  }
};

ProbeConfig config(const std::string& set, const Vec3& point = Vec3::Zero()) {
  ProbeConfig probe;
  probe.name = "p";
  probe.body = "sheet";
  probe.set = set;
  probe.point = point;
  return probe;
}

TEST(Probe, FollowsTheNearestNodeOfItsBody) {
  const Square square;
  const auto probes = find_probes({config("", Vec3(0.9, 0.8, 0)), config("", Vec3(1.1, -1, 0))}, square.model, square.elements);
  EXPECT_EQ(probes[0].nodes, std::vector<int>{5});
  EXPECT_EQ(probes[0].elements, (std::vector<int>{1, 2}));
  EXPECT_EQ(probes[1].nodes, std::vector<int>{4});
  EXPECT_EQ(probes[1].elements, std::vector<int>{1});
}

TEST(Probe, AveragesTheElementsInsideASetOrThoseThatTouchIt) {
  const Square square;
  const auto probes = find_probes({config("all"), config("lower"), config("corner")}, square.model, square.elements);
  EXPECT_EQ(probes[0].elements, (std::vector<int>{1, 2}));
  EXPECT_EQ(probes[1].elements, std::vector<int>{1});
  EXPECT_EQ(probes[2].elements, std::vector<int>{1});
}

TEST(Probe, WeighsStressByCurrentVolume) {
  const Square square;
  const auto probes = find_probes({config("all")}, square.model, square.elements);
  NodeField x(7, Node::Zero()), v(7, Node::Zero());
  x[4] = Node(1, 0, 0, 0);
  x[5] = Node(1, 1, 0, 0);
  x[6] = Node(-2, 1, 0, 0);  // the second triangle has three times the first one's area
  v[5] = Node(0, 4, 0, 0);
  std::vector<Sym> stress(2, Sym::Zero());
  stress[0] << 1, 2, 3, 4, 5, 6;
  stress[1] << 5, 6, 7, 8, 9, 10;
  const ProbeValue value = measure(probes[0], square.model, square.elements, x, v, stress.data());
  EXPECT_EQ(value.position, Vec3(0, 0.5, 0));
  EXPECT_EQ(value.velocity, Vec3(0, 1, 0));
  Sym expected;
  expected << 4, 5, 6, 7, 8, 9;
  EXPECT_LT((value.stress - expected).norm(), 1e-14);
}

TEST(Probe, WeighsStressByTheCircleOfARing) {
  Square square;
  square.model.axisymmetric = true;
  const auto probes = find_probes({config("all")}, square.model, square.elements);
  NodeField x(7, Node::Zero()), v(7, Node::Zero());
  x[3] = Node(1, 0, 0, 0);  // two triangles of the same area, with mean radii 5/3 and 4/3
  x[4] = Node(2, 0, 0, 0);
  x[5] = Node(2, 1, 0, 0);
  x[6] = Node(1, 1, 0, 0);
  std::vector<Sym> stress(2, Sym::Zero());
  stress[0][2] = 9;
  EXPECT_NEAR(measure(probes[0], square.model, square.elements, x, v, stress.data()).stress[2], 5, 1e-12);
}

TEST(Probe, TellsAllThatCannotBePlaced) {
  const Square square;
  ProbeConfig elsewhere = config("all");
  elsewhere.body = "die";
  try {
    find_probes({config("empty"), config("all"), elsewhere, config("no such set")}, square.model, square.elements);
    FAIL() << "no error";
  } catch (const SceneError& error) {
    ASSERT_EQ(error.faults().size(), 3u);
    EXPECT_EQ(error.faults()[0].field, "output.probes[0].set");
    EXPECT_EQ(error.faults()[1].field, "output.probes[2].body");
    EXPECT_EQ(error.faults()[1].given, "die");
    EXPECT_EQ(error.faults()[2].field, "output.probes[3].set");
  }
}

TEST(LineAngle, LiesInThePlaneOfTheDimension) {
  EXPECT_DOUBLE_EQ(line_angle_deg(2, Vec3(1, 1, 0), Vec3(1, 0, 9)), -90);
  EXPECT_DOUBLE_EQ(line_angle_deg(3, Vec3(0, 0, 0), Vec3(1, 7, 1)), 45);
  EXPECT_DOUBLE_EQ(line_angle_deg(2, Vec3(0, 0, 0), Vec3(-1, 0, 0)), 180);
  EXPECT_DOUBLE_EQ(line_angle_deg(3, Vec3(0, 0, 0), Vec3(1, 7, 1), Vec3(0, -2, 0)), 45);
  EXPECT_DOUBLE_EQ(line_angle_deg(3, Vec3(1, 0, 5), Vec3(2, -1, 9), Vec3(0, 0, 1)), -45);
  EXPECT_DOUBLE_EQ(line_angle_deg(3, Vec3(0, 0, 0), Vec3(3, 1, 1), Vec3(1, 0, 0)), 45);
  EXPECT_NEAR(line_angle_deg(3, Vec3(0, 0, 0), Vec3(1, 1, 0), Vec3(1, 0, 1)), 54.735610317245346, 1e-12);
}

TEST(LineAngle, ChangesTheShortWayRound) {
  EXPECT_DOUBLE_EQ(angle_change_deg(-91, -88), 3);
  EXPECT_DOUBLE_EQ(angle_change_deg(179, -179), 2);
  EXPECT_DOUBLE_EQ(angle_change_deg(-179, 179), -2);
  EXPECT_DOUBLE_EQ(angle_change_deg(0, 180), 180);
}

}  // namespace
}  // namespace forming_sim
