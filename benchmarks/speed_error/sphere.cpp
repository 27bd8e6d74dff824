// A thick sphere yields from inside: how far its inner wall has moved when the plastic
// front should stand at .6 and at .8 of the outer radius. Flow is confined by the
// elastic shell, so that locking shows. Axisymmetric, and a third of an octant in 3D.
#include "support/sphere.h"

#include "speed_error/families.h"
#include "speed_error/report.h"

namespace forming_sim::bench {
namespace {

double mean_motion(const Simulation& sim, const std::vector<int>& wall) {
  double sum = 0;
  for (int n : wall) sum += vec3(sim.positions()[n]).norm() - vec3(sim.initial_positions()[n]).norm();
  return sum / static_cast<double>(wall.size());
}

void yielded(Report& report, const Family& family, int cells, double safety, const std::string& also = "") {
  const double fronts[] = {0.6, 0.8}, last = sphere::exact_pressure(0.85);
  const bool flat = family.dimension == 2;
  OneBody run = flat ? sphere::section(cells, family.pattern, family.average) : sphere::pyramid(cells, family.pattern, family.average);
  const std::string inside = flat ? "left" : "bottom";
  sphere::press(run, inside, last, 1e2);
  run.plan.time_step.safety = safety;
  const Mesh& mesh = run.model.bodies[0].mesh;
  auto sim = run.start();
  std::vector<double> found;
  double before = 0, time_before = 0;
  while (found.size() < 2 && sim->step()) {
    const double at = sphere::kDuration * sphere::exact_pressure(fronts[found.size()]) / last, now = mean_motion(*sim, mesh.sets.at(inside));
    if (sim->time() >= at) found.push_back(1e3 * (before + (now - before) * (at - time_before) / (sim->time() - time_before)));
    before = now;
    time_before = sim->time();
  }
  report.add({std::string(flat ? "axisymmetric, " : "octant, ") + family.name + also, std::to_string(cells) + " through", size_of(*sim), found});
}

}  // namespace

void sphere_problem(Report& report) {
  report.begin("sphere", "Thick sphere yielding from inside",
               {{"u(a), front at .6 m, mm", 1e3 * sphere::exact_displacement(0.6), 0.02}, {"u(a), front at .8 m, mm", 1e3 * sphere::exact_displacement(0.8), 0.02}});
  for (const Family& family : kFamilies)
    for (int cells : family.dimension == 2 ? std::vector<int>{4, 8, 16} : std::vector<int>{4, 8}) yielded(report, family, cells, 0.9);
  yielded(report, kFamilies[0], 8, 0.3, ", step safety 0.3");
}

}  // namespace forming_sim::bench
