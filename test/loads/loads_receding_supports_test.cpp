// Supports that recede: they bear what the tools pressed with, less as they or the node go; and are the gradient of an energy.
#include <gtest/gtest.h>

#include <random>

#include "forming_sim/loads/receding_supports.h"

namespace forming_sim {
namespace {

constexpr double kDt = 1e-3, kMass = 2, kStiff = kMass * (RecedingSupports::kStiffness / kDt) * (RecedingSupports::kStiffness / kDt);  // N/m
const std::vector<double> kMasses(3, kMass);
const NodeField kPlaces = {node(Vec3(1, 2, 3)), node(Vec3(4, 5, 6)), node(Vec3(7, 8, 9))};

/// Tools pressed on nodes 0 and 1 by (0, 30, 40) N and its opposite on .5 m2 each, a boundary held node 2 by (1, 0, 0) N, let go from 2 s on; what is left fades in 7.5 s.
RecedingSupports supports() {
  RecedingSupports made;
  made.begin({7, {5, 7}, 0.1, 1e6, 0, 2, 7.5}, 1, kDt, kMasses, kPlaces, {{{0, node(Vec3(0, 30, 40))}, 0.5}, {{1, node(Vec3(0, -30, -40))}, 0.5}, {{2, node(Vec3(1, 0, 0))}, 0}});
  return made;
}
Vec3 on(RecedingSupports& s, int n, double t, const NodeField& x) {
  NodeField f(3, Node::Zero());
  s.add(t, x, f);
  return vec3(f[n]);
}
NodeField moved(const Vec3& by) {
  NodeField x = kPlaces;
  for (Node& n : x) n += node(by);
  return x;
}

TEST(RecedingSupports, BearWhatTheToolsDidAndLessAsTheNodeLeaves) {
  RecedingSupports s = supports();
  const Vec3 F(0, 30, 40), way = F / 50;
  const double give = 50 / kStiff;
  EXPECT_LT((on(s, 0, 2, kPlaces) - F).norm(), 1e-12);
  EXPECT_LT((on(s, 0, 2, moved(-2 * give * way)) - 3 * F).norm(), 1e-9) << "against it";
  EXPECT_LT((on(s, 0, 2, moved(0.25 * give * way)) - 0.75 * F).norm(), 1e-9);
  EXPECT_EQ(on(s, 0, 2, moved(1.01 * give * way)), Vec3::Zero());
  EXPECT_LT((on(s, 0, 2, moved(Vec3(5, 4, -3))) - F).norm(), 1e-9) << "across it nothing changes";
  EXPECT_LT((on(s, 1, 2, kPlaces) + F).norm(), 1e-12);
  EXPECT_EQ(on(s, 2, 2.9, moved(Vec3(1, 1, 1))), Vec3(1, 0, 0)) << "what a boundary held";
}

// By 3 p t/E, 3 x 100 Pa x .1 m/1 MPa = 30 micrometres, and twice what the supports give, in a third of that.
TEST(RecedingSupports, RecedeByTheSqueezeAndHandOverWhatIsLeft) {
  RecedingSupports s = supports(), early = supports();
  const Vec3 F(0, 30, 40), way = F / 50;
  const double give = 50 / kStiff, depth = 30e-6 + 2 * give;
  EXPECT_LT((on(early, 0, 3.25, moved((0.5 * give - depth / 2) * way)) - 0.5 * F).norm(), 1e-9);
  EXPECT_TRUE(s.take(4.499).empty());
  EXPECT_EQ(s.end(), 12);
  NodeField x = moved((0.2 * give - depth) * way);
  x[1] = kPlaces[1] + node(Vec3(0, -1, -1));
  // Before it is nearly open nothing counts; then .2 s and .4 s of other forces do.
  const double open = 2 + RecedingSupports::kNearlyOpen * 2.5;
  on(s, 0, open - 0.05, x);
  NodeField closer = x;
  closer[0] -= node(Vec3(0.1 * give * way));
  const Vec3 first = on(s, 0, open + 0.2, x), then = on(s, 0, open + 0.6, closer);
  const auto left = s.take(4.5);
  EXPECT_TRUE(s.empty());
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0].of.body, 7);
  ASSERT_EQ(left[0].forces.size(), 2u) << "what was left behind bears nothing";
  EXPECT_GT(first.norm(), 1);
  EXPECT_LT((vec3(left[0].forces[0].force) - (first + 2 * then) / 3).norm(), 1e-9 * F.norm()) << "in the mean";
  EXPECT_LT((vec3(left[0].forces[1].force) - Vec3(1, 0, 0)).norm(), 1e-12);
  EXPECT_EQ(RecedingSupports::squeeze({{{0, node(F)}, 0.5}}), 0) << "what presses on one side squeezes nothing";
  EXPECT_NEAR(RecedingSupports::squeeze({{{0, node(F)}, 0.5}, {{1, node(Vec3(-F))}, 0.5}, {{2, node(F)}, 0}}), 1, 1e-15);
  EXPECT_NEAR(RecedingSupports::squeeze({{{0, node(F)}, 0.5}, {{1, node(Vec3(-F / 2))}, 0.5}}), 2. / 3, 1e-15);
  const Mat3 half = Mat3::Identity() - (Vec3::UnitZ() * Vec3::UnitZ().transpose()).eval();
  EXPECT_NEAR(RecedingSupports::squeeze({{{0, node(F)}, 0.5}}, half), 1 - 30. / 50, 1e-15) << "across a plane of symmetry the other half presses back";
}

