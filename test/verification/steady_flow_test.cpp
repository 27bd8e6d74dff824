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

/// How a bar vibrates that is held and drawn by a speed that rises for `rise`, s, with `time_step.limit: element`: how far a node's velocity is from the middle of those a
/// step before and after, m/s, root mean square over the second half of the run, of the node where it is most.
double vibration(const BlankConfig& blank, bool axisymmetric, double duration, std::vector<BoundaryConfig> held, const std::string& end, const Vec3& speed, double rise) {
  MaterialConfig steel;
  steel.density = 7850;
  steel.youngs_modulus = 200e9;
  steel.poissons_ratio = 0.3;
  steel.hardening.emplace();
  steel.hardening->curve = "linear";
  steel.hardening->yield_stress = 250e6;
  steel.hardening->modulus = 1e9;
  Mesh mesh = generate_blank(blank);
  if (axisymmetric) close_at_axis(mesh);
  OneBody run(body_of(std::move(mesh), steel), duration);
  run.model.axisymmetric = axisymmetric;
  run.plan.time_step.limit = "element";
  BoundaryConfig drawn;
  drawn.set = end;
  drawn.kind = "velocity";
  drawn.axes = {"x", "y"};
  if (blank.shape == "plate") drawn.axes.push_back("z");
  drawn.times = {0, rise};
  drawn.velocities = {Vec3::Zero(), speed};
  drawn.profile = "smooth";
  held.push_back(drawn);
  run.plan.bodies[0].boundaries = held;
  auto sim = run.start();
  NodeField before, last = sim->velocities();
  std::vector<double> squares(last.size(), 0);
  long steps = 0;
  for (bool on = true; on;) {
    before = last;
    last = sim->velocities();
    on = sim->step();
    if (sim->time() < 0.5 * duration) continue;
    ++steps;
    for (std::size_t n = 0; n < last.size(); ++n) squares[n] += 0.25 * (sim->velocities()[n] - 2 * last[n] + before[n]).squaredNorm();
  }
  return std::sqrt(*std::max_element(squares.begin(), squares.end()) / static_cast<double>(steps));
}
BlankConfig strip(int along, int through) {
  BlankConfig blank = strip_of(6e-3, 4e-3, along, through);
  blank.pattern = "one_point";
  return blank;
}

void expect_rest(double vibration) { EXPECT_LT(vibration, 1e-3); }

TEST(SteadyFlow, OfARingComesToRestInItself) {
  expect_rest(vibration(strip(1, 2), true, 1.1e-3, {symmetric("bottom", Vec3::UnitY())}, "top", Vec3(0, 0.5, 0), 2e-3));
  expect_rest(vibration(strip(3, 3), true, 1.1e-3, {symmetric("bottom", Vec3::UnitY())}, "top", Vec3(0, 0.5, 0), 2e-3));
}
TEST(SteadyFlow, OfASectionComesToRestInItself) {
  expect_rest(vibration(strip(3, 3), false, 1.1e-3, {symmetric("bottom", Vec3::UnitY()), symmetric("left", Vec3::UnitX())}, "top", Vec3(0, 0.5, 0), 2e-3));
}
TEST(SteadyFlow, OfHexahedraComesToRestInItself) {
  for (const auto& cells : {std::array<int, 3>{3, 2, 2}, {4, 3, 3}}) {
    BlankConfig plate;
    plate.shape = "plate";
    plate.pattern = "one_point";
    plate.length = 6e-3;
    plate.width = plate.thickness = 4e-3;
    plate.cells_along = cells[0], plate.cells_across = cells[1], plate.cells_through = cells[2];
    BoundaryConfig fixed;
    fixed.set = "left";
    fixed.kind = "fixed";
    expect_rest(vibration(plate, false, 1e-3, {fixed}, "right", Vec3(0.5, 0.1, 0), 1e-3));
  }
}

}  // namespace
}  // namespace forming_sim
