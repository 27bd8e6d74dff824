#pragma once
// Runs the problems that were asked for, all where none was.
#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "report.h"

namespace forming_sim::bench {

struct Problem {
  const char* name;
  void (*run)(Report&);
};

/// Throws std::runtime_error, before any runs, for a name that no problem has.
inline void run_problems(Report& report, const std::vector<std::string>& asked, const std::vector<Problem>& problems) {
  std::string known;
  for (const Problem& problem : problems) known += (known.empty() ? "" : ", ") + std::string(problem.name);
  for (const std::string& name : asked)
    if (std::none_of(problems.begin(), problems.end(), [&](const Problem& problem) { return name == problem.name; }))
      throw std::runtime_error("problem " + name + " is not one of " + known);
  for (const Problem& problem : problems)
    if (asked.empty() || std::find(asked.begin(), asked.end(), problem.name) != asked.end()) problem.run(report);
}

}  // namespace forming_sim::bench
