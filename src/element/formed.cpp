#include "forming_sim/element/formed.h"

namespace forming_sim {

namespace {

/// The entries of those, `size` numbers each.
std::vector<double> picked(const std::vector<double>& values, const std::vector<int>& which, int size) {
  std::vector<double> kept;
  if (values.empty()) return kept;
  for (int i : which) kept.insert(kept.end(), values.begin() + static_cast<std::ptrdiff_t>(i) * size, values.begin() + static_cast<std::ptrdiff_t>(i + 1) * size);
  return kept;
}

}  // namespace

FormedMemory remaining(const FormedMemory& memory, const Remainder& left) {
  FormedMemory rest;
  for (std::size_t n = 0; n < memory.reference.size(); ++n)
    if (left.node[n] >= 0) rest.reference.push_back(memory.reference[n]);
  for (std::size_t b = 0; b < memory.cells.size(); ++b) {
    const FormedCells& of = memory.cells[b];
    FormedCells cells{of.points, of.items, of.hourglass_items, {}, {}, {}, {}};
    cells.memory = picked(of.memory, left.cells[b], of.points * of.items);
    cells.hourglass = picked(of.hourglass, left.cells[b], of.hourglass_items);
    cells.ratio = picked(of.ratio, left.cells[b], 1);
    cells.damage = picked(of.damage, left.cells[b], of.points);
    rest.cells.push_back(std::move(cells));
  }
  rest.edges.items = memory.edges.items;
  std::vector<int> stay;
  for (std::size_t e = 0; e < memory.edges.ends.size(); ++e) {
    const auto [a, b] = memory.edges.ends[e];
    if (left.node[a] < 0 || left.node[b] < 0) continue;  // an edge of no cell that is left may stay: nobody asks for it
    stay.push_back(static_cast<int>(e));
    rest.edges.ends.push_back({left.node[a], left.node[b]});
    rest.edges.edges.push_back(memory.edges.edges[e]);
    rest.edges.volume_ratio.push_back(memory.edges.volume_ratio[e]);
  }
  rest.edges.memory = picked(memory.edges.memory, stay, memory.edges.items);
  for (std::size_t n = 0; n < memory.nodal_ratio.size(); ++n)
    if (left.node[n] >= 0) rest.nodal_ratio.push_back(memory.nodal_ratio[n]);
  return rest;
}

void turn(FormedMemory& memory, const std::string& law, int dimension, const Mat3& rotation) {
  for (Eigen::Matrix3d& edges : memory.edges.edges) edges = rotation * edges;
  if (law != "classical") return;
  for (FormedCells& cells : memory.cells)
    for (std::size_t at = 0; at < cells.memory.size(); at += cells.items) {
      double* S = &cells.memory[at];  // xx yy zz xy (yz zx)
      const double yz = dimension == 3 ? S[4] : 0, zx = dimension == 3 ? S[5] : 0;
      Mat3 stress;
      stress << S[0], S[3], zx, S[3], S[1], yz, zx, yz, S[2];
      stress = rotation * stress * rotation.transpose();
      for (int i = 0; i < 3; ++i) S[i] = stress(i, i);
      S[3] = stress(0, 1);
      if (dimension == 3) S[4] = stress(1, 2), S[5] = stress(2, 0);
    }
}

}  // namespace forming_sim
