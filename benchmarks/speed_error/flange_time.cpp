// What is paid for less time on the flange: mass scaling, faster tools, a shorter or
// longer step, each against the same mesh without.
#include <cmath>

#include "speed_error/flange.h"

namespace forming_sim::bench {
namespace {

constexpr int kThrough = 4;

std::string text(double value) {
  char text[24];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

}  // namespace

void flange_time_problem(Report& report) {
  const Scene shipped = flange_scene(kThrough);
  const Flanged reference = flange(shipped);
  report.begin("flange-time", "scenes/flange.yaml, 4 cells through, against itself without mass scaling", flange_sought(reference));
  const auto add = [&](const std::string& choice, double factor, const Scene& scene) {
    const Flanged run = flange(scene);
    add_flange(report, choice, "x " + text(factor) + ", kinetic/internal at its peak " + text(run.kinetic_over_internal), run, reference);
  };
  add_flange(report, "as it is", "kinetic/internal at its peak " + text(reference.kinetic_over_internal), reference, reference);
  for (double factor : {4., 25., 100., 400.}) {
    Scene scene = shipped;
    scene.time_step.mass_scaling = factor;
    scene.stages.back().limit *= std::sqrt(factor);  // it swings the slower
    add("mass scaling", factor, scene);
  }
  for (double factor : {0.5, 2., 5., 10.}) {
    Scene scene = shipped;
    for (double& time : scene.tools[2].motion->times) time /= factor;
    scene.output.history_interval /= factor;  // its rows are where the kinetic energy is looked at
    for (StageConfig& stage : scene.stages)
      if (stage.kind != "settle") stage.duration /= factor;
    add("tool speed", factor, scene);
  }
  for (const char* limit : {"element", "node"}) {
    Scene scene = shipped;
    scene.time_step.limit = limit;
    add(std::string("step limit ") + limit, 1, scene);
  }
  for (double safety : {0.5}) {
    Scene scene = shipped;
    scene.time_step.safety = safety;
    add("step safety", safety, scene);
  }
}

}  // namespace forming_sim::bench
