#pragma once
// What stages are called, when what a scene gives begins and a boundary lets go, and which tools a stage takes away.
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "forming_sim/loads/config.h"
#include "forming_sim/simulation/config.h"
#include "forming_sim/simulation/stage_times.h"

namespace forming_sim {

/// Every stage by its own name: those without one take their kind, "form", then "form_2".
inline std::vector<StageConfig> named(std::vector<StageConfig> stages) {
  std::map<std::string, int> count;
  for (const StageConfig& stage : stages)
    if (!stage.name.empty()) count[stage.name] = 1;
  for (StageConfig& stage : stages) {
    if (!stage.name.empty()) continue;
    const int number = ++count[stage.kind];
    stage.name = number == 1 ? stage.kind : stage.kind + "_" + std::to_string(number);
  }
  return stages;
}

/// The stage at whose beginning a boundary with this `until` lets go, the one of that name after the first stage: its
/// index, or the number of stages where `until` is empty (it stays) or names no such stage.
/// stages: named.
inline int release_stage(const std::string& until, const std::vector<StageConfig>& stages) {
  const int count = static_cast<int>(stages.size());
  for (int k = 1; k < count && !until.empty(); ++k)
    if (stages[k].title() == until) return k;
  return count;
}

/// The stage with whose beginning what has this `since` begins: 0 where it is empty, or the number of stages where it names none.
/// stages: named.
inline int first_stage(const std::string& since, const std::vector<StageConfig>& stages) {
  return since.empty() || (!stages.empty() && stages[0].title() == since) ? 0 : release_stage(since, stages);
}

/// The boundary holds in this stage. stages: named.
inline bool holds_in(int stage, const BoundaryConfig& boundary, const std::vector<StageConfig>& stages) {
  return first_stage(boundary.since, stages) <= stage && stage < release_stage(boundary.until, stages);
}

/// When what has this `since` begins at the latest, s. stages: named.
inline double latest_begin(const std::string& since, const std::vector<StageConfig>& stages) {
  return longest_time({stages.begin(), stages.begin() + first_stage(since, stages)});
}

/// When at the earliest: stages that may end before their time take none.
inline double earliest_begin(const std::string& since, const std::vector<StageConfig>& stages) {
  double time = 0;
  for (int k = 0; k < first_stage(since, stages); ++k)
    if (stages[k].kind == "settle" ? stages[k].ends == "limit" : stages[k].until_stopped.empty()) time += longest_time(stages[k]);
  return time;
}

/// The stage takes the tool of this name away.
inline bool takes_away(const StageConfig& stage, const std::string& tool) {
  return stage.kind == "withdraw" && (stage.tools.empty() || std::find(stage.tools.begin(), stage.tools.end(), tool) != stage.tools.end());
}

}  // namespace forming_sim
