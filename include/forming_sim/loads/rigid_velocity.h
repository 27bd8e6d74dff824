#pragma once
// Velocity of a set that moves and turns as a rigid body: prescribed along its axes by a boundary.
#include <optional>
#include <vector>

#include "forming_sim/loads/config.h"
#include "forming_sim/loads/course_clock.h"
#include "forming_sim/loads/motion.h"
#include "forming_sim/loads/profile.h"

namespace forming_sim {

/// A centre c that moves with v(t), and a turn about it with w(t). Both are those of a
/// step (VelocityProfile::of_step), and the turn is done in full, so that a node that follows keeps its distance from the centre.
/// Of a trajectory: what takes a point from the pose at the beginning of the step to that at its end, so that it stays on its way to rounding.
class RigidVelocity {
 public:
  /// What it is in one step: of a point at x at its beginning, the way to where it is at its end, over dt.
  struct Step {
    Vec3 v = Vec3::Zero();       ///< of the centre, m/s
    Mat3 turn = Mat3::Zero();    ///< 1/s
    Vec3 centre = Vec3::Zero();  ///< at its beginning, m
    Vec3 at(const Vec3& x) const { return v + turn * (x - centre); }
  };
  RigidVelocity() = default;  ///< rest
  /// Of a boundary that is_driven(). Throws Error(invalid_scene) as VelocityProfile and RigidMotion do.
  explicit RigidVelocity(const BoundaryConfig& config, const CourseClock& clock = {});

  bool turns() const { return places_ ? turning_ : !spin_.times().empty(); }
  bool moves() const { return !own_times().empty(); }
  /// Times of the run at the knots; none at rest.
  std::vector<double> times() const {
    std::vector<double> of_run;
    for (double own : own_times()) of_run.push_back(clock_.of_run(own));
    return of_run;
  }
  Vec3 velocity(double t) const { return places_ ? places_->at(clock_.at(t)).velocity : velocity_.at(clock_.at(t)); }
  Vec3 spin(double t) const { return places_ ? places_->at(clock_.at(t)).spin : spin_.at(clock_.at(t)); }  ///< rad/s
  const Vec3& centre() const { return centre_; }     ///< at the start

  /// From the time t of the run on (dt = 0: its velocity there):
  /// v + w x r sin(a)/a + w x (w x r) dt (1 - cos a)/a^2,  r = x - c(t), a = |w| dt, v and w those of the step from t to t + dt.
  Step step(double time, double dt) const;

 private:
  const std::vector<double>& own_times() const { return places_ ? times_ : turns() ? spin_.times() : velocity_.times(); }
  Step between_places(double t, double dt) const;

  VelocityProfile velocity_, spin_;
  std::optional<RigidMotion> places_;  ///< of a trajectory, in the place of both
  std::vector<double> times_;          ///< its knots
  Vec3 first_ = Vec3::Zero();          ///< its displacement at the first of them, from which others count
  bool turning_ = false;
  CourseClock clock_;
  Vec3 centre_ = Vec3::Zero();
};

/// Two boundaries that are driven and say the same motion.
bool same_motion(const BoundaryConfig& a, const BoundaryConfig& b);

}  // namespace forming_sim
