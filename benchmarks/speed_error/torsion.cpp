// A round bar is twisted until most of it flows, and let go: error of the torque and of the twist that
// stays, on three meshes of every family in 3D.
#include "speed_error/families.h"
#include "speed_error/problems.h"
#include "support/torsion.h"

namespace forming_sim::bench {
namespace {

using namespace torsion;

void twisted(Report& report, const Family& family, int cells) {
  const double kept = 3 - exact_torque(3);
  const Twisted run = twist(cells, family.pattern, {1.5, 3, kept}, perfect());
  report.add({family.name, std::to_string(cells) + " a radius", run.size, {run.torque[0], run.torque[1], left_over(3, run.torque[1], kept, run.torque[2])}});
}

}  // namespace

void torsion_problem(Report& report) {
  report.begin("torsion", "Round bar, perfectly plastic, twisted to three times the twist of first yield and let go",
               {{"T/T_y at 1.5", exact_torque(1.5), 0.02}, {"T/T_y at 3", exact_torque(3), 0.02}, {"twist that stays/theta_y", 3 - exact_torque(3), 0.01}});
  for (const Family& family : kFamilies)
    for (int cells : {4, 8, 12})
      if (family.dimension == 3) twisted(report, family, cells);
}

}  // namespace forming_sim::bench
