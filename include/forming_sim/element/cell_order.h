#pragma once
// In which order cells are worked on. Those of a file may come in any: neighbours far apart in it, so that the blocks of a
// tile have nodes all over the body, each of which then adds up the slots of many tiles (element/cell_group.h). Halving the
// cells again and again across the longest side of where they lie makes tiles that are compact.
#include <vector>

#include "forming_sim/element/body.h"

namespace forming_sim {

/// The cells' numbers in that order: by halves where the tiles of so many cells then have less than half the nodes, of all
/// tiles together, and otherwise as they come, which is how their nodes are numbered: large bodies whose nodes come in another
/// order than their cells are slower. of_tile: cells, a multiple of kLanes; first_node: added to the cells' node numbers.
std::vector<int> order_of_cells(const Cells& cells, int first_node, const NodeField& X, int of_tile);

}  // namespace forming_sim
