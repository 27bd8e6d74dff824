#pragma once
// Small runs for tests.
#include <Eigen/Geometry>

#include "forming_sim/simulation/simulation.h"
#include "support/bodies.h"

namespace forming_sim {

inline StageConfig form_for(double duration) {
  StageConfig stage;
  stage.name = stage.kind = "form";
  stage.duration = duration;
  return stage;
}

inline StageConfig settle(double limit) {
  StageConfig stage;
  stage.name = stage.kind = "settle";
  stage.limit = limit;
  return stage;
}
/// Upwards; by no height: at once.
inline StageConfig withdraw(double height, double duration) {
  StageConfig stage;
  stage.name = stage.kind = "withdraw";
  stage.displacement = Vec3(0, height, 0);
  stage.duration = duration;
  return stage;
}

/// One body, no loads, one form stage.
struct OneBody {
  Model model;
  RunPlan plan;
  OneBody(BodyModel body, double duration) {
    model.dimension = body.mesh.dimension;
    model.bodies.push_back(std::move(body));
    plan.bodies.emplace_back();
    plan.stages.push_back(form_for(duration));
  }
  std::unique_ptr<Simulation> start(int threads = 1) const { return std::make_unique<Simulation>(plan, model, threads); }
};

/// kg
inline double mass_of(const Simulation& sim) {
  double mass = 0;
  for (double m : sim.nodal_mass()) mass += m;
  return mass;
}

inline BlankConfig strip_of(double length, double thickness, int along, int through) {
  BlankConfig blank;
  blank.shape = "strip";
  blank.length = length;
  blank.thickness = thickness;
  blank.cells_along = along;
  blank.cells_through = through;
  return blank;
}

/// A set that does not move along `normal`.
inline BoundaryConfig symmetric(const std::string& set, const Vec3& normal) {
  BoundaryConfig b;
  b.set = set;
  b.kind = "symmetric";
  b.normal = normal;
  return b;
}
/// Holds the set `left` of the body of a run.
inline void clamp_left(OneBody& run) {
  BoundaryConfig left;
  left.set = "left";
  left.kind = "fixed";
  run.plan.bodies[0].boundaries = {left};
}
/// Holds it, and drives the set `right` along x.
inline void pull_right(OneBody& run, const std::vector<double>& times, const std::vector<Vec3>& velocities) {
  clamp_left(run);
  BoundaryConfig right;
  right.set = "right";
  right.kind = "velocity";
  right.axes = {"x"};
  right.times = times;
  right.velocities = velocities;
  run.plan.bodies[0].boundaries.push_back(right);
}
/// A cantilever under a weight of 1000 g that settles.
inline void hang_from_left(OneBody& run) {
  clamp_left(run);
  run.plan.gravity = Vec3(0, -1e4, 0);
  run.plan.stages.push_back(settle(20e-3));
  run.plan.stages.back().kinetic_fraction = 1e-6;
}

/// Puts a body that flies with `velocity` behind those of the model.
inline BodyLoads& add_flying(Model& model, RunPlan& plan, BodyModel body, const std::string& name, const Vec3& velocity) {
  body.name = name;
  body.first_node = model.node_count();
  body.first_element = model.element_count();
  model.bodies.push_back(std::move(body));
  plan.bodies.emplace_back();
  plan.bodies.back().initial_velocity = velocity;
  return plan.bodies.back();
}

/// A rigid plane that looks along `normal`.
inline ToolModel plane_at(const std::string& name, int dimension, const Vec3& point, const Vec3& normal) {
  ToolModel plane;
  plane.name = name;
  plane.mesh.dimension = dimension;
  plane.point = point;
  plane.normal = normal;
  return plane;
}
/// It goes by `way` in `time`.
inline void lead(ToolModel& tool, double time, const Vec3& way) {
  MotionConfig motion;
  motion.kind = "trajectory";
  motion.times = {0, time};
  motion.positions = {Vec3::Zero(), way};
  tool.motion = motion;
}
/// A force drives it. mass, kg (kg/m in plane strain); 0: that of the bodies.
inline void drive(ToolModel& tool, std::vector<double> times, std::vector<Vec3> forces, double mass = 0) {
  MotionConfig motion;
  motion.kind = "force";
  motion.times = std::move(times);
  motion.forces = std::move(forces);
  motion.mass = mass;
  tool.motion = motion;
}
/// Its surface in a section: segments from each node to the next.
inline void join_nodes(Mesh& mesh) {
  for (int k = 0; k + 1 < static_cast<int>(mesh.nodes.size()); ++k) {
    Facet f;
    f.nodes = {k, k + 1, -1};
    mesh.surface.push_back(f);
  }
}
/// Puts a body of this height, which stands on 0 along its last axis, between a bed and a ram that comes down by `way`.
inline void press(OneBody& run, double height, double time, double way) {
  const int D = run.model.dimension;
  const Vec3 up = Vec3::Unit(D - 1);
  run.model.tools = {plane_at("bed", D, Vec3::Zero(), up), plane_at("ram", D, height * up, -up)};
  lead(run.model.tools[1], time, -way * up);
}

/// The rigid plane x = 0 with the bodies to its right, in plane strain.
inline ToolModel wall_at_zero() { return plane_at("wall", 2, Vec3::Zero(), Vec3::UnitX()); }

/// What the bodies of the paper's impact are made of: G 26.5, K 65.1 GPa, 2800 kg/m3.
inline MaterialConfig impact_material() {
  const double G = 26.5e9, K = 65.1e9;
  MaterialConfig m;
  m.density = 2800;
  m.youngs_modulus = 9 * K * G / (3 * K + G);
  m.poissons_ratio = (3 * K - 2 * G) / (2 * (3 * K + G));
  return m;
}

struct Momenta {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
};
/// Linear and angular momentum about the origin at the half step.
inline Momenta momenta(const Simulation& s) {
  Momenta m;
  for (std::size_t i = 0; i < s.positions().size(); ++i) {
    const Vec3 p = s.nodal_mass()[i] * vec3(s.velocities()[i]);
    m.linear += p;
    m.angular += vec3(s.positions()[i] - 0.5 * s.dt() * s.velocities()[i]).cross(p);
  }
  return m;
}

}  // namespace forming_sim
