#pragma once
// Velocity of a set that moves and turns as a rigid body: prescribed along its axes by a boundary.
#include "forming_sim/loads/config.h"
#include "forming_sim/loads/course_clock.h"
#include "forming_sim/loads/profile.h"

namespace forming_sim {

/// A centre c that moves with v(t), and a turn about it with w(t). Both are those of a
/// step (VelocityProfile::of_step), and the turn is done in full, so that a node that follows keeps its distance from the centre.
class RigidVelocity {
 public:
  RigidVelocity() = default;  ///< rest
  /// Of a boundary of kind velocity. Throws Error(invalid_scene) as VelocityProfile does.
  explicit RigidVelocity(const BoundaryConfig& config, const CourseClock& clock = {});

  bool turns() const { return !spin_.times().empty(); }
  bool moves() const { return !own_times().empty(); }
  /// Times of the run at the knots; none at rest.
  std::vector<double> times() const {
    std::vector<double> of_run;
    for (double own : own_times()) of_run.push_back(clock_.of_run(own));
    return of_run;
  }
  Vec3 velocity(double t) const { return velocity_.at(clock_.at(t)); }
  Vec3 spin(double t) const { return spin_.at(clock_.at(t)); }  ///< rad/s
  const Vec3& centre() const { return centre_; }     ///< at the start

  /// By which a point at x at the time t of the run moves on in dt, over dt (dt = 0: its velocity):
  /// v + w x r sin(a)/a + w x (w x r) dt (1 - cos a)/a^2,  r = x - c(t), a = |w| dt, v and w those of the step from t to t + dt.
  Vec3 at(double time, double dt, const Vec3& x) const;

 private:
  const std::vector<double>& own_times() const { return turns() ? spin_.times() : velocity_.times(); }

  VelocityProfile velocity_, spin_;
  CourseClock clock_;
  Vec3 centre_ = Vec3::Zero();
};

/// Two boundaries of kind velocity that say the same motion.
bool same_motion(const BoundaryConfig& a, const BoundaryConfig& b);

}  // namespace forming_sim
