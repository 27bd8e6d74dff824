// The Taylor bar: a copper rod flattens on a wall at 227 m/s, plastic strains of some 3
// at the rim. Length and face radius as published, 3D (a quarter) and axisymmetric.
#include "speed_error/families.h"
#include "speed_error/peers.h"
#include "speed_error/problems.h"
#include "support/taylor.h"

namespace forming_sim::bench {
namespace {

void flattened(Report& report, const Family& family, int cells, double safety, const std::string& also = "") {
  OneBody setup = taylor_bar(family.dimension, cells, family.pattern, family.average);
  setup.plan.time_step.safety = safety;
  const std::string choice = std::string(family.dimension == 2 ? "axisymmetric, " : "quarter, ") + family.name + also;
  auto sim = setup.start();
  const std::atomic<bool> cancel{false};
  const Outcome outcome = sim->run(cancel);
  if (outcome.code != Code::success) return report.no_answer(choice, outcome.message, sim->wall_time(), false);
  const TaylorShape shape = taylor_shape(sim->positions(), family.dimension);
  report.add({choice, std::to_string(cells) + " a radius", size_of(*sim), {1e3 * shape.length, 1e3 * shape.radius}});
}

}  // namespace

void taylor_problem(Report& report) {
  report.begin("taylor", "Taylor bar of copper, 227 m/s", {{"length, mm", 21.42, 0.005}, {"face radius, mm", 7.22, 0.01}});
  for (const Family& family : kFamilies)
    for (int cells : family.dimension == 2 ? std::vector<int>{4, 8, 12} : std::vector<int>{3, 4, 6, 12}) {
      const std::string pattern = family.pattern;
      if (family.dimension == 3 && pattern != "one_point" && cells > (pattern == "fine" ? 4 : 6)) continue;
      flattened(report, family, cells, 0.9);
    }
  for (double safety : {0.6, 0.3}) flattened(report, kFamilies[0], 8, safety, ", step safety " + std::to_string(safety).substr(0, 3));
  taylor_by_calculix(report);
}

}  // namespace forming_sim::bench
