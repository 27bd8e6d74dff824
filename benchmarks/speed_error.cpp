// forming_bench speed-error [PROBLEM ...]: what each choice of elements, mesh and time
// step gives for its time, on problems whose answer is known.
#include <algorithm>
#include <stdexcept>

#include "speed_error/report.h"

namespace forming_sim::bench {

std::vector<Row> speed_error(const Request& request) {
  struct Problem {
    const char* name;
    void (*run)(Report&);
  };
  constexpr Problem problems[] = {{"bending", bending_problem}, {"cook", cook_problem},     {"taylor", taylor_problem},
                                  {"cube", cube_problem},       {"sphere", sphere_problem}, {"torsion", torsion_problem}, {"impact", impact_problem},
                                  {"flange", flange_problem},   {"flange-time", flange_time_problem}, {"slivers", slivers_problem}, {"layers", layers_problem}};
  std::string known;
  for (const Problem& problem : problems) known += (known.empty() ? "" : ", ") + std::string(problem.name);
  const auto asked = [&](const std::string& name) {
    return std::find(request.arguments.begin(), request.arguments.end(), name) != request.arguments.end();
  };
  for (const std::string& name : request.arguments)
    if (std::none_of(std::begin(problems), std::end(problems), [&](const Problem& problem) { return name == problem.name; }))
      throw std::runtime_error("problem " + name + " is not one of " + known);
  Report report(request);
  for (const Problem& problem : problems)
    if (request.arguments.empty() || asked(problem.name)) problem.run(report);
  return report.finish();
}

}  // namespace forming_sim::bench
