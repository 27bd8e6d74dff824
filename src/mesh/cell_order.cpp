#include "forming_sim/mesh/cell_order.h"

#include <algorithm>
#include <numeric>

namespace forming_sim {
namespace {

/// Nodes of all pieces.
long nodes_of_pieces(const std::vector<int>& nodes, int nodes_of_cell, const std::vector<int>& order, const std::vector<int>& ends, std::size_t points) {
  std::vector<int> seen(points, -1);
  long count = 0;
  int now = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (static_cast<int>(i) == ends[now]) ++now;
    for (int a = 0; a < nodes_of_cell; ++a) {
      int& last = seen[nodes[static_cast<std::size_t>(order[i]) * nodes_of_cell + a]];
      if (last == now) continue;
      last = now;
      ++count;
    }
  }
  return count;
}

/// Puts [first, last) in order: halves of whole pieces, those that end at [end, behind) behind `start`, then of eights.
void halve(const std::vector<Vec3>& centre, int* start, int* first, int* last, const int* end, const int* behind) {
  constexpr int eight = 8;  // cells of a block
  const long count = last - first, pieces = behind - end;
  if (count <= eight) return;
  Vec3 low = centre[*first], high = low;
  for (const int* cell = first; cell < last; ++cell) {
    low = low.cwiseMin(centre[*cell]);
    high = high.cwiseMax(centre[*cell]);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const int* const half = end + pieces / 2;  // end of the piece behind the middle
  int* const middle = pieces > 1 ? start + half[-1] : first + (count / eight + 1) / 2 * eight;
  if (middle >= last) return;
  std::nth_element(first, middle, last, [&](int a, int b) { return centre[a][axis] != centre[b][axis] ? centre[a][axis] < centre[b][axis] : a < b; });
  halve(centre, start, first, middle, end, std::max(half, end + 1));
  halve(centre, start, middle, last, half, behind);
}

}  // namespace

std::vector<int> order_of_cells(const std::vector<Vec3>& points, const std::vector<int>& nodes, int nodes_of_cell, const std::vector<int>& ends, double worth) {
  std::vector<int> given(nodes.size() / nodes_of_cell);
  std::iota(given.begin(), given.end(), 0);
  const auto count = [&](const std::vector<int>& order, const std::vector<int>& pieces) { return static_cast<double>(nodes_of_pieces(nodes, nodes_of_cell, order, pieces, points.size())); };
  const double enough = worth * count(given, ends);
  if (count(given, {static_cast<int>(given.size())}) > enough) return given;  // every node is once in some piece at least
  std::vector<Vec3> centre(given.size(), Vec3::Zero());
  for (std::size_t i = 0; i < nodes.size(); ++i) centre[i / nodes_of_cell] += points[nodes[i]] / nodes_of_cell;
  std::vector<int> by_halves = given;
  halve(centre, by_halves.data(), by_halves.data(), by_halves.data() + by_halves.size(), ends.data(), ends.data() + ends.size());
  return count(by_halves, ends) <= enough ? by_halves : given;
}

std::vector<int> ends_of_pieces(int cells, int piece) {
  std::vector<int> ends;
  for (int end = piece; end < cells; end += piece) ends.push_back(end);
  ends.push_back(cells);
  return ends;
}

}  // namespace forming_sim
