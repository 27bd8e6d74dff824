// The patch test: two blocks whose meshes match or do not, the finer one above or below, by mesh, by h0 and by the sweeps of a step.
#include "support/patch.h"

#include "contact_exact/choice.h"
#include "contact_exact/problems.h"

namespace forming_sim::bench {
namespace {

void pressed(Report& report, const std::string& choice, const std::string& mesh, const patch::Blocks& blocks, double fineness) {
  const patch::Found found = patch::press(blocks);
  report.add({choice, mesh, found.run, {found.mean, found.spread, found.worst}, "", fineness});
}

}  // namespace

void patch_problem(Report& report) {
  const std::vector<Sought> sought{{"mean stress / exact", 1, 5e-4, kNothing}, {"rms of the stress", 0, 2e-3, kNothing}, {"worst cell", 0, 0.02, kNothing}};
  struct Kind {
    const char* name;
    int dimension;
    bool axisymmetric;
  };
  constexpr Kind kinds[] = {{"2D", 2, false}, {"axisymmetric", 2, true}, {"3D", 3, false}};
  struct Pair {
    const char* name;
    int lower, upper;
  };
  constexpr Pair pairs[] = {{"same", 4, 4}, {"4 on 6", 6, 4}, {"6 on 4", 4, 6}, {"5 on 7", 7, 5}, {"7 on 5", 5, 7}};
  const auto blocks_of = [](const Kind& kind, int lower, int upper) {
    patch::Blocks blocks;
    blocks.dimension = kind.dimension;
    blocks.axisymmetric = kind.axisymmetric;
    blocks.lower = lower;
    blocks.upper = upper;
    return blocks;
  };
  report.begin("patch", "Two blocks pressed together, matching meshes and others", sought, "times as many cells");
  for (const Kind& kind : kinds)
    for (const Pair& pair : pairs)
      for (int times : {1, 2, 4}) {
        if (kind.dimension == 3 && times > 2) continue;
        const patch::Blocks blocks = blocks_of(kind, times * pair.lower, times * pair.upper);
        pressed(report, std::string(kind.name) + ", " + pair.name, words("%d on %d", blocks.upper, blocks.lower), blocks, times);
      }
  report.begin("patch by layer", "Two blocks pressed together: layer", sought, "");
  for (const Kind& kind : kinds)
    for (double layer : {1e-3, 1e-4, 1e-5, 1e-6}) {
      patch::Blocks blocks = blocks_of(kind, 7, 5);
      blocks.layer = layer;
      pressed(report, std::string(kind.name) + ", 5 on 7", words("h0 %g m", layer), blocks, 0);
    }
  report.begin("patch by sweeps", "Two blocks pressed together: contact.max_sweeps", sought, "");
  for (const Kind& kind : kinds)
    for (int sweeps : {25, 100, 400, 1000}) {
      patch::Blocks blocks = blocks_of(kind, 7, 5);
      blocks.max_sweeps = sweeps;
      pressed(report, std::string(kind.name) + ", 5 on 7", words("at most %d", sweeps), blocks, 0);
    }
}

}  // namespace forming_sim::bench
