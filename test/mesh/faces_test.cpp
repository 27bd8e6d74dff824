// Faces of bodies' surfaces and what their corners stand for.
#include "forming_sim/mesh/faces.h"

#include <gtest/gtest.h>

#include "support/moved.h"

namespace forming_sim {
namespace {

std::vector<double> areas_of_nodes(const Mesh& mesh, Vec3& sum) {
  const NodeField x = positions_of(mesh);
  std::vector<double> area(x.size(), 0.0);
  sum = Vec3::Zero();
  for (const Face& face : faces_of(mesh))
    for (int k = 0; k < face.corners; ++k) {
      const Vec3 share = area_share(face, k, x, false);
      area[face.nodes[k]] += share.norm();
      sum += share;
    }
  return area;
}

TEST(Faces, AHexahedronThatStaysWholeHasSixOfFourCorners) {
  const int n = 3;
  const Mesh mesh = block_of(CellKind::hex1, n);
  const NodeField x = positions_of(mesh);
  const std::vector<Face> faces = faces_of(mesh);
  ASSERT_EQ(faces.size(), 6u * n * n);
  Vec3 sum;
  areas_of_nodes(mesh, sum);
  EXPECT_LT(sum.norm(), 1e-14);
  for (const Face& face : faces) {
    ASSERT_EQ(face.corners, 4);
    const Vec3 whole = (vec3(x[face.nodes[1]]) - vec3(x[face.nodes[0]])).cross(vec3(x[face.nodes[3]]) - vec3(x[face.nodes[0]]));
    for (int k = 0; k < 4; ++k) EXPECT_LT((area_share(face, k, x, false) - 0.25 * whole).norm(), 1e-15);
  }
}

TEST(Faces, SimplicesHaveThoseOfTheirFacets) {
  for (CellKind kind : {CellKind::hex24, CellKind::hex6, CellKind::crossed, CellKind::quad1}) {
    const Mesh mesh = block_of(kind, 2);
    const std::vector<Face> faces = faces_of(mesh);
    ASSERT_EQ(faces.size(), mesh.surface.size());
    for (std::size_t i = 0; i < faces.size(); ++i) {
      EXPECT_EQ(faces[i].corners, mesh.dimension);
      for (int k = 0; k < mesh.dimension; ++k) EXPECT_EQ(faces[i].nodes[k], mesh.surface[i].nodes[k]);
    }
    Vec3 sum;
    areas_of_nodes(mesh, sum);
    EXPECT_LT(sum.norm(), 1e-14);
  }
}

TEST(Faces, FollowEachOtherThroughBodiesOfSeveralKinds) {
  Mesh mesh = block_of(CellKind::hex24, 1);  // a hexahedron that is divided, and beside it one that stays whole
  const Mesh whole = block_of(CellKind::hex1, 1);
  const int shift = static_cast<int>(mesh.nodes.size());
  for (const Vec3& X : whole.nodes) mesh.nodes.push_back(X + Vec3(3, 0, 0));
  Cells cells = whole.cells[0];
  for (int& n : cells.nodes) n += shift;
  mesh.cells.push_back(cells);
  find_surface(mesh);
  int triangles = 0, quadrilaterals = 0;
  for (const Face& face : faces_of(mesh)) {
    (face.corners == 3 ? triangles : quadrilaterals) += 1;
    EXPECT_EQ(face.corners == 4, mesh.nodes[face.nodes[0]].x() > 2);
  }
  EXPECT_EQ(triangles, 24);
  EXPECT_EQ(quadrilaterals, 6);
}

}  // namespace
}  // namespace forming_sim
