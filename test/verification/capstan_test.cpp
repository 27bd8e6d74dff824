// A thin strip around a drum that turns under it: F2 / F1 = exp(mu theta).
#include <gtest/gtest.h>

#include "support/runs.h"

namespace forming_sim {
namespace {

struct Found {
  double ratio, balance;
  long crossings, steps;
};

/// Axial forces in the legs of a strip with t/R = .01 on a drum of R = .1 m. One end is held, a traction acts on the
/// other, and the drum turns towards that; the strip is in rest, so that damping takes nothing but its swing.
Found brake(double degrees, double mu, int cells) {
  const double R = 0.1, t = 1e-3, leg = 0.05, theta = degrees * M_PI / 180, E = 1e9, rho = 1000, traction = 2e5, speed = 0.3, T = 3e-3;
  const double cell = theta * R / cells, layer = 1e-6;
  const int legs = static_cast<int>(std::round(leg / cell));
  // Facets of the strip touch the drum's circle with their middles.
  const double inner = R / std::cos(0.5 * theta / cells) + layer;
  Mesh mesh = generate_blank(strip_of(1, t, cells + 2 * legs, 1));
  for (Vec3& X : mesh.nodes) {
    const double along = X.x() * (cells + 2 * legs) - legs, r = inner + X.y();  // in cells, from where the strip meets the drum
    const double a = std::min(std::max(along, 0.), double(cells)) / cells * theta, more = (along - a / theta * cells) * cell;
    X = Vec3(r * std::sin(a) + more * std::cos(a), r * std::cos(a) - more * std::sin(a), 0);
  }
  MaterialConfig material;
  material.density = rho;
  material.youngs_modulus = E;
  material.poissons_ratio = 0;
  OneBody run(body_of(std::move(mesh), material), 2 * T);
  PressureConfig hold;
  hold.set = "left";
  hold.times = {0, T / 4};
  hold.values = {0, -traction};
  run.plan.bodies[0].pressures.push_back(hold);
  BoundaryConfig end;
  end.set = "right";
  end.kind = "fixed";
  run.plan.bodies[0].boundaries.push_back(end);
  run.plan.time_step.damping = 6000;
  run.plan.contact.layer = layer;
  ToolModel drum;
  drum.name = "drum";
  drum.friction = mu;
  drum.mesh.dimension = 2;
  const int around = 2000;
  for (int k = 0; k < around; ++k) {
    drum.mesh.nodes.push_back(R * Vec3(std::sin(2 * M_PI * k / around), std::cos(2 * M_PI * k / around), 0));
    Facet f;
    f.nodes = {k, (k + 1) % around, -1};
    drum.mesh.surface.push_back(f);
  }
  MotionConfig turn;
  turn.kind = "velocity";
  turn.times = {0, T / 2};
  turn.spins_deg_s = {Vec3::Zero(), Vec3(0, 0, speed / R * 180 / M_PI)};
  turn.velocities = {Vec3::Zero(), Vec3::Zero()};
  drum.motion = turn;
  run.model.tools.push_back(drum);
  auto sim = run.start();
  // Elements in the middle of either leg.
  std::vector<int> in_leg[2];
  for (size_t e = 0; e < sim->elements().size(); ++e) {
    Vec3 middle = Vec3::Zero();
    for (int k = 0; k < 3; ++k) middle += vec3(sim->positions()[sim->elements()[e][k]]) / 3;
    const Vec3 out(std::cos(theta), -std::sin(theta), 0);
    const double before = -middle.x(), behind = middle.dot(out);
    if (before > 0.3 * leg && before < 0.7 * leg && middle.y() > 0) in_leg[0].push_back(static_cast<int>(e));
    if (behind > 0.3 * leg && behind < 0.7 * leg && middle.dot(Vec3(std::sin(theta), std::cos(theta), 0)) > 0) in_leg[1].push_back(static_cast<int>(e));
  }
  double force[2] = {0, 0};
  long count = 0;
  while (sim->step()) {
    if (sim->time() < T || sim->steps() % 20 != 0) continue;
    ++count;
    const std::vector<Sym> stress = sim->stress();
    for (int side = 0; side < 2; ++side) {
      const Vec3 u = side == 0 ? Vec3(Vec3::UnitX()) : Vec3(std::cos(theta), -std::sin(theta), 0);
      for (int e : in_leg[side]) force[side] += (u.x() * u.x() * stress[e][0] + u.y() * u.y() * stress[e][1] + 2 * u.x() * u.y() * stress[e][3]) / static_cast<double>(in_leg[side].size());
    }
  }
  return {force[1] / force[0], sim->balance_error(), sim->contact_status().crossings, sim->steps()};
}

}  // namespace

// The strip is not quite thin: friction acts at its inner side, t/2 from its middle, which takes t/(2R) from the exponent.
TEST(Capstan, RightAngleAndHalfTurn) {
  struct Case {
    double mu, degrees;
    int cells;
    double allowed;
  };
  for (const Case& c : {Case{.2, 90, 20, .005}, Case{.2, 90, 40, .005}, Case{.2, 180, 40, .01}, Case{.4, 90, 20, .01}, Case{.4, 180, 40, .02}}) {
    const Found found = brake(c.degrees, c.mu, c.cells);
    const double exact = std::exp(c.mu * c.degrees * M_PI / 180);
    std::printf("  mu %g, %g degrees, %d cells: F2/F1 %.5f, exact %.6f (%+.2f %%), %ld steps, balance %.1e\n", c.mu, c.degrees, c.cells, found.ratio, exact,
                100 * (found.ratio / exact - 1), found.steps, found.balance);
    EXPECT_NEAR(found.ratio, exact, c.allowed * exact) << c.mu << ", " << c.degrees << " degrees";
    EXPECT_EQ(found.crossings, 0);
    EXPECT_LT(found.balance, 1e-3);
  }
}

}  // namespace forming_sim
