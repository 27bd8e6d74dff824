// Bars of one-point cells that are drawn on and on: what their supports' start has set swinging dies, and the flow does not drive it on.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "forming_sim/mesh/axis.h"
#include "support/runs.h"

namespace forming_sim {
namespace {

/// A bar of one-point cells.
OneBody bar_of(BlankConfig blank, bool axisymmetric = false) {
  MaterialConfig steel;
  steel.density = 7850;
  steel.youngs_modulus = 200e9;
  steel.poissons_ratio = 0.3;
  steel.hardening.emplace();
  steel.hardening->curve = "linear";
  steel.hardening->yield_stress = 250e6;
  steel.hardening->modulus = 1e9;
  blank.pattern = "one_point";
  Mesh mesh = generate_blank(blank);
  if (axisymmetric) close_at_axis(mesh);
  OneBody run(body_of(std::move(mesh), steel), 1.1e-3);
  run.model.axisymmetric = axisymmetric;
  return run;
}

/// How it vibrates while it is drawn at `end` by a speed that rises for `rise`, s, with `time_step.limit: element`: how far a node's velocity is from the middle of those a
/// step before and after, m/s, root mean square over the second half of the run, of the node where it is most.
double vibration(OneBody run, const std::string& end, const Vec3& speed, double rise) {
  run.plan.time_step.limit = "element";
  BoundaryConfig drawn;
  drawn.set = end;
  drawn.kind = "velocity";
  drawn.times = {0, rise};
  drawn.velocities = {Vec3::Zero(), speed};
  drawn.profile = "smooth";
  run.plan.bodies[0].boundaries.push_back(drawn);
  auto sim = run.start();
  NodeField before, last = sim->velocities();
  std::vector<double> squares(last.size(), 0);
  long steps = 0;
  for (bool on = true; on;) {
    before = last;
    last = sim->velocities();
    on = sim->step();
    if (sim->time() < 0.5 * run.plan.stages[0].duration) continue;
    ++steps;
    for (std::size_t n = 0; n < last.size(); ++n) squares[n] += 0.25 * (sim->velocities()[n] - 2 * last[n] + before[n]).squaredNorm();
  }
  return std::sqrt(*std::max_element(squares.begin(), squares.end()) / static_cast<double>(steps));
}

/// Of a section that is drawn upwards, held below and, where it does not end at the axis, at its left.
double vibration_of_strip(int along, int through, bool axisymmetric) {
  OneBody run = bar_of(strip_of(6e-3, 4e-3, along, through), axisymmetric);
  std::vector<BoundaryConfig>& held = run.plan.bodies[0].boundaries;
  held.push_back(symmetric("bottom", Vec3::UnitY()));
  if (!axisymmetric) held.push_back(symmetric("left", Vec3::UnitX()));
  return vibration(run, "top", Vec3(0, 0.5, 0), 2e-3);
}

constexpr double kRest = 1e-3;  // m/s

TEST(SteadyFlow, OfARingComesToRestInItself) {
  EXPECT_LT(vibration_of_strip(1, 2, true), kRest);
  EXPECT_LT(vibration_of_strip(3, 3, true), kRest);
}
TEST(SteadyFlow, OfASectionComesToRestInItself) { EXPECT_LT(vibration_of_strip(3, 3, false), kRest); }
TEST(SteadyFlow, OfHexahedraComesToRestInItself) {
  for (const auto& cells : {std::array<int, 3>{3, 2, 2}, {4, 3, 3}}) {
    BlankConfig plate = strip_of(6e-3, 4e-3, cells[0], cells[2]);
    plate.shape = "plate";
    plate.width = 4e-3;
    plate.cells_across = cells[1];
    OneBody run = bar_of(plate);
    run.plan.stages[0].duration = 1e-3;
    clamp_left(run);
    EXPECT_LT(vibration(run, "right", Vec3(0.5, 0.1, 0), 1e-3), kRest);
  }
}

}  // namespace
}  // namespace forming_sim
