// A sheet with a few thin cells among even ones, as a mesh generator leaves them where
// two features nearly meet: pulled beyond yield, with each limit of the step and with mass
// for the few. The reference is the same mesh with the element's limit.
#include <atomic>
#include <cmath>
#include <stdexcept>

#include "speed_error/problems.h"
#include "support/run_size.h"
#include "support/runs.h"

namespace forming_sim::bench {
namespace {

constexpr double kLength = 40e-3, kThickness = 2e-3;
constexpr int kAlong = 80, kThrough = 4;

/// Every 16th column is `thin` of the others' width.
Mesh mesh_with_slivers(const std::string& pattern, double thin) {
  BlankConfig blank = strip_of(kLength, kThickness, kAlong, kThrough);
  blank.pattern = pattern;
  Mesh mesh = generate_blank(blank);
  const double cell = kLength / kAlong;
  for (Vec3& X : mesh.nodes) {
    double gone = 0;
    for (int column = 8; column < kAlong; column += 16) gone += (1 - thin) * std::min(cell, std::max(0.0, X.x() - column * cell));
    X.x() -= gone;
  }
  return mesh;
}

OneBody pulled(const std::string& pattern, double thin) {
  OneBody run(body_of(mesh_with_slivers(pattern, thin), aluminium(true)), 2e-4);
  pull_right(run, {0, 5e-5, 1.5e-4, 2e-4}, {Vec3::Zero(), Vec3(10, 0, 0), Vec3(10, 0, 0), Vec3::Zero()});
  return run;
}

struct Pulled {
  RunSize size;
  std::vector<double> found;  ///< work, plastic dissipation, mean and largest plastic strain
  AddedMass added;
  double dt;
};

Pulled pull(const OneBody& run) {
  auto sim = run.start();
  const std::atomic<bool> go_on{false};
  const Outcome outcome = sim->run(go_on);
  if (outcome.code != Code::success) throw std::runtime_error("slivers: " + outcome.message);
  double mean = 0, most = 0;
  const std::vector<double> p = sim->plastic_strain();
  for (double value : p) mean += value / static_cast<double>(p.size()), most = std::max(most, value);
  const Energies& e = sim->energies();
  return {size_of(*sim),
          {e.work, e.plastic, mean, most},
          sim->added_mass(),
          sim->first_dt()};
}

}  // namespace

void slivers_problem(Report& report) {
  for (const std::string pattern : {"fine", "one_point"}) {
    const double thin = 0.1;
    OneBody run = pulled(pattern, thin), without = pulled(pattern, 1);
    run.plan.time_step.limit = without.plan.time_step.limit = "element";
    const double even = without.start()->dt();
    const Pulled reference = pull(run);
    report.begin("slivers, " + pattern, "a pulled strip with 5 of 80 columns a tenth as wide, against itself",
                 {{"work, J/m", reference.found[0], 0.02}, {"plastic dissipation, J/m", reference.found[1], 0.02},
                  {"mean plastic strain", reference.found[2], 0.02}, {"largest plastic strain", reference.found[3], 0.02}});
    report.add({"element", "as it is", reference.size, reference.found});
    for (const char* limit : {"node", "global"}) {
      run.plan.time_step.limit = limit;
      const Pulled found = pull(run);
      report.add({limit, "as it is", found.size, found.found});
    }
    for (const char* limit : {"node", "global"})
      for (double factor : {1., 1.5}) {
        run.plan.time_step.limit = limit;
        run.plan.time_step.raise_to = factor * even;
        run.plan.time_step.raise_limit = 10;
        const Pulled found = pull(run);
        char text[96];
        std::snprintf(text, sizeof text, "step of the even mesh x %.1f, mass + %.2g %%", factor, 100 * found.added.fraction);
        report.add({std::string("raised, ") + limit, text, found.size, found.found});
      }
    run.plan.time_step.raise_to = 0;
    run.plan.time_step.limit = "element";
    run.plan.time_step.mass_scaling = std::pow(even / reference.dt, 2);
    const Pulled scaled = pull(run);
    char text[64];
    std::snprintf(text, sizeof text, "all masses x %.3g", run.plan.time_step.mass_scaling);
    report.add({"uniform scaling", text, scaled.size, scaled.found});
  }
}

}  // namespace forming_sim::bench
