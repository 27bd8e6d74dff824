// Materials at the edge: nearly incompressible, strained beyond 3, pressed to nothing.
#include <cmath>

#include "stability/stability.h"

namespace forming_sim::bench {
namespace {

BoundaryConfig driven(const std::string& set, const std::vector<std::string>& axes, const std::vector<double>& times, const std::vector<Vec3>& velocities) {
  BoundaryConfig b;
  b.set = set;
  b.kind = times.empty() ? "fixed" : "velocity";
  b.axes = axes;
  b.times = times;
  b.velocities = velocities;
  return b;
}

/// Of the cells, whose simplices are alike at the start: it is the cell that has a pressure.
double farthest_volume(const Simulation& sim) {
  const int simplices = shape_of(sim.model().bodies[0].mesh.cells[0].kind).simplices;
  const std::vector<double> ratio = sim.volume_ratio();
  double off = 0;
  for (std::size_t e = 0; e < ratio.size(); e += simplices) {
    double mean = 0;
    for (int i = 0; i < simplices; ++i) mean += ratio[e + i] / simplices;
    off = std::max(off, std::abs(mean - 1));
  }
  return off;
}

MaterialConfig hardening(double nu) {
  MaterialConfig m = aluminium();
  m.poissons_ratio = nu;
  m.hardening.emplace();
  m.hardening->curve = "linear";
  m.hardening->yield_stress = 200e6;
  m.hardening->modulus = 100e6;
  return m;
}

/// A block, plane strain, its ends pressed together evenly: the height falls from H to H exp(-strain), the
/// sides are free. The true strain rate is even where the speed falls with the height.
OneBody pressed(const std::string& pattern, const MaterialConfig& material, double strain, double duration) {
  BlankConfig blank = strip_of(1e-2, 1e-2, 4, 8);
  blank.pattern = pattern;
  OneBody run(body_of(generate_blank(blank), material), duration);
  std::vector<double> times;
  std::vector<Vec3> velocities;
  for (int k = 0; k <= 200; ++k) {
    times.push_back(duration * k / 200);
    velocities.push_back(Vec3(0, -1e-2 * strain / duration * std::exp(-strain * k / 200), 0));
  }
  run.plan.bodies[0].boundaries = {driven("left", {"x"}, {}, {}), driven("bottom", {"y"}, {}, {}), driven("top", {"y"}, times, velocities)};
  return run;
}

}  // namespace

std::vector<Row> nearly_incompressible(const Request&) {
  std::vector<Row> rows;
  for (const bool plastic : {false, true})
    for (const char* pattern : {"fine", "coarse"}) {
      MaterialConfig material = plastic ? hardening(0.4999) : aluminium();
      material.poissons_ratio = 0.4999;
      if (!plastic) material.youngs_modulus = 1e8;  // rubber-like: large strain at the loads of a pull
      const std::string name = std::string("nu .4999, ") + (plastic ? "plastic, " : "elastic, ") + pattern;
      BlankConfig blank = strip_of(2e-2, 1e-2, 8, 4);
      blank.pattern = pattern;
      const double duration = plastic ? 1e-3 : 4e-3;
      OneBody run(body_of(generate_blank(blank), material), duration);
      run.plan.time_step.damping = 1e3;
      // Both ends are gripped: the sheet necks in between, which an element that locks cannot.
      run.plan.bodies[0].boundaries = {driven("left", {}, {}, {}), driven("right", {}, {0, duration / 2, duration}, {Vec3(0, 0, 0), Vec3(8e-3 / duration, 0, 0), Vec3(0, 0, 0)})};
      const auto sim = tried(rows, name, run, 1e-3);
      rows.push_back(at_most(name, "farthest V/V0 from 1 of a cell", farthest_volume(*sim), 2e-3, sim->wall_time()));
    }
  return rows;
}

std::vector<Row> large_strain(const Request&) {
  std::vector<Row> rows;
  for (const char* pattern : {"fine", "coarse"}) {
    const std::string name = std::string("pressed to log strain 3.2, ") + pattern;
    const double strain = 3.2;
    const auto sim = tried(rows, name, pressed(pattern, hardening(0.34), strain, 4e-3), 5e-3);
    double least = 1e9, low = 1, high = -1;
    for (double p : sim->plastic_strain()) least = std::min(least, p);
    for (const Node& x : sim->positions()) low = std::min(low, x[1]), high = std::max(high, x[1]);
    // Even plane-strain compression: 2/sqrt 3 of the log strain, a little less for what is elastic.
    rows.push_back(near(name, "plastic strain, least", least, 2 / std::sqrt(3.) * strain, 0.03, sim->wall_time()));
    rows.push_back(near(name, "height, m", high - low, 1e-2 * std::exp(-strain), 1e-3, sim->wall_time()));
  }
  // The ends are driven through each other: no material survives that, and the run must say so.
  const double duration = 1e-4;
  OneBody through = pressed("fine", hardening(0.34), 1, duration);
  through.plan.bodies[0].boundaries.back() = driven("top", {"y"}, {0, duration}, {Vec3(0, -150, 0), Vec3(0, -150, 0)});
  tried(rows, "pressed past nothing", through, 1, Code::mesh_error);
  return rows;
}

}  // namespace forming_sim::bench
