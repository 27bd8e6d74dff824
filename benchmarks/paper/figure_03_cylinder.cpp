// Figure 3: a cylinder with free sides pulled, pushed and pulled, perfect plasticity.
//
// The paper gives E, nu and eps_s. Chosen here: a cylinder of radius 10 mm and length
// 20 mm, of which a quarter is meshed (6 tetrahedra a cell, one pressure a cell); its
// lower end slides on a plane of symmetry, the upper one is moved along z between rests at
// nominal strain 0, .03, -.03, .03 with smooth velocities of at most .6 m/s, so that
// inertia and damping carry about 1e-4 of the stress: density 2700 kg/m3, damping 5e3 1/s.
#include <atomic>
#include <cmath>

#include "figures.h"
#include "levels.h"
#include "support/runs.h"

namespace forming_sim::bench {
namespace {

constexpr double kRadius = 10e-3, kLength = 20e-3, kAmplitude = 0.03;
const std::vector<double> kTimes{0, 1e-3, 2e-3, 4e-3, 6e-3, 8e-3, 10e-3};  // s
constexpr double kSpeed = 2 * kAmplitude * kLength / 2e-3;                 // m/s: a rise and fall over T travels T speed/2

struct Moment {
  double strain, stress, nominal;  ///< x/X - 1; force over current area, over initial area
};

OneBody cylinder() {
  BlankConfig bar;
  bar.shape = "bar";
  bar.portion = "quarter";
  bar.pattern = "coarse";
  bar.radius = kRadius;
  bar.length = kLength;
  bar.cells_radius = 3;
  bar.cells_along = 4;
  OneBody run(body_of(generate_blank(bar), paper_material({.01})), kTimes.back());
  auto& boundaries = run.plan.bodies[0].boundaries;
  const char* planes[] = {"symmetry_x", "symmetry_y", "bottom"};
  for (int axis = 0; axis < 3; ++axis) boundaries.push_back(symmetric(planes[axis], Vec3::Unit(axis)));
  BoundaryConfig top;
  top.set = "top";
  top.kind = "velocity";
  top.axes = {"z"};
  top.times = kTimes;
  for (double v : {0., 1., 0., -1., 0., 1., 0.}) top.velocities.push_back(Vec3(0, 0, v * kSpeed));
  top.profile = "smooth";
  boundaries.push_back(top);
  run.plan.time_step.damping = 5e3;
  return run;
}

double volume(const NodeField& x, const std::array<int, 4>& s) {
  const Vec3 a = vec3(x[s[0]]);
  return (vec3(x[s[1]]) - a).cross(vec3(x[s[2]]) - a).dot(vec3(x[s[3]]) - a) / 6;
}

/// With free sides the sum of sigma_zz over the volume is the axial force times the length.
Moment observe(const Simulation& sim, double volume_at_start) {
  const auto stress = sim.stress();
  double force_length = 0, all = 0, top = 0;
  for (std::size_t i = 0; i < stress.size(); ++i) {
    const double V = std::fabs(volume(sim.positions(), sim.elements()[i]));
    force_length += stress[i][2] * V;
    all += V;
  }
  for (const Node& n : sim.positions()) top = std::max(top, n[2]);
  return {top / kLength - 1, force_length / all, force_length / top / (volume_at_start / kLength)};
}

/// Slope of stress over log strain between two stresses of a branch, by its end points.
double slope(const std::vector<Moment>& branch, double low, double high) {
  const Moment *first = nullptr, *last = nullptr;
  for (const Moment& m : branch)
    if (m.stress > low && m.stress < high) {
      if (!first) first = &m;
      last = &m;
    }
  if (!first || first == last) return kNothing;
  return (last->stress - first->stress) / (std::log1p(last->strain) - std::log1p(first->strain));
}

}  // namespace

std::vector<Row> figure_3(const Request& request) {
  const Clock clock;
  auto sim = cylinder().start();
  double volume_at_start = 0;
  for (const auto& s : sim->elements()) volume_at_start += std::fabs(volume(sim->positions(), s));
  std::vector<Moment> branches[3];  // up, down, up
  const double turns[] = {kTimes[2], kTimes[4], kTimes[6]}, every = 2e-5;
  double next = 0, kinetic = 0;
  while (sim->step()) {
    if (sim->time() < next) continue;
    next += every;
    int b = 0;
    while (b < 2 && sim->time() > turns[b]) ++b;
    branches[b].push_back(observe(*sim, volume_at_start));
    const Energies& e = sim->energies();
    if (e.elastic > 0.1 * volume_at_start * 5e6) kinetic = std::max(kinetic, e.kinetic / e.elastic);
  }
  const double time = clock.seconds();

  Pull point(paper_material({.01}));
  Figure figure("figure_03", "Figure 3: a cylinder, perfect plasticity, one cycle", "nominal strain x/X - 1", "axial stress, MPa");
  double plateau_error = 0, sum[2] = {0, 0}, off = 0;
  int count[2] = {0, 0};
  for (const auto& branch : branches)
    for (const Moment& m : branch) {
      figure.add("cylinder, force over current area", m.strain, m.stress / 1e6);
      figure.add("cylinder, force over initial area", m.strain, m.nominal / 1e6);
      const double exact = point.to(m.strain, 2e-5);
      figure.add("one point, exact", m.strain, exact / 1e6);
      off = std::max(off, std::fabs(m.stress - exact));
      if (std::fabs(exact) < 0.999999e9) continue;
      const int side = exact < 0;
      plateau_error = std::max(plateau_error, std::fabs(std::fabs(m.stress) / 1e9 - 1));
      sum[side] += m.stress;
      ++count[side];
    }
  figure.write(request.directory);

  std::vector<Row> rows;
  const std::string name = "figure 3";
  rows.push_back(near(name, "plateau in tension, Pa", sum[0] / count[0], 1e9, 1e-3, time));
  rows.push_back(near(name, "plateau in compression, Pa", sum[1] / count[1], -1e9, 1e-3, time));
  rows.push_back(at_most(name, "farthest from 1 GPa on plateaus, part", plateau_error, 5e-3, time));
  rows.push_back(near(name, "slope loading ab, Pa", slope(branches[0], 0, 0.5e9), kPaperE, 0.01, time));
  rows.push_back(near(name, "slope unloading cd, Pa", slope(branches[1], -0.5e9, 0.5e9), kPaperE, 0.01, time));
  rows.push_back(near(name, "slope reloading ef, Pa", slope(branches[2], -0.5e9, 0.5e9), kPaperE, 0.01, time));
  rows.push_back(at_most(name, "farthest from one point, part of 1 GPa", off / 1e9, 5e-3, time));
  rows.push_back(just(name, "largest kinetic over elastic energy", kinetic, time));
  rows[3].note = "slopes over the log strain; sides free, ends slide; chosen: R 10 mm, L 20 mm, 2700 kg/m3, " +
                 std::to_string(sim->steps()) + " steps to 10 ms at up to .6 m/s, damping 5e3 1/s";
  return rows;
}

}  // namespace forming_sim::bench
