#pragma once
// How long the stages of a scene may last.
#include <vector>

#include "forming_sim/simulation/config.h"

namespace forming_sim {

/// Longest time of a stage, of settle stages their limit, s.
inline double longest_time(const StageConfig& stage) { return stage.kind == "settle" ? stage.limit : stage.duration; }

/// Simulated time to the end of the last stage, settle stages by their limits, s.
inline double longest_time(const std::vector<StageConfig>& stages) {
  double time = 0;
  for (const StageConfig& stage : stages) time += longest_time(stage);
  return time;
}

}  // namespace forming_sim
