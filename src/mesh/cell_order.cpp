#include "forming_sim/mesh/cell_order.h"

#include <algorithm>
#include <numeric>

namespace forming_sim {
namespace {

/// Nodes of all pieces.
long nodes_of_pieces(const std::vector<int>& nodes, int nodes_of_cell, const std::vector<int>& order, int piece, std::size_t points) {
  std::vector<int> seen(points, -1);
  long count = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const int now = static_cast<int>(i) / piece;
    for (int a = 0; a < nodes_of_cell; ++a) {
      int& last = seen[nodes[static_cast<std::size_t>(order[i]) * nodes_of_cell + a]];
      if (last == now) continue;
      last = now;
      ++count;
    }
  }
  return count;
}

/// Puts [first, last) in order: halves of whole pieces, then of eights.
void halve(const std::vector<Vec3>& centre, int* first, int* last, int piece) {
  constexpr int eight = 8;  // cells of a block
  const long count = last - first, unit = count > piece ? piece : eight;
  if (count <= eight) return;
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
  halve(centre, first, middle, piece);
  halve(centre, middle, last, piece);
}

}  // namespace

std::vector<int> order_of_cells(const std::vector<Vec3>& points, const std::vector<int>& nodes, int nodes_of_cell, int piece, double worth) {
  std::vector<int> given(nodes.size() / nodes_of_cell);
  std::iota(given.begin(), given.end(), 0);
  const auto count = [&](const std::vector<int>& order, int of_piece) { return static_cast<double>(nodes_of_pieces(nodes, nodes_of_cell, order, of_piece, points.size())); };
  const double enough = worth * count(given, piece);
  if (count(given, std::max<int>(1, given.size())) > enough) return given;  // every node is once in some piece at least
  std::vector<Vec3> centre(given.size(), Vec3::Zero());
  for (std::size_t i = 0; i < nodes.size(); ++i) centre[i / nodes_of_cell] += points[nodes[i]] / nodes_of_cell;
  std::vector<int> by_halves = given;
  halve(centre, by_halves.data(), by_halves.data() + by_halves.size(), piece);
  return count(by_halves, piece) <= enough ? by_halves : given;
}

}  // namespace forming_sim
