// Figure 20: a nearly incompressible hyperelastic solid (3.74), folded until it touches
// itself in several places, and released.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "forming_sim/simulation/simulation.h"
#include "paper/figures.h"
#include "shipped_scene.h"

namespace forming_sim::bench {
namespace {

/// Looks at the strip where it is folded most (the end of the first stage) and at the end.
class Fold : public Observer {
 public:
  void on_stage_end(const Simulation& s, int index) override {
    if (index != 0) return;
    time = s.time();
    volume_error = std::abs(volume(s, s.positions()) / volume(s, s.initial_positions()) - 1);
    // Nodes that feel a pressure where no tool is near: the strip touches itself there.
    const std::vector<double> pressure = s.contact_pressure();
    for (std::size_t n = 0; n < s.positions().size(); ++n) {
      if (!(pressure[n] > 0)) continue;
      double nearest = 1e300;
      for (std::size_t k = 0; k < s.tools().size(); ++k) {
        const Vec3 point = s.model().tools[k].point + s.tools()[k].position;
        nearest = std::min(nearest, std::abs(s.model().tools[k].normal.dot(vec3(s.positions()[n]) - point)));
      }
      touching += nearest > 20 * s.contact_status().layer;
    }
  }
  void on_end(const Simulation& s, Code, const std::string&) override {
    for (std::size_t n = 0; n < s.positions().size(); ++n)
      left = std::max(left, vec3(s.positions()[n] - s.initial_positions()[n]).norm());
  }
  double time = 0, volume_error = 0, left = 0;
  int touching = 0;

 private:
  static double volume(const Simulation& s, const NodeField& x) {
    double sum = 0;
    for (const auto& corner : s.elements()) {
      Mat3 edges;
      for (int m = 0; m < 3; ++m) edges.col(m) = vec3(x[corner[m + 1]] - x[corner[0]]);
      sum += edges.determinant() / 6;
    }
    return sum;
  }
};

}  // namespace

std::vector<Row> figure_20(const Request& request) {
  Fold fold;
  const std::string name = "figure 20, scenes/folded_rubber.yaml";
  const ShippedRun run("folded_rubber", request, &fold);
  const auto& s = run.summary;
  const double time = run.wall_time;
  run.draw("mises", fold.time, "figure_20_folded.png");
  run.draw("mises", s["sim_time_s"], "figure_20_released.png");
  Row touching = just(name, "nodes that touch the strip itself", fold.touching, time);
  touching.holds = fold.touching > 0;
  Row gap = just(name, "void layer: smallest gap over h0", s["contact"]["min_gap_over_h0"], time);
  gap.holds = gap.found > 0;
  return {touching, gap,
          at_most(name, "crossings", s["contact"]["crossings"], 0, time),
          at_most(name, "volume of the strip, change when folded", fold.volume_error, 0.02, time),
          at_most(name, "largest displacement left / length", fold.left / 0.060, 1e-4, time),
          at_most(name, "elastic energy left over work", s["energy_J"]["elastic"].get<double>() / s["energy_J"]["work"].get<double>(), 1e-6, time),
          at_most(name, "ledger error over work", s["energy_J"]["balance_error"], 1e-3, time)};
}

}  // namespace forming_sim::bench
