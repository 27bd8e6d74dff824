// A bar in uniaxial strain hits a rigid plane, and another bar whose mesh need not
// match: pressure rho c_p v for the time that a wave takes there and back.
#include "speed_error/problems.h"
#include "support/bars.h"

namespace forming_sim::bench {

void impact_problem(Report& report) {
  const std::vector<Sought> sought{{"pressure, Pa", kBarPressure, 0.004}, {"duration, s", kBarDuration, 0.03}, {"restitution", 1, 0.05}};
  report.begin("impact", "A bar in uniaxial strain hits a plane", sought);
  for (double safety : {0.9, 0.5, 0.2})
    for (int cells : {20, 40, 80, 160}) {
      if (safety < 0.9 && cells > 80) continue;
      const Impact found = hit_wall(cells, safety);
      report.add({"step safety " + std::to_string(safety).substr(0, 3), std::to_string(cells) + " along", found.run, {found.pressure, found.duration, found.restitution}});
    }
  report.begin("impact of two", "Two bars in uniaxial strain meet", sought);
  for (int other : {40, 46, 80}) {
    const Meeting found = hit_each_other(40, other);
    report.add({"40 cells and " + std::to_string(other), "40 along", found.run, {found.pressure, found.duration, found.restitution}});
  }
}

}  // namespace forming_sim::bench
