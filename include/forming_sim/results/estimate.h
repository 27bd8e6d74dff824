#pragma once
// What a run will cost, told before it starts.
#include <string>

#include "forming_sim/simulation/simulation.h"

namespace forming_sim {

struct Estimate {
  long nodes = 0, elements = 0;
  double time_step_s = 0;        ///< mean of the measured steps, at the start of the run
  bool settles = false;          ///< has a settle stage
  long steps = 0;                ///< settle stages by their limits: an upper bound there
  long settling_steps = 0;       ///< of these those of settle stages
  double wall_time_s = 0;        ///< of the solver at the measured speed; contact that comes later, measuring and writing are not in it
  double memory_bytes = 0;       ///< of the solver's data
  std::string broken;            ///< with what one of the steps ended that were taken to measure; empty: with none
};

/// Takes some dozens of real steps of a simulation at its start.
Estimate estimate_run(Simulation& simulation);

/// A few lines for a terminal.
std::string estimate_text(const Estimate& estimate);

}  // namespace forming_sim
