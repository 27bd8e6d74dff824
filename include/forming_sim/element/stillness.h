#pragma once
// Which nodes have not moved since the forces were last found, to the last bit.
//
// The forces of a cell follow from the places of its nodes and its memory. Where
// the nodes stand still and the last evaluation left the memory as it was, the next
// one would give the same bits: there is nothing to do. So a body that waits for a
// tool, or the part of a bar that the wave has not reached, costs nothing. (What its cells pull by
// rounding does not count: Kick of element/nodes.h.)
#include <vector>

#include "forming_sim/element/node_team.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

class Stillness {
 public:
  /// To be called before every evaluation of the forces at x. While nearly all
  /// nodes move, or those that do not let no cell rest, it compares in one of sixteen calls only.
  void look(const NodeField& x, const NodeTeam& team);
  /// Enough nodes stand still for a look at the cells to pay.
  bool any() const { return any_; }
  /// Node n has moved since the last evaluation; only where any().
  bool moved(int n) const { return moved_[n] != 0; }
  /// Every cell has a node that moves.
  void no_cell_rests() { seen_last_ = false; }
  /// Nothing is known of the last evaluation (the memory was read from a file).
  void forget();

 private:
  NodeField seen_;           ///< positions of the last evaluation
  std::vector<char> moved_;
  bool any_ = false, seen_last_ = false;
  int calls_ = 0;
};

}  // namespace forming_sim
