// Cook's membrane by CalculiX: static, one layer of bricks held in plane strain.
#include "support/cook.h"
#include "speed_error/peers.h"

namespace forming_sim::bench {

void cook_by_calculix(Report& report) {
  if (!calculix_or_say(report)) return;
  for (const std::string type : {"C3D8", "C3D8I", "C3D20R"})
    for (int cells : {4, 8, 16}) {
      if (cells > 8 && type == "C3D20R") continue;  // a minute
      const std::string choice = "CalculiX " + type, mesh_name = std::to_string(cells) + " x " + std::to_string(cells);
      const Mesh mesh = membrane(cells, "coarse");
      Deck deck(mesh, type, 1e-3);
      deck.material(cook_material());
      deck.node_set("corner", deck.numbers(upper_right(mesh)));
      deck.steps += "*BOUNDARY\nleft, 1, 2\n*STEP, NLGEOM, INC=1000\n*STATIC\n0.05, 1.\n";
      deck.traction("right", 2, kCookTraction);
      deck.steps += "*NODE PRINT, NSET=corner\nU\n*END STEP\n";
      const CalculixRun run(deck, "cook_" + type + "_" + std::to_string(cells), report.request());
      if (run.failed()) {
        report.no_answer(choice + ", " + mesh_name, run.failure(), run.wall_time(), false);
        continue;
      }
      RunSize size = deck.size();
      size.steps = run.increments();
      size.wall_time = run.wall_time();
      report.add({choice, mesh_name, size, {run.last("displacements", "CORNER").rows.at(0).at(2)}});
    }
}

}  // namespace forming_sim::bench
