// forming_bench contact exact [PROBLEM ...].
#include "contact_exact/problems.h"
#include "problem_choice.h"

namespace forming_sim::bench {

std::vector<Row> contact_exact(const Request& request) {
  Report report(request, "contact-exact");
  run_problems(report, request.arguments,
               {{"bounce", bounce_problem},
                {"bars", bars_problem},
                {"hertz", hertz_line_problem},
                {"hertz-sphere", hertz_sphere_problem},
                {"patch", patch_problem},
                {"capstan", capstan_problem},
                {"incline", incline_problem}});
  return report.finish();
}

}  // namespace forming_sim::bench
