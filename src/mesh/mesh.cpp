#include "forming_sim/mesh/mesh.h"

#include "forming_sim/mesh/cell_tables.h"

namespace forming_sim {

const CellShape& shape_of(CellKind kind) { return kShapes[static_cast<int>(kind)]; }

int Mesh::simplex_count() const {
  int count = 0;
  for (const Cells& block : cells) count += block.count() * shape_of(block.kind).simplices;
  return count;
}

std::vector<std::array<int, 4>> Mesh::simplices() const {
  std::vector<std::array<int, 4>> all;
  all.reserve(simplex_count());
  for (const Cells& block : cells) {
    const CellShape& shape = shape_of(block.kind);
    for (int cell = 0; cell < block.count(); ++cell) {
      const int* nodes = &block.nodes[static_cast<std::size_t>(cell) * shape.nodes];
      for (int s = 0; s < shape.simplices; ++s) {
        std::array<int, 4> simplex{-1, -1, -1, -1};
        for (int corner = 0; corner <= shape.dimension; ++corner)
          simplex[corner] = nodes[shape.simplex[s][corner]];
        all.push_back(simplex);
      }
    }
  }
  return all;
}

}  // namespace forming_sim
