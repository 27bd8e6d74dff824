#pragma once
// Loops over the nodes, shared by the threads of a run.
#include <algorithm>
#include <vector>

#include "forming_sim/parallel/team.h"

namespace forming_sim {

/// Goes through the nodes in parts, in the order in which the cells that touch them lie in memory: who has added up the forces of a share of the
/// cells moves their nodes too, whatever their numbers, and no more goes from core to core than what lies on the border of two shares. To fetch what the other
/// core has written costs a node more than all that is done with it.
class NodeTeam {
 public:
  static constexpr long kPart = 128;  ///< nodes of which v before and after the kick and x are 12 kB

  /// In the order of their numbers.
  NodeTeam(Team& team, long nodes) : team_(&team), nodes_(nodes) {
    for (long first = 0; first < nodes; first += kPart) order_.push_back(first);
  }
  /// place: where in memory the first cell of each node lies, in any unit; cells_are_shared: by the threads, who have the forces of their nodes at hand.
  NodeTeam(Team& team, const std::vector<long>& place, bool cells_are_shared) : NodeTeam(team, static_cast<long>(place.size())) {
    if (cells_are_shared) parts_of_a_thread_ = 4;  // some microseconds of work, and what it is about is in the caches already
    std::vector<double> mean(order_.size());
    for (std::size_t p = 0; p < order_.size(); ++p) {
      const long last = std::min(nodes_, order_[p] + kPart);
      for (long n = order_[p]; n < last; ++n) mean[p] += static_cast<double>(place[n]) / static_cast<double>(last - order_[p]);
    }
    std::stable_sort(order_.begin(), order_.end(), [&](long a, long b) { return mean[a / kPart] < mean[b / kPart]; });
  }

  /// Calls work(first, last) for the nodes of each part. Work must not throw.
  template <class Work> void share(Work&& work) const {
    team_->share(static_cast<long>(order_.size()), parts_of_a_thread_, [&](long begin, long end) { over(begin, end, work); });
  }
  /// Likewise; the largest of the numbers that work returns, at least 0.
  template <class Work> double largest(Work&& work) const {
    return team_->largest(static_cast<long>(order_.size()), parts_of_a_thread_, [&](long begin, long end) {
      double most = 0;
      over(begin, end, [&](long first, long last) { most = std::max(most, work(first, last)); });
      return most;
    });
  }

 private:
  template <class Work> void over(long begin, long end, Work&& work) const {
    for (long p = begin; p < end; ++p) work(order_[p], std::min(nodes_, order_[p] + kPart));
  }

  Team* team_;
  long nodes_;
  long parts_of_a_thread_ = kNodesOfAThread / kPart;  ///< fewer are not worth another thread
  std::vector<long> order_;  ///< first nodes of the parts
};

}  // namespace forming_sim
