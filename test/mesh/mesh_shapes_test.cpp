// The tables of cells, the surface and the check of volumes.
#include <algorithm>
#include <cmath>

#include "forming_sim/mesh/cell_tables.h"
#include "mesh/mesh_test_tools.h"

namespace forming_sim {
namespace {

// One cell of each kind, of volume 1 (triangle 1/2, tetrahedron 1/6).
Mesh one_cell(CellKind kind) {
  Mesh mesh;
  const CellShape& shape = shape_of(kind);
  mesh.dimension = shape.dimension;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  if (kind == CellKind::triangle) mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  if (kind == CellKind::tetrahedron) mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  if (shape.dimension == 2 && kind != CellKind::triangle) mesh.nodes.resize(4);
  if (kind == CellKind::crossed) mesh.nodes.push_back({.5, .5, 0});
  if (kind == CellKind::wedge14) mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  if (kind == CellKind::pyramid8) mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {.5, .5, 1}};
  if (const QuadFaces faces = split_faces_of(kind); faces.count > 0) {
    Vec3 middle = Vec3::Zero();
    for (const Vec3& x : mesh.nodes) middle += x / static_cast<double>(mesh.nodes.size());
    for (int f = 0; f < faces.count; ++f) {
      const auto& face = faces.corners[f];
      mesh.nodes.push_back((mesh.nodes[face[0]] + mesh.nodes[face[1]] + mesh.nodes[face[2]] + mesh.nodes[face[3]]) / 4);
    }
    mesh.nodes.push_back(middle);
  }
  Cells block{kind, {}};
  for (int n = 0; n < shape.nodes; ++n) block.nodes.push_back(n);
  mesh.cells = {block};
  return mesh;
}

const CellKind kAll[] = {CellKind::triangle,    CellKind::quad2, CellKind::crossed,
                         CellKind::tetrahedron, CellKind::hex6,  CellKind::hex24, CellKind::wedge14, CellKind::pyramid8};

TEST(MeshShapes, EverySimplexIsPositiveAndTheyFillTheCell) {
  const std::map<CellKind, double> expected{{CellKind::triangle, .5}, {CellKind::tetrahedron, 1. / 6}, {CellKind::wedge14, .5}, {CellKind::pyramid8, 1. / 3}};
  for (CellKind kind : kAll) {
    const Mesh mesh = one_cell(kind);
    SCOPED_TRACE(shape_of(kind).name);
    ASSERT_EQ(int(mesh.nodes.size()), shape_of(kind).nodes);
    ASSERT_EQ(mesh.simplex_count(), shape_of(kind).simplices);
    for (const auto& s : mesh.simplices()) EXPECT_GT(signed_volume(mesh.nodes, s, mesh.dimension), 0);
    EXPECT_NEAR(volume(mesh), expected.count(kind) ? expected.at(kind) : 1, 1e-15);
    EXPECT_NO_THROW(check_volumes(mesh));
  }
}

TEST(MeshShapes, FaceCentresOfHex24LieOnTheFacesTheTableNames) {
  const Vec3 centres[] = {{.5, .5, 0}, {.5, .5, 1}, {.5, 0, .5}, {1, .5, .5}, {.5, 1, .5}, {0, .5, .5}};
  const Mesh mesh = one_cell(CellKind::hex24);
  for (int f = 0; f < 6; ++f) EXPECT_EQ(mesh.nodes[8 + f], centres[f]);
  for (int s = 0; s < 24; ++s) EXPECT_EQ(kHex24[s][3], 8 + s / 4);
}

TEST(MeshShapes, FaceCentresOfWedge14LieOnTheFacesTheTableNames) {
  const Vec3 centres[] = {{.5, 0, .5}, {.5, .5, .5}, {0, .5, .5}};
  const Mesh mesh = one_cell(CellKind::wedge14);
  for (int f = 0; f < 3; ++f) EXPECT_EQ(mesh.nodes[6 + f], centres[f]);
  for (int s = 2; s < 14; ++s) EXPECT_EQ(kWedge14[s][3], 6 + (s - 2) / 4);
}

TEST(MeshShapes, SurfacesAreClosedAndPointOutwards) {
  const std::map<CellKind, int> facets{{CellKind::triangle, 3}, {CellKind::quad2, 4}, {CellKind::crossed, 4}, {CellKind::tetrahedron, 4}, {CellKind::hex6, 12}, {CellKind::hex24, 24}, {CellKind::wedge14, 14}, {CellKind::pyramid8, 8}};
  for (CellKind kind : kAll) {
    Mesh mesh = one_cell(kind);
    SCOPED_TRACE(shape_of(kind).name);
    find_surface(mesh);
    EXPECT_EQ(int(mesh.surface.size()), facets.at(kind));
    EXPECT_LT(sum_of_areas(mesh).norm(), 1e-15);
    EXPECT_NEAR(enclosed(mesh), volume(mesh), 1e-15);
    if (mesh.dimension == 3) { EXPECT_EQ(euler_characteristic(mesh), 2); }
    const auto simplices = mesh.simplices();
    for (const Facet& f : mesh.surface) {
      ASSERT_GE(f.element, 0);
      for (int k = 0; k < mesh.dimension; ++k) {
        const auto& s = simplices[f.element];
        EXPECT_TRUE(std::count(s.begin(), s.begin() + mesh.dimension + 1, f.nodes[k]));
      }
    }
  }
}

TEST(MeshShapes, AFacetOfThreeElementsIsNamed) {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {0, 0, 2}};
  mesh.cells = {{CellKind::tetrahedron, {0, 1, 2, 3, 0, 1, 2, 4, 0, 1, 2, 5}}};
  const std::string text = error_of([&] { find_surface(mesh); });
  EXPECT_TRUE(has(text, "the facet with the corners (0, 0, 0) m, (0, 1, 0) m, (1, 0, 0) m")) << text;
  EXPECT_TRUE(has(text, "belongs to 3 elements")) << text;
}

TEST(MeshShapes, AnInvertedCellIsNamedWithItsNodesAndVolume) {
  Mesh mesh = one_cell(CellKind::tetrahedron);
  mesh.nodes.push_back({-1, 0, 0});
  mesh.cells[0].nodes.insert(mesh.cells[0].nodes.end(), {0, 4, 2, 3});
  const std::string text = error_of([&] { check_volumes(mesh); });
  EXPECT_TRUE(has(text, "tetrahedron 1 of nodes 0 4 2 3")) << text;
  EXPECT_TRUE(has(text, "-0.166667 m3")) << text;
}

TEST(MeshShapes, AFlatCellIsRefused) {
  Mesh mesh = one_cell(CellKind::triangle);
  mesh.nodes[2] = {.1 + .2, 0, 0};
  EXPECT_TRUE(has(error_of([&] { check_volumes(mesh); }), "triangle 0 of nodes 0 1 2"));
}

TEST(MeshShapes, BadNodesAreNamed) {
  Mesh mesh = one_cell(CellKind::hex6);
  mesh.nodes[5].y() = std::nan("");
  EXPECT_TRUE(has(error_of([&] { check_volumes(mesh); }), "node 5"));
  mesh = one_cell(CellKind::hex6);
  mesh.nodes.push_back({3, 3, 3});
  EXPECT_TRUE(has(error_of([&] { check_volumes(mesh); }), "node 8 at (3, 3, 3) m belongs to no cell"));
  mesh = one_cell(CellKind::hex6);
  mesh.cells[0].nodes[3] = 8;
  EXPECT_TRUE(has(error_of([&] { check_volumes(mesh); }), "names node 8; the nodes run from 0 to 7"));
}

}  // namespace
}  // namespace forming_sim
