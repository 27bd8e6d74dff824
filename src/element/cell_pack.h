#pragma once
// A pack of cells of a kind as the kernels see it: kWidth of the kLanes cells of a block, their nodes gathered, their simplices'
// edges and volumes, their memory. For files that are compiled once per vector width only.
#include "element/packs.h"
#include "forming_sim/element/cell_types.h"
#include "forming_sim/element/crossed.h"
#include "forming_sim/element/guard.h"
#include "forming_sim/element/one_point_sums.h"
#include "forming_sim/material/classical.h"
#include "forming_sim/material/law.h"

namespace forming_sim {
namespace FORMING_SIM_ISA {

template <class Cell> constexpr int kD = Cell::dimension;
template <class Cell> constexpr int kE = kEdges<kD<Cell>, Cell::ring>;
template <class Cell> using CellEdges = Edges<Pack, kD<Cell>, Cell::ring>;
template <class Cell> using CellIncrement = Increment<Pack, kD<Cell>, Cell::ring>;

/// The nodes of a pack's cells, and the slots of their forces.
template <class Cell> const int* nodes_of(const CellGroup& g, long pack) { return lanes_of(g.nodes, Cell::nodes, pack); }
template <class Cell> const int* slots_of(const CellGroup& g, long pack) { return lanes_of(g.slots, Cell::nodes, pack); }

/// A nodal vector of each of kWidth nodes, gathered: one Pack per component.
template <int D> [[gnu::always_inline]] inline Vector<Pack, D> gather_vectors(const int* nodes, const double* field) {
  const auto record = [&](int l) { return field + 4 * static_cast<long>(nodes[l]); };
  Vector<Pack, D> out;
  Pack z;
  if constexpr (D == 2) gather_records(record, out[0], out[1], z);
  else gather_records(record, out[0], out[1], out[2]);
  return out;
}
/// Adds a vector to the slots of kWidth nodes.
inline void add_vectors(const Vector<Pack, 2>& f, const int* slots, double* sums) { add_pairs(f[0], f[1], slots, sums); }
inline void add_vectors(const Vector<Pack, 3>& f, const int* slots, double* sums) { add_records(f[0], f[1], f[2], slots, sums); }

/// Nodal vectors of a pack of cells.
template <class Cell>
void gather(const int* nodes, const double* field, Vector<Pack, kD<Cell>>* out) {
  for (int a = 0; a < Cell::nodes; ++a) out[a] = gather_vectors<kD<Cell>>(nodes + a * kLanes, field);
}

/// The node that all simplices of a cell have in common (mesh/cell_tables.h).
template <class Cell> constexpr int kApex = Cell::table[0][0];

/// From where the nodes of a cell of simplices are to the ways from the apex to the others; the apex stays where it
/// is. One-point cells have no apex, and keep all their nodes.
template <class Cell> void refer_to_apex(Vector<Pack, kD<Cell>>* x) {
  if constexpr (!Cell::one_point)
    for (int a = 0; a < Cell::nodes; ++a)
      if (a != kApex<Cell>) x[a] = x[a] - x[kApex<Cell>];
}
template <class Cell> void gather_ways(const int* nodes, const double* field, Vector<Pack, kD<Cell>>* out) {
  if constexpr (Cell::one_point) {
    gather<Cell>(nodes, field, out);
  } else {
    const Vector<Pack, kD<Cell>> apex = gather_vectors<kD<Cell>>(nodes + kApex<Cell> * kLanes, field);
    for (int a = 0; a < Cell::nodes; ++a) out[a] = gather_vectors<kD<Cell>>(nodes + a * kLanes, field) - apex;
    out[kApex<Cell>] = apex;
  }
}

/// Constants of one-point cells, or crossed ones; null elsewhere, and where the law is at the edges.
template <class Cell> const double* constants_of(const CellGroup& g, long pack) {
  const auto of_set = [&](long items) { return g.constants + g.constant_set[block_of(pack)] * items * kLanes + first_lane(pack); };
  if constexpr (Cell::one_point) return of_set(OnePoint<kD<Cell>, Cell::ring>::items);
  else if constexpr (Cell::drawn) return g.constants ? of_set(kCrossedItems) : nullptr;
  else return nullptr;
}
template <class Cell> double* hourglass_of(const CellGroup& g, long pack) { return lanes_of(g.hourglass, g.hourglass_items, pack); }

/// One of the constants of a cell.
inline Pack weight(const double* constants, int item) { return Pack::load(constants + item * kLanes); }

/// Edges of simplex s from what gather_ways() gives.
template <class Cell>
void edges_of(const double* constants, const Vector<Pack, kD<Cell>>* x, int s, Vector<Pack, kD<Cell>>* edge) {
  constexpr int D = kD<Cell>;
  if constexpr (Cell::one_point) {
    find_one_point_edges<D, Cell::ring>(constants, x, edge);
  } else {
    repeat<D>([&](auto m) { edge[m] = x[Cell::table[s][m + 1]]; });
    if constexpr (Cell::ring) edge[2] = {{x[kApex<Cell>][0] + Pack(1.0 / 3) * (edge[0][0] + edge[1][0]), Pack(0.0)}};
  }
}

/// Up to which |J - 1| there is no guard of simplex s (element/guard.h).
template <class Cell> Pack free_of_guard(const double* constants, int s) {
  if constexpr (Cell::drawn)
    if (constants) return weight(constants, kCrossedGuard + s);
  return Pack(kFreeOfGuard);
}

/// What the law sees of a cell that is drawn (element/crossed.h): y_c of the corners, and last -lambda sum_b w_b x_b.
template <class Cell> constexpr int kDrawn = Cell::drawn ? Cell::nodes : 1;
template <class Cell> void draw(const double* constants, const Vector<Pack, kD<Cell>>* x, Vector<Pack, kD<Cell>>* y) {
  static_assert(kApex<Cell> == 4);
  const auto item = [&](int i) { return weight(constants, i); };
  for (int c = 0; c < 4; ++c) y[c] = crossed_mix(item, c * 4, x);
  y[4] = crossed_mix(item, kCrossedApex, x);
}
/// Edges of simplex s for the law; the hoop of a ring is that of x.
template <class Cell>
void law_edges(const double* constants, const Vector<Pack, kD<Cell>>* x, const Vector<Pack, kD<Cell>>* drawn, int s, Vector<Pack, kD<Cell>>* edge) {
  edges_of<Cell>(constants, x, s, edge);
  if constexpr (Cell::drawn)
    for (int m = 0; m < 2; ++m) {
      edge[m] = drawn[Cell::table[s][m + 1]];
      edge[m] += weight(constants, kCrossedFreed + s) * drawn[4];
    }
}
/// Adds what pulls at these edges to what pulls at those of draw().
template <class Cell> void add_law_forces(const double* constants, const Vector<Pack, kD<Cell>>* on_edges, int s, Vector<Pack, kD<Cell>>* on_drawn) {
  for (int m = 0; m < 2; ++m) {
    on_drawn[Cell::table[s][m + 1]] += on_edges[m];
    on_drawn[4] += weight(constants, kCrossedFreed + s) * on_edges[m];
  }
}
/// And hands them back to the corners.
template <class Cell> void hand_back(const double* constants, const Vector<Pack, kD<Cell>>* on_drawn, Vector<Pack, kD<Cell>>* f) {
  for (int b = 0; b < 4; ++b)
    for (int c = 0; c <= 4; ++c) f[b] -= weight(constants, c * 4 + b) * on_drawn[c];
}

template <class Cell> Pack volume_of(const double* constants, const Vector<Pack, kD<Cell>>* x, int s) {
  Vector<Pack, kD<Cell>> edge[kE<Cell>];
  edges_of<Cell>(constants, x, s, edge);
  return simplex_volume<Pack, kD<Cell>, Cell::ring>(edge);
}
template <class Cell> void simplex_volumes(const double* constants, const Vector<Pack, kD<Cell>>* x, Pack* V) {
  for (int s = 0; s < Cell::simplices; ++s) V[s] = volume_of<Cell>(constants, x, s);
}

/// Calls work(s, e, w) with each simplex of cells whose nodes stand at x and move with v: its edges with their reciprocal vectors, and how
/// the edges move.
template <class Cell, class Work> [[gnu::always_inline]] inline void each_moving(const double* constants, const Vector<Pack, kD<Cell>>* x, const Vector<Pack, kD<Cell>>* v, Work&& work) {
  for (int s = 0; s < Cell::simplices; ++s) {
    CellEdges<Cell> e;
    edges_of<Cell>(constants, x, s, e.x);
    find_reciprocal(e);
    Vector<Pack, kD<Cell>> w[kE<Cell>];
    edges_of<Cell>(constants, v, s, w);
    work(s, e, w);
  }
}

/// The forces on edges are in balance with those on the apex, where all of them start; of rings but for the thirds of the hoops' forces, `hoops` their sum.
template <class Cell> void balance_apex(const Pack& hoops, Vector<Pack, kD<Cell>>* f) {
  for (int a = 0; a < Cell::nodes; ++a)
    if (a != kApex<Cell>) f[kApex<Cell>] -= f[a];
  if constexpr (Cell::ring) f[kApex<Cell>][0] -= Pack(3.0) * hoops;
}

template <class Cell> double* memory_of(const CellGroup& g, long pack, int s) {
  return lanes_of(g.memory, static_cast<long>(Cell::simplices) * g.items, pack) + static_cast<long>(s) * g.items * kLanes;
}

/// What a kernel of the forces is made for, so that it is as lean as it can be: the law of material/von_mises.h with a single
/// layer, or with several; all others are told apart at run time.
enum class Made { one_layer, layers, any };
inline bool of_von_mises(Law law) { return law == Law::green_elastic || law == Law::paper; }

/// Calls `work` with the cell type of the group's kind.
template <class Work> void with_cell(const CellGroup& g, Work&& work) {
  const auto flat = [&](auto cell) {
    if (g.ring) return work(cell_types::Turned<decltype(cell)>());
    work(cell);
  };
  switch (static_cast<CellKind>(g.kind)) {
    case CellKind::triangle: return flat(cell_types::Triangle());
    case CellKind::quad2: return flat(cell_types::Quad2());
    case CellKind::crossed: return flat(cell_types::Crossed());
    case CellKind::tetrahedron: return work(cell_types::Tetrahedron());
    case CellKind::hex6: return work(cell_types::Hex6());
    case CellKind::hex24: return work(cell_types::Hex24());
    case CellKind::quad1: return flat(cell_types::Quad1());
    case CellKind::hex1: return work(cell_types::Hex1());
    case CellKind::wedge14: return work(cell_types::Wedge14());
    case CellKind::pyramid8: return work(cell_types::Pyramid8());
  }
}

/// The parts of the table of kernels that have files of their own.
NodalKernels nodal_kernels();
EdgeKernels edge_kernels();

}  // namespace FORMING_SIM_ISA
}  // namespace forming_sim
