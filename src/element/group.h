#pragma once
// Cells of one body and kind, with the arrays that they own.
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "forming_sim/element/crossed.h"
#include "forming_sim/element/elements.h"
#include "forming_sim/element/even_pressure.h"
#include "forming_sim/element/one_point_sums.h"
#include "forming_sim/material/law.h"

namespace forming_sim {

/// Into how many tiles so many blocks go.
int tiles_of(int blocks, int simplices_of_a_cell);

struct Elements::Group : CellGroup {
  LargeArray<int> node_storage, row_storage, slot_storage;
  std::vector<int> constant_sets;
  int shared_sets = 0;           ///< so many of the start, which blocks that are alike share; those behind are of one block each
  std::vector<long> tile_start;  ///< first slot of each tile, and behind the last
  std::vector<double> plastic, viscous;
  std::vector<double> plastic_before;  ///< room for `plastic` of the step before, where tiles may rest
  std::unique_ptr<bool[]> upright_storage, pressed_storage;
  enum Rest : char { changed, kept, passed_over };  ///< a tile's memory by the last evaluation, or none was needed
  std::vector<Rest> rest;  ///< per tile; empty where all are evaluated
  CurveTables curves;
  // Of crossed triangles whose weights go with the shape (element/crossed.h), where the law is one of plastic flow:
  std::vector<std::array<Vec3, 5>> first_corners;  ///< [cell] at the start
  LargeArray<Lane> weight_ratio;                   ///< [block] r of the weights
  LargeArray<Lane> memory_storage, constants_storage, hourglass_storage, node_share_storage, viscosity_storage;
  std::vector<double> share;  ///< [cell][node] kg, with ElementOptions::shares
  int parts = 0;  ///< simplices of a cell, all of them its one point's in a one-point cell; none of points at edges
  std::vector<int> edge_points;  ///< [simplex][edges_of_simplex] of simplices whose law is there: place among all such points, a lane each
  std::vector<std::array<int, 2>> edge_ends;  ///< of points at edges: the nodes of each edge
  int first_point = 0;                        ///< likewise: place of the first of the group
  int first_element = 0;
  std::vector<int> order, cell_of;  ///< [cell] which of the body's cells of its kind it is, and the other way round (mesh/cell_order.h); none of points at edges
  long first_slot = 0;           ///< of all slots
  std::string body;

