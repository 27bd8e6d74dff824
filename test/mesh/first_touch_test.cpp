// Where a surface that comes along a line first touches another: exact cases, and random surfaces against rays.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "forming_sim/mesh/first_touch.h"

using namespace forming_sim;

namespace {

PlacedSurface soup(std::vector<Vec3> points, int dimension = 3) {
  PlacedSurface surface;
  surface.dimension = dimension;
  for (int i = 0; i + dimension <= static_cast<int>(points.size()); i += dimension) surface.facets.push_back({i, i + 1, dimension == 3 ? i + 2 : -1});
  surface.points = std::move(points);
  return surface;
}

/// A long roof with its ridge along `along` through `at`, open below.
PlacedSurface roof(const Vec3& at, const Vec3& along, const Vec3& side, double depth) {
  const Vec3 a = at - along, b = at + along, down = Vec3(0, 0, -depth);
  return soup({a, b, a + side + down, a, a - side + down, b});
}

/// Distances along the way from points all over `from` to where they meet `to`, by a test of its own; the least.
double sampled(const PlacedSurface& from, const PlacedSurface& to, const Vec3& along, int steps) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& f : from.facets)
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; i + j <= steps; ++j) {
        const double s = double(i) / steps, t = double(j) / steps;
        const Vec3 p = (1 - s - t) * from.points[f[0]] + s * from.points[f[1]] + t * from.points[f[2]];
        for (const auto& g : to.facets) {
          Mat3 m;  // p + w along = a + s (b - a) + t (c - a)
          m << to.points[g[1]] - to.points[g[0]], to.points[g[2]] - to.points[g[0]], -along;
          const Vec3 found = m.inverse() * (p - to.points[g[0]]);
          if (found.allFinite() && found[0] >= 0 && found[1] >= 0 && found[0] + found[1] <= 1) least = std::min(least, found[2]);
        }
      }
  return least;
}

}  // namespace

TEST(FirstTouch, RidgesMeetWhereTheyCross) {
  const PlacedSurface below = roof({0, 0, 0}, {3, 1, 0}, {-1, 3, 0}, 2);
  PlacedSurface above = roof({0.2, 0.1, 0}, {1, -3, 0}, {3, 1, 0}, 2);
  for (Vec3& x : above.points) x.z() = 5 - x.z();  // turned over
  const std::optional<double> way = way_to_touch(above, below, -Vec3::UnitZ());
  ASSERT_TRUE(way);
  EXPECT_NEAR(*way, 5, 1e-12);
  for (Vec3& x : above.points) x.z() -= 7;
  EXPECT_NEAR(*way_to_touch(above, below, -Vec3::UnitZ()), -2, 1e-12) << "past it already";
  for (Vec3& x : above.points) x.x() += 50;
  EXPECT_FALSE(way_to_touch(above, below, -Vec3::UnitZ())) << "it goes by";
}

TEST(FirstTouch, RandomSurfacesAsRaysFindIt) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto any = [&] { return Vec3(unit(random), unit(random), unit(random)); };
  int touched = 0;
  for (int round = 0; round < 40; ++round) {
    std::vector<Vec3> points[2];
    for (int k = 0; k < 2; ++k)
      for (int f = 0; f < 12; ++f) {
        const Vec3 at = 2 * any();
        for (int c = 0; c < 3; ++c) points[k].push_back(at + (f % 3 == 0 ? 0.8 : 0.3) * any());
      }
    const PlacedSurface a = soup(points[0]), b = soup(points[1]);
    const Vec3 along = any().normalized();
    const double rays = std::min(sampled(a, b, along, 25), sampled(b, a, -along, 25));
    const std::optional<double> way = way_to_touch(a, b, along), back = way_to_touch(b, a, -along);
    ASSERT_EQ(way.has_value(), back.has_value());
    if (way) { EXPECT_NEAR(*way, *back, 1e-9); }
    if (!std::isfinite(rays)) continue;
    ASSERT_TRUE(way);
    ++touched;
    EXPECT_LE(*way, rays + 1e-9);
    // Moved there no ray of one reaches the other sooner, and by finer and finer rays they come together.
    PlacedSurface moved = a;
    for (Vec3& x : moved.points) x += *way * along;
    EXPECT_GE(std::min(sampled(moved, b, along, 25), sampled(b, moved, -along, 25)), -1e-9);
    const double finer = std::min(sampled(moved, b, along, 60), sampled(b, moved, -along, 60));
    EXPECT_LT(finer, std::max(0.7 * (rays - *way), 0.1)) << round;
  }
  EXPECT_GT(touched, 25);
}

TEST(FirstTouch, SectionsAndPlanes) {
  const PlacedSurface strip = soup({{0, 0, 0}, {2, 0.5, 0}, {2, 0.5, 0}, {3, 0, 0}}, 2), peak = soup({{0.5, 4, 0}, {1, 3, 0}, {1, 3, 0}, {1.5, 4, 0}}, 2);
  EXPECT_NEAR(*way_to_touch(peak, strip, -Vec3::UnitY()), 3 - 0.25, 1e-12);
  const PlacedSurface flat = soup({{-5, 4, 0}, {5, 4, 0}}, 2);
  EXPECT_NEAR(*way_to_touch(flat, strip, -Vec3::UnitY()), 3.5, 1e-12) << "a corner of what stands";
  const Vec3 aslant = Vec3(0.2, -1, 0).normalized();  // the foot of the peak, (1, 3), onto y = x/4
  EXPECT_NEAR(*way_to_touch(peak, strip, aslant), 2.75 / 1.05 * std::hypot(0.2, 1), 1e-12);
  EXPECT_NEAR(*way_to_touch(strip, peak, -aslant), 2.75 / 1.05 * std::hypot(0.2, 1), 1e-12);
  EXPECT_FALSE(way_to_touch(peak, strip, Vec3(1, -1, 0).normalized())) << "beside its end";
  PlacedSurface plane;
  plane.dimension = 2;
  plane.plane_point = Vec3(0, 9, 0);
  plane.plane_normal = -Vec3::UnitY();
  EXPECT_NEAR(*way_to_touch(plane, strip, -Vec3::UnitY()), 8.5, 1e-12);
  EXPECT_NEAR(*way_to_touch(strip, plane, Vec3::UnitY()), 8.5, 1e-12);
  EXPECT_NEAR(*way_to_touch(plane, strip, Vec3(1, -1, 0).normalized()), 8.5 * std::sqrt(2), 1e-12);
  EXPECT_FALSE(way_to_touch(plane, strip, Vec3::UnitX())) << "along itself";
  EXPECT_FALSE(way_to_touch(plane, strip, Vec3::UnitY())) << "backwards";
  EXPECT_FALSE(way_to_touch(plane, plane, Vec3::UnitY()));
}
