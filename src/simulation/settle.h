#pragma once
// How a body that its tools have left comes to rest: adaptive dynamic relaxation.
//
// Mass-proportional damping alpha = 2 omega is critical for the mode of frequency
// omega, and every mode then dies out at least as exp(-omega t). omega is taken
// from the motion itself by the Rayleigh quotient of the last step,
//   omega^2 = - v . (f_n - f_(n-1)) / (dt v . M v),
// so that fast modes are damped first and the slowest swing decides in the end.
//
// The body rests when its kinetic energy and the energy that the forces out of
// balance could still set free, f . M^-1 f / (2 omega^2), have together stayed below a
// fraction of the elastic energy for a while. A body that returns to its shape keeps
// none: then a millionth of all the energy that was put in stands for it; and what positions cannot tell is no unrest.
#include <algorithm>
#include <cmath>

namespace forming_sim {

class Settle {
 public:
  static constexpr int kInterval = 10;  ///< steps between two estimates of omega

  Settle() = default;
  /// shortest: s, time for which the body must be quiet (size^2 / (thickness wave
  /// speed), about the slowest swing of a strip). least: J, of which positions tell nothing: what has less rests.
  Settle(double start, double shortest, double fraction, double least) : shortest_(shortest), fraction_(fraction), least_(least), quiet_since_(start), looked_(start) {}

  /// v . (f_n - f_(n-1)) and v . M v of the free motion over a step dt.
  void estimate(double v_df, double v_Mv, double dt) {
    if (v_Mv > 0 && v_df < 0) omega_ = std::min(std::sqrt(-v_df / (dt * v_Mv)), 0.5 / dt);
  }
  /// alpha, 1/s.
  double damping() const { return 2 * omega_; }

  /// f_Mf = f . M^-1 f, energies in J; put_in: the largest work and initial energy so far.
  /// True when the body rests.
  bool at_rest(double t, double f_Mf, double kinetic, double elastic, double put_in) {
    restless_ = kinetic + (omega_ > 0 ? 0.5 * f_Mf / (omega_ * omega_) : 0);
    quiet_ = std::max(fraction_ * std::max(elastic, 1e-6 * put_in), least_);
    looked_ = t;
    if ((omega_ == 0 && restless_ > least_) || restless_ > quiet_) quiet_since_ = t;
    return t - quiet_since_ > shortest_;
  }
  /// The body is not on its own yet: what it was held by fades.
  void not_yet(double t) { quiet_since_ = t; }
  /// It was quiet when it was last looked at: it rests when it stays so.
  bool is_quiet() const { return looked_ > quiet_since_; }
  /// Kinetic and releasable energy when it was last looked at, and what it should be below, J.
  double restless() const { return restless_; }
  double quiet() const { return quiet_; }
  /// For so long it has to be quiet, s.
  double shortest() const { return shortest_; }

 private:
  double shortest_ = 0, fraction_ = 0, least_ = 0, quiet_since_ = 0, looked_ = 0, omega_ = 0, restless_ = 0, quiet_ = 0;
};

}  // namespace forming_sim
