// A strip is drawn through a wedge. Contact is at one end and the rest of the strip can swing; what damps the swing where it rubs must not feed that.
#include <gtest/gtest.h>

#include <cmath>

#include "support/runs.h"

namespace forming_sim {

namespace {

constexpr double kSlope = 15 * M_PI / 180, kFriction = .1, kBefore = 3e-3, kBehind = 2.25e-3;  // half thicknesses, m

struct Found {
  double along, across;  ///< mean force on the die, N per m
  double swing;          ///< largest difference of a mean over kWindow from that of all, of it
};

constexpr double kWindow = .02e-3;  // s

/// Upper half; its head is through the wedge already.
Found draw() {
  const double reach = (kBefore - kBehind) / std::tan(kSlope), tail = 22e-3, head = 6e-3, speed = 4, ramp = .5e-3, end = 3e-3;
  const int before = 44, within = 6, behind = 12;  // cells
  Mesh mesh = generate_blank(strip_of(before + within + behind, 1, before + within + behind, 4));
  for (Vec3& X : mesh.nodes) {
    const double cell = X.x() - before, part = std::min(std::max(cell / within, 0.), 1.);
    const double x = cell < 0 ? tail * cell / before : cell < within ? reach * part : reach + head * (cell - within) / behind;
    X = Vec3(x, X.y() * (kBefore + part * (kBehind - kBefore)), 0);
  }
  MaterialConfig material;
  material.density = 2700;
  material.youngs_modulus = 70e9;
  material.poissons_ratio = .3;
  HardeningConfig perfect;
  perfect.curve = "perfect";
  perfect.yield_stress = 100e6;
  material.hardening = perfect;
  OneBody run(body_of(std::move(mesh), material), end);
  BoundaryConfig pull;
  pull.set = "right";
  pull.kind = "velocity";
  pull.axes = {"x"};
  pull.times = {0, ramp};
  pull.velocities = {Vec3::Zero(), Vec3(speed, 0, 0)};
  pull.profile = "smooth";
  run.plan.bodies[0].boundaries = {pull, symmetric("bottom", Vec3::UnitY())};
  ToolModel die;
  die.name = "die";
  die.friction = kFriction;
  die.mesh.dimension = 2;
  const double gap = 2e-6, back = 8e-3;
  die.mesh.nodes = {Vec3(-back, kBefore + gap + back * std::tan(kSlope), 0), Vec3(reach, kBehind + gap, 0), Vec3(reach + 3e-3, kBehind + gap, 0), Vec3(reach + 4e-3, kBehind + 2e-3, 0)};
  join_nodes(die.mesh);
  run.model.tools.push_back(die);
  const auto sim = run.start();
  std::vector<Vec3> impulse;
  double next = 1.1e-3;
  while (sim->step()) {
    if (sim->time() < next) continue;
    impulse.push_back(sim->tools()[0].felt.impulse);
    next += kWindow;
  }
  EXPECT_LT(std::abs(sim->balance_error()), 1e-3);
  EXPECT_EQ(sim->contact_status().crossings, 0);
  const Vec3 mean = (impulse.back() - impulse.front()) / static_cast<double>(impulse.size() - 1);
  double swing = 0;
  for (std::size_t i = 1; i < impulse.size(); ++i) swing = std::max(swing, std::abs((impulse[i] - impulse[i - 1] - mean).x() / mean.x()));
  return {std::abs(mean.x()) / kWindow, std::abs(mean.y()) / kWindow, swing};
}

}  // namespace

TEST(WedgeDraw, PullsSteadilyWithTheFrictionThatWasGiven) {
  const Found found = draw();
  std::printf("  die: %.5g N/m along, %.5g across, ratio %.4f, tan of slope and friction %.4f; means over .02 ms differ by %.1f %%\n", found.along, found.across,
              found.along / found.across, std::tan(kSlope + std::atan(kFriction)), 100 * found.swing);
  EXPECT_NEAR(found.along / found.across, std::tan(kSlope + std::atan(kFriction)), .02 * found.along / found.across);
  EXPECT_LT(found.swing, .08);
}

}  // namespace forming_sim
