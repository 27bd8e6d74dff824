#pragma once
// The forces on the nodes before they are added up: what every tile of cells found for its nodes
// (element/cell_group.h), and the loads. Whoever needs f adds it up on the way, so that a step passes over no array of it.
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// Slots that are fetched at a time for nodes to come.
constexpr int kSlotsFetched = 6;

/// f_n = sum of the slots index[start[n]] to index[start[n + 1] - 1], in this order, + load_n, N.
/// index has kSlotsFetched more behind those of the last node, of any slots.
struct NodalForces {
  int dimension = 0;
  const int *start = nullptr, *index = nullptr;
  const double* slots = nullptr;  ///< [slot][kRecord<dimension>]
  const double* load = nullptr;   ///< [node][4]; null: none
};

}  // namespace forming_sim
