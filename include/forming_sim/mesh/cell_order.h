#pragma once
// In which order cells lie. Those of a file may come in any: neighbours far apart in it, so that cells that are worked on
// together (element/cell_group.h) have nodes all over the body. Halving the cells again and again across the longest side of
// where they lie makes pieces that are compact.
#include <vector>

#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// The cells' numbers in that order if it is worth it, and otherwise as they come.
/// points, nodes: [cell][nodes_of_cell] indices of points; ends: of the pieces of cells that are worked on together, the last that of all
/// cells; worth: largest ratio of the numbers of nodes that the pieces have by halves and as they come, those of several pieces counted
/// once each, at which it is.
std::vector<int> order_of_cells(const std::vector<Vec3>& points, const std::vector<int>& nodes, int nodes_of_cell, const std::vector<int>& ends, double worth);

/// Ends of pieces of so many cells each; the last may have fewer.
std::vector<int> ends_of_pieces(int cells, int piece);

}  // namespace forming_sim
