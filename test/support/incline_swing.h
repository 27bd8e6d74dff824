#pragma once
// How the swing of the block of support/incline.h grows while it slides, and what the eigenvalues of support/slide_eigenvalues.h
// say of it.
//
// The block settles while it slides on the belt, under damping, in plane strain on a plane. Then the damping becomes another
// one, or none, which moves nothing: the swing grows out of rounding.
#include "support/level_block.h"
#include "support/slide_eigenvalues.h"

namespace forming_sim::incline {

/// A block that slides at .5 m/s, faster than it swings, so that no node slips back. Its swing is free.
inline Block sliding_block(int cells, int rows, double mu, double damping) {
  Block block;
  block.cells = cells;
  block.rows = rows;
  block.mu = mu;
  block.layer = 1e-7;
  block.facets = false;
  block.belt = 0.5;
  block.settling = 2000;
  block.damping = damping;
  block.swing = "free";
  block.after = 0.8;
  return block;
}

struct Swing {
  double rate = 0, frequency = 0;   ///< of growth, 1/s; rad/s
};

struct Grown {
  Swing linear;         ///< by the eigenvalues, of steps that go to zero; no growth: 0
  Swing stepped;        ///< of the steps of the run
  Swing found;          ///< while the speed of the swing went from `from` to `to`; not a number where it did not come there
  double first, last;   ///< speed of the swing at the first and the last step, m/s
  double damping;       ///< that ends the growth, by the eigenvalues, 1/s
  RunSize run;
};

inline Swing of(slide::Complex s) { return {s.real(), std::abs(s.imag())}; }

/// steps: dt, which stays the same, over the longest stable one. from, to: m/s, roots of the mean squares over the mass.
inline Grown let_swing(const Block& block, double steps = 0.4, double from = 1e-7, double to = 1e-4) {
  Grown grown;
  LevelBlock whole(block);
  const NodeField& level = whole.X;
  Elements& elements = whole.elements;

  Block even = block;
  even.longest_step = steps * whole.longest_step;
  double settling_time = 0;
  const std::unique_ptr<Simulation> run = settled(even, &settling_time);
  Simulation& sim = *run;
  const std::vector<double> pressure = sim.contact_pressure();
  std::vector<int> base;
  for (std::size_t i = 0; i < level.size(); ++i)
    if (pressure[i] > 0) base.push_back(static_cast<int>(i));
  const slide::Complex lambda = slide::fastest_growing(slide::eigenvalues(elements, level, base, block.mu));
  if (lambda != 0.0) {
    grown.linear = of(slide::growth(lambda, block.damping));
    grown.damping = lambda.imag() / std::sqrt(lambda.real());
  } else {
    grown.damping = 0;
  }

  // Rate: the slope of the logarithm of the swing's speed. Frequency: from when the first node of the base turns.
  const double mass = mass_of(sim), begin = sim.time();
  const Vec3 down = down_slope(2);
  double n = 0, t1 = 0, t2 = 0, y1 = 0, ty = 0, before = 0, first_turn = 0, last_turn = 0, dt = 0;
  int turns = 0;
  grown.first = grown.last = 0;
  while (sim.time() < begin + block.after - even.longest_step && sim.step()) {
    Vec3 mean = Vec3::Zero();
    for (std::size_t i = 0; i < level.size(); ++i) mean += sim.nodal_mass()[i] / mass * vec3(sim.velocities()[i]);
    double square = 0;
    for (std::size_t i = 0; i < level.size(); ++i) square += sim.nodal_mass()[i] / mass * (vec3(sim.velocities()[i]) - mean).squaredNorm();
    const double t = sim.time() - begin, speed = std::sqrt(square), now = (vec3(sim.velocities()[base[0]]) - mean).dot(down);
    if (grown.first == 0) grown.first = speed;
    grown.last = speed;
    dt = sim.dt();
    if (speed > to) break;
    if (speed < from) {
      n = t1 = t2 = y1 = ty = turns = 0;
    } else {
      n += 1, t1 += t, t2 += t * t, y1 += std::log(speed), ty += t * std::log(speed);
      if (n > 1 && now * before < 0) (turns++ == 0 ? first_turn : last_turn) = t - sim.dt() * now / (now - before);
    }
    before = now;
  }
  if (lambda != 0.0) grown.stepped = of(slide::growth(lambda, block.damping, dt));
  grown.found = {std::nan(""), std::nan("")};
  if (grown.last > to) grown.found = {(n * ty - t1 * y1) / (n * t2 - t1 * t1), (turns - 1) * M_PI / (last_turn - first_turn)};
  grown.run = size_of(sim);
  grown.run.wall_time += settling_time;
  return grown;
}

}  // namespace forming_sim::incline
