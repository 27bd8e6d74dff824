// Two freedoms of one tool, found one after the other from the same impulses: what each counts keeps the two together from overshooting.
#include "forming_sim/contact/driven.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

#include "forming_sim/contact/closest.h"

namespace forming_sim {
namespace {

/// A link of inverse mass w that is pushed along `on`, with friction or along `normal` alone.
DrivenLink link_of(const Node& on, const Node& normal, double w, bool rubs) {
  const double along = dot3(on, normal);
  const Node answer = (rubs ? on : Node(along * normal)) / w;
  return {0, on, answer, along, dot3(on, answer), rubs};
}

}  // namespace

// The impulses answer the two by no more than sum [m1 m12; m12 m2]: less than the diagonal that is counted, in every mixture of both.
TEST(DrivenTool, TwoFreedomsTogetherStayBelowWhatIsCounted) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vector = [&] { return node(any(random), any(random), any(random)); };
  for (int trial = 0; trial < 200; ++trial) {
    DrivenTool guide, axle;
    Eigen::Matrix2d answers = Eigen::Matrix2d::Zero();
    for (int i = 0; i < 4; ++i) {
      const bool rubs = any(random) > 0;
      const double w = 1.5 + any(random);
      Node normal = vector();
      normal /= std::sqrt(dot3(normal, normal));
      guide.pairs.push_back(link_of(vector(), normal, w, rubs));
      axle.pairs.push_back(link_of(1e-2 * vector(), normal, w, rubs));  // in other units
      const double m12 = dot3(guide.pairs[i].on, axle.pairs[i].answer);
      answers += (Eigen::Matrix2d() << guide.pairs[i].mass, m12, m12, axle.pairs[i].mass).finished();
    }
    const double alone = guide.pairs[0].mass;
    DrivenTool::see_each_other(guide, axle);
    EXPECT_GT(guide.pairs[0].mass, alone);
    EXPECT_LE(guide.pairs[0].mass, 2 * alone * (1 + 1e-12));
    Eigen::Vector2d counted = Eigen::Vector2d::Zero();
    for (int i = 0; i < 4; ++i) counted += Eigen::Vector2d(guide.pairs[i].mass, axle.pairs[i].mass);
    const Eigen::Vector2d scale = counted.cwiseSqrt().cwiseInverse();
    const Eigen::Matrix2d part = scale.asDiagonal() * answers * scale.asDiagonal();
    EXPECT_LE(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(part).eigenvalues().maxCoeff(), 1 + 1e-12);
  }
}

}  // namespace forming_sim
