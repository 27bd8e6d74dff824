#pragma once
// Volumes, areas and extents of a mesh.
#include <array>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "forming_sim/mesh/mesh.h"

namespace forming_sim {

/// Volume of a simplex, m3; in 2D its area, m2. Positive in the orders of mesh.h.
double signed_volume(const std::vector<Vec3>& nodes, const std::array<int, 4>& simplex, int dimension);

/// Sum over all simplices, m3 (m2 in 2D).
double volume(const Mesh& mesh);

/// Normal of a facet times its area, m2; of a segment: its normal to the right
/// of the way from its first to its second node, times its length, m.
Vec3 area_vector(const Mesh& mesh, const Facet& facet);

/// Smallest axis-parallel box about all nodes; empty for a mesh without nodes.
Eigen::AlignedBox3d bounds(const Mesh& mesh);

/// Length of the diagonal of `bounds`, m; 0 for a mesh without nodes.
double size_of(const Mesh& mesh);

/// How flat the hexahedra and wedges are that are split into tetrahedra: the middle one of the lengths of a cell (the means of its parallel
/// edges; of a wedge's triangles the mean edge twice) over the shortest, in the mean over these cells; 1 of cubes and of long bars, 0 where there are none.
double flatness(const Mesh& mesh);
/// Mean length of the edges of the tetrahedra that no hexahedron was split into, m; 0 where there are none.
double edge_of_tetrahedra(const Mesh& mesh);
/// A plane of symmetry in which the nodes of a set lie, or along which they move; the normal of any length.
struct SymmetryPlane {
  std::string set;
  Vec3 normal;
};
/// Of every facet of the surface, 1: it lies in one of the planes, where the body goes on: its normal is within 8 degrees of the plane's, and all its nodes are in the set,
/// as those of all facets that lie in one plane with it are (a patch that holds a part of a face is a support). Sets that the mesh does not have cut nothing.
std::vector<char> cut_facets(const Mesh& mesh, const std::vector<SymmetryPlane>& planes);
/// Twice the volume over the surface that is not cut (cut_facets): the thickness of a thin sheet, m, also where the mesh is a
/// half or a slice of it. Axisymmetric: both turned, by the radii of their middles. cut: one a facet of mesh.surface; where all of it is, over all of it.
double thickness_of(const Mesh& mesh, bool axisymmetric, const std::vector<char>& cut);

/// Whether it is a sheet of this thickness: 8 times as long and, in space, 3 times as wide as thick (of a bar the middle one of its sizes is 2 times).
bool is_sheet(const Mesh& mesh, double thickness);

/// The node whose initial place is nearest to a point.
int nearest_node(const Mesh& mesh, const Vec3& point);

/// "(x, y, z) m", as messages name a place.
std::string place(const Vec3& x);

}  // namespace forming_sim
