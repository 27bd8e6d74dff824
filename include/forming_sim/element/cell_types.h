#pragma once
// The kinds of cells as types, for the kernels: CellShape known at compile time, and
// whether the section is turned about the y axis.
#include "forming_sim/mesh/cell_tables.h"

namespace forming_sim {
namespace cell_types {

struct Plain { static constexpr bool ring = false, one_point = false, drawn = false; };
/// A cell whose one element is element/one_point.h's: to the kernels a single simplex.
struct OnePointCell { static constexpr bool ring = false, one_point = true, drawn = false; static constexpr int simplices = 1; };

struct Triangle : Plain { static constexpr int dimension = 2, nodes = 3, simplices = 1; static constexpr auto& table = kTriangle; };
struct Quad2 : Plain { static constexpr int dimension = 2, nodes = 4, simplices = 2; static constexpr auto& table = kQuad2; };
/// drawn: its law has strains of element/crossed.h.
struct Crossed : Plain { static constexpr bool drawn = true; static constexpr int dimension = 2, nodes = 5, simplices = 4; static constexpr auto& table = kCrossed; };
struct Tetrahedron : Plain { static constexpr int dimension = 3, nodes = 4, simplices = 1; static constexpr auto& table = kTetrahedron; };
struct Hex6 : Plain { static constexpr int dimension = 3, nodes = 8, simplices = 6; static constexpr auto& table = kHex6; };
struct Hex24 : Plain { static constexpr int dimension = 3, nodes = 15, simplices = 24; static constexpr auto& table = kHex24; };
struct Wedge14 : Plain { static constexpr int dimension = 3, nodes = 10, simplices = 14; static constexpr auto& table = kWedge14; };
struct Pyramid8 : Plain { static constexpr int dimension = 3, nodes = 7, simplices = 8; static constexpr auto& table = kPyramid8; };

struct Quad1 : OnePointCell { static constexpr int dimension = 2, nodes = 4; };
struct Hex1 : OnePointCell { static constexpr int dimension = 3, nodes = 8; };

/// A cell of triangles that are rings.
template <class Cell> struct Turned : Cell { static constexpr bool ring = true; };

}  // namespace cell_types
}  // namespace forming_sim
