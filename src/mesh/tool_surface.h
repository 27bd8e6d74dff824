#pragma once
// The triangles of a tool, as read and as used.
#include <array>
#include <string>
#include <vector>

#include "forming_sim/mesh/mesh.h"

namespace forming_sim {

struct Triangles {
  std::string source;                      ///< as messages name it
  std::vector<Vec3> points;                ///< metres
  std::vector<std::array<int, 3>> corners;
};

/// Triangles of an STL, OBJ, PLY or DAE file, by way of assimp.
Triangles read_triangles(const std::string& path, double unit_scale);

/// Merges coinciding points, along seams those that differ by rounding too, removes triangles without area and repeated ones,
/// says so in `notes`, and there too whether the surface is open.
Mesh clean_surface(const Triangles& triangles, std::vector<std::string>& notes);

}  // namespace forming_sim
