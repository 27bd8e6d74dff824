// forming_bench speed-error [PROBLEM ...]: what each choice of elements, mesh and time
// step gives for its time, on problems whose answer is known.
#include "problem_choice.h"
#include "speed_error/problems.h"

namespace forming_sim::bench {

std::vector<Row> speed_error(const Request& request) {
  Report report(request, "speed-error");
  run_problems(report, request.arguments,
               {{"bending", bending_problem},
                {"cook", cook_problem},
                {"taylor", taylor_problem},
                {"cube", cube_problem},
                {"sphere", sphere_problem},
                {"torsion", torsion_problem},
                {"impact", impact_problem},
                {"flange", flange_problem},
                {"flange-time", flange_time_problem},
                {"slivers", slivers_problem},
                {"layers", layers_problem},
                {"release", release_problem}});
  return report.finish();
}

}  // namespace forming_sim::bench
