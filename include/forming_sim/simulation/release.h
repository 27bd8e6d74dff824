#pragma once
// What stages are called, when a boundary lets go, and which tools a stage takes away.
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "forming_sim/simulation/config.h"

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

/// The stage takes the tool of this name away.
inline bool takes_away(const StageConfig& stage, const std::string& tool) {
  return stage.kind == "withdraw" && (stage.tools.empty() || std::find(stage.tools.begin(), stage.tools.end(), tool) != stage.tools.end());
}

}  // namespace forming_sim
