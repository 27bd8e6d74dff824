#pragma once
// How a facet of a surface is stretched.
#include <array>

#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// Principal logarithmic strains in the surface, of one of its facets. Plane strain: the one along the section and 0;
/// axisymmetric: those along the section and around the circle.
struct SurfaceStrain {
  double major = 0, minor = 0;
};

/// Of a facet with the corners X at the start and x now, m; two of them in a section.
SurfaceStrain strain_of_segment(const std::array<Vec3, 3>& X, const std::array<Vec3, 3>& x, bool axisymmetric);
SurfaceStrain strain_of_triangle(const std::array<Vec3, 3>& X, const std::array<Vec3, 3>& x);

}  // namespace forming_sim
