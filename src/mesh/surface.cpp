// The surface of a body: the facets that belong to one simplex only. The two triangles of a face of
// a hexahedron that stays whole go by the corners of the face, since its neighbour may be
// divided along the other diagonal.
#include <algorithm>
#include <sstream>

#include "forming_sim/config/fault.h"
#include "forming_sim/mesh/cell_tables.h"
#include "forming_sim/mesh/measure.h"
#include "forming_sim/mesh/mesh.h"

namespace forming_sim {
namespace {

// Facet opposite corner i, its normal pointing away from that corner when the
// simplex has a positive volume.
constexpr int kOpposite2[3][3] = {{1, 2, -1}, {2, 0, -1}, {0, 1, -1}};
constexpr int kOpposite3[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

struct Candidate {
  std::array<int, 4> key;  // nodes in rising order; three: after -1
  int order;               // simplex and corner, so that the surface keeps the order of the elements
  Facet facet;
};

[[noreturn]] void refuse_shared(const Mesh& mesh, const Candidate& c, int times) {
  std::ostringstream text;
  text << "mesh: the facet with the corners";
  for (int k = 0; k < mesh.dimension; ++k) text << (k == 0 ? " " : ", ") << place(mesh.nodes[c.facet.nodes[k]]);
  text << " belongs to " << times
       << " elements; a facet lies between two elements or on the surface, so remove repeated or overlapping cells";
  throw Error(Code::mesh_error, text.str());
}

/// The face of a hexahedron that three of its corners lie on, -1: none.
int face_with(const int* corners) {
  for (int f = 0; f < 6; ++f)
    if (std::all_of(corners, corners + 3, [&](int c) { return std::count(kHexFaces[f], kHexFaces[f] + 4, c) > 0; })) return f;
  return -1;
}

std::vector<Candidate> candidates_of(const Mesh& mesh) {
  const int d = mesh.dimension;
  std::vector<Candidate> all;
  all.reserve(static_cast<std::size_t>(mesh.simplex_count()) * (d + 1));
  int element = 0;
  for (const Cells& block : mesh.cells) {
    const CellShape& shape = shape_of(block.kind);
    for (int cell = 0; cell < block.count(); ++cell) {
      const int* nodes = &block.nodes[static_cast<std::size_t>(cell) * shape.nodes];
      for (int s = 0; s < shape.simplices; ++s, ++element)
        for (int corner = 0; corner <= d; ++corner) {
          Candidate c;
          int local[3];
          for (int k = 0; k < d; ++k) {
            local[k] = shape.simplex[s][d == 2 ? kOpposite2[corner][k] : kOpposite3[corner][k]];
            c.facet.nodes[k] = nodes[local[k]];
          }
          c.key = {-1, c.facet.nodes[0], c.facet.nodes[1], c.facet.nodes[2]};
          if (block.kind == CellKind::hex1) {
            const int face = face_with(local);
            if (face < 0) continue;  // inside the cell
            for (int k = 0; k < 4; ++k) c.key[k] = nodes[kHexFaces[face][k]];
          }
          std::sort(c.key.begin(), c.key.end());
          c.facet.element = element;
          c.order = static_cast<int>(all.size());
          all.push_back(c);
        }
    }
  }
  return all;
}

// The facet runs the other way round in the element on its other side, or the
// two lie on the same side of it.
bool same_side(const Mesh& mesh, const Candidate* one, const Candidate* other) {
  const Facet &a = one->facet, &b = other->facet;
  const int d = mesh.dimension;
  // Of four corners: of the whole face, since the halves of a warped one are turned against each other.
  if (one->key[0] >= 0) return (area_vector(mesh, a) + area_vector(mesh, one[1].facet)).dot(area_vector(mesh, b) + area_vector(mesh, other[1].facet)) > 0;
  for (int turn = 0; turn < (d == 2 ? 1 : 3); ++turn) {
    bool same = true;
    for (int k = 0; k < d; ++k) same = same && a.nodes[k] == b.nodes[(k + turn) % d];
    if (same) return true;
  }
  return false;
}

[[noreturn]] void refuse_folded(const Mesh& mesh, const Facet& a) {
  std::ostringstream text;
  text << "mesh: two elements near " << place(mesh.nodes[a.nodes[0]])
       << " lie on the same side of the facet they share; the mesh is folded there, or one of them has a negative volume";
  throw Error(Code::mesh_error, text.str());
}

}  // namespace

void find_surface(Mesh& mesh) {
  std::vector<Candidate> all = candidates_of(mesh);
  std::sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
    return a.key != b.key ? a.key < b.key : a.order < b.order;
  });

  std::vector<Candidate> once;
  for (std::size_t i = 0; i < all.size();) {
    std::size_t end = i + 1;
    while (end < all.size() && all[end].key == all[i].key) ++end;
    const std::size_t of_a_side = all[i].key[0] >= 0 ? 2 : 1, sides = (end - i) / of_a_side;
    if (sides > 2) refuse_shared(mesh, all[i], static_cast<int>(sides));
    if (sides == 1) once.insert(once.end(), all.begin() + i, all.begin() + end);
    else if (same_side(mesh, &all[i], &all[end - of_a_side])) refuse_folded(mesh, all[i].facet);
    i = end;
  }
  std::sort(once.begin(), once.end(), [](const Candidate& a, const Candidate& b) { return a.order < b.order; });
  mesh.surface.clear();
  mesh.surface.reserve(once.size());
  for (const Candidate& c : once) mesh.surface.push_back(c.facet);
}

}  // namespace forming_sim
