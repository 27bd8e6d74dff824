#pragma once
// Thickness of a sheet: distance of the nodes of set `top` from the surface
// whose facets have all their nodes in set `bottom`.
#include <array>
#include <optional>
#include <vector>

#include "forming_sim/mesh/mesh.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// Distance from a point to a segment (c = b) or a triangle, m.
double distance_to_facet(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c);

class Thickness {
 public:
  /// first_node: number of the mesh's node 0 in the joined numbering.
  /// nullopt where the mesh has no sets top and bottom, or no facet in bottom.
  static std::optional<Thickness> of(const Mesh& mesh, int first_node);
  /// Smallest over the nodes of `top`, m; positions in the joined numbering.
  double smallest(const NodeField& positions) const;

 private:
  std::vector<int> top_;
  std::vector<std::array<int, 3>> bottom_;  ///< a segment repeats its second node
};

}  // namespace forming_sim
