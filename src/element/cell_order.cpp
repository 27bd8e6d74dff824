#include "forming_sim/element/cell_order.h"

#include <algorithm>
#include <numeric>

#include "forming_sim/element/cell_group.h"

namespace forming_sim {
namespace {

/// Nodes of all tiles, those that tiles have in common once each tile.
long nodes_of_tiles(const Cells& cells, const std::vector<int>& order, int of_tile) {
  std::vector<int> seen(*std::max_element(cells.nodes.begin(), cells.nodes.end()) + 1, -1);
  const int nodes_of_cell = shape_of(cells.kind).nodes;
  long count = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const int tile = static_cast<int>(i) / of_tile;
    for (int a = 0; a < nodes_of_cell; ++a) {
      int& last = seen[cells.nodes[static_cast<std::size_t>(order[i]) * nodes_of_cell + a]];
      if (last == tile) continue;
      last = tile;
      ++count;
    }
  }
  return count;
}

/// Puts [first, last) in order: halves of whole tiles, then of whole blocks.
void halve(const std::vector<Vec3>& centre, int* first, int* last, int of_tile) {
  const long count = last - first, unit = count > of_tile ? of_tile : kLanes;
  if (count <= kLanes) return;
  Vec3 low = centre[*first], high = low;
  for (const int* cell = first; cell < last; ++cell) {
    low = low.cwiseMin(centre[*cell]);
    high = high.cwiseMax(centre[*cell]);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  int* const middle = first + (count / unit + 1) / 2 * unit;
  if (middle >= last) return;
  std::nth_element(first, middle, last, [&](int a, int b) { return centre[a][axis] != centre[b][axis] ? centre[a][axis] < centre[b][axis] : a < b; });
  halve(centre, first, middle, of_tile);
  halve(centre, middle, last, of_tile);
}

}  // namespace

std::vector<int> order_of_cells(const Cells& cells, int first_node, const NodeField& X, int of_tile) {
  const int nodes_of_cell = shape_of(cells.kind).nodes;
  std::vector<int> given(cells.count());
  std::iota(given.begin(), given.end(), 0);
  std::vector<Vec3> centre(given.size(), Vec3::Zero());
  for (std::size_t i = 0; i < cells.nodes.size(); ++i) centre[i / nodes_of_cell] += vec3(X[cells.nodes[i] + first_node]) / nodes_of_cell;
  std::vector<int> by_halves = given;
  halve(centre, by_halves.data(), by_halves.data() + by_halves.size(), of_tile);
  const auto nodes = [&](const std::vector<int>& order) { return nodes_of_tiles(cells, order, of_tile); };
  return 2 * nodes(by_halves) < nodes(given) ? by_halves : given;
}

}  // namespace forming_sim
