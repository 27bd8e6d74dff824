#pragma once
// The block of support/incline.h in plane strain by other means: linear elastic, on a rigid slope without any layer, contact and
// friction by impulses on one node after the other. What it shares with the package is K and the masses of the elements.
//
//   v* = (v (1 - a/2) + dt (g - M^-1 K u)) / (1 + a/2), a = alpha dt
//   a node that would end below the slope is pushed so that it ends on it, by j >= 0;
//   friction ends its slip, by no more than mu j;  u += dt v
#include <chrono>

#include "support/level_block.h"

namespace forming_sim::incline {

/// x: down the slope, y: off it. steps: dt over the longest stable one.
inline Found by_impulses(LevelBlock& level, const Block& block, double steps) {
  const NodeField& X = level.X;
  Elements& elements = level.elements;
  const std::vector<double>& mass = elements.nodal_mass();
  const int n = static_cast<int>(X.size());
  const double dt = steps * level.longest_step;
  Eigen::VectorXd root(2 * n), g(2 * n), u = Eigen::VectorXd::Zero(2 * n), v = u;  // root: of the mass
  double whole = 0;
  for (int c = 0; c < 2 * n; ++c) {
    root[c] = std::sqrt(mass[c / 2]);
    g[c] = kGravity * (c % 2 == 0 ? std::sin(std::atan(kTan)) : -std::cos(std::atan(kTan)));
    whole += c % 2 == 0 ? mass[c / 2] : 0.0;
  }
  const Eigen::MatrixXd K_over_M = root.cwiseInverse().asDiagonal() * stiffness_over_mass(elements, X, 2) * root.asDiagonal();
  const auto mean = [&](const Eigen::VectorXd& field) {
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += mass[i] * field[2 * i];
    return sum / whole;
  };
  const long settling = std::lround(kSettling / dt), last = settling + std::lround(block.after / dt);
  double v0 = 0, x0 = 0, pressed = 0, rubbed = 0;
  const auto begin = std::chrono::steady_clock::now();
  for (long step = 0; step < last; ++step) {
    if (step == settling) v0 = mean(v), x0 = mean(u), pressed = rubbed = 0;
    const double a = (step < settling ? block.settling : block.damping) * dt;
    v = (v * (1 - a / 2) + dt * (g - K_over_M * u)) / (1 + a / 2);
    for (int i = 0; i < n; ++i) {
      if (X[i][1] > 0) continue;
      const double below = -(u[2 * i + 1] + dt * v[2 * i + 1]);
      if (below <= 0) continue;
      const double most = block.mu * below / dt, slip = v[2 * i] + block.belt, change = std::clamp(-slip, -most, most);
      v[2 * i + 1] += below / dt;
      v[2 * i] += change;
      pressed += mass[i] * below / dt;
      rubbed -= mass[i] * change;
    }
    u += dt * v;
  }
  const double t = static_cast<double>(last - settling) * dt, change = mean(v) - v0, way = mean(u) - x0;
  const double wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return {(change + block.damping * way) / (kGravity * t), way / t, mean(v) + block.belt, rubbed / pressed, 0, 0, size_of(level.body.mesh, last, wall_time)};
}

struct BothWays {
  Found found{}, by_impulses{};
};
/// Means over runs that start a little differently: where a swing has grown as far as it can, single runs scatter.
inline BothWays both_ways(const Block& block, double steps, int starts) {
  LevelBlock level(block);
  Block one = block;
  one.longest_step = steps * level.longest_step;
  BothWays mean;
  const auto add = [&](const Found& found, Found& sum) {
    sum.acceleration += found.acceleration / starts;
    sum.creep += found.creep / starts;
    sum.slip += found.slip / starts;
    sum.ratio += found.ratio / starts;
    sum.crossings += found.crossings;
    const RunSize before = sum.run;
    sum.run = found.run;
    sum.run.steps += before.steps;
    sum.run.wall_time += before.wall_time;
  };
  for (int k = 0; k < starts; ++k) {
    one.settling = block.settling * (1 + 1e-4 * k);
    add(rest_or_slide(one), mean.found);
    add(by_impulses(level, one, steps), mean.by_impulses);
  }
  return mean;
}

}  // namespace forming_sim::incline
