#include "forming_sim/contact/facet_grid.h"

#include <limits>

namespace forming_sim {

FacetGrid::FacetGrid(int corners, const std::vector<std::array<int, 3>>& facets, const NodeField& positions)
    : corners_(corners), facets_(facets), positions_(positions) {
  std::vector<Box> boxes;
  Box all;
  double size = 0;
  for (const auto& facet : facets) {
    boxes.push_back(Box::of(positions[facet[0]], positions[facet[1]], positions[facet[2]]));
    all.add(boxes.back());
    size += (boxes.back().high - boxes.back().low).norm() / facets.size();
  }
  grid_ = Grid(std::move(boxes), all, std::max(size, std::numeric_limits<double>::min()));
}

Closest FacetGrid::closest(const Node& p, int facet) const {
  const auto& c = facets_[facet];
  return closest_on_facet(corners_, p, positions_[c[0]], positions_[c[1]], positions_[c[2]]);
}

}  // namespace forming_sim
