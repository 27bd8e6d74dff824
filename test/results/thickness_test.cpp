// Distance of the top nodes from the bottom surface, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "forming_sim/results/thickness.h"

namespace forming_sim {
namespace {

TEST(DistanceToFacet, IsThatOfFaceEdgeAndCorner) {
  const Vec3 a(0, 0, 0), b(2, 0, 0), c(0, 2, 0);
  EXPECT_DOUBLE_EQ(distance_to_facet(Vec3(0.5, 0.5, 3), a, b, c), 3);
  EXPECT_DOUBLE_EQ(distance_to_facet(Vec3(1, -1, 0), a, b, c), 1);
  EXPECT_DOUBLE_EQ(distance_to_facet(Vec3(-3, -4, 0), a, b, c), 5);
  EXPECT_DOUBLE_EQ(distance_to_facet(Vec3(2, 2, 0), a, b, c), std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(distance_to_facet(Vec3(1, 4, 0), a, b, b), 4);   // a segment
  EXPECT_DOUBLE_EQ(distance_to_facet(Vec3(5, 4, 0), a, b, b), 5);
}

/// A strip of length pi/2 and thickness t as two rows of nodes.
Mesh strip(int cells, double t) {
  Mesh mesh;
  mesh.dimension = 2;
  for (int row = 0; row < 2; ++row)
    for (int i = 0; i <= cells; ++i) mesh.nodes.push_back(Vec3(i * M_PI / 2 / cells, row * t, 0));
  for (int i = 0; i <= cells; ++i) {
    mesh.sets["bottom"].push_back(i);
    mesh.sets["top"].push_back(cells + 1 + i);
  }
  for (int i = 0; i < cells; ++i) mesh.surface.push_back({{i, i + 1, -1}, 0});
  mesh.surface.push_back({{cells, 2 * cells + 1, -1}, 0});  // the end: not of the bottom
  return mesh;
}

TEST(Thickness, OfABentSheetIsItsRadialDistance) {
  const int cells = 40, offset = 3;
  const double t = 0.1;
  const Mesh mesh = strip(cells, t);
  const auto thickness = Thickness::of(mesh, offset);
  ASSERT_TRUE(thickness);
  NodeField flat(offset + mesh.nodes.size()), bent = flat;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    const Vec3& x = mesh.nodes[i];
    flat[offset + i] = node(x);
    bent[offset + i] = Node((1 + x.y()) * std::sin(x.x()), (1 + x.y()) * std::cos(x.x()), 0, 0);
  }
  EXPECT_DOUBLE_EQ(thickness->smallest(flat), t);
  // The bottom's chords lie within a chord's height of the arc.
  const double chord = 1 - std::cos(M_PI / 4 / cells);
  EXPECT_GE(thickness->smallest(bent), t - 1e-12);
  EXPECT_LE(thickness->smallest(bent), t + chord);

  bent[offset + cells + 1 + 7].head<3>() *= 1.05 / 1.1;  // one dent
  const double expected = 0.05;
  EXPECT_NEAR(thickness->smallest(bent), expected, chord);
}

TEST(Thickness, NeedsBothSetsAndFacetsOfTheBottom) {
  Mesh mesh = strip(4, 0.1);
  mesh.surface.resize(0);
  EXPECT_FALSE(Thickness::of(mesh, 0));
  mesh = strip(4, 0.1);
  mesh.sets.erase("top");
  EXPECT_FALSE(Thickness::of(mesh, 0));
}

TEST(Thickness, FindsTheNearestTriangleAsASearchOfAllDoes) {
  Mesh mesh;
  const int n = 8;
  for (int side = 0; side < 2; ++side)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        mesh.nodes.push_back(Vec3(i, j, side ? 2 + std::sin(1.3 * i + 0.7 * j) : 0.4 * std::sin(2.1 * i * j)));
  const int layer = (n + 1) * (n + 1);
  for (int k = 0; k < layer; ++k) {
    mesh.sets["bottom"].push_back(k);
    mesh.sets["top"].push_back(layer + k);
  }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + n + 1;
      mesh.surface.push_back({{a, a + 1, b + 1}, 0});
      mesh.surface.push_back({{a, b + 1, b}, 0});
    }
  NodeField positions;
  for (const Vec3& x : mesh.nodes) positions.push_back(node(x));
  double expected = 1e300;
  for (int top : mesh.sets["top"])
    for (const Facet& f : mesh.surface)
      expected = std::min(expected, distance_to_facet(mesh.nodes[top], mesh.nodes[f.nodes[0]], mesh.nodes[f.nodes[1]],
                                                      mesh.nodes[f.nodes[2]]));
  EXPECT_EQ(Thickness::of(mesh, 0)->smallest(positions), expected);
}

}  // namespace
}  // namespace forming_sim
