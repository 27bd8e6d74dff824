#pragma once
// A body's mesh as its source says it, before it is split and checked.
#include <map>
#include <string>
#include <vector>

#include "forming_sim/mesh/mesh.h"

namespace forming_sim {

/// What a source may hold; corners in the order of mesh.h. As wide as a tag, so that a RawCell has no padding.
enum class RawKind : long long { point, line, triangle, quadrilateral, tetrahedron, hexahedron, wedge, pyramid };
struct RawShape {
  const char* name;
  int dimension, corners;
};
const RawShape& shape_of(RawKind kind);

struct RawCell {
  RawKind kind;
  long long tag;     ///< number by which its author knows it
  int nodes[8] = {}; ///< indices into RawMesh::points
};

struct RawMesh {
  std::string source;                  ///< as messages name it
  std::string note;                    ///< what of it is taken otherwise than its author may expect; empty: nothing
  std::string group;                   ///< the one that is wanted; empty: all
  std::string volumes;                 ///< names of the source's groups of volumes, where a group is wanted
  std::string wrong_group;             ///< why the group that is wanted is no body; empty: it is, and the rest holds
  int dimension = 3;
  bool one_point = false;              ///< quadrilaterals and hexahedra stay whole, with one point each
  std::vector<Vec3> points;            ///< metres
  std::vector<long long> point_tags;   ///< as their author knows them
  std::vector<RawCell> cells;          ///< of the body, of the one dimension
  std::map<std::string, std::vector<RawCell>> groups;  ///< cells of any dimension
};

/// Splits the cells, lays the groups out as sets, finds the surface and checks
/// everything; turns a mirrored mesh round, which `note` then says. Throws Error(mesh_error), SceneError where its group is to blame.
Mesh assemble(RawMesh& raw);

}  // namespace forming_sim
