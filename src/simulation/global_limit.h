#pragma once
// time_step.limit global: a bound on the frequencies of the whole mesh, found now and
// then by a Lanczos run (simulation/lanczos.h) and followed in between by the cells.
//
// Between two runs the stiffness K = sum_c K_c grows at most as that of its fastest
// growing cell. How much that is a cell's bound omega2_c tells but roughly: it is the nearer to
// the truth the flatter the cell, so that a mode of the mesh can gain on it. The square of its
// growth is taken,
//   omega^2 <= omega^2(then) (max over the cells of omega2_c(now)/omega2_c(then))^2,
// which makes rubber that is squeezed to half its height within one such interval keep below the
// truth (test/simulation/step_limit_test.cpp). The square is believed up to a growth of 3 % only: the bound of an even cell
// is level where a stretch without change of volume begins, and the mesh gains more than the square there.
// A run comes when the bound of some cell has risen by 3 %, after 2 steps for each product of the last run; when one has
// risen by 1 % or fallen by 5 %, after 20 steps for each; in any case after 100.
// What free simplices get from their guards comes on top (Elements::guard_limit): a sliver bears nothing until then, so that no run before knows of it.
#include <algorithm>
#include <vector>

#include "forming_sim/element/step_bounds.h"

namespace forming_sim {

class GlobalLimit {
 public:
  long estimates = 0, products = 0;

  bool due(long step, const CellRates& rates) const {
    if (estimates == 0 || step >= latest_) return true;
    if (step < unpaid_) return false;
    const Change change = since(rates);
    return change.most > kFarthest || (step >= soonest_ && (change.most > 1.01 || change.least < 0.95));
  }
  /// The next step asks for a run: something has changed that the cells do not tell.
  void forget() { latest_ = 0; }
  /// A run of `cost` products has found omega2, at these rates.
  void set(long step, double omega2, int cost, const CellRates& rates) {
    ++estimates;
    products += cost;
    omega2_ = omega2;
    then_.clear();
    each(rates, [&](double now) { then_.push_back(now); });
    unpaid_ = step + 2L * cost;
    soonest_ = step + 20L * cost;
    latest_ = step + 100L * cost;
  }
  /// Bound on omega^2 now, 1/s2.
  double omega2(const CellRates& rates) const {
    const double growth = since(rates).most;
    return omega2_ * growth * growth;
  }

  /// cells: number of entries of the rates.
  template <class Archive> void exchange(Archive& a, std::size_t cells) {
    then_.resize(cells);
    a.numbers(then_.data(), cells);
    for (long* value : {&estimates, &products, &unpaid_, &soonest_, &latest_}) a.number(*value);
    a.number(omega2_);
  }

 private:
  static constexpr double kFarthest = 1.03;  ///< growth of a cell's bound up to which its square is believed

  template <class Visit> static void each(const CellRates& rates, Visit&& visit) {
    for (const std::vector<BlockRates>& group : rates)
      for (const BlockRates& block : group)
        for (double now : block.omega2.value) visit(now);
  }
  /// Of the cells' bounds; `most` at least 1: cells that widen are believed at the next run.
  struct Change {
    double least = 1, most = 1;
  };
  Change since(const CellRates& rates) const {
    Change change;
    std::size_t k = 0;
    each(rates, [&](double now) {
      const double ratio = now / then_[k++];
      change.least = std::min(change.least, ratio);
      change.most = std::max(change.most, ratio);
    });
    return change;
  }

  double omega2_ = 0;
  std::vector<double> then_;  ///< omega2 of every cell at the last run, 1/s2
  long unpaid_ = 0, soonest_ = 0, latest_ = 0;
};

}  // namespace forming_sim
