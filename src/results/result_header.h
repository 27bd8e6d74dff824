#pragma once
// The part of result.h5 that is written once.
#include "forming_sim/results/frame.h"
#include "forming_sim/files/hdf5_file.h"

namespace forming_sim {

/// frames: how many there will be, as far as is known.
void write_header(Hdf5Group root, const ResultHeader& header, std::size_t frames);
/// Facet or segment indices, `columns` of the array's entries each.
template <std::size_t N>
std::vector<std::int32_t> flatten(const std::vector<std::array<int, N>>& rows, int columns) {
  std::vector<std::int32_t> flat;
  flat.reserve(rows.size() * columns);
  for (const auto& row : rows) flat.insert(flat.end(), row.begin(), row.begin() + columns);
  return flat;
}
inline std::vector<double> coordinates(const NodeField& nodes) {
  std::vector<double> flat;
  flat.reserve(3 * nodes.size());
  for (const Node& node : nodes) flat.insert(flat.end(), node.data(), node.data() + 3);
  return flat;
}

}  // namespace forming_sim
