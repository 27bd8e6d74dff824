#pragma once
// Tools that move as they are pushed: along the line of a force (a blank holder, a hammer), or about an axle (an idle roll, one with a torque on it).
// One equation for both, in the words of the first; about an axle M is the moment of inertia, F and R torques, V the spin:
//
//   M dV/dt = F(t) + R - alpha M V,   R: what the bodies press on it; alpha: its damping, and in settle stages theirs,
//
// with a spring to its guide, whose other end goes by g(t), s the way of the tool: K (g - s) + alpha M dg/dt more,
//
// V at the half step, as the velocities of nodes; k = (dt_previous + dt)/2 the kick, a = alpha k/2:
//
//   V* = ((1 - a) V + k F/M)/(1 + a),   V = V* + J/(M (1 + a)),   J = k R,
//
// and where it brakes so hard that this would swing, a > 1, V* = (k F/M)/(2 a),   V = V* + J/(2 a M).
//
// Past a stop it stands from the next step on, V = 0 and in contact as if it were infinitely heavy, and loses its momentum to the stop; the V that
// it would have come to instead tells when it leaves. How far it is past the stop then, no more than its way in a step, stays.
//
// V and J depend on each other: contact finds both (contact/driven.h). Taken one after the other, the tool would feed the swings of
// what it touches, whatever its mass and however short the step.
#include <algorithm>
#include <limits>

#include "forming_sim/loads/config.h"
#include "forming_sim/loads/motion.h"
#include "forming_sim/loads/profile.h"

namespace forming_sim {

/// Unit vector along the guide; where none is given along the largest of the forces, where all are zero along the initial velocity; zero where that is, too.
Vec3 guide_of(const MotionConfig& config);
/// Whether a force or velocity lies along it, to round-off.
bool goes_along(const Vec3& given, const Vec3& guide);

/// Between a tool and its guide.
struct Spring {
  double stiffness = 0;  ///< K, N/m; 0: there is none
  RigidMotion end;       ///< g(t) along the guide
  Vec3 guide = Vec3::Zero();
  double force(double t, double gone) const { return stiffness > 0 ? stiffness * (guide.dot(end.at(t).translation) - gone) : 0; }  ///< on the tool, N
  double end_speed(double t) const { return stiffness > 0 ? guide.dot(end.at(t).velocity) : 0; }                                ///< dg/dt, m/s
};

class Drive {
 public:
  /// force: over the time of its own; mass above 0; speed: at the start.
  Drive(const ScalarProfile& force, double mass, double damping, double speed) : force_(force), mass_(mass), damping_(damping), speed_(speed), momentum_(speed) {}
  void tie_to(const Spring& spring) { spring_ = spring; }
  /// Stops at `ahead` and at -`behind` of the way, m; infinite: none.
  void put_stops(double ahead, double behind) { ahead_ = ahead, behind_ = behind; }

  /// Its times count from the time t of the run on.
  void begin(double t) { began_ = t; }

  /// V* of a step from t on.
  double free_speed(double t, double kick) const;
  /// By so much an impulse changes V: 1/(M (1 + a)), braked hard 1/(2 a M); against a stop 0.
  double inverse_mass(double kick) const { return against_ == 0 ? free_inverse_mass(kick) : 0; }
  double force(double t) const { return force_.at(t - began_) + spring_.force(t - began_, gone_); }  ///< F and what its spring gives, N; N m
  double mass() const { return mass_; }    ///< M, kg; kg m2
  double gone() const { return gone_; }    ///< from the start, m; rad
  double speed() const { return speed_; }  ///< V of the last step, m/s; rad/s
  bool springs_back() const { return spring_.stiffness > 0; }
  bool stands() const { return against_ != 0; }  ///< against a stop
  /// The longest step that its spring bears, 2/omega, s; infinite without one.
  double stable_step() const;
  /// Adds `rate` to alpha, 1/s, until it is told another: in settle stages.
  void slow_down(double rate) { settling_ = rate; }

 protected:
  ~Drive() = default;  ///< what drives is one of the two below
  void take_step(double t, double kick, double dt, double push, double answer);
  template <class Archive> void exchange_motion(Archive& a) {
    for (double* value : {&gone_, &speed_, &momentum_, &against_}) a.number(*value);
  }

 private:
  double kept(double kick) const { return std::max(0.0, 1 - braking(kick)); }  ///< of V
  double free_inverse_mass(double kick) const;
  double unstopped_speed(double t, double kick) const;
  double braking(double kick) const { return 0.5 * (damping_ + settling_) * kick; }  ///< a

  ScalarProfile force_;
  Spring spring_;
  double mass_, damping_, settling_ = 0;
  double began_ = 0;  ///< s
  double gone_ = 0, speed_ = 0;
  double ahead_ = std::numeric_limits<double>::infinity(), behind_ = ahead_;  ///< m
  double against_ = 0;  ///< 1: the stop ahead, -1: the one behind, 0: neither
  double momentum_ = 0;  ///< over M: V as J says; speed_ is as near to it as contact searches, and no impulse is lost
};

/// Along its guide.
class ForceDrive : public Drive {
 public:
  /// Of a motion of kind force, its mass above 0, kg (kg/m in plane strain). Throws Error(invalid_scene) where forces and initial velocity are not
  /// along one line or all zero without a guide, and as ScalarProfile does.
  explicit ForceDrive(const MotionConfig& config);

  const Vec3& guide() const { return guide_; }
  /// A told pose with its way along the guide replaced by that of the tool, `way` at `speed`.
  Pose placed(Pose told, double way, double speed) const;
  /// The step has been done, dt long, with V = V* + push; answer: J, along the guide, N s.
  void take(double t, double kick, double dt, double push, double answer);
  /// How far it has gone on along its force since it last pressed on anything, m; 0: it has not pressed yet, is on a spring, or has come to a stop.
  double fallen(double t) const;

  template <class Archive> void exchange(Archive& a) {
    exchange_motion(a);
    a.number(pressed_at_);
  }

 private:
  Vec3 guide_;
  double pressed_at_ = std::numeric_limits<double>::quiet_NaN();  ///< gone() when it last pressed
};

/// About its axle, which the tool's told motion takes along; its centre of mass lies on that. V is all of its spin about the axle: what the told turn has about it
/// is taken out of the free one, so that the tool is carried without being turned.
class AxleDrive : public Drive {
 public:
  /// Of a motion with an axle, its inertia above 0, kg m2 (kg m in plane strain). Throws Error(invalid_scene) as ScalarProfile does.
  explicit AxleDrive(const MotionConfig& config);

  const Vec3& axle() const { return axle_; }  ///< at the start, of length 1
  /// Against the told orientation, rad.
  double angle() const { return gone() - told_; }
  /// The step has been done, dt long, with V = V* + push; answer: J, about the axle, N m s; told: what the told turn has about the axle in the step, rad.
  void take(double t, double kick, double dt, double push, double answer, double told) {
    take_step(t, kick, dt, push, answer);
    told_ += told;
  }
  template <class Archive> void exchange(Archive& a) {
    exchange_motion(a);
    a.number(told_);
  }

 private:
  Vec3 axle_;
  double told_ = 0;  ///< turned about the axle by what is told, rad
};

}  // namespace forming_sim
