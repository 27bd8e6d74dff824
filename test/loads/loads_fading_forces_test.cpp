// Forces that fade: whole at their start, level at both ends, gone at their end or once they have done more work than they may; turned with the surface.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "forming_sim/loads/fading_forces.h"

namespace forming_sim {
namespace {

const NodeField kPlaces(4, Node::Zero());
const std::vector<double> kMasses = {1, 2, 1, 4};

Vec3 on(FadingForces& forces, int n, double t, const NodeField& x = kPlaces) {
  NodeField f(4, Node::Zero());
  forces.add(t, x, kMasses, f);
  return vec3(f[n]);
}

TEST(FadingForces, FadeFromAllToNothing) {
  FadingForces forces;
  EXPECT_TRUE(forces.empty());
  forces.begin(2, 4, 1e9, {0, 4, 8}, {{1, false, node(Vec3(8, 0, -16))}, {3, false, node(Vec3(0, 1, 0))}}, {}, kPlaces);
  forces.begin(3, 2, 1e9, {0, 4, 8}, {{1, false, node(Vec3(0, 10, 0))}}, {}, kPlaces);
  EXPECT_EQ(on(forces, 1, 2), Vec3(8, 10, -16));
  EXPECT_EQ(on(forces, 3, 4), Vec3(0, 0.5, 0));
  EXPECT_EQ(on(forces, 1, 4), Vec3(4, 5, -8));
  EXPECT_EQ(on(forces, 0, 4), Vec3(0, 0, 0));
  EXPECT_EQ(on(forces, 1, 7), Vec3(0, 0, 0));
  const double h = 1e-3;
  for (double t : {2., 6.}) EXPECT_NEAR((on(forces, 3, t + h) - on(forces, 3, t - h)).norm() / h, 0, 1e-5);
  forces.forget(5);
  EXPECT_EQ(on(forces, 1, 5.9).y(), 0);
  EXPECT_FALSE(forces.empty());
  forces.forget(6);
  EXPECT_TRUE(forces.empty());
}

// In space and in a section: what a tool pressed with turns as the face does, whatever the face is stretched by, and what is held keeps its direction.
TEST(FadingForces, OfToolsTurnWithTheSurface) {
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3::UnitZ()).toRotationMatrix();
  for (int corners : {2, 3, 4}) {
    NodeField x = {node(Vec3(0, 0, 0)), node(Vec3(1, 0, 0)), node(Vec3(1, 0, 2)), node(Vec3(0, 0, 2))}, later = x;
    for (Node& n : later) n = node(Vec3(turn * (1.3 * vec3(n)) + Vec3(4, 5, 6)));
    Face face;
    face.corners = corners;
    for (int k = 0; k < corners; ++k) face.nodes[k] = k;
    const Vec3 force(3, -7, 0.5);
    FadingForces forces;
    forces.begin(0, 1, 1e9, {0, 4, 8}, {{0, true, node(force)}, {1, false, node(force)}}, {face}, x);
    EXPECT_LT((on(forces, 0, 0, x) - force).norm(), 1e-14) << corners;
    // Together they do what they did: what is more by the turn is taken from all nodes.
    const Vec3 more = turn * force - force;
    EXPECT_LT((on(forces, 0, 0, later) - (turn * force - more / 8)).norm(), 1e-14) << corners;
    EXPECT_LT((on(forces, 1, 0, later) - (force - more / 4)).norm(), 1e-14) << corners;
    EXPECT_LT((on(forces, 3, 0, later) + more / 2).norm(), 1e-14) << corners;
  }
}

TEST(FadingForces, DriveNothingOnByMoreThanTheyMay) {
  FadingForces forces;
  forces.begin(2, 4, 10, {0, 4, 8}, {{1, false, node(Vec3(0, 5, 0))}}, {}, kPlaces);  // 5 N that may do 10 J
  const NodeField along(4, node(Vec3(7, 1, 0))), against(4, node(Vec3(7, -1, 0)));
  on(forces, 1, 2);
  EXPECT_FALSE(forces.work(0.9, kMasses, along, along)) << "4.5 J";
  EXPECT_FALSE(forces.work(1, kMasses, against, against)) << "what springs back moves against them: -.5 J";
  on(forces, 1, 4);
  EXPECT_FALSE(forces.work(1, kMasses, along, along)) << "half of them is left: 2 J";
  EXPECT_FALSE(forces.work(9, kMasses, along, against)) << "and stays so where the mean velocity is none";
  on(forces, 1, 2);
  EXPECT_TRUE(forces.work(0.9, kMasses, along, along)) << "6.5 J, and the next such step would do 4.5 more";
  EXPECT_TRUE(forces.empty());
  EXPECT_FALSE(forces.work(1, kMasses, along, along));
}

}  // namespace
}  // namespace forming_sim
