#pragma once
// How often the stable step is asked for again: often while the mesh changes
// fast, seldom while it does not.
#include <algorithm>

#include "forming_sim/simulation/observer.h"

namespace forming_sim {

struct StepControl {
  double stable_dt = 0;    ///< no safety, s
  int element = -1, node = -1;  ///< what limits it; neither: the whole mesh
  bool longer = false;     ///< than time_step.limit node allows
  int interval = 1, until_next = 0;

  bool due() const { return until_next <= 0; }
  void update(double dt) {
    const double ratio = stable_dt > 0 ? dt / stable_dt : 1;
    if (ratio < 0.99) interval = std::max(1, interval / 4);
    else if (ratio > 0.998) interval = std::min(64, interval * 2);
    stable_dt = dt;
    until_next = interval;
  }
};

}  // namespace forming_sim