  /// Its simplices have pressures in the nodes, and their law at the edges.
  bool nodal() const { return pressure == PressureMode::node && !at_edges; }
  /// Its pressures are those of element/even_pressure.h, with K_r < K.
  bool even() const { return nodal() && rough_bulk(solid.K, solid.mu) < solid.K; }
  /// So many cells, and what is kept a block of them. For cells of so many simplices each.
  void make_blocks(int count, int simplices) {
    cells = count;
    cell_simplices = simplices;
    blocks = (cells + kLanes - 1) / kLanes;
    tiles = tiles_of(blocks, simplices);
    plastic.assign(blocks, 0.0);
    viscous.assign(blocks, 0.0);
    upright_storage = std::make_unique<bool[]>(blocks);
    std::fill_n(upright_storage.get(), blocks, true);
    pressed_storage = std::make_unique<bool[]>(blocks);
  }
  /// The memory of a point (block * cell_simplices + simplex, and lane) free of stress. edges: its edge vectors as columns.
  void start(std::size_t point, int lane, const Eigen::Matrix3d& edges, double V0) {
    Lane* memory = memory_storage.data() + point * items;
    memory[items - 1][lane] = V0;
    if (items == 1) return;  // the law is elsewhere
    const Eigen::Matrix3d up = edges.inverse();  // rows: X^m
    const Eigen::Matrix3d G = up * up.transpose();
    const auto put = [&](int item, double value) { memory[item][lane] = value; };
    const std::vector<double> axes = solid.law == Law::hill ? axes_at_start(solid.orthotropy, dimension, edges) : std::vector<double>();
    if (dimension == 2) start_memory<2>(solid, {{G(0, 0), G(1, 1), G(2, 2), G(0, 1)}}, axes.data(), put);
    else start_memory<3>(solid, {{G(0, 0), G(1, 1), G(2, 2), G(0, 1), G(1, 2), G(2, 0)}}, axes.data(), put);
  }
  const std::array<Vec3, 5>& first_corners_of(int block, int lane) const { return first_corners[std::min(block * kLanes + lane, cells - 1)]; }
  /// The weights of a block as its weight_ratio says, in a set of its own.
  void set_weights(int block);
  /// Likewise of the blocks whose weight_ratio is no more what it was.
  void set_changed_weights(const LargeArray<Lane>& ratio_before);
  /// The two edges of the law of triangle s of a cell of crossed triangles, as columns; corners: places of the cell's nodes.
  Eigen::Matrix2d law_edges(int block, int lane, const Vec3* corners, int s) const;
  /// Of a cell of crossed triangles with its nodes at `corners`, J of what the law sees of a triangle over J of the cell, the least of the four.
  double least_seen(int block, int lane, const Vec3* corners) const;
  /// A constant of a one-point cell or of crossed triangles.
  double constant(int block, int item, int lane) const {
    const int count = static_cast<CellKind>(kind) == CellKind::crossed ? kCrossedItems : one_point_items(dimension, ring);
    return constants_storage[static_cast<std::size_t>(constant_sets[block]) * count + item][lane];
  }
  /// Number of a part of a cell among all elements.
  int element(int cell, int part) const { return first_element + order[cell] * parts + part; }
  /// Of a simplex, counted through the cells.
  int element(std::size_t simplex) const { return element(static_cast<int>(simplex) / parts, static_cast<int>(simplex) % parts); }
  /// Node a of a cell.
  int node(int cell, int a) const { return node_storage[(static_cast<std::size_t>(cell / kLanes) * cell_nodes + a) * kLanes + cell % kLanes]; }
  /// Of a block, and behind the last one: where its cells' nodes start in node_storage.
  long first_node(long block) const { return (at_edges ? row_storage[block] : block * cell_nodes) * kLanes; }
  /// Whether what stands there is of a copy of the last cell.
  bool copied(long at) const { return at >= first_node(blocks - 1) && at % kLanes >= cells - (blocks - 1) * kLanes; }
  int first_block(long t) const { return static_cast<int>(blocks * t / tiles); }
  int last_block(long t) const { return first_block(t + 1); }
  /// Cells up to the end of each tile.
  std::vector<int> ends_of_tiles() const {
    std::vector<int> ends(tiles);
    for (int t = 0; t < tiles; ++t) ends[t] = std::min(last_block(t) * kLanes, cells);
    return ends;
  }
};

constexpr long kEightsOfAThread = 100;  ///< eight simplices each: fewer are not worth another thread

/// work(D, ring) with both as constants of the compiler.
template <class Work> auto with_dimension(int dimension, bool ring, Work&& work) {
  constexpr std::integral_constant<int, 2> flat;
  if (dimension == 3) return work(std::integral_constant<int, 3>(), std::false_type());
  return ring ? work(flat, std::true_type()) : work(flat, std::false_type());
}

/// A one-point cell of a group where it stands.
template <int D> struct Elements::StandingCell {
  std::vector<double> constants;
  Vector<double, D> x[OnePoint<D>::nodes];

  StandingCell(const Group& g, const NodeField& field, int cell) : constants(one_point_items(D, g.ring)) {
    for (std::size_t i = 0; i < constants.size(); ++i) constants[i] = g.constant(cell / kLanes, static_cast<int>(i), cell % kLanes);
    for (int a = 0; a < OnePoint<D>::nodes; ++a)
      for (int i = 0; i < D; ++i) x[a][i] = field[g.node(cell, a)][i];
  }
};

}  // namespace forming_sim
