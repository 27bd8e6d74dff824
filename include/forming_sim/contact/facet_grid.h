#pragma once
// Facets of a surface where they are just now, and which of them is nearest to a point.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "forming_sim/contact/closest.h"
#include "forming_sim/contact/grid.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

class FacetGrid {
 public:
  /// corners: of a facet, 2 or 3; facets: nodes, a segment repeats its second one; one at least. Both lists must outlive it.
  FacetGrid(int corners, const std::vector<std::array<int, 3>>& facets, const NodeField& positions);
  Closest closest(const Node& p, int facet) const;
  /// Calls found(facet) for those whose boxes overlap this one, once each. Not from two threads at once.
  template <class Found> void query(const Box& box, Found&& found) const { grid_.query(box, found); }
  /// The least of what `count` makes of facets and their distances, m. near: a facet that may be near p.
  template <class Count> double nearest(const Node& p, int near, Count&& count) const {
    return grid_.nearest(p, std::sqrt(closest(p, near).squared), [&](int facet) { return count(facet, std::sqrt(closest(p, facet).squared)); });
  }

 private:
  int corners_;
  const std::vector<std::array<int, 3>>& facets_;
  const NodeField& positions_;
  Grid grid_;
};

}  // namespace forming_sim
