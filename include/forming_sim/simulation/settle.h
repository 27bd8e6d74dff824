#pragma once
// How bodies that their tools have left come to rest: adaptive dynamic relaxation.
//
// Mass-proportional damping alpha = 2 omega is critical for the mode of frequency
// omega, and every mode then dies out at least as exp(-omega t). omega is taken
// from the motion itself, by the quotient of what a body did in a window of T,
//   omega^2 = - d . dF / (d . M d),
// d the way between the middles of its halves, dF the change of the mean forces from half to half
// (simulation/ways.h). The window is over when omega T has come to kTurn: it is as long as
// the body takes to turn by that in its swing. Modes then count by their energy: in a window of one
// step a fast swing of a millionth of the energy hides the slow one, and such damping lets that creep. So what
// has most energy is damped first, and the slowest swing decides in the end. What a body moved by as a whole
// does not count where nothing draws it back: it drifts. A window that goes on beyond kTurn / omega tells that the body
// is slower: omega = kTurn / T from there. None is much longer than the slowest swing of a strip.
// Where forces that fade lead a body on, it answers them as it springs back slowly, and is not drawn back on that way: windows
// are as short as they can be, and tell of its swings about it. Damping for the way itself would drag on it, and
// bend the body anew: of a bent strip 4 % of the curvature.
//
// A body rests when its kinetic energy and the energy that the forces out of
// balance could still set free, F . M^-1 F / (2 omega^2), F their mean in the later half of the window, have together stayed below a
// fraction of its elastic energy for a while. A body that returns to its shape keeps
// none: then a millionth of the largest energy that it has had in the stage stands for it; and what positions cannot tell is no unrest.
// Each is judged by itself, with the omega of its own motion: beside a block under pressure a soft strip has no energy, and its forces, over
// the block's omega^2, next to none to set free. One that has had no energy in the stage has nothing to come to rest from, however slowly it would swing.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "forming_sim/simulation/ways.h"

namespace forming_sim {

class Settle {
 public:
  static constexpr int kInterval = 10;    ///< steps between two looks at the windows
  static constexpr double kTurn = 0.5;    ///< omega T of a window
  static constexpr double kLongest = 2;   ///< T of a window, of the time for which a body must be quiet
  static constexpr double kDrift = 0.25;  ///< of that: below it a body that moves as a whole drifts

  /// Of a body that is looked at: its energies, J.
  struct Energies {
    double kinetic = 0, elastic = 0;
  };
  /// Of the tools that settle with the bodies: F . M^-1 F, and their energy, J.
  struct Unrest {
    double F_MF = 0, kinetic = 0;
  };

  Settle() = default;
  /// shortest_of: s, time for which each body must be quiet (size^2 / (thickness wave
  /// speed), about the slowest swing of a strip). least: J, of which positions tell nothing: what has less rests.
  Settle(double start, std::vector<double> shortest_of, double fraction, double least)
      : fraction_(fraction), least_(least), quiet_since_(start), looked_(start), shortest_of_(std::move(shortest_of)), swing_of_(shortest_of_.size()), most_of_(shortest_of_.size(), 0.0) {}

  /// What body b has done in its window up to now, by steps of dt, s; led: forces that fade lead it on. True when the window is over.
  bool over(std::size_t b, const Way& way, double dt, bool led) {
    Swing& swing = swing_of_[b];
    if (led) {
      if (const double omega = of(way.d_dF, way.d_Md); omega > 0) swing = {std::min(omega, 0.5 / dt), 4 * way.d_Md / (way.T * way.T), way.F_MF};
      return true;
    }
    const double slower = kTurn / way.T;
    const bool drifts = of(way.rigid_dF, way.rigid_Md) < kDrift * slower;
    const double d_dF = way.d_dF - (drifts ? way.rigid_dF : 0), d_Md = way.d_Md - (drifts ? way.rigid_Md : 0), omega = of(d_dF, d_Md);
    if (omega < slower && slower >= swing.omega) return false;
    swing = {std::min(std::max(omega, slower), 0.5 / dt), 4 * d_Md / (way.T * way.T), way.F_MF};
    return omega >= slower || way.T >= kLongest * shortest_of_[b];
  }
  /// omega of all bodies together, each by the energy of its mean motion; driven: V . M V of the tools that settle with them.
  void take_together(double driven) {
    double v_Kv = 0, v_Mv = driven;
    for (const Swing& swing : swing_of_) v_Kv += swing.v_Mv * swing.omega * swing.omega, v_Mv += swing.v_Mv;
    if (v_Kv > 0) omega_ = std::sqrt(v_Kv / v_Mv);
  }
  /// alpha, 1/s.
  double damping() const { return 2 * omega_; }

  /// The energies of each body, and the unrest of the tools that settle with them, which counts beside the elastic energy of all. True when all rest.
  bool at_rest(double t, const std::vector<Energies>& bodies, const Unrest& tools) {
    restless_ = quiet_ = 0;
    bool quiet = true;
    double elastic = 0, most = 0;
    const auto judge = [&](const Unrest& u, double omega, double beside, double had) {
      const double restless = u.kinetic + (omega > 0 ? 0.5 * u.F_MF / (omega * omega) : 0), below = std::max(fraction_ * std::max(beside, 1e-6 * had), least_);
      if ((omega == 0 && restless > least_) || restless > below) quiet = false;
      if (quiet_ == 0 || restless * quiet_ > restless_ * below) restless_ = restless, quiet_ = below;
    };
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      most_of_[b] = std::max(most_of_[b], bodies[b].elastic + bodies[b].kinetic);
      judge({swing_of_[b].F_MF, bodies[b].kinetic}, swing_of_[b].omega, bodies[b].elastic, most_of_[b]);
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
    a.each(swing_of_, [&](Swing& swing) {
      for (double* value : {&swing.omega, &swing.v_Mv, &swing.F_MF}) a.number(*value);
    });
    a.list(most_of_);
  }

 private:
  static double of(double d_dF, double d_Md) { return d_Md > 0 && d_dF < 0 ? std::sqrt(-d_dF / d_Md) : 0; }

  /// Of a body by its last window, or by the running one once that is longer; v the mean velocity of its swing there.
  struct Swing {
    double omega = 0, v_Mv = 0, F_MF = 0;
  };

  double fraction_ = 0, least_ = 0, quiet_since_ = 0, looked_ = 0, restless_ = 0, quiet_ = 0;
  double omega_ = 0;               ///< of all together: what damps
  std::vector<double> shortest_of_;  ///< of each body, s
  std::vector<Swing> swing_of_;      ///< likewise
  std::vector<double> most_of_;    ///< likewise, J: the largest of its elastic and kinetic energy
};

}  // namespace forming_sim
