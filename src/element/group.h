#pragma once
// Cells of one body and kind, with the arrays that they own.
#include <memory>
#include <string>
#include <vector>

#include "forming_sim/element/elements.h"
#include "forming_sim/element/one_point.h"

namespace forming_sim {

struct Elements::Group : CellGroup {
  std::vector<int> node_storage, slot_storage, constant_sets;
  std::vector<long> tile_start;  ///< first slot of each tile, and behind the last
  std::vector<double> plastic, viscous;
  std::unique_ptr<bool[]> upright_storage;
  enum Rest : char { changed, kept, passed_over };  ///< a tile's memory by the last evaluation, or none was needed
  std::vector<Rest> rest;  ///< per tile; empty where all are evaluated
  CurveTables curves;
  std::vector<Lane> memory_storage, constants_storage, hourglass_storage;
  std::vector<double> share;  ///< [cell][node] kg, with ElementOptions::shares
  int parts = 0;  ///< simplices of a cell, all of them its one point's in a one-point cell
  int first_element = 0;
  long first_slot = 0;           ///< of all slots
  std::string body;

  /// A constant of a one-point cell.
  double constant(int block, int item, int lane) const { return constants_storage[static_cast<std::size_t>(constant_sets[block]) * one_point_items(dimension, ring) + item][lane]; }
  int first_block(long t) const { return static_cast<int>(t) * tile; }
  int last_block(long t) const { return blocks < first_block(t + 1) ? blocks : first_block(t + 1); }
};

}  // namespace forming_sim
