// The Taylor bar by CalculiX: explicit dynamics at the step that it chooses at the
// start, the quarter bar of bricks.
#include <algorithm>
#include <cmath>

#include "speed_error/peers.h"
#include "support/taylor.h"

namespace forming_sim::bench {

void taylor_by_calculix(Report& report) {
  if (!calculix_or_say(report)) return;
  for (const std::string type : {"C3D8", "C3D8R"})
    for (int cells : {3, 4}) {
      const std::string choice = "CalculiX " + type + ", explicit", mesh = std::to_string(cells) + " a radius";
      Deck deck(quarter_bar(cells, "coarse"), type);
      deck.material(copper());
      char text[400];
      std::snprintf(text, sizeof text,
                    "*BOUNDARY\nbottom, 3, 3\nsymmetry_x, 1, 1\nsymmetry_y, 2, 2\n*INITIAL CONDITIONS, TYPE=VELOCITY\nALL, 3, %g\n"
                    "*STEP, NLGEOM, INC=10000000\n*DYNAMIC, EXPLICIT\n1e-8, %g\n*NODE PRINT, NSET=ALL, FREQUENCY=10000000\nU\n*END STEP\n",
                    -1e3 * kTaylorSpeed, kTaylorTime);
      deck.steps = text;
      const CalculixRun run(deck, "taylor_" + std::to_string(cells) + "_" + type, report.request());
      const auto bad = [&](const std::string& why) { report.no_answer(choice + ", " + mesh, why, run.wall_time(), false); };
      if (run.failed()) {
        bad(run.failure());
        continue;
      }
      NodeField x;
      for (const std::vector<double>& row : run.last("displacements", "ALL").rows)
        x.push_back(node(deck.place(static_cast<int>(row.at(0))) + Vec3(row.at(1), row.at(2), row.at(3))));
      if (std::any_of(x.begin(), x.end(), [](const Node& n) { return !n.allFinite(); })) {
        bad("says \"Job finished\"; its displacements are not numbers");
        continue;
      }
      const TaylorShape shape = taylor_shape(x, 3);
      RunSize size = deck.size();
      size.elements = size.cells;
      size.steps = run.increments();
      size.wall_time = run.wall_time();
      report.add({choice, mesh, size, {shape.length, shape.radius}});
    }
}

}  // namespace forming_sim::bench
