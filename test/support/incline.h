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
  int cells = 6;             ///< along its length; it is a third as high and, in 3D, two thirds as wide
  double layer = 1e-5;       ///< h0, m
  bool facets = true;        ///< the slope is of facets larger than the block's, whose borders it passes; else a plane
  double belt = 0;           ///< speed of the slope up along itself, m/s
  double damping = 500;      ///< after settling, 1/s; a sixth of critical of the slowest swing
};

struct Found {
  double acceleration;       ///< force down the slope over m g, mean of the run after settling
  double creep;              ///< m/s, mean speed down the slope
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

inline Found rest_or_slide(const Block& block) {
  const int dimension = block.dimension, up = dimension - 1;
  const double angle = std::atan(kTan), length = 0.6, settling = 0.1, after = 0.4;
  // Down the slope is x, turned by the angle of the slope.
  const Mat3 turn = Eigen::AngleAxisd(dimension == 2 ? -angle : angle, dimension == 2 ? Vec3(Vec3::UnitZ()) : Vec3(Vec3::UnitY())).toRotationMatrix();
  BlankConfig blank = strip_of(length, length / 3, block.cells, std::max(1, block.cells / 3));
  if (dimension == 3) {
    blank.shape = "plate";
    blank.width = 2 * length / 3;
    blank.cells_across = std::max(1, 2 * block.cells / 3);
    blank.pattern = "coarse";
    blank.origin = Vec3(-length / 2, -length / 3, 0);
  } else {
    blank.origin = Vec3(-length / 2, 0, 0);
  }
  Mesh mesh = generate_blank(blank);
  for (Vec3& X : mesh.nodes) X = turn * X;
  MaterialConfig material;
  material.density = 1000;
  material.youngs_modulus = 1e8;
  material.poissons_ratio = 0.3;
  OneBody run(body_of(std::move(mesh), material), settling);
  run.plan.stages.push_back(form_for(after));
  run.plan.gravity = -kGravity * Vec3::Unit(up);
  run.plan.contact.layer = block.layer;
  ToolModel slope;
  slope.name = "slope";
  slope.friction = block.mu;
  slope.mesh.dimension = dimension;
  if (block.facets) {
    slope.mesh = slope_of_facets(dimension, 1, 0.23);
    for (Vec3& X : slope.mesh.nodes) X = turn * X;
  } else {
    slope.normal = turn * Vec3::Unit(up);
  }
  const Vec3 down = turn * Vec3::UnitX(), normal = turn * Vec3::Unit(up);
  if (block.belt > 0) {
    MotionConfig motion;
    motion.kind = "velocity";
    motion.times = {0};
    motion.velocities = {-block.belt * down};
    motion.spins_deg_s = {Vec3::Zero()};
    slope.motion = motion;
  }
  run.model.tools.push_back(slope);
  run.plan.time_step.damping = block.damping;
  RunPlan damped = run.plan;
  damped.time_step.damping = 500;
  Simulation settles(damped, run.model, 1);
  while (settles.stage() == 0 && settles.step()) {
  }
  Simulation sim(run.plan, run.model, 1);
  sim.restore(settles.save());
  double mass = 0;
  for (double m : sim.nodal_mass()) mass += m;
  const auto mean = [&](const NodeField& field) {
    double sum = 0;
    for (std::size_t i = 0; i < field.size(); ++i) sum += sim.nodal_mass()[i] * vec3(field[i]).dot(down);
    return sum / mass;
  };
  const double t0 = sim.time(), v0 = mean(sim.velocities()), x0 = mean(sim.positions());
  const Vec3 impulse0 = sim.tools()[0].impulse;
  while (sim.step()) {
  }
  const double t = sim.time() - t0, change = mean(sim.velocities()) - v0, way = mean(sim.positions()) - x0;
  const Vec3 impulse = sim.tools()[0].impulse - impulse0;
  RunSize size = size_of(sim);
  size.wall_time += settles.wall_time();
  return {(change + block.damping * way) / (kGravity * t), way / t, impulse.dot(down) / -impulse.dot(normal), sim.balance_error(),
          sim.contact_status().crossings, size};
}

}  // namespace forming_sim::incline
