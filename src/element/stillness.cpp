#include "forming_sim/element/stillness.h"

#include "forming_sim/element/nodes.h"

namespace forming_sim {

constexpr int kLook = 16;       // calls from one look to the next while all move
constexpr double kMoving = .9;  // share of the nodes that counts as all

void Stillness::forget() {
  any_ = seen_last_ = false;
  calls_ = 0;
}

void Stillness::look(const NodeField& x, const NodeTeam& team) {
  const bool compare = seen_last_, keep = compare || calls_++ % kLook == 0;
  any_ = seen_last_ = false;
  if (!keep) return;
  seen_.resize(x.size());
  moved_.resize(x.size());
  const long movers = compare_nodes(team, x, seen_, moved_);
  if (compare) any_ = static_cast<double>(movers) < kMoving * static_cast<double>(x.size());
  seen_last_ = any_ || !compare;
}

}  // namespace forming_sim
