#pragma once
// A meshed body: nodes, cells split into simplices, its surface and its sets.
#include <array>
#include <map>
#include <string>
#include <vector>

#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// How a cell is split into simplices; the cell carries one pressure.
/// Node orders (all counter-clockwise, positive volume):
///  triangle       3 corners
///  quad2          4 corners; triangles 0 1 2, 0 2 3
///  crossed        4 corners, centre; triangles 0 1 4, 1 2 4, 2 3 4, 3 0 4
///  tetrahedron    4 corners
///  hex6           8 corners (0-3 bottom, 4-7 above them); 6 tetrahedra about the diagonal 0-6
///  quad1          4 corners; one element (element/one_point.h)
///  hex1           8 corners, likewise
///  hex24          8 corners, 6 face centres (bottom, top, front 0 1 5 4, right 1 2 6 5, back 2 3 7 6, left 3 0 4 7), cell centre
///  wedge14        6 corners (0-2 bottom, 3-5 above them), centres of the faces 0 1 4 3, 1 2 5 4, 2 0 3 5, cell centre
///  pyramid8       4 corners of the base, counter-clockwise seen from the fifth, centre of the base, cell centre
enum class CellKind { triangle, quad2, crossed, tetrahedron, hex6, hex24, quad1, hex1, wedge14, pyramid8 };
constexpr int kCellKinds = 10;

struct CellShape {
  const char* name;
  int dimension, nodes, simplices;
  const int (*simplex)[4];  ///< node of the cell per corner of each simplex (3 used in 2D)
  int points;               ///< at which the law is asked: one a simplex; or 1, whose values all simplices share
  int checked;              ///< simplices that need a positive volume: those of the cell; of one point, those at its corners
  const int (*check)[4];
};
/// The table of the shapes above. The simplices of a one-point cell (the triangles of quad2, the
/// tetrahedra of hex6) are for its surface, for pictures and files.
const CellShape& shape_of(CellKind kind);
inline bool is_one_point(CellKind kind) { return kind == CellKind::quad1 || kind == CellKind::hex1; }

/// Cells of one kind, `nodes` holding shape_of(kind).nodes indices per cell.
struct Cells {
  CellKind kind;
  std::vector<int> nodes;
  int count() const { return static_cast<int>(nodes.size()) / shape_of(kind).nodes; }
};

/// Boundary facet: segment (2 nodes) or triangle (3), ordered so that its normal
/// points out of the body; `element` is the simplex it belongs to (numbered
/// through all cells in order), -1 for a rigid tool. Unused node: -1.
struct Facet {
  std::array<int, 3> nodes{-1, -1, -1};
  int element = -1;
};

struct Mesh {
  int dimension = 3;
  std::vector<Vec3> nodes;                      ///< m; z = 0 in dimension 2
  std::vector<Cells> cells;                     ///< empty for a rigid tool
  std::vector<Facet> surface;
  std::map<std::string, std::vector<int>> sets; ///< sorted node indices

  int simplex_count() const;
  /// Simplices in order: dimension + 1 node indices each.
  std::vector<std::array<int, 4>> simplices() const;
};

/// Fills `surface` with the facets that belong to one simplex only; a face of hex1 becomes two
/// triangles, also where that of its neighbour is divided the other way.
/// Throws Error(mesh_error) naming a facet shared by more than two.
void find_surface(Mesh& mesh);

/// Throws Error(mesh_error) naming the first cell with a simplex of volume <= 0
/// (its nodes, its volume), a node that is not finite, or a node in no cell.
void check_volumes(const Mesh& mesh);

}  // namespace forming_sim
