// Can a mesh be computed with? Says what is wrong with the first bad cell or node.
#include <sstream>

#include "forming_sim/config/fault.h"
#include "forming_sim/mesh/measure.h"
#include "forming_sim/mesh/mesh.h"

namespace forming_sim {
namespace {

[[noreturn]] void refuse(const std::ostringstream& text) { throw Error(Code::mesh_error, text.str()); }

void check_nodes(const Mesh& mesh) {
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (!mesh.nodes[n].allFinite()) {
      std::ostringstream text;
      text << "mesh: node " << n << " lies at " << place(mesh.nodes[n])
           << "; every coordinate must be a finite number";
      refuse(text);
    }
}

void check_indices(const Mesh& mesh) {
  std::vector<char> used(mesh.nodes.size(), 0);
  const int count = static_cast<int>(mesh.nodes.size());
  for (const Cells& block : mesh.cells)
    for (int n : block.nodes) {
      if (n < 0 || n >= count) {
        std::ostringstream text;
        text << "mesh: a " << shape_of(block.kind).name << " names node " << n << "; the nodes run from 0 to "
             << count - 1;
        refuse(text);
      }
      used[n] = 1;
    }
  for (int n = 0; n < count; ++n)
    if (!used[n]) {
      std::ostringstream text;
      text << "mesh: node " << n << " at " << place(mesh.nodes[n])
           << " belongs to no cell and would have no mass; remove it";
      refuse(text);
    }
}

[[noreturn]] void refuse_cell(const Mesh& mesh, const CellShape& shape, int cell, const int* nodes, double volume) {
  std::ostringstream text;
  text << "mesh: " << shape.name << ' ' << cell << " of nodes";
  for (int k = 0; k < shape.nodes; ++k) text << ' ' << nodes[k];
  text << " near " << place(mesh.nodes[nodes[0]]) << " has a part of " << (shape.dimension == 2 ? "area " : "volume ")
       << volume << (shape.dimension == 2 ? " m2" : " m3")
       << "; every cell needs a positive one: it is inverted, flat or not convex, so turn round its node order or mesh it anew";
  refuse(text);
}

}  // namespace

void check_volumes(const Mesh& mesh) {
  check_nodes(mesh);
  check_indices(mesh);
  for (const Cells& block : mesh.cells) {
    const CellShape& shape = shape_of(block.kind);
    if (shape.dimension != mesh.dimension) {
      std::ostringstream text;
      text << "mesh: a " << shape.name << " in a body of dimension " << mesh.dimension;
      refuse(text);
    }
    for (int cell = 0; cell < block.count(); ++cell) {
      const int* nodes = &block.nodes[static_cast<std::size_t>(cell) * shape.nodes];
      for (int s = 0; s < shape.checked; ++s) {
        std::array<int, 4> simplex{-1, -1, -1, -1};
        for (int k = 0; k <= shape.dimension; ++k) simplex[k] = nodes[shape.check[s][k]];
        const double v = signed_volume(mesh.nodes, simplex, mesh.dimension);
        // A sliver that is flat to rounding error counts as flat.
        const double edge = (mesh.nodes[simplex[1]] - mesh.nodes[simplex[0]]).norm();
        if (!(v > 1e-14 * (shape.dimension == 2 ? edge * edge : edge * edge * edge)))
          refuse_cell(mesh, shape, cell, nodes, v);
      }
    }
  }
}

}  // namespace forming_sim
