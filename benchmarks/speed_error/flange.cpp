// The flange of scenes/flange.yaml: 20 mm of sheet folded over a die's edge and let go.
// There is no exact answer; the reference is the finest mesh.
#include "speed_error/flange.h"

#include <cmath>

#include "shipped_scene.h"
#include "speed_error/families.h"
#include "speed_error/peers.h"

namespace forming_sim::bench {
namespace {

/// The punch's impulse at the end of each part of its stage.
class PunchForce : public Observer {
 public:
  explicit PunchForce(double duration) : duration_(duration) {}
  void on_step(const Simulation& sim) override {
    while (static_cast<int>(force.size()) < kForceParts && sim.time() >= duration_ * static_cast<double>(force.size() + 1) / kForceParts) {
      const double impulse = sim.tools()[2].felt.impulse[1];  // die, pad, punch
      force.push_back((impulse - impulse_) / (sim.time() - time_));
      impulse_ = impulse;
      time_ = sim.time();
    }
  }
  std::vector<double> force;

 private:
  double duration_, impulse_ = 0, time_ = 0;
};

double largest(const std::vector<double>& values) {
  double most = 0;
  for (double value : values) most = std::max(most, std::abs(value));
  return most;
}

}  // namespace

Scene flange_scene(int through) {
  Scene scene = read_shipped("flange");
  BlankConfig& blank = *scene.bodies[0].blank;
  blank.cells_along = blank.cells_along * through / blank.cells_through;
  blank.cells_through = through;
  scene.output.frames = 2;
  scene.output.history_interval = scene.stages[0].duration / 10;
  return scene;
}

Flanged flange(const Scene& scene) {
  Flanged found;
  PunchForce punch(scene.stages[0].duration);
  Request scratch;
  try {
    const ShippedRun run(scene, "flange", scratch, &punch);
    const auto& s = run.summary;
    const BlankConfig& blank = *scene.bodies[0].blank;
    found.size = {static_cast<long>(blank.cells_along) * blank.cells_through, s["elements"], 2 * s["nodes"].get<long>(), s["steps"], s["wall_time_s"]};
    found.strain = s["surface_strain"]["at_end_of_forming"]["max"];
    found.springback = s["springback"]["change_deg"];
    found.kinetic_over_internal = s["energy_J"]["kinetic_over_internal_forming"];
    found.ledger = s["energy_J"]["balance_error"];
    found.crossings = s["contact"]["crossings"];
  } catch (const std::runtime_error& error) {
    found.failure = error.what();
  }
  found.force = punch.force;
  return found;
}

std::vector<Sought> flange_sought(const Flanged& reference) {
  if (!reference.failure.empty()) throw std::runtime_error("the reference: " + reference.failure);
  return {{"punch force, largest mean, N/m", largest(reference.force), 0.05},
          {"force curve, rms difference / rms", 0, 0.05},
          {"strain of the outer fibre", reference.strain, 0.05},
          {"springback, degrees", reference.springback, 0.05}};
}

void add_flange(Report& report, const std::string& choice, const std::string& mesh, const Flanged& run, const Flanged& reference) {
  if (!run.failure.empty()) return report.no_answer(choice + ", " + mesh, run.failure, run.size.wall_time, false);
  double off = 0, whole = 0;
  for (std::size_t i = 0; i < reference.force.size(); ++i) {
    off += std::pow(run.force.at(i) - reference.force[i], 2);
    whole += std::pow(reference.force[i], 2);
  }
  report.add({choice, mesh, run.size, {largest(run.force), std::sqrt(off / whole), run.strain, run.springback}});
}

void flange_problem(Report& report) {
  const Flanged finest = flange(flange_scene(7));
  report.begin("flange", "scenes/flange.yaml against its mesh of 7 cells through", flange_sought(finest));
  for (const Family& family : kFamilies) {
    if (family.dimension != 2) continue;
    for (int through : {2, 3, 5}) {
      Scene scene = flange_scene(through);
      if (is_free(family)) {
        const BlankConfig& blank = *scene.bodies[0].blank;
        Mesh strip = free_rectangle(blank.length, blank.thickness, blank.thickness / through);
        scene.bodies[0].mesh = inline_mesh(strip);
        scene.bodies[0].blank.reset();
      } else {
        scene.bodies[0].blank->pattern = family.pattern;
      }
      scene.bodies[0].pressure_average = family.average;
      add_flange(report, family.name, std::to_string(through) + " through", flange(scene), finest);
    }
  }
  for (int through : {4, 6}) {  // cells twice as long as high
    Scene scene = flange_scene(through);
    scene.bodies[0].blank->cells_along /= 2;
    add_flange(report, std::string(kFamilies[0].name) + ", twice as long as high", std::to_string(through) + " through", flange(scene), finest);
  }
  flange_by_calculix(report, finest);
}

}  // namespace forming_sim::bench
