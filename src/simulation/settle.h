#pragma once
// How bodies that their tools have left come to rest: adaptive dynamic relaxation.
//
// Mass-proportional damping alpha = 2 omega is critical for the mode of frequency
// omega, and every mode then dies out at least as exp(-omega t). omega is taken
// from the motion itself by the Rayleigh quotient of the last step,
//   omega^2 = - v . (f_n - f_(n-1)) / (dt v . M v),
// so that fast modes are damped first and the slowest swing decides in the end.
//
// A body rests when its kinetic energy and the energy that the forces out of
// balance could still set free, f . M^-1 f / (2 omega^2), have together stayed below a
// fraction of its elastic energy for a while. A body that returns to its shape keeps
// none: then a millionth of the largest energy that it has had in the stage stands for it; and what positions cannot tell is no unrest.
// Each is judged by itself, with the omega of its own motion: beside a block under pressure a soft strip has no energy, and its forces, over
// the block's omega^2, next to none to set free. One that has had no energy in the stage has nothing to come to rest from, however slowly it would swing.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace forming_sim {

class Settle {
 public:
  static constexpr int kInterval = 10;  ///< steps between two estimates of omega

  /// Of a body over a step: v . (f_n - f_(n-1)) and v . M v of the free motion.
  struct Swing {
    double v_df = 0, v_Mv = 0;
  };
  /// Of a body that is looked at: f . M^-1 f, and its energies, J.
  struct Unrest {
    double f_Mf = 0, kinetic = 0, elastic = 0;
  };

  Settle() = default;
  /// shortest_of: s, time for which each body must be quiet (size^2 / (thickness wave
  /// speed), about the slowest swing of a strip). least: J, of which positions tell nothing: what has less rests.
  Settle(double start, std::vector<double> shortest_of, double fraction, double least)
      : fraction_(fraction), least_(least), quiet_since_(start), looked_(start), shortest_of_(std::move(shortest_of)), omega_of_(shortest_of_.size(), 0.0), most_of_(shortest_of_.size(), 0.0) {}

  /// One swing a body, over a step dt; driven: v . M v of the tools that settle with them.
  void estimate(const std::vector<Swing>& swings, double driven, double dt) {
    Swing all{0, driven};
    for (std::size_t b = 0; b < swings.size(); ++b) {
      take(swings[b], dt, omega_of_[b]);
      all.v_df += swings[b].v_df;
      all.v_Mv += swings[b].v_Mv;
    }
    take(all, dt, omega_);
  }
  /// alpha, 1/s.
  double damping() const { return 2 * omega_; }

  /// One unrest a body, and that of the tools that settle with them, which counts beside the elastic energy of all. True when all rest.
  bool at_rest(double t, const std::vector<Unrest>& bodies, const Unrest& tools) {
    restless_ = quiet_ = 0;
    bool quiet = true;
    double elastic = 0, most = 0;
    const auto judge = [&](const Unrest& u, double omega, double beside, double had) {
      const double restless = u.kinetic + (omega > 0 ? 0.5 * u.f_Mf / (omega * omega) : 0), below = std::max(fraction_ * std::max(beside, 1e-6 * had), least_);
      if ((omega == 0 && restless > least_) || restless > below) quiet = false;
      if (quiet_ == 0 || restless * quiet_ > restless_ * below) restless_ = restless, quiet_ = below;
    };
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      most_of_[b] = std::max(most_of_[b], bodies[b].elastic + bodies[b].kinetic);
      judge(bodies[b], omega_of_[b], bodies[b].elastic, most_of_[b]);
      elastic += bodies[b].elastic;
      most += most_of_[b];
    }
    judge(tools, omega_, elastic, most);
    const bool was_quiet = is_quiet();
    looked_ = t;
    if (!quiet) quiet_since_ = t;
    return was_quiet && t - quiet_since_ > shortest();
  }
  /// The bodies are not on their own yet: what they were held by fades.
  void not_yet(double t) { quiet_since_ = t; }
  /// They were quiet when they were last looked at: they rest when they stay so.
  bool is_quiet() const { return looked_ > quiet_since_; }
  /// Kinetic and releasable energy of the body farthest from rest when they were last looked at, and what it should be below, J.
  double restless() const { return restless_; }
  double quiet() const { return quiet_; }
  /// For so long they have to be quiet, s.
  double shortest() const {
    double longest = 0;
    for (std::size_t b = 0; b < shortest_of_.size(); ++b)
      if (most_of_[b] > least_) longest = std::max(longest, shortest_of_[b]);
    return longest;
  }

  template <class Archive> void exchange(Archive& a) {
    for (double* value : {&fraction_, &least_, &quiet_since_, &looked_, &omega_, &restless_, &quiet_}) a.number(*value);
    a.list(shortest_of_);
    a.list(omega_of_);
    a.list(most_of_);
  }

 private:
  static void take(const Swing& swing, double dt, double& omega) {
    if (swing.v_Mv > 0 && swing.v_df < 0) omega = std::min(std::sqrt(-swing.v_df / (dt * swing.v_Mv)), 0.5 / dt);
  }

  double fraction_ = 0, least_ = 0, quiet_since_ = 0, looked_ = 0, restless_ = 0, quiet_ = 0;
  double omega_ = 0;               ///< of all together: what damps
  std::vector<double> shortest_of_;  ///< of each body, s
  std::vector<double> omega_of_;   ///< likewise
  std::vector<double> most_of_;    ///< likewise, J: the largest of its elastic and kinetic energy
};

}  // namespace forming_sim
