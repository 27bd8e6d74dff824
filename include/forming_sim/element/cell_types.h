#pragma once
// The kinds of cells as types, for the kernels: CellShape known at compile time.
#include "forming_sim/mesh/cell_tables.h"

namespace forming_sim {
namespace cell_types {

struct Triangle { static constexpr int dimension = 2, nodes = 3, simplices = 1; static constexpr auto& table = kTriangle; };
struct Quad2 { static constexpr int dimension = 2, nodes = 4, simplices = 2; static constexpr auto& table = kQuad2; };
struct Crossed { static constexpr int dimension = 2, nodes = 5, simplices = 4; static constexpr auto& table = kCrossed; };
struct Tetrahedron { static constexpr int dimension = 3, nodes = 4, simplices = 1; static constexpr auto& table = kTetrahedron; };
struct Hex6 { static constexpr int dimension = 3, nodes = 8, simplices = 6; static constexpr auto& table = kHex6; };
struct Hex24 { static constexpr int dimension = 3, nodes = 15, simplices = 24; static constexpr auto& table = kHex24; };

}  // namespace cell_types
}  // namespace forming_sim
