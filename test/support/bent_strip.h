#pragma once
// A strip that is bent evenly, lies still, and is let go: what of its curvature it keeps.
#include <algorithm>
#include <cmath>

#include "support/runs.h"

namespace forming_sim {

constexpr double kBentThickness = 0.93e-3;  // m
/// k_after/k of k t = .02 (VERIFICATION 7): perfectly plastic, and with the hardening of aluminium().
constexpr double kKeptPerfect = 0.59401, kKeptVoce = 0.57531;

/// Turned from the upright, rad: the section at an end of a strip.
inline double turned(const Simulation& sim, const char* at = "right") {
  const auto& X = sim.initial_positions();
  const std::vector<int>& end = sim.model().bodies[0].mesh.sets.at(at);
  const auto by_height = [&](int a, int b) { return X[a][1] < X[b][1]; };
  const auto [low, high] = std::minmax_element(end.begin(), end.end(), by_height);
  const Vec3 section = vec3(sim.positions()[*high] - sim.positions()[*low]);
  return std::atan2(-section.x(), section.y());
}

/// Its end turns until k t = .02, stays on the arc of length L, and is let go when the stage that is settling begins.
inline OneBody bent_strip(const MaterialConfig& metal) {
  constexpr double L = 0.02, t = kBentThickness, curvature = 0.02 / t, T = 2e-3;
  constexpr int knots = 80;
  OneBody run(body_of(generate_blank(strip_of(L, t, 40, 4)), metal), T);
  BoundaryConfig corner, end;
  run.model.bodies[0].mesh.sets["corner"] = {0};
  corner.set = "corner";
  corner.kind = "fixed";
  corner.axes = {"y"};
  end.set = "right";
  end.kind = "velocity";
  end.axes = {"x", "y"};
  end.centre = Vec3(L, t / 2, 0);
  end.until = "settle";
  for (int k = 0; k <= knots; ++k) {
    const double s = static_cast<double>(k) / knots, q = std::max(curvature * L * s * s * (3 - 2 * s), 1e-5), rate = curvature * L * 6 * s * (1 - s) / T;
    end.times.push_back(T * s);
    // d/dq of L sin q/q and L (1 - cos q)/q
    end.velocities.push_back(rate * L * Vec3((q * std::cos(q) - std::sin(q)) / (q * q), (q * std::sin(q) - 1 + std::cos(q)) / (q * q), 0));
    end.spins_deg_s.push_back(Vec3(0, 0, rate * 180 / M_PI));
  }
  run.plan.bodies[0].boundaries = {symmetric("left", Vec3::UnitX()), corner, end};
  run.plan.stages.push_back(settle(20e-3));
  return run;
}
inline MaterialConfig perfect_aluminium() {
  MaterialConfig metal = aluminium(true);
  metal.hardening->curve = "perfect";
  return metal;
}

struct Kept {
  double curvature;      ///< that stays, over that which it had
  double late_flow;      ///< plastic work after it was let go, over the elastic energy before
  double balance_error;
};
/// Runs it to its end.
inline Kept let_go(Simulation& sim) {
  while (sim.stage() == 0) sim.step();
  const double formed = turned(sim);
  const Energies before = sim.energies();
  while (sim.step()) {}
  return {turned(sim) / formed, (sim.energies().plastic - before.plastic) / before.elastic, sim.balance_error()};
}

}  // namespace forming_sim
