#pragma once
// An elastic block on an incline of tan = .5 under gravity: with friction .5 it sticks, with less it slides at
// g cos(theta) (tan(theta) - mu).
//
// It settles on the slope under damping; then the run goes on from there. The slope may move up along itself, as a belt:
// the block slides on it at that speed from the start, at the same acceleration. What is found is the force on the block
// over its mass: its acceleration and what damping took.
#include <cmath>

#include "support/run_size.h"
#include "support/runs.h"

namespace forming_sim::incline {

constexpr double kGravity = 9.81, kTan = 0.5;

struct Block {
  int dimension = 2;
  double mu = 0.5;
  int cells = 6;             ///< along its length; in 3D it is two thirds as wide
  int rows = 0;              ///< of cells in its height, a third of its length; 0: as square as they can be
  double layer = 1e-5;       ///< h0, m
  bool facets = true;        ///< the slope is of facets larger than the block's, whose borders it passes; else a plane
  double belt = 0;           ///< speed of the slope up along itself, m/s
  double settling = 500;     ///< damping while it settles, 1/s; a sixth of critical of the slowest swing
  double damping = 500;      ///< after settling, 1/s
  double after = 0.4;        ///< time after settling, s
  double longest_step = 0;   ///< s; 0: the stable one
  double viscosity = 0;      ///< coefficient of the linear bulk viscosity
  std::string swing = "damped";
};

struct Found {
  double acceleration;       ///< force down the slope over m g, mean of the run after settling
  double creep;              ///< m/s, mean speed down the slope
  double slip;               ///< m/s, mean speed down the slope, relative to it, at the end
  double ratio;              ///< of the tangential to the normal impulse on the slope
  double balance;
  long crossings;
  RunSize run;
};

inline double exact(const Block& block) { return std::cos(std::atan(kTan)) * std::max(0.0, kTan - block.mu); }

/// Segments along x, or triangles over x and y, of spacing `cell`, shifted so that none of their borders is the block's.
inline Mesh slope_of_facets(int dimension, double size, double cell) {
  Mesh mesh;
  mesh.dimension = dimension;
  const int n = static_cast<int>(std::ceil(2 * size / cell));
  const auto at = [&](int i) { return -size + (i + 0.37) * cell; };
  const auto facet = [&](int a, int b, int c) {
    Facet f;
    f.nodes = {a, b, c};
    mesh.surface.push_back(f);
  };
  for (int j = 0; j <= (dimension == 3 ? n : 0); ++j)
    for (int i = 0; i <= n; ++i) mesh.nodes.emplace_back(at(i), dimension == 3 ? at(j) : 0, 0);
  for (int i = 0; i < n && dimension == 2; ++i) facet(i, i + 1, -1);
  for (int j = 0; j < n && dimension == 3; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      facet(a, a + 1, a + n + 2);
      facet(a, a + n + 2, a + n + 1);
    }
  return mesh;
}

constexpr double kSettling = 0.1;  ///< s

/// The block on a slope along x.
inline Mesh level_block(const Block& block) {
  const double length = 0.6;
  BlankConfig blank = strip_of(length, length / 3, block.cells, block.rows > 0 ? block.rows : std::max(1, block.cells / 3));
  blank.origin = Vec3(-length / 2, 0, 0);
  if (block.dimension == 3) {
    blank.shape = "plate";
    blank.width = 2 * length / 3;
    blank.cells_across = std::max(1, 2 * block.cells / 3);
    blank.pattern = "coarse";
    blank.origin = Vec3(-length / 2, -length / 3, 0);
  }
  return generate_blank(blank);
}

inline MaterialConfig material_of_block() {
  MaterialConfig material;
  material.density = 1000;
  material.youngs_modulus = 1e8;
  material.poissons_ratio = 0.3;
  return material;
}

/// Down the slope is x, turned by the angle of the slope.
inline Mat3 turn_of(int dimension) {
  const double angle = std::atan(kTan);
  return Eigen::AngleAxisd(dimension == 2 ? -angle : angle, dimension == 2 ? Vec3(Vec3::UnitZ()) : Vec3(Vec3::UnitY())).toRotationMatrix();
}
inline Vec3 down_slope(int dimension) { return turn_of(dimension) * Vec3::UnitX(); }
inline Vec3 off_slope(int dimension) { return turn_of(dimension) * Vec3::Unit(dimension - 1); }

/// Damped as after settling; the first stage is the settling.
inline OneBody run_of(const Block& block) {
  const Mat3 turn = turn_of(block.dimension);
  Mesh mesh = level_block(block);
  for (Vec3& X : mesh.nodes) X = turn * X;
  OneBody run(body_of(std::move(mesh), material_of_block()), kSettling);
  run.plan.stages.push_back(form_for(block.after));
  run.plan.gravity = -kGravity * Vec3::Unit(block.dimension - 1);
  run.plan.contact.layer = block.layer;
  run.plan.contact.swing = block.swing;
  run.plan.time_step.damping = block.damping;
  run.plan.time_step.maximum = block.longest_step;
  run.plan.time_step.linear_viscosity = block.viscosity;
  ToolModel slope;
  slope.name = "slope";
  slope.friction = block.mu;
  slope.mesh.dimension = block.dimension;
  if (block.facets) {
    slope.mesh = slope_of_facets(block.dimension, 1, 0.23);
    for (Vec3& X : slope.mesh.nodes) X = turn * X;
  } else {
    slope.normal = off_slope(block.dimension);
  }
  if (block.belt > 0) {
    MotionConfig motion;
    motion.kind = "velocity";
    motion.times = {0};
    motion.velocities = {-block.belt * down_slope(block.dimension)};
    motion.spins_deg_s = {Vec3::Zero()};
    slope.motion = motion;
  }
  run.model.tools.push_back(slope);
  return run;
}

/// The run at the end of its settling. wall_time: what that took, s.
inline std::unique_ptr<Simulation> settled(const Block& block, double* wall_time = nullptr) {
  const OneBody run = run_of(block);
  RunPlan damped = run.plan;
  damped.time_step.damping = block.settling;
  Simulation settles(damped, run.model, 1);
  while (settles.stage() == 0 && settles.step()) {
  }
  if (wall_time) *wall_time = settles.wall_time();
  auto sim = std::make_unique<Simulation>(run.plan, run.model, 1);
  sim->restore(settles.save());
  return sim;
}

inline Found rest_or_slide(const Block& block) {
  const Vec3 down = down_slope(block.dimension), normal = off_slope(block.dimension);
  double settling_time = 0;
  const std::unique_ptr<Simulation> run = settled(block, &settling_time);
  Simulation& sim = *run;
  const double mass = mass_of(sim);
  const auto mean = [&](const NodeField& field) {
    double sum = 0;
    for (std::size_t i = 0; i < field.size(); ++i) sum += sim.nodal_mass()[i] * vec3(field[i]).dot(down);
    return sum / mass;
  };
  const double t0 = sim.time(), half0 = t0 - 0.5 * sim.dt(), v0 = mean(sim.velocities()), x0 = mean(sim.positions());
  const Vec3 impulse0 = sim.tools()[0].felt.impulse;
  while (sim.step()) {
  }
  const double t = sim.time() - t0, between = sim.time() - 0.5 * sim.dt() - half0;  // half steps, where velocities are
  const double change = mean(sim.velocities()) - v0, way = mean(sim.positions()) - x0;
  const Vec3 impulse = sim.tools()[0].felt.impulse - impulse0;
  RunSize size = size_of(sim);
  size.wall_time += settling_time;
  return {(change / between + block.damping * way / t) / kGravity, way / t, mean(sim.velocities()) + block.belt, impulse.dot(down) / -impulse.dot(normal), sim.balance_error(),
          sim.contact_status().crossings, size};
}

}  // namespace forming_sim::incline
