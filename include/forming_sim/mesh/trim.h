#pragma once
// Cells cut away: those whose middle lies in a region. What is cut is whole cells, so that the edge follows the mesh.
#include <vector>

#include "forming_sim/mesh/config.h"
#include "forming_sim/mesh/mesh.h"

namespace forming_sim {

/// What a cut leaves of a mesh, in its numbering.
struct Remainder {
  std::vector<std::vector<int>> cells;  ///< [block of Mesh::cells] its cells that stay, increasing
  std::vector<int> node;                ///< [node] its new number, -1: it is gone
};

/// What lies in none of the regions, by the means of the cells' nodes. Throws SceneError, field trim[i], for a region without
/// a direction or with exchanged corners and for one in which no cell lies, Error(mesh_error) where nothing is left.
Remainder find_remainder(const Mesh& mesh, const std::vector<TrimConfig>& regions);

/// The mesh of it: its nodes in their order, sets without what is gone (empty ones left out), its surface.
Mesh remaining(const Mesh& mesh, const Remainder& left);

}  // namespace forming_sim
