// The order in which cells lie: mesh/cell_order.h.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include "forming_sim/mesh/cell_order.h"
#include "support/bodies.h"

namespace forming_sim {
namespace {

constexpr int kPiece = 512;  // cells

/// The same cells, the one that was number order[i] as number i.
Cells reordered(const Cells& cells, const std::vector<int>& order) {
  const int n = shape_of(cells.kind).nodes;
  Cells to{cells.kind, {}};
  for (int cell : order) to.nodes.insert(to.nodes.end(), cells.nodes.begin() + cell * n, cells.nodes.begin() + (cell + 1) * n);
  return to;
}

std::vector<int> shuffled(int count) {
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  return order;
}

double nodes_of_a_piece(const Cells& cells, const std::vector<int>& order) {
  const int n = shape_of(cells.kind).nodes;
  double sum = 0;
  int pieces = 0;
  for (std::size_t first = 0; first < order.size(); first += kPiece, ++pieces) {
    std::set<int> nodes;
    for (std::size_t i = first; i < std::min(first + kPiece, order.size()); ++i)
      nodes.insert(cells.nodes.begin() + order[i] * n, cells.nodes.begin() + (order[i] + 1) * n);
    sum += static_cast<double>(nodes.size());
  }
  return sum / pieces;
}

TEST(CellOrder, ShuffledCellsLieTogetherAgain) {
  for (CellKind kind : {CellKind::tetrahedron, CellKind::triangle, CellKind::hex1}) {
    const Mesh mesh = block_of(kind, kind == CellKind::triangle ? 60 : 12);
    const Cells cells = reordered(mesh.cells[0], shuffled(mesh.cells[0].count()));
    const std::vector<int> order = order_of_cells(mesh.nodes, cells.nodes, shape_of(kind).nodes, ends_of_pieces(cells.count(), kPiece), 0.7);
    std::vector<int> numbers = order, all(order.size());
    std::sort(numbers.begin(), numbers.end());
    std::iota(all.begin(), all.end(), 0);
    EXPECT_EQ(numbers, all) << shape_of(kind).name;
    // A cube of 512 cells has 9^3 nodes, of 85 cells of six tetrahedra some 5.4^3; strips and thin layers more.
    const double as_generated = nodes_of_a_piece(mesh.cells[0], all);
    EXPECT_LT(nodes_of_a_piece(cells, order), 1.1 * as_generated) << shape_of(kind).name;
    EXPECT_GT(nodes_of_a_piece(cells, all), 1.5 * as_generated) << shape_of(kind).name;
  }
}

TEST(CellOrder, CellsInOrderStay) {
  const Mesh mesh = block_of(CellKind::hex1, 20);
  const std::vector<int> order = order_of_cells(mesh.nodes, mesh.cells[0].nodes, 8, ends_of_pieces(mesh.cells[0].count(), 4096), 0.7);
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

/// A body's elements keep their numbers, and what is found of each is the same in whatever order the mesh has them.
TEST(CellOrder, DoesNotShow) {
  for (CellKind kind : {CellKind::tetrahedron, CellKind::hex1}) {
    const char* average = kind == CellKind::tetrahedron ? "node" : "cell";
    Mesh mesh = block_of(kind, 14);
    const NodeField X = positions_of(mesh);
    NodeField x = X;
    for (Node& n : x) n = {n[0] + 0.02 * n[0] * n[1], n[1] - 0.01 * n[0], n[2] + 0.01 * n[0] * n[2], 0};
    const NodeField v(X.size(), Node::Zero());
    const auto found = [&](const Mesh& of) {
      Elements elements({body_of(of, aluminium(true), average)}, 3, X, ElementOptions(), 1);
      NodeField f(X.size());
      elements.forces(x, v, 1e-8, 1e-8, f);
      return std::tuple(f, elements.plastic_strain(), elements.observe(x), elements.simplices(), elements.stored_energy(x));
    };
    const auto [f, strain, fields, simplices, energy] = found(mesh);
    const std::vector<int> order = shuffled(mesh.cells[0].count());
    mesh.cells[0] = reordered(mesh.cells[0], order);
    find_surface(mesh);
    const auto [f2, strain2, fields2, simplices2, energy2] = found(mesh);

    double largest = 0, apart = 0;
    for (std::size_t n = 0; n < f.size(); ++n) {
      largest = std::max(largest, f[n].matrix().norm());
      apart = std::max(apart, (f[n] - f2[n]).matrix().norm());
    }
    EXPECT_GT(largest, 0);
    EXPECT_LT(apart, 1e-11 * largest);
    EXPECT_NEAR(energy2, energy, 1e-12 * energy);
    const int parts = shape_of(kind).simplices;
    EXPECT_GT(*std::max_element(strain.begin(), strain.end()), 1e-3);
    for (std::size_t i = 0; i < order.size(); ++i)
      for (int s = 0; s < parts; ++s) {
        const std::size_t now = i * parts + s, then = static_cast<std::size_t>(order[i]) * parts + s;
        ASSERT_EQ(simplices2[now], simplices[then]);
        ASSERT_NEAR(strain2[now], strain[then], 1e-12);
        ASSERT_NEAR(fields2.volume_ratio[now], fields.volume_ratio[then], 1e-12);
        ASSERT_LT((fields2.stress[now] - fields.stress[then]).norm(), 1e-9 * 200e6);
      }
  }
}

}  // namespace
}  // namespace forming_sim
