// A thick sphere yields from inside: how far its inner wall has moved when the plastic
// front should stand at .6 and at .8 of the outer radius, and the pressure that brings the front there, as the elastic shell outside tells. Flow is
// confined by that shell, so that locking shows. Axisymmetric, and a third of an octant in 3D.
#include "support/sphere.h"

#include <cmath>
#include <optional>

#include "speed_error/families.h"
#include "speed_error/problems.h"

namespace forming_sim::bench {
namespace {

double mean_motion(const Simulation& sim, const std::vector<int>& wall) {
  double sum = 0;
  for (int n : wall) sum += vec3(sim.positions()[n]).norm() - vec3(sim.initial_positions()[n]).norm();
  return sum / static_cast<double>(wall.size());
}

/// What another quantity is when one that rises has risen to `target`, between two steps.
class Crossing {
 public:
  explicit Crossing(double target) : target_(target) {}
  void step(double now, double other) {
    if (!found_ && now >= target_) found_ = before_other_ + (other - before_other_) * (target_ - before_) / (now - before_);
    before_ = now;
    before_other_ = other;
  }
  const std::optional<double>& found() const { return found_; }

 private:
  double target_, before_ = 0, before_other_ = 0;
  std::optional<double> found_;
};

void yielded(Report& report, const Family& family, int cells, double safety, const std::string& also = "") {
  const double last = 1.035 * sphere::exact_pressure(0.8);  // the sphere bears 1.039 of it
  const bool flat = family.dimension == 2;
  OneBody run = flat ? sphere::section(cells, family.pattern, family.average) : sphere::pyramid(cells, family.pattern, family.average);
  const std::string inside = flat ? "left" : "bottom", outside = flat ? "right" : "top";
  sphere::press(run, inside, last, 1e2);
  run.plan.time_step.safety = safety;
  const Mesh& mesh = run.model.bodies[0].mesh;
  auto sim = run.start();
  Crossing wall[] = {Crossing(sphere::exact_pressure(0.6)), Crossing(sphere::exact_pressure(0.8))};
  Crossing front[] = {Crossing(sphere::exact_shell(0.6)), Crossing(sphere::exact_shell(0.8))};
  while (!(wall[1].found() && front[1].found()) && sim->step()) {
    const double pressure = last * std::min(1.0, sim->time() / sphere::kDuration);
    const double inner = mean_motion(*sim, mesh.sets.at(inside)), outer = mean_motion(*sim, mesh.sets.at(outside));
    for (Crossing& c : wall) c.step(pressure, inner);
    for (Crossing& c : front) c.step(outer, pressure);
  }
  std::vector<double> found;
  for (const Crossing& c : wall) found.push_back(1e3 * c.found().value());
  for (const Crossing& c : front) found.push_back(1e-6 * c.found().value_or(std::nan("")));
  report.add({std::string(flat ? "axisymmetric, " : "octant, ") + family.name + also, std::to_string(cells) + " through", size_of(*sim), found});
}

}  // namespace

void sphere_problem(Report& report) {
  report.begin("sphere", "Thick sphere yielding from inside",
               {{"u(a), front at .6 m, mm", 1e3 * sphere::exact_displacement(0.6), 0.02},
                {"u(a), front at .8 m, mm", 1e3 * sphere::exact_displacement(0.8), 0.02},
                {"pressure, front at .6 m, MPa", 1e-6 * sphere::exact_pressure(0.6), 0.01},
                {"pressure, front at .8 m, MPa", 1e-6 * sphere::exact_pressure(0.8), 0.01}});
  for (const Family& family : kFamilies)
    for (int cells : family.dimension == 2 ? std::vector<int>{4, 8, 16} : std::vector<int>{4, 8}) yielded(report, family, cells, 0.9);
  yielded(report, kFamilies[0], 8, 0.3, ", step safety 0.3");
}

}  // namespace forming_sim::bench
