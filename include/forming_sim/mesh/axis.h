#pragma once
// The axis of an axisymmetric section: the y axis, about which it is turned. x is the radius.
#include <vector>

#include "forming_sim/mesh/mesh.h"

namespace forming_sim {

/// Makes a section ready to be turned: nodes within 1e-9 of its size of the axis are put
/// onto it, and the facets that lie on it are taken out of the surface, since they are
/// inside the turned body. Throws Error(mesh_error) naming a node with x < 0.
void close_at_axis(Mesh& mesh);

/// Nodes with x = 0, rising.
std::vector<int> axis_nodes(const Mesh& mesh);

/// Area that an end of a segment stands for when it is turned, over the segment's
/// length: the integral of the end's shape function, 2 pi (2 r + r_other) / 6, m.
inline double turned_share(double r, double r_other) { return 3.14159265358979323846 / 3 * (2 * r + r_other); }

}  // namespace forming_sim
