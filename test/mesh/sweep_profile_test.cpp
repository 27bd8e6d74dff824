// Sections swept into surfaces.
#include "forming_sim/mesh/sweep.h"

#include <cmath>
#include <map>

#include "mesh/mesh_test_tools.h"

namespace forming_sim {
namespace {

ProfileConfig section(const Vec3& start, const std::vector<std::pair<Vec3, double>>& pieces, const std::string& sweep) {
  ProfileConfig p = way(start, pieces);
  p.sweep = sweep;
  return p;
}

/// Does every edge belong to two facets that pass it in opposite directions?
bool closed(const Mesh& mesh) {
  std::map<std::pair<int, int>, int> ways;
  for (const Facet& f : mesh.surface)
    for (int k = 0; k < 3; ++k) {
      const int a = f.nodes[k], b = f.nodes[(k + 1) % 3];
      ++ways[{a, b}];
      --ways[{b, a}];
      if (a == b) return false;
    }
  for (const auto& [way, count] : ways)
    if (count != 0) return false;
  return true;
}

// From the lower pole to the upper one, the ball to the left.
TEST(SweepProfile, AHalfCircleTurnedIsABall) {
  const double r = 0.02;
  for (const double chord : {0.0, 1e-6}) {
    ProfileConfig half = section({0, 0, -r}, {{{0, 0, r}, r}}, "turned");
    half.chord_error = chord;
    const Mesh ball = sweep_profile(half);
    EXPECT_EQ(ball.dimension, 3);
    EXPECT_TRUE(closed(ball));
    const double relative = chord > 0 ? chord / r : 1e-3;
    for (const Vec3& x : ball.nodes) EXPECT_NEAR(x.norm(), r, 1e-15);
    const double volume = 4.0 / 3 * M_PI * r * r * r;
    EXPECT_LT(enclosed(ball), volume);
    EXPECT_GT(enclosed(ball), volume * (1 - 4 * relative));  // chords along the way and around it take 4/3 of that each
    for (const Facet& f : ball.surface) EXPECT_GT(area_vector(ball, f).dot(ball.nodes[f.nodes[0]]), 0);
  }
}

TEST(SweepProfile, ARingIsClosedAndItsQuartersAreAlike) {
  const ProfileConfig profile = section({0.03, 0, 0}, {{{0.04, 0, 0}, 0}, {{0.04, 0, 0.01}, 0}, {{0.03, 0, 0.01}, 0}, {{0.03, 0, 0}, 0}}, "turned");
  const Mesh ring = sweep_profile(profile);
  EXPECT_TRUE(closed(ring));
  const double circle = 1 - 1e-3, volume = M_PI * (0.04 * 0.04 - 0.03 * 0.03) * 0.01;
  EXPECT_LT(enclosed(ring), volume);
  EXPECT_GT(enclosed(ring), volume * circle * circle);
  int on_x = 0, on_y = 0;
  for (const Vec3& x : ring.nodes) {
    on_x += x.y() == 0;
    on_y += x.x() == 0;
  }
  EXPECT_EQ(on_x, 8);  // the four corners, on either side
  EXPECT_EQ(on_y, 8);
}

TEST(SweepProfile, CirclesAreAsFineAsTheBodiesAsk) {
  const ProfileConfig tube = section({1, 0, 0}, {{{1, 0, 1}, 0}}, "turned");
  EXPECT_EQ(sweep_profile(tube).nodes.size(), 2u * 72);  // a thousandth: 70.2
  EXPECT_EQ(sweep_profile(tube, 0.05).nodes.size(), 2u * 128);  // 125.7
  ProfileConfig coarse = tube;
  coarse.chord_error = 0.2;
  EXPECT_EQ(sweep_profile(coarse, 0.05).nodes.size(), 2u * 8);  // as it is said: 4.9
}

// The section of mesh_profile, and as there what looks to the right of the way is outside.
TEST(SweepProfile, AStraightOneIsItsSectionAllAlong) {
  ProfileConfig edge = section({0.01, 0, -0.01}, {{{0.01, 0, -1e-3}, 0}, {{0.009, 0, 0}, 1e-3}, {{-0.01, 0, 0}, 0}}, "straight");
  edge.width = 0.05;
  const Mesh swept = sweep_profile(edge);
  ProfileConfig flat = section({0.01, -0.01, 0}, {{{0.01, -1e-3, 0}, 0}, {{0.009, 0, 0}, 1e-3}, {{-0.01, 0, 0}, 0}}, "");
  const Mesh line = mesh_profile(flat);
  ASSERT_EQ(swept.nodes.size(), 2 * line.nodes.size());
  ASSERT_EQ(swept.surface.size(), 2 * line.surface.size());
  for (std::size_t s = 0; s < line.surface.size(); ++s) {
    const Vec3 side = area_vector(line, line.surface[s]);
    for (int half : {0, 1}) EXPECT_LT((area_vector(swept, swept.surface[2 * s + half]) - 0.025 * Vec3(side.x(), 0, side.y())).norm(), 1e-17);
  }
  for (const Vec3& x : swept.nodes) EXPECT_EQ(std::abs(x.y()), 0.025);
}

TEST(SweepProfile, SaysWhatIsWrong) {
  const auto fault = [](const ProfileConfig& p) { return error_of([&] { sweep_profile(p); }); };
  EXPECT_NE(fault(section({0.01, 0.02, 0}, {{{0.01, 0, 0.01}, 0}}, "turned")).find("profile.start: given (0.01, 0.02, 0) m; in dimension 3 a profile lies in y = 0"), std::string::npos)
      << fault(section({0.01, 0.02, 0}, {{{0.01, 0, 0.01}, 0}}, "turned"));
  EXPECT_NE(fault(section({0.01, 0, 0}, {{{-0.01, 0, 0.01}, 0}}, "turned")).find("give the section at x >= 0"), std::string::npos);
  EXPECT_NE(fault(section({0, 0, 0}, {{{0, 0, 0.01}, 0}}, "turned")).find("on the axis"), std::string::npos);
  EXPECT_NE(fault(section({1, 0, 0}, {{{0, 0, 0}, 0.4}}, "straight")).find(".pieces[0].radius"), std::string::npos);
}

}  // namespace
}  // namespace forming_sim
