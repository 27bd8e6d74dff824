#pragma once
// Free meshes as gmsh makes them, of triangles and tetrahedra about as large as asked for. Every
// plane side is a set of its nodes, named as those of a generated blank.
#include "forming_sim/mesh/config.h"
#include "forming_sim/mesh/mesh.h"

namespace forming_sim {

/// 0 <= x <= length, 0 <= y <= height; sets left, right (x), bottom, top (y).
Mesh free_rectangle(double length, double height, double edge);
/// From the origin to `size`; sets left, right (x), front, back (y), bottom, top (z).
Mesh free_box(const Vec3& size, double edge);
/// A quarter of a round bar along z from z = 0, x and y positive; sets bottom, top, symmetry_x, symmetry_y.
Mesh free_quarter_bar(double radius, double length, double edge);
/// A round bar along z from z = 0; sets bottom, top.
Mesh free_bar(double radius, double length, double edge);

/// The mesh, all of one kind of cells, given inline.
MeshConfig inline_mesh(const Mesh& mesh);

}  // namespace forming_sim
