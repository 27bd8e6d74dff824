#pragma once
// Cook's membrane, as both programs are given it.
#include <string>

#include "support/bodies.h"

namespace forming_sim::bench {

constexpr double kCookTraction = 0.3125e9;  ///< Pa, upwards on the right edge, a dead load
constexpr double kCookRise = 6.95;          ///< mm, of the upper right corner, +- .1

/// sigma = 450 + 129.24 p + 265 (1 - exp(-16.93 p)) MPa.
MaterialConfig cook_material();
/// Corners (0,0) (48,44) (48,60) (0,44) mm, cells x cells.
Mesh membrane(int cells, const std::string& pattern);
/// Its node at (48,60) mm.
int upper_right(const Mesh& mesh);

}  // namespace forming_sim::bench
