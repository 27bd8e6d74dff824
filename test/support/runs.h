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

inline BlankConfig strip_of(double length, double thickness, int along, int through) {
  BlankConfig blank;
  blank.shape = "strip";
  blank.length = length;
  blank.thickness = thickness;
  blank.cells_along = along;
  blank.cells_through = through;
  return blank;
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
