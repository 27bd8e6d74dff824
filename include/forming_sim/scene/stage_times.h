#pragma once
// How long the stages of a scene may last.
#include <vector>

#include "forming_sim/scene/scene.h"

namespace forming_sim {

/// Simulated time to the end of the last stage, settle stages by their limits, s.
inline double longest_time(const std::vector<StageConfig>& stages) {
  double time = 0;
  for (const StageConfig& stage : stages) time += stage.kind == "settle" ? stage.limit : stage.duration;
  return time;
}

}  // namespace forming_sim
