#include "forming_sim/element/stillness.h"

#include <algorithm>

namespace forming_sim {

constexpr int kLook = 16;       // calls from one look to the next while all move
constexpr double kMoving = .9;  // share of the nodes that counts as all

void Stillness::forget() {
  any_ = seen_last_ = false;
  calls_ = 0;
}

void Stillness::look(const NodeField& x, Team& team) {
  const bool compare = seen_last_, keep = compare || calls_++ % kLook == 0;
  any_ = seen_last_ = false;
  if (!keep) return;
  const long count = static_cast<long>(x.size());
  seen_.resize(x.size());
  moved_.resize(x.size());
  team.share(count, kNodesOfAThread, [&](long first, long last) {
    for (long n = first; n < last; ++n) {
      moved_[n] = !(seen_[n] == x[n]);
      seen_[n] = x[n];
    }
  });
  if (compare) any_ = static_cast<double>(std::count(moved_.begin(), moved_.end(), 1)) < kMoving * static_cast<double>(count);
  seen_last_ = any_ || !compare;
}

}  // namespace forming_sim
