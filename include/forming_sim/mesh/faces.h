#pragma once
// The faces of a body's surface and the areas that their corners stand for. A facet of a simplex is one; the two triangles that a face
// of a hexahedron that stays whole is divided into in Mesh::surface make one together, since which diagonal divides it means nothing:
// its corners get what both ways to divide it give them in the mean, which is the integral of their shape functions over the bilinear face.
#include <array>
#include <vector>

#include "forming_sim/mesh/mesh.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// A segment, a triangle or a quadrilateral, its corners in the order of a Facet's.
struct Face {
  std::array<int, 4> nodes{-1, -1, -1, -1};
  int corners = 0;

  const int* begin() const { return nodes.data(); }
  const int* end() const { return nodes.data() + corners; }
};

/// Those of the surface, in its order.
std::vector<Face> faces_of(const Mesh& mesh);

/// Of these, the ones all of whose nodes are in the set, which increases.
std::vector<Face> faces_within(const Mesh& mesh, const std::vector<int>& set);

/// What corner k has of the area vector A n of a face at x, m2; of a segment a b, (y_b - y_a, x_a - x_b)/2, m, and where it is turned
/// about the y axis the integral of its shape function over the cone, 2 pi (2 r_a + r_b)/6 (y_b - y_a, x_a - x_b).
Vec3 area_share(const Face& face, int k, const NodeField& x, bool axisymmetric);

}  // namespace forming_sim
