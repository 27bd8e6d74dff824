// Points of the law at the edges of free simplices: element/edge_points.h.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "forming_sim/element/edge_points.h"
#include "forming_sim/mesh/cell_tables.h"
#include "support/bodies.h"
#include "support/dense_limit.h"
#include "support/free_case.h"
#include "support/rings.h"

namespace forming_sim {
namespace {

class EdgePointsOf : public ::testing::TestWithParam<FreeCase> {
 protected:
  EdgePointsOf() : mesh(free_mesh(GetParam())), simplices(mesh.simplices()), X(positions_of(mesh)), points(find_edge_points(simplices, X, D, ring)) {}
  const int D = GetParam().dimension;
  const bool ring = GetParam().ring;
  const Mesh mesh;
  const std::vector<std::array<int, 4>> simplices;
  const NodeField X;
  const EdgePoints points;

  Eigen::Matrix3d edges_of_simplex_at(const NodeField& x, const std::array<int, 4>& s) const {
    Eigen::Matrix3d e = Eigen::Matrix3d::Identity();
    for (int m = 0; m < D; ++m) e.col(m) = vec3(x[s[m + 1]] - x[s[0]]);
    if (ring) e(2, 2) = (x[s[0]][0] + x[s[1]][0] + x[s[2]][0]) / 3;
    return e;
  }
  /// x_m from the weights.
  Eigen::Matrix3d edges_of_point(const NodeField& x, int point) const {
    Eigen::Matrix3d e = Eigen::Matrix3d::Identity();
    e.topLeftCorner(D, D).setZero();
    if (ring) e(2, 2) = 0;
    const int n = edge_weights(D, ring);
    for (int i = points.start[point]; i < points.start[point + 1]; ++i) {
      for (int m = 0; m < D; ++m) e.col(m) += points.weight[i * n + m] * vec3(x[points.node[i]]);
      if (ring) e(2, 2) += points.weight[i * n + D] * x[points.node[i]][0];
    }
    return e;
  }
};

TEST_P(EdgePointsOf, AreTheEdgesAndShareTheVolumes) {
  std::set<std::pair<int, int>> edges;
  double whole = 0;
  for (const auto& s : simplices) {
    whole += edges_of_simplex_at(X, s).determinant() * (D == 3 ? 1. / 6 : ring ? kTwoPi / 2 : 0.5);
    for (int a = 0; a <= D; ++a)
      for (int b = 0; b < a; ++b) edges.insert(std::minmax(s[a], s[b]));
  }
  ASSERT_EQ(points.count(), static_cast<int>(edges.size()));
  double sum = 0;
  for (int point = 0; point < points.count(); ++point) {
    sum += points.volume[point];
    EXPECT_EQ(edges.count({points.ends[point][0], points.ends[point][1]}), 1u);
    double share = 0;
    for (int i = points.start[point]; i < points.start[point + 1]; ++i) share += points.share[i];
    EXPECT_NEAR(share, 1, 1e-14);
  }
  EXPECT_NEAR(sum, whole, 1e-13 * whole);
}

// F_e = sum_s (V_s / k) F_s / V_e, found anew by going through all simplices for each edge.
TEST_P(EdgePointsOf, HaveTheMeanGradientOfTheSimplicesAround) {
  NodeField x = X;
  shake(x, D, 0.05, 3);
  for (int point = 0; point < points.count(); ++point) {
    const int low = points.ends[point][0], high = points.ends[point][1];
    Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
    double volume = 0;
    for (const auto& s : simplices) {
      if (std::find(s.begin(), s.end(), low) == s.end() || std::find(s.begin(), s.end(), high) == s.end()) continue;
      const Eigen::Matrix3d start = edges_of_simplex_at(X, s);
      const double V = start.determinant();
      mean += V * edges_of_simplex_at(x, s) * start.inverse();
      volume += V;
    }
    mean /= volume;
    const Eigen::Matrix3d F = edges_of_point(x, point) * points.edges(point).inverse();
    EXPECT_LT((F - mean).norm(), 1e-12) << "edge " << low << " " << high;
    EXPECT_LT((edges_of_point(X, point) - points.edges(point)).norm(), 1e-13);
  }
}

// No motion but that of a rigid body is free of force: the strains in the nodes, of which there are fewer than edges, leave some that are.
TEST_P(EdgePointsOf, LeaveNoShapeWithoutStiffness) {
  ElementOptions options;
  options.axisymmetric = ring;
  Elements elements({body_of(mesh, aluminium())}, D, X, options, 1);
  const Eigen::VectorXd omega2 = dense_frequencies(elements, X, D);
  const int rigid = D == 3 ? 6 : ring ? 1 : 3;
  const double slowest = std::pow(M_PI * std::sqrt(aluminium().youngs_modulus / aluminium().density), 2);  // of a bar as long as the body, or so
  for (int i = 0; i < rigid; ++i) EXPECT_LT(std::abs(omega2[i]), 1e-6 * slowest);
  EXPECT_GT(omega2[rigid], 0.05 * slowest);
}

INSTANTIATE_TEST_SUITE_P(Free, EdgePointsOf, ::testing::Values(FreeCase{2, false}, FreeCase{2, true}, FreeCase{3, false}));

// A mesh of two kinds of cells: the nodes' pressures are those of the free ones alone, and the forces the gradient of the energy.
TEST(EdgePoints, BesideCellsWithPressuresOfTheirOwn) {
  Mesh mesh = block_of(CellKind::crossed, 2);
  Cells &crossed = mesh.cells[0], triangles{CellKind::triangle, {}};
  std::vector<int> kept;
  for (int c = 0; c < crossed.count(); ++c)
    for (int i = 0; i < 5; ++i)
      if (c % 2 == 0) kept.push_back(crossed.nodes[c * 5 + i]);
  for (int c = 1; c < crossed.count(); c += 2)
    for (const auto& t : kCrossed)
      for (int a = 0; a < 3; ++a) triangles.nodes.push_back(crossed.nodes[c * 5 + t[a]]);
  crossed.nodes = kept;
  mesh.cells.push_back(triangles);
  const NodeField X = positions_of(mesh);
  NodeField x = X, f(X.size()), unused(X.size()), v(X.size(), Node::Zero());
  Elements elements({body_of(mesh, aluminium())}, 2, X, {}, 1);
  shake(x, 2, 0.03, 4);
  elements.forces(x, v, 0, 0, f);
  double scale = 0;
  for (const Node& n : f) scale = std::max(scale, n.norm());
  const double h = 1e-6;
  for (std::size_t n = 0; n < x.size(); ++n)
    for (int i = 0; i < 2; ++i) {
      NodeField plus = x, minus = x;
      plus[n][i] += h, minus[n][i] -= h;
      const double slope = (elements.stored_energy(plus) - elements.stored_energy(minus)) / (2 * h);
      EXPECT_NEAR(f[n][i], -slope, 1e-6 * scale) << "node " << n << " axis " << i;
    }
}

}  // namespace
}  // namespace forming_sim
