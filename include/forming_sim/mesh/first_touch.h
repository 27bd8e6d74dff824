#pragma once
// How far a surface may go along a line until it touches another.
#include <array>
#include <optional>
#include <vector>

#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// Triangles in space, segments in dimension 2 (third index -1), or a plane, which has no facets.
struct PlacedSurface {
  int dimension = 3;
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> facets;
  Vec3 plane_point = Vec3::Zero(), plane_normal = Vec3::Zero();  ///< outward
};

/// Where `mover` comes to touch `standing` if it comes from far away along the unit vector `along`: the way from where it is now, m, below 0 where it
/// is past that. Exact for facets: over what both cover, seen along the way, the distance between two of them is least where a corner of one meets the other or two edges cross.
/// None: it goes by. What would only graze, flush with it to a billionth, counts as met. Two planes never meet: they have no corners.
std::optional<double> way_to_touch(const PlacedSurface& mover, const PlacedSurface& standing, const Vec3& along);

}  // namespace forming_sim
