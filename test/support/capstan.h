#pragma once
// A thin strip around a drum that turns under it: F2 / F1 = exp(mu theta).
#include <cmath>

#include "support/run_size.h"
#include "support/runs.h"

namespace forming_sim::capstan {

constexpr double kRadius = 0.1;  // m

struct Strip {
  double mu = 0.2, degrees = 90;
  int cells = 20;             ///< on the drum
  int through = 1;            ///< cells through the thickness
  double thickness = 1e-3;    ///< t, m
  double layer = 1e-6;        ///< h0, m
};

struct Found {
  double ratio, balance;
  long crossings;
  RunSize run;
};

inline double exact(const Strip& strip) { return std::exp(strip.mu * strip.degrees * M_PI / 180); }

/// Axial forces in the legs of a strip on a drum. One end is held, a traction acts on the
/// other, and the drum turns towards that; the strip is in rest, so that damping takes nothing but its swing.
/// The drum is fast beside that swing: where the slip of a node turns back now and then, friction is less than mu N.
inline Found brake(const Strip& strip) {
  const double R = kRadius, t = strip.thickness, leg = 0.05, theta = strip.degrees * M_PI / 180, E = 1e9, rho = 1000, traction = 2e5, speed = 1, T = 6e-3;
  const double cell = theta * R / strip.cells;
  const int cells = strip.cells, legs = static_cast<int>(std::round(leg / cell));
  // Facets of the strip touch the drum's circle with their middles.
  const double inner = R / std::cos(0.5 * theta / cells) + strip.layer;
  Mesh mesh = generate_blank(strip_of(1, t, cells + 2 * legs, strip.through));
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
  run.plan.contact.layer = strip.layer;
  ToolModel drum;
  drum.name = "drum";
  drum.friction = strip.mu;
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
  const Vec3 out(std::cos(theta), -std::sin(theta), 0), up(std::sin(theta), std::cos(theta), 0);
  for (std::size_t e = 0; e < sim->elements().size(); ++e) {
    Vec3 middle = Vec3::Zero();
    for (int k = 0; k < 3; ++k) middle += vec3(sim->positions()[sim->elements()[e][k]]) / 3;
    const double before = -middle.x(), behind = middle.dot(out);
    if (before > 0.3 * leg && before < 0.7 * leg && middle.y() > 0) in_leg[0].push_back(static_cast<int>(e));
    if (behind > 0.3 * leg && behind < 0.7 * leg && middle.dot(up) > 0) in_leg[1].push_back(static_cast<int>(e));
  }
  double force[2] = {0, 0};
  while (sim->step()) {
    if (sim->time() < T || sim->steps() % 20 != 0) continue;
    const std::vector<Sym> stress = sim->stress();
    for (int side = 0; side < 2; ++side) {
      const Vec3 u = side == 0 ? Vec3(Vec3::UnitX()) : out;
      for (int e : in_leg[side]) force[side] += (u.x() * u.x() * stress[e][0] + u.y() * u.y() * stress[e][1] + 2 * u.x() * u.y() * stress[e][3]) / static_cast<double>(in_leg[side].size());
    }
  }
  return {force[1] / force[0], sim->balance_error(), sim->contact_status().crossings, size_of(*sim)};
}

}  // namespace forming_sim::capstan
