// Profiles of lines and arcs.
#include <cmath>

#include "forming_sim/mesh/profile.h"
#include "mesh/mesh_test_tools.h"

namespace forming_sim {
namespace {

TEST(MeshProfile, LinesAreSegmentsInOrder) {
  const Mesh mesh = mesh_profile(way({0, 0, 0}, {{{2, 0, 0}, 0}, {{2, 1, 0}, 0}}));
  EXPECT_EQ(mesh.dimension, 2);
  EXPECT_EQ(mesh.nodes.size(), 3u);
  ASSERT_EQ(mesh.surface.size(), 2u);
  EXPECT_EQ(mesh.surface[1].nodes, (std::array<int, 3>{1, 2, -1}));
  EXPECT_EQ(mesh.surface[1].element, -1);
  EXPECT_EQ(area_vector(mesh, mesh.surface[0]), Vec3(0, -2, 0));
  EXPECT_TRUE(mesh.cells.empty());
}

TEST(MeshProfile, QuarterArcTurnsLeftForAPositiveRadius) {
  for (double sign : {1., -1.}) {
    const Mesh mesh = mesh_profile(way({1, 0, 0}, {{{0, 1, 0}, sign}}));
    const Vec3 centre = sign > 0 ? Vec3(0, 0, 0) : Vec3(1, 1, 0);
    for (const Vec3& x : mesh.nodes) EXPECT_NEAR((x - centre).norm(), 1, 1e-14);
    const int n = int(mesh.surface.size());
    // the chord error of a thousandth: n >= (pi/2) / (2 acos(.999)) = 17.6
    EXPECT_EQ(n, 18);
    EXPECT_NEAR(area(mesh), 2 * n * std::sin(M_PI / 4 / n), 1e-13);
    EXPECT_NEAR(area(mesh), M_PI / 2, 6e-4);
    EXPECT_EQ(mesh.nodes.back(), Vec3(0, 1, 0));
  }
}

TEST(MeshProfile, ArcLengthConvergesAndKeepsTheChordError) {
  for (double error : {1e-3, 1e-5, 1e-7}) {
    ProfileConfig p = way({3, 1, 0}, {{{3 + 2 * std::cos(.7) * 2, 1 + 2 * std::sin(.7) * 2, 0}, 2.5}});
    p.chord_error = error;
    const Mesh mesh = mesh_profile(p);
    const double exact = 2.5 * 2 * std::asin(2 / 2.5);
    EXPECT_NEAR(area(mesh), exact, 3 * error);
    double worst = 0;
    for (const Facet& f : mesh.surface) {
      const double chord = area_vector(mesh, f).norm();
      worst = std::max(worst, 2.5 - std::sqrt(2.5 * 2.5 - chord * chord / 4));
    }
    EXPECT_LE(worst, error * (1 + 1e-5));
    EXPECT_GT(worst, error / 3);
  }
}

TEST(MeshProfile, HalfCircleIsTheLargestArc) {
  const Mesh mesh = mesh_profile(way({-1, 0, 0}, {{{1, 0, 0}, 1}}));
  EXPECT_NEAR(area(mesh), M_PI, 1e-3);
  EXPECT_NEAR(bounds(mesh).min().y(), -1, 1e-14);  // turning left: below the chord
  const std::string text = error_of([] { mesh_profile(way({-1, 0, 0}, {{{1, 0, 0}, .99}})); });
  EXPECT_TRUE(has(text, "profile.pieces[0].radius: given a radius of 0.99 m")) << text;
  EXPECT_TRUE(has(text, "1 m, is needed")) << text;
}

TEST(MeshProfile, AClosedProfileSharesItsFirstNode) {
  ProfileConfig p = way({0, 0, 0}, {{{2, 0, 0}, 0}, {{2, 1, 0}, 0}, {{0, 1, 0}, 0}});
  p.closed = true;
  Mesh mesh = mesh_profile(p);
  EXPECT_EQ(mesh.nodes.size(), 4u);
  EXPECT_EQ(mesh.surface.size(), 4u);
  EXPECT_LT(sum_of_areas(mesh).norm(), 1e-15);
  EXPECT_NEAR(enclosed(mesh), 2, 1e-14);  // normals point out
  p = way({0, 0, 0}, {{{2, 0, 0}, 0}, {{2, 1, 0}, 0}, {{0, 0, 0}, 0}});
  for (bool closed : {false, true}) {  // it returns by itself
    p.closed = closed;
    mesh = mesh_profile(p);
    EXPECT_EQ(mesh.nodes.size(), 3u);
    EXPECT_EQ(mesh.surface.back().nodes, (std::array<int, 3>{2, 0, -1}));
  }
}

// A cylinder of large radius has no corners that the cells on it would feel, unless its chord error is said.
TEST(MeshProfile, SegmentsOfAnArcAreNoLongerThanTold) {
  ProfileConfig p = way({50, 0, 0}, {{{-50, 0, 0}, 50}});
  for (double longest : {1.0, 3.0}) {
    const Mesh mesh = mesh_profile(p, longest);
    for (const Facet& f : mesh.surface) EXPECT_LE(area_vector(mesh, f).norm(), longest);
    EXPECT_EQ(mesh.surface.size(), static_cast<std::size_t>(std::ceil(50 * M_PI / longest)));
  }
  EXPECT_EQ(mesh_profile(p, 20).surface.size(), 36u);  // the chord error asks for more
  p.chord_error = 1;
  EXPECT_EQ(mesh_profile(p, 1).surface.size(), mesh_profile(p).surface.size());
}

TEST(MeshProfile, NonsenseIsRefusedByItsPiece) {
  EXPECT_TRUE(has(error_of([] { mesh_profile(way({0, 0, 0}, {})); }), "profile.pieces: given none"));
  EXPECT_TRUE(has(error_of([] { mesh_profile(way({0, 0, 0}, {{{1, 0, 0}, 0}, {{1, 0, 0}, 0}})); }),
                  "profile.pieces[1]: ends at (1, 0, 0) m, where it starts"));
  EXPECT_TRUE(has(error_of([] { mesh_profile(way({0, 0, 0}, {{{1, NAN, 0}, 0}})); }), "profile.pieces[0].to"));
  EXPECT_TRUE(has(error_of([] { mesh_profile(way({0, 0, 0}, {{{1, 0, 0}, INFINITY}})); }), "profile.pieces[0].radius"));
  EXPECT_TRUE(has(error_of([] { mesh_profile(way({0, 0, 1}, {{{1, 0, 0}, 0}})); }), "z = 0"));
  ProfileConfig p = way({0, 0, 0}, {{{1, 0, 0}, 0}});
  p.closed = true;
  EXPECT_TRUE(has(error_of([&] { mesh_profile(p); }), "that enclose an area"));
  p.closed = false;
  p.chord_error = -1;
  EXPECT_TRUE(has(error_of([&] { mesh_profile(p); }), "profile.chord_error"));
  p = way({0, 0, 0}, {{{1, 0, 0}, 1}});
  p.chord_error = 1e-30;
  EXPECT_TRUE(has(error_of([&] { mesh_profile(p); }), "more than 100000 segments; give at least 1e-09 m"));
  p = way({0, 0, 0}, {{{1e40, 0, 0}, 1e40}});
  EXPECT_TRUE(has(error_of([&] { mesh_profile(p, 1e-3); }), "more than 100000 segments of at most 0.001 m"));
}

}  // namespace
}  // namespace forming_sim
