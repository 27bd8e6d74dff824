#pragma once
// How often the stable step is asked for again: often while the mesh changes
// fast, seldom while it does not.
#include <algorithm>

#include "forming_sim/simulation/config.h"
#include "forming_sim/simulation/observer.h"

namespace forming_sim {

struct StepControl {
  double element_dt = 0;   ///< stable step of the limiting element, no safety, s
  int element = -1;
  int interval = 1, until_next = 0;

  bool due() const { return until_next <= 0; }
  void update(double dt, int limiting) {
    const double ratio = element_dt > 0 ? dt / element_dt : 1;
    if (ratio < 0.99) interval = std::max(1, interval / 4);
    else if (ratio > 0.998) interval = std::min(kLongestBoundInterval, interval * 2);
    element_dt = dt;
    element = limiting;
    until_next = interval;
  }
};

}  // namespace forming_sim
