// What swings freely for long in the time loop of a run, with the default time step: energy must not come from nowhere.
#include "stability/stability.h"

namespace forming_sim::bench {
namespace {

struct Family {
  const char* pattern;
  int dimension;
};
constexpr Family kFamilies[] = {{"fine", 2}, {"coarse", 2}, {"one_point", 2}, {"fine", 3}, {"coarse", 3}, {"one_point", 3}};

BlankConfig blank_of(const Family& family, double length, double width, double thickness, int along, int across, int through) {
  BlankConfig blank = strip_of(length, thickness, along, through);
  blank.pattern = family.pattern;
  if (family.dimension == 3) blank.shape = "plate", blank.width = width, blank.cells_across = across;
  return blank;
}

std::string name_of(const char* what, const Family& family) { return std::string(what) + ", " + family.pattern + ", " + std::to_string(family.dimension) + "D"; }

void count_steps(std::vector<Row>& rows, const std::string& name, const Simulation& sim) {
  rows.push_back(just(name, "steps", static_cast<double>(sim.steps()), sim.wall_time()));
}

}  // namespace

std::vector<Row> free_swings(const Request&) {
  std::vector<Row> rows;
  const double side = 10e-3;
  for (const Family& family : kFamilies) {
    const std::string name = name_of("a block under a pressure that came at once", family);
    OneBody run(body_of(generate_blank(blank_of(family, side, side, side, 3, 3, 3)), aluminium()), 1);
    PressureConfig pressure;
    pressure.set = "top";
    pressure.times = {0};
    pressure.values = {100e6};
    run.plan.bodies[0].pressures = {pressure};
    run.plan.bodies[0].boundaries = {symmetric("bottom", Vec3::Unit(family.dimension - 1))};
    run.plan.stages[0].duration = 2e5 * run.start()->dt();
    count_steps(rows, name, *tried(rows, name, run, 2e-3));
  }
  for (const Family& family : kFamilies) {
    const std::string name = name_of("a sheet pulled beyond yield and let go at once", family);
    OneBody run(body_of(generate_blank(blank_of(family, 20e-3, 10e-3, 5e-3, 8, 4, 2)), aluminium(true)), 40e-6);
    pull_right(run, {0}, {Vec3(10, 0, 0)});
    run.plan.bodies[0].boundaries[1].until = "free";
    run.plan.stages.push_back(form_for(1e5 * run.start()->dt()));
    run.plan.stages[1].name = "free";
    run.plan.stages[1].release = "sudden";
    const auto sim = tried(rows, name, run, 1e-2);
    rows.push_back(at_most(name, "plastic work over all work", sim->energies().plastic / sim->energies().work, 1, sim->wall_time()));
    count_steps(rows, name, *sim);
  }
  return rows;
}

}  // namespace forming_sim::bench
