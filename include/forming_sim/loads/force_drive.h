#pragma once
// A tool that a force drives, or that flies with a mass of its own: a blank holder, a hammer. It is guided along the line of its force and does not turn.
//
//   M dV/dt = F(t) + R - alpha M V,   R: what the bodies press on it; alpha: its damping, and in settle stages theirs,
//
// V at the half step, as the velocities of nodes; k = (dt_previous + dt)/2 the kick, a = alpha k/2:
//
//   V* = ((1 - a) V + k F/M)/(1 + a),   V = V* + J/(M (1 + a)),   J = k R.
//
// V and J depend on each other: contact finds both (contact/driven.h). Taken one after the other, the tool would feed the swings of
// what it touches, whatever its mass and however short the step.
#include <limits>

#include "forming_sim/loads/config.h"
#include "forming_sim/loads/profile.h"

namespace forming_sim {

/// Unit vector along the largest of the forces, where all are zero along the initial velocity; zero where that is, too.
Vec3 guide_of(const MotionConfig& config);
/// Whether a force or velocity lies along it, to round-off.
bool goes_along(const Vec3& given, const Vec3& guide);

class ForceDrive {
 public:
  /// Of a motion of kind force, its mass above 0, kg (kg/m in plane strain). Throws Error(invalid_scene) where forces and initial velocity are not
  /// along one line or all zero, and as ScalarProfile does.
  explicit ForceDrive(const MotionConfig& config);

  /// Its times count from the time t of the run on.
  void begin(double t) { began_ = t; }

  const Vec3& guide() const { return guide_; }
  /// V* of a step from t on, along the guide, m/s.
  double free_speed(double t, double kick) const;
  /// 1/(M (1 + a)), 1/kg.
  double inverse_mass(double kick) const;
  /// The step has been done, dt long, with V = V* + push; J: `answer`, N s along the guide.
  void take(double t, double kick, double dt, double push, double answer);

  double force(double t) const { return force_.at(t - began_); }  ///< F, N
  double mass() const { return mass_; }                  ///< M, kg
  /// Adds `rate` to alpha, 1/s, until it is told another: in settle stages.
  void slow_down(double rate) { settling_ = rate; }

  /// How far it has gone on along its force since it last pressed on anything, m; 0: it has not pressed yet.
  double fallen(double t) const;

  Vec3 way() const { return way_ * guide_; }         ///< from the start, m
  Vec3 velocity() const { return speed_ * guide_; }  ///< V of the last step, m/s

  template <class Archive> void exchange(Archive& a) {
    for (double* value : {&way_, &speed_, &momentum_, &pressed_at_}) a.number(*value);
  }

 private:
  double braking(double kick) const { return 0.5 * (damping_ + settling_) * kick; }  ///< a

  Vec3 guide_;
  ScalarProfile force_;  ///< along guide_, N
  double mass_, damping_, settling_ = 0;
  double began_ = 0;     ///< s
  double way_ = 0, speed_ = 0;
  double pressed_at_ = std::numeric_limits<double>::quiet_NaN();  ///< way_ when it last pressed
  double momentum_ = 0;  ///< over M: V as J says, m/s; speed_ is as near to it as contact searches, and no impulse is lost
};

}  // namespace forming_sim
