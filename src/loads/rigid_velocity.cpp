#include "forming_sim/loads/rigid_velocity.h"

#include <Eigen/Geometry>
#include <cmath>

#include "forming_sim/loads/rotation.h"

namespace forming_sim {

RigidVelocity::RigidVelocity(const BoundaryConfig& config, const CourseClock& clock) : clock_(clock), centre_(config.centre) {
  if (config.kind == "trajectory") {
    MotionConfig motion;
    motion.kind = config.kind;
    motion.times = times_ = config.times;
    motion.positions = config.positions;
    motion.rotations_deg = config.rotations_deg;
    motion.profile = config.shape();
    places_.emplace(motion, 3);
    if (!config.positions.empty()) first_ = config.positions.front();
    turning_ = !config.rotations_deg.empty();
    return;
  }
  if (!config.velocities.empty()) velocity_ = VelocityProfile(config.times, config.velocities, config.shape());
  if (config.spins_deg_s.empty()) return;
  std::vector<Vec3> spins;
  for (const Vec3& spin : config.spins_deg_s) spins.push_back(kRadiansPerDegree * spin);
  spin_ = VelocityProfile(config.times, spins, config.shape());
}

RigidVelocity::Step RigidVelocity::between_places(double t, double dt) const {
  const Pose from = places_->at(t), to = places_->at(t + dt);
  Step step;
  step.centre = centre_ + from.translation - first_;
  step.v = dt > 0 ? Vec3((to.translation - from.translation) / dt) : from.velocity;
  const bool rests = dt > 0 && to.rotation == from.rotation;  // to the last bit: R R^T is the identity but for rounding
  if (turning_ && !rests) step.turn = dt > 0 ? Mat3((to.rotation * from.rotation.transpose() - Mat3::Identity()) / dt) : skew(from.spin);
  return step;
}

RigidVelocity::Step RigidVelocity::step(double time, double dt) const {
  const double t = clock_.at(time);
  if (places_) return between_places(t, dt);
  Step step;
  step.v = velocity_.of_step(t, dt);
  if (!turns()) return step;
  step.centre = centre_ + velocity_.displacement(0, t);
  const Vec3 w = spin_.of_step(t, dt);
  const Mat3 W = skew(w);
  const double a = w.norm() * dt;
  if (a < 1e-4) {
    step.turn = (1 - a * a / 6) * W + 0.5 * dt * W * W;  // next terms: a^4/120, a^2/24
    return step;
  }
  const double half = std::sin(0.5 * a) / a;
  step.turn = std::sin(a) / a * W + 2 * half * half * dt * W * W;
  return step;
}

bool same_motion(const BoundaryConfig& a, const BoundaryConfig& b) {
  return a.kind == b.kind && a.since == b.since && a.times == b.times && a.velocities == b.velocities && a.spins_deg_s == b.spins_deg_s && a.positions == b.positions &&
         a.rotations_deg == b.rotations_deg && a.shape() == b.shape() && (a.centre == b.centre || (a.spins_deg_s.empty() && a.rotations_deg.empty()));
}

}  // namespace forming_sim
