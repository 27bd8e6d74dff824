// The thickness of a body does not depend on how much of it is meshed.
#include <gtest/gtest.h>

#include <algorithm>

#include "forming_sim/loads/boundary.h"
#include "forming_sim/mesh/axis.h"
#include "forming_sim/mesh/generate.h"
#include "forming_sim/mesh/measure.h"
#include "support/runs.h"

namespace forming_sim {
namespace {

constexpr double kLength = 40e-3, kWidth = 10e-3, kThickness = 1e-3;

BlankConfig sheet(int dimension, double width = kWidth) {
  BlankConfig blank = strip_of(kLength, kThickness, 20, 2);
  if (dimension == 3) blank.shape = "plate", blank.width = width, blank.cells_across = 2;
  return blank;
}

/// A sheet with a set of all nodes that have this coordinate, or of all of them.
Mesh with_set(const BlankConfig& blank, int axis, double at) {
  Mesh mesh = generate_blank(blank);
  for (int n = 0; n < static_cast<int>(mesh.nodes.size()); ++n)
    if (axis < 0 || std::abs(mesh.nodes[n][axis] - at) < 1e-9) mesh.sets["plane"].push_back(n);
  return mesh;
}

double thickness(const Mesh& mesh, const std::vector<SymmetryPlane>& planes = {}, bool axisymmetric = false) { return thickness_of(mesh, axisymmetric, cut_facets(mesh, planes)); }
double of_whole_section() { return kLength * kThickness / (kLength + kThickness); }

}  // namespace

TEST(ThicknessOf, ASheetIsTwiceItsVolumeOverItsSurface) {
  EXPECT_NEAR(thickness(generate_blank(sheet(2))), of_whole_section(), 1e-12);
  const double volume = kLength * kWidth * kThickness, area = 2 * (kLength * kWidth + kWidth * kThickness + kThickness * kLength);
  EXPECT_NEAR(thickness(generate_blank(sheet(3))), 2 * volume / area, 1e-12);
}

TEST(ThicknessOf, ASliceOfASheetIsAsThickAsItsSection) {
  const Mesh slice = with_set(sheet(3, 0.1e-3), -1, 0);  // a slice holds all its nodes across
  EXPECT_NEAR(thickness(slice, {{"plane", Vec3(0, -2, 0)}}), of_whole_section(), 1e-12);
}

TEST(ThicknessOf, HalfASheetIsAsThickAsTheWhole) {
  BlankConfig half = sheet(2);
  half.length /= 2;
  EXPECT_NEAR(thickness(with_set(half, 0, 0), {{"plane", Vec3::UnitX()}}), of_whole_section(), 1e-12);
  half = sheet(2);
  half.thickness /= 2;
  EXPECT_NEAR(thickness(with_set(half, 1, 0), {{"plane", Vec3::UnitY()}}), of_whole_section(), 1e-12);
}

TEST(ThicknessOf, WhatIsHeldAlongItselfIsNoPlaneOfSymmetry) {
  const Mesh mesh = with_set(sheet(2), 1, 0);
  EXPECT_NEAR(thickness(mesh, {{"plane", Vec3::UnitX()}}), of_whole_section(), 1e-12);
  EXPECT_NEAR(thickness(mesh, {{"a missing set", Vec3::UnitY()}}), of_whole_section(), 1e-12);
}

// What carries a sheet in its middle holds a part of its lower face, and is no plane of symmetry.
TEST(ThicknessOf, APatchOfAFaceIsNoPlaneOfSymmetry) {
  Mesh mesh = with_set(sheet(2), 1, 0);
  std::vector<int>& held = mesh.sets["plane"];
  held.erase(std::remove_if(held.begin(), held.end(), [&](int n) { return std::abs(mesh.nodes[n].x() - kLength / 2) > kLength / 8; }), held.end());
  ASSERT_GT(held.size(), 2u);
  EXPECT_NEAR(thickness(mesh, {{"plane", Vec3::UnitY()}}), of_whole_section(), 1e-12);
}

TEST(ThicknessOf, PlanesOfSymmetryHoldOneDirectionToTheEnd) {
  BoundaryConfig fixed;
  fixed.set = "bottom";
  fixed.kind = "fixed";
  fixed.axes = {"y"};
  EXPECT_EQ(symmetry_planes({fixed}, false).size(), 1u);
  EXPECT_EQ(symmetry_planes({fixed}, true).size(), 1u);
  fixed.axes = {"x"};
  EXPECT_EQ(symmetry_planes({fixed}, true).size(), 0u) << "a wall that is held in x is a mandrel's";
  fixed.axes = {"x", "y"};
  EXPECT_EQ(symmetry_planes({fixed}, false).size(), 0u);
  BoundaryConfig let_go = symmetric("bottom", Vec3::UnitY());
  let_go.until = "springback";
  EXPECT_EQ(symmetry_planes({let_go}, false).size(), 0u);
}

TEST(ThicknessOf, ABodyBetweenPlanesOfSymmetryAloneHasItsOwnSurface) {
  const Mesh mesh = with_set(sheet(2), -1, 0);
  EXPECT_NEAR(thickness(mesh, {{"plane", Vec3::UnitX()}, {"plane", Vec3::UnitY()}}), of_whole_section(), 1e-12);
}

TEST(ThicknessOf, ADiscThatIsTurnedIsAsThickAsItsSectionSays) {
  const double R = kLength;
  Mesh section = generate_blank(sheet(2));
  close_at_axis(section);
  EXPECT_NEAR(thickness(section, {}, true), R * R * kThickness / (R * R + R * kThickness), 1e-9);
}

}  // namespace forming_sim
