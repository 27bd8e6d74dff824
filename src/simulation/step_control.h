#pragma once
// How often the stable step is asked for again: often while the mesh changes
// fast, seldom while it does not.
#include <algorithm>

#include "forming_sim/simulation/config.h"
#include "forming_sim/simulation/observer.h"

namespace forming_sim {

struct StepControl {
  double stable_dt = 0;    ///< no safety, s
  int element = -1, node = -1;  ///< what limits it; neither: the whole mesh
  bool longer = false;     ///< than time_step.limit node allows
  double bound = 0;        ///< what was found last, s
  int interval = 1, until_next = 0;

  template <class Archive> void exchange(Archive& a) {
    a.number(stable_dt);
    a.number(element);
    a.number(node);
    a.number(longer);
    a.number(bound);
    a.number(interval);
    a.number(until_next);
  }

  bool due() const { return until_next <= 0; }
  /// Something has come that the last bound did not foresee: ask at once, and again after one step.
  void hurry() { interval = 1, until_next = 0; }
  /// dt: the bound now. close: it has little to spare, and is taken for what it will have fallen to
  /// by the next time if it goes on falling as it did since the last.
  void update(double dt, bool close) {
    const double ratio = bound > 0 ? dt / bound : 1, fall = std::max(0.0, 1 - ratio) / interval;
    if (ratio < 0.99) interval = std::max(1, interval / 4);
    else if (ratio > 0.998) interval = std::min(kLongestBoundInterval, interval * 2);
    bound = stable_dt = dt;
    if (close) {
      interval = std::min(interval, kLongestBoundInterval / 2);
      while (interval > 1 && fall * interval > 0.01) interval /= 2;
      stable_dt = dt * std::max(0.9, 1 - fall * interval);
    }
    until_next = interval;
  }
};

}  // namespace forming_sim
