#pragma once
// Where the cells of one body lie against each other without being joined.
#include <array>
#include <vector>

#include "forming_sim/mesh/mesh.h"

namespace forming_sim {

/// A node of the surface that lies on a facet of the surface without being a corner of it: a doubled node,
/// or one that hangs on the side of a larger cell. The body is torn there: its surface runs through it.
struct Seam {
  int node = -1;
  Facet facet;
};

/// All nodes that lie within 1e-8 of its longest edge of a facet, one seam a node, in rising order of the nodes.
std::vector<Seam> find_seams(const Mesh& mesh);

/// Four nodes between which the cells on one side have two triangles along the diagonal 0-2, and those on the other two along 1-3:
/// they hang together at these corners alone. (A body in the shape of a flat tetrahedron that is cut into several cells counts as one.)
using CrossedCut = std::array<int, 4>;
std::vector<CrossedCut> find_crossed_cuts(const Mesh& mesh);

/// Parts of a mesh that share no node.
int count_parts(const Mesh& mesh);

}  // namespace forming_sim
