#pragma once
// Nodes chosen by where they are: a plane, a box, a cylinder, a sphere.
#include <vector>

#include "forming_sim/mesh/config.h"
#include "forming_sim/mesh/mesh.h"

namespace forming_sim {

/// Sorted nodes of the mesh on the plane, cylinder or sphere or in the box, to within the tolerance
/// (1e-6 of the body's size unless given); may be empty. `surface_only` uses
/// mesh.surface. Throws Error(mesh_error) for a normal of no length, a box whose
/// least corner is beyond its greatest, or an unknown way to choose.
std::vector<int> choose_nodes(const Mesh& mesh, const SetConfig& set);

}  // namespace forming_sim
