#pragma once
// A deformable body as the elements see it.
#include <optional>
#include <string>
#include <vector>

#include "forming_sim/element/formed.h"
#include "forming_sim/material/config.h"
#include "forming_sim/mesh/mesh.h"

namespace forming_sim {

/// A body's share of the joined mesh.
struct BodyModel {
  std::string name;
  int first_node = 0, node_count = 0;
  int first_element = 0, element_count = 0;  ///< simplices
  MaterialConfig material;
  std::string pressure_average = "cell";     ///< cell | node | element
  bool self_contact = false;                 ///< it meets itself where it folds
  Mesh mesh;                     ///< its own mesh where it stands at the start, nodes numbered from 0; sets hold the named sets of the scene too
  std::optional<FormedMemory> formed;        ///< of a part that an earlier run has formed
  // Found by the simulation, which knows the boundaries
  std::vector<char> cut;         ///< cut_facets() of the mesh, by the planes of symmetry that its boundaries make
  double thickness = 0;          ///< thickness_of() it at the start, m

  /// Where its nodes were while it was free of stress, m.
  const std::vector<Vec3>& reference() const { return formed ? formed->reference : mesh.nodes; }
};

}  // namespace forming_sim
