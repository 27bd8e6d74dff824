#include "forming_sim/loads/rigid_velocity.h"

#include <Eigen/Geometry>
#include <cmath>

#include "forming_sim/loads/rotation.h"

namespace forming_sim {

RigidVelocity::RigidVelocity(const BoundaryConfig& config, const CourseClock& clock) : clock_(clock), centre_(config.centre) {
  if (!config.velocities.empty()) velocity_ = VelocityProfile(config.times, config.velocities, config.profile);
  if (config.spins_deg_s.empty()) return;
  std::vector<Vec3> spins;
  for (const Vec3& spin : config.spins_deg_s) spins.push_back(kRadiansPerDegree * spin);
  spin_ = VelocityProfile(config.times, spins, config.profile);
}

Vec3 RigidVelocity::at(double time, double dt, const Vec3& x) const {
  const double t = clock_.at(time);
  const Vec3 v = velocity_.of_step(t, dt);
  if (!turns()) return v;
  const Vec3 w = spin_.of_step(t, dt), turn = w.cross(x - centre_ - velocity_.displacement(0, t));
  const double a = w.norm() * dt;
  if (a < 1e-4) return v + (1 - a * a / 6) * turn + 0.5 * dt * w.cross(turn);  // next terms: a^4/120, a^2/24
  const double half = std::sin(0.5 * a) / a;
  return v + std::sin(a) / a * turn + 2 * half * half * dt * w.cross(turn);
}

bool same_motion(const BoundaryConfig& a, const BoundaryConfig& b) {
  return a.since == b.since && a.times == b.times && a.velocities == b.velocities && a.spins_deg_s == b.spins_deg_s && a.profile == b.profile &&
         (a.centre == b.centre || a.spins_deg_s.empty());
}

}  // namespace forming_sim
