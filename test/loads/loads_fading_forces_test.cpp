// Forces that fade: whole at their start, level at both ends, gone at their end or once they have done more work than they may.
#include <gtest/gtest.h>

#include "forming_sim/loads/fading_forces.h"

namespace forming_sim {
namespace {

Vec3 on(FadingForces& forces, int n, double t) {
  NodeField f(4, Node::Zero());
  forces.add(t, f);
  return vec3(f[n]);
}

TEST(FadingForces, FadeFromAllToNothing) {
  FadingForces forces;
  EXPECT_TRUE(forces.empty());
  forces.begin(2, 4, {0}, 1e9, {{1, node(Vec3(8, 0, -16))}, {3, node(Vec3(0, 1, 0))}});
  forces.begin(3, 2, {0}, 1e9, {{1, node(Vec3(0, 10, 0))}});
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

TEST(FadingForces, DriveNothingOnByMoreThanTheyMay) {
  FadingForces forces;
  forces.begin(2, 4, {0}, 10, {{1, node(Vec3(0, 5, 0))}});  // 5 N that may do 10 J
  const NodeField along(4, node(Vec3(7, 1, 0))), against(4, node(Vec3(7, -1, 0)));
  on(forces, 1, 2);
  EXPECT_FALSE(forces.work(0.9, along, along)) << "4.5 J";
  EXPECT_FALSE(forces.work(1, against, against)) << "what springs back moves against them: -.5 J";
  on(forces, 1, 4);
  EXPECT_FALSE(forces.work(1, along, along)) << "half of them is left: 2 J";
  EXPECT_FALSE(forces.work(9, along, against)) << "and stays so where the mean velocity is none";
  on(forces, 1, 2);
  EXPECT_TRUE(forces.work(0.9, along, along)) << "6.5 J, and the next such step would do 4.5 more";
  EXPECT_TRUE(forces.empty());
  EXPECT_FALSE(forces.work(1, along, along));
}

// One layer of two is driven on by what the other takes; a body that hangs on neither has what it may for itself.
TEST(FadingForces, OfWhatHangsTogetherMayDoItTogether) {
  FadingForces forces;
  const NodeField along(4, node(Vec3(0, 1, 0)));
  forces.begin(2, 4, {2, 0}, 3, {{1, node(Vec3(0, 5, 0))}});
  forces.begin(2, 4, {0, 2}, 3, {{2, node(Vec3(0, -4, 0))}});
  forces.begin(2, 4, {1}, 3, {{3, node(Vec3(0, 5, 0))}});
  EXPECT_EQ(on(forces, 1, 2), Vec3(0, 5, 0));
  EXPECT_TRUE(forces.work(1, along, along)) << "5 J on the third";
  EXPECT_EQ(on(forces, 3, 2), Vec3::Zero());
  EXPECT_EQ(on(forces, 2, 2), Vec3(0, -4, 0));
  EXPECT_FALSE(forces.work(1, along, along)) << "2 J in all";
  forces.begin(2, 4, {2, 3}, 2, {{0, node(Vec3(0, 1, 0))}});  // what lets go of them later hangs together with what did before
  on(forces, 0, 2);
  EXPECT_TRUE(forces.work(1, along, along)) << "2 of 2 J";
  EXPECT_TRUE(forces.empty());
}

// What lets go of a body on which others fade balances these, and goes with them.
TEST(FadingForces, JoinWhatFadesAlready) {
  FadingForces forces;
  forces.begin(2, 4, {0, 1}, 1e9, {{1, node(Vec3(0, 8, 0))}});
  on(forces, 1, 4);
  EXPECT_FALSE(forces.join({2}, 1e9, {{3, node(Vec3(3, 0, 0))}}));
  EXPECT_TRUE(forces.join({1}, 1e9, {{3, node(Vec3(3, 0, 0))}}));
  EXPECT_EQ(on(forces, 3, 4), Vec3(3, 0, 0)) << "now it is what it was";
  EXPECT_EQ(on(forces, 1, 4), Vec3(0, 4, 0));
  const Vec3 later = on(forces, 3, 5);
  EXPECT_NEAR(later.x() / 3, on(forces, 1, 5).y() / 4, 1e-15);
  on(forces, 1, 5.9);
  EXPECT_FALSE(forces.join({1}, 1e9, {{2, node(Vec3(3, 0, 0))}})) << "too little is left";
  EXPECT_EQ(forces.end(), 6);
}

TEST(FadingForces, CountWhatOthersDo) {
  FadingForces forces;
  const NodeField rest(4, Node::Zero());
  forces.begin(2, 4, {0, 1}, 10, {{1, node(Vec3(0, 8, 0))}});
  on(forces, 1, 2);
  forces.count(2, 100);
  EXPECT_FALSE(forces.work(1, rest, rest));
  forces.count(1, 9);
  EXPECT_FALSE(forces.work(1, rest, rest));
  forces.count(0, 2);
  EXPECT_TRUE(forces.work(1, rest, rest));
}

}  // namespace
}  // namespace forming_sim
