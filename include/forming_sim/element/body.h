#pragma once
// A deformable body as the elements see it.
#include <string>

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
  Mesh mesh;                     ///< its own mesh, nodes numbered from 0; sets hold the named sets of the scene too
  // Found by the simulation, which knows the boundaries
  std::vector<char> cut;         ///< cut_facets() of the mesh, by the planes of symmetry that its boundaries make
  double thickness = 0;          ///< thickness_of() it at the start, m
};

}  // namespace forming_sim
