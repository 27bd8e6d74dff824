#pragma once
// Quadrilaterals, hexahedra, wedges and pyramids into cells of simplices: adds the nodes in the
// middle of cells and faces.
#include <array>
#include <map>
#include <vector>

#include "forming_sim/mesh/mesh.h"

namespace forming_sim {

using Quad = std::array<int, 4>;  ///< corners, counter-clockwise
using Hex = std::array<int, 8>;   ///< 0-3 bottom, 4-7 above them
using Wedge = std::array<int, 6>; ///< 0-2 bottom, 3-5 above them
using Pyramid = std::array<int, 5>; ///< 0-3 base, 4 above it

/// The nodes of a face of a solid cell. nodes: of the cell; face: which of them, as the tables of cell_tables.h tell.
template <class Nodes> std::array<int, 4> face_of(const Nodes& nodes, const int (&face)[4]) {
  return {nodes[face[0]], nodes[face[1]], nodes[face[2]], nodes[face[3]]};
}

/// The centre node that splitting put on a face or into a cell, by its corners.
class Centres {
 public:
  void add(const int* corners, int count, int centre);
  /// -1 where there is none.
  int find(const int* corners, int count) const;
  /// Adds to a set the centres of the faces whose four corners are all in it.
  void extend_by_faces(std::vector<int>& set, const std::vector<Hex>& hexes) const;

 private:
  std::map<std::array<int, 8>, int> nodes_;  // corners in rising order, after -1 for the unused
};

/// Appends cells of the kind (crossed, quad2 or quad1; hex24, hex6 or hex1) to the mesh and
/// its nodes. Centres lie at the mean of the corners; hexahedra share those of
/// their common faces.
Centres split_quads(Mesh& mesh, const std::vector<Quad>& quads, CellKind kind);
Centres split_hexes(Mesh& mesh, const std::vector<Hex>& hexes, CellKind kind);
/// Append cells of the kinds wedge14 and pyramid8. centres: of the faces that other cells have already, which they share with these; theirs are added.
void split_wedges(Mesh& mesh, const std::vector<Wedge>& wedges, Centres& centres);
void split_pyramids(Mesh& mesh, const std::vector<Pyramid>& pyramids, Centres& centres);

}  // namespace forming_sim
