#pragma once
// The section of a tool in dimension 2.
#include <limits>

#include "forming_sim/mesh/config.h"
#include "forming_sim/mesh/mesh.h"

namespace forming_sim {

/// Lines and arcs as segments: a 2D Mesh with `surface` of two nodes each
/// (element -1), in the order of the way, nodes shared. The material of the tool
/// lies to the left of the way, so that normals (to the right) point out of it.
/// Arcs are divided evenly so that no segment departs from its arc by more than
/// the chord error; their nodes lie on the arc. Where that is not given it is 1e-3 of the radius, and
/// no segment is longer than `longest`, m: what meets a tool of large radius would feel its corners.
/// Throws Error(mesh_error) naming the piece: a radius of less than half the
/// chord, a piece of no length, a number that is not finite, no pieces.
Mesh mesh_profile(const ProfileConfig& profile, double longest = std::numeric_limits<double>::infinity());

}  // namespace forming_sim
