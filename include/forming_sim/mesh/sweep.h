#pragma once
// The section of a tool of dimension 3, swept into its surface.
#include "forming_sim/mesh/profile.h"

namespace forming_sim {

/// The section lies in y = 0, x to the right and z upwards as one looks along y: with the material to the left of the way, as in
/// dimension 2, facets look to the right of it. Arcs are divided as in mesh_profile().
///   turned    about the axis z. The circles are divided evenly, into a multiple of four parts, their nodes on the circle and
///             two of them in y = 0; the largest by the chord error or `longest`, as an arc is, and all into as many.
///   straight  along y, from -width/2 to width/2; the ends are open.
/// The ends of a way that is not closed are open too.
/// Throws Error(mesh_error) as mesh_profile() does, for points off y = 0, and for turned ones at x < 0.
Mesh sweep_profile(const ProfileConfig& profile, double longest = std::numeric_limits<double>::infinity());

}  // namespace forming_sim