// A boundary that lets go while they recede is handed over whole, however late it came; and what they do is told.
TEST(RecedingSupports, TakeInWhatLetsGoMeanwhile) {
  RecedingSupports s = supports();
  const HoldingForce clamp{2, node(Vec3(0, 7, 0))};
  EXPECT_FALSE(s.join({6, 8}, kPlaces, {{clamp}})) << "another body";
  on(s, 0, 4.4, kPlaces);
  EXPECT_TRUE(s.join({6, 7}, kPlaces, {{clamp}, {{1, Node::Zero()}}}));
  EXPECT_EQ(on(s, 2, 4.45, kPlaces), Vec3(1, 7, 0));
  const NodeField v(3, node(Vec3(0, 2, 0)));
  const auto done = s.work(0.5, v, v);
  ASSERT_EQ(done.size(), 1u);
  EXPECT_EQ(done[0].body, 7);
  EXPECT_NEAR(done[0].work, 7, 1e-9) << "7 N by 1 m; all else has been left behind or goes across";
  const auto left = s.take(4.5);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0].of.together, (std::vector<int>{5, 7}));
  ASSERT_GE(left[0].forces.size(), 2u);
  EXPECT_EQ(vec3(left[0].forces.back().force), Vec3(0, 7, 0));
}

// A release of less than a step fades from where it was; a force of nothing is nothing.
TEST(RecedingSupports, ThatNoStepSawHandOverAll) {
  RecedingSupports s;
  s.begin({0, {0}, 0.1, 1e6, 0, 2, 1e-4}, 1, kDt, kMasses, kPlaces, {{{0, node(Vec3(0, 30, 40))}, 0.5}, {{1, Node::Zero()}, 0.5}, {{2, node(Vec3(0, -30, -40))}, 0.5}});
  EXPECT_NEAR(s.end(), 2 + 4e-4 / 3, 1e-12);
  const Vec3 nothing = on(s, 1, 2, kPlaces);
  EXPECT_EQ(nothing, Vec3::Zero());
  const auto left = s.take(2.001);
  ASSERT_EQ(left.size(), 1u);
  ASSERT_EQ(left[0].forces.size(), 2u);
  EXPECT_LT((vec3(left[0].forces[0].force) - Vec3(0, 30, 40)).norm(), 1e-12);
}

// What presses on an edge or a corner presses from each of its faces: a support along the sum alone would let the corner of a block in a closed die escape along the wall.
TEST(RecedingSupports, ForcesOnEdgesAndCornersAreSplitByFaces) {
  const Vec3 F(1, -20, 3), down(0, 2, 0), nearly_down = Vec3(0.4, 1, 0), right(-1, 0, 0), front(0, 0, -4), back(0, 0, 1);
  const auto same = [](const std::vector<Vec3>& parts, const std::vector<Vec3>& expected) {
    if (parts.size() != expected.size()) return false;
    for (std::size_t k = 0; k < parts.size(); ++k)
      if ((parts[k] - expected[k]).norm() > 1e-12) return false;
    return true;
  };
  EXPECT_TRUE(same(parts_by_face(F, {}), {F}));
  EXPECT_TRUE(same(parts_by_face(F, {down, nearly_down, down}), {F})) << "a curved face: friction goes with it";
  EXPECT_TRUE(same(parts_by_face(F, {down, right, front}), {Vec3(0, -20, 0), Vec3(1, 0, 0), Vec3(0, 0, 3)}));
  EXPECT_TRUE(same(parts_by_face(F, {down, right, back}), {Vec3(0, -20, 3), Vec3(1, 0, 0)})) << "none pulls";
  EXPECT_TRUE(same(parts_by_face(F, {-down}), {F})) << "nothing that presses";
}

TEST(RecedingSupports, AreTheGradientOfAnEnergyThatFallsAsTheyRecede) {
  RecedingSupports s;
  s.begin({0, {0}, 0.1, 1e6, 0, 2, 7.5}, 0.4, kDt, kMasses, kPlaces, {{{0, node(Vec3(0, 30, 40))}, 0.5}, {{1, node(Vec3(-9, 2, 1))}, 0.1}, {{2, node(Vec3(5, 5, 5))}, 2}});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-3e-4, 3e-4);
  for (int trial = 0; trial < 50; ++trial) {
    NodeField x = kPlaces;
    for (Node& n : x) n += node(Vec3(any(random), any(random), any(random)));
    const double t = 2 + trial / 50., h = 1e-9;
    NodeField f(3, Node::Zero());
    s.add(t, x, f);
    for (int n = 0; n < 3; ++n)
      for (int k = 0; k < 3; ++k) {
        NodeField more = x, less = x;
        more[n][k] += h, less[n][k] -= h;
        EXPECT_NEAR(f[n][k], -(s.energy(t, more) - s.energy(t, less)) / (2 * h), 1e-3) << n << k;
      }
    EXPECT_LE(s.energy(t + 0.02, x), s.energy(t, x));
  }
}

}  // namespace
}  // namespace forming_sim
