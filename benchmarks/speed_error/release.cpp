// A sheet bent evenly to k t = .02, where a thin skin flows and two fifths spring back, is let go: in one step, or while what held it
// fades. A wave of bending runs along the sheet, and near the moment of flow little is needed to make it flow anew.
#include "speed_error/problems.h"
#include "support/bent_strip.h"
#include "support/run_size.h"

namespace forming_sim::bench {

void release_problem(Report& report) {
  report.begin("release", "A bent strip is let go", {{"curvature kept, perfectly plastic", kKeptPerfect, 0.01}, {"curvature kept, Voce hardening", kKeptVoce, 0.01}});
  const double own = 6.2 * 0.02 * 0.02 / (kBentThickness * std::sqrt(aluminium().E() / aluminium().density));  // s, the default of release_time but for the width of the diagonal
  const auto add = [&](const std::string& name, const std::string& release, double time) {
    const auto run = [&](OneBody strip) {
      strip.plan.stages.back().release = release;
      strip.plan.stages.back().release_time = time;
      return strip.start();
    };
    const auto perfect = run(bent_strip(perfect_aluminium())), voce = run(bent_strip(aluminium(true)));
    const double kept = let_go(*perfect).curvature;
    report.add({"4 crossed triangles", name, size_of(*perfect), {kept, let_go(*voce).curvature}});
  };
  add("at once", "sudden", 0);
  for (double part : {1. / 16, 1. / 4, 1. / 2, 2.}) add("release_time times " + std::to_string(part).substr(0, 6), "gradual", part * own);
  add("release_time as it is", "gradual", 0);
}

}  // namespace forming_sim::bench
