#include "forming_sim/mesh/faces.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "forming_sim/mesh/axis.h"
#include "forming_sim/mesh/cell_tables.h"

namespace forming_sim {
namespace {

/// The face of a hexahedron that a facet lies in. cell: its nodes.
int face_of_hexahedron(const int* cell, const Facet& facet) {
  for (int f = 0; f < 6; ++f)
    if (std::all_of(facet.nodes.begin(), facet.nodes.end(), [&](int n) { return std::any_of(kHexFaces[f], kHexFaces[f] + 4, [&](int c) { return cell[c] == n; }); })) return f;
  return -1;
}

}  // namespace

std::vector<Face> faces_of(const Mesh& mesh) {
  std::vector<std::vector<unsigned>> seen;  // [block][cell] of hexahedra that stay whole: a bit a face
  for (const Cells& block : mesh.cells) seen.emplace_back(block.kind == CellKind::hex1 ? block.count() : 0, 0u);
  std::vector<Face> faces;
  for (const Facet& facet : mesh.surface) {
    int element = facet.element;
    std::size_t b = 0;
    while (b < mesh.cells.size() && element >= mesh.cells[b].count() * shape_of(mesh.cells[b].kind).simplices)
      element -= mesh.cells[b].count() * shape_of(mesh.cells[b].kind).simplices, ++b;
    Face face;
    if (b < mesh.cells.size() && mesh.cells[b].kind == CellKind::hex1) {
      const CellShape& shape = shape_of(CellKind::hex1);
      const int cell = element / shape.simplices, *nodes = &mesh.cells[b].nodes[static_cast<std::size_t>(cell) * shape.nodes];
      const int of_cell = face_of_hexahedron(nodes, facet);
      const unsigned bit = 1u << of_cell;
      if (seen[b][cell] & bit) continue;
      seen[b][cell] |= bit;
      face.corners = 4;
      for (int k = 0; k < 4; ++k) face.nodes[k] = nodes[kHexFaces[of_cell][k]];
    } else {
      face.corners = mesh.dimension;
      std::copy_n(facet.nodes.begin(), mesh.dimension, face.nodes.begin());
    }
    faces.push_back(face);
  }
  return faces;
}

std::vector<Face> faces_within(const Mesh& mesh, const std::vector<int>& set) {
  std::vector<Face> faces = faces_of(mesh);
  const auto leaves = [&](const Face& face) { return !std::all_of(face.begin(), face.end(), [&](int n) { return std::binary_search(set.begin(), set.end(), n); }); };
  faces.erase(std::remove_if(faces.begin(), faces.end(), leaves), faces.end());
  return faces;
}

Vec3 area_share(const Face& face, int k, const NodeField& x, bool axisymmetric) {
  const auto at = [&](int corner) { return vec3(x[face.nodes[corner % face.corners]]); };
  if (face.corners == 2) {
    const Vec3 ab = at(1) - at(0);
    const double part = axisymmetric ? turned_share(x[face.nodes[k]][0], x[face.nodes[1 - k]][0]) : 0.5;
    return part * Vec3(ab.y(), -ab.x(), 0);
  }
  const auto triangle = [&](int a, int b, int c) -> Vec3 { return 0.5 * (at(b) - at(a)).cross(at(c) - at(a)); };
  if (face.corners == 3) return 1.0 / 3 * triangle(0, 1, 2);
  // of a, b, c, d from a = k on: both that the diagonal a c divides it into, and a b d beside the diagonal b d
  return 1.0 / 6 * (triangle(k, k + 1, k + 2) + triangle(k, k + 2, k + 3) + triangle(k, k + 1, k + 3));
}

}  // namespace forming_sim
