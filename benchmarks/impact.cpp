// A bar in uniaxial strain against a plane and against another bar.
#include "rows.h"
#include "support/bars.h"

namespace forming_sim::bench {

std::vector<Row> impact(const Request&) {
  std::vector<Row> rows;
  for (int cells : {20, 40, 80, 160}) {
    const Clock clock;
    const Impact found = hit_wall(cells, 0.9);
    const std::string name = "bar on a plane, " + std::to_string(cells) + " cells";
    rows.push_back(near(name, "pressure, Pa", found.pressure, kBarPressure, 0.002, clock.seconds()));
    rows.push_back(near(name, "duration, s", found.duration, kBarDuration, 0.02, clock.seconds()));
    rows.push_back(just(name, "restitution", found.restitution, clock.seconds()));
    rows.push_back(just(name, "balance error", found.balance, clock.seconds()));
  }
  for (int other : {40, 46, 80}) {
    const Clock clock;
    const Meeting found = hit_each_other(40, other);
    const std::string name = "two bars, 40 and " + std::to_string(other) + " cells";
    rows.push_back(near(name, "pressure, Pa", found.pressure, kBarPressure, 0.004, clock.seconds()));
    rows.push_back(near(name, "duration, s", found.duration, kBarDuration, 0.03, clock.seconds()));
    rows.push_back(just(name, "restitution", found.restitution, clock.seconds()));
    rows.push_back(at_most(name, "momentum of both / of one", found.momentum, 1e-11, clock.seconds()));
  }
  return rows;
}

}  // namespace forming_sim::bench
