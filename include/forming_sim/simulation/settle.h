#pragma once
// How bodies that their tools have left come to rest: adaptive dynamic relaxation.
//
// Mass-proportional damping alpha = 2 omega is critical for the mode of frequency
// omega, and every mode then dies out at least as exp(-omega t). omega is taken
// from the motion itself, by the quotient of what a body did in a window of T,
//   omega^2 = - d . dF / (d . M d),
// d half its way, dF the change of the mean forces from its first half to its second
// (simulation/ways.h). The window is over when omega T has come to kTurn: it is as long as
// the body takes to turn by that in its swing. Modes then count by their energy: in a window of one
// step a fast swing of a millionth of the energy hides the slow one, and such damping lets that creep. So what
// has most energy is damped first, and the slowest swing decides in the end; what flies is not held up. A window that goes
// on beyond kTurn / omega tells that the body is slower. None is much longer than the slowest swing of a strip.
// Where forces that fade, loads or motions lead a body on, it answers them as it springs back slowly, and is not drawn back on that way: windows
// are of two steps then, and tell of its swings about it. Damping for the way itself would drag on it, and
// bend the body anew: of a bent strip 4 % of the curvature.
//
// A body rests when its kinetic energy and the energy that the forces out of
// balance could still set free, F . M^-1 F / (2 omega^2), F their mean in the later half of the window, have together stayed below a
// fraction of its elastic energy for a while. There omega is that of the body's own swing: what it moved by as a whole
// does not count where nothing draws it back, unless it falls, and kTurn / T is the least that is known of omega. A body that returns to its shape keeps
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
  static constexpr double kSteady = 0.1;  ///< by which a force that a body falls by may change from half to half
  static constexpr double kFall = 10;     ///< times the slowest swing: when what it gives the body counts
  static constexpr double kDrift = 0.25;  ///< of that: below it a body that moves as a whole drifts

  /// Of a body that is looked at: its energies, J.
  struct Energies {
    double kinetic = 0, elastic = 0;
  };

  Settle() = default;
  /// shortest_of: s, time for which each body must be quiet (size^2 / (thickness wave
  /// speed), about the slowest swing of a strip). tools: how many may settle with the bodies, as movers behind these.
  /// least: J, of which positions tell nothing: what has less rests.
  Settle(double start, std::vector<double> shortest_of, std::size_t tools, double fraction, double least)
      : fraction_(fraction), least_(least), quiet_since_(start), looked_(start),
        shortest_of_(std::move(shortest_of)), swing_of_(shortest_of_.size() + tools), most_of_(shortest_of_.size(), 0.0) {}

  /// What a body or tool has done in its window up to now, by steps of dt, s; led: it is led on. True when the window is over.
  bool over(std::size_t mover, const Way& way, double dt, bool led) {
    Swing& swing = swing_of_[mover];
    const double slower = kTurn / way.T;
    const bool drifts = !led && of(way.rigid_dF, way.rigid_Md) < kDrift * slower;
    const double own_dF = way.d_dF - (drifts ? way.rigid_dF : 0), own_Md = way.d_Md - (drifts ? way.rigid_Md : 0), omega = of(own_dF, own_Md);
    // A steady force drives it on, and will have given it what is no rest any more.
    const bool falls = drifts && way.rigid_dF_MdF < kSteady * kSteady * way.rigid_F_MF && 0.5 * way.rigid_F_MF * std::pow(kFall * slowest_of(mover), 2) > swing.below;
    const bool flies = falls || (drifts && 2 * way.rigid_Md > swing.below * way.T * way.T);
    const bool turned = led ? omega > 0 : omega >= slower;
    if (turned || (!led && slower < swing.omega)) {
      swing.omega = std::min(led ? omega : std::max(omega, slower), 0.5 / dt);
      swing.v_Mv = 4 * (flies ? way.d_Md : own_Md) / (way.T * way.T);
      swing.v_Kv = swing.v_Mv * (flies ? std::max(0.0, -way.d_dF / way.d_Md) : swing.omega * swing.omega);
    } else if (swing.omega > 0) {
      return led;
    }
    swing.F_MF = way.F_MF - (drifts ? way.rigid_F_MF : 0);
    swing.falls = falls;
    return led || turned || way.T >= kLongest * slowest_of(mover);
  }
  /// A tool that presses on the bodies no more.
  void forget(std::size_t mover) { swing_of_[mover] = Swing(); }
  /// omega of all together, each by the energy of its mean motion.
  void take_together(double dt) {
    double v_Kv = 0, v_Mv = 0;
    for (const Swing& swing : swing_of_) v_Kv += swing.v_Kv, v_Mv += swing.v_Mv;
    if (v_Mv > 0) omega_ = std::min(std::sqrt(v_Kv / v_Mv), 0.5 / dt);
  }
  /// alpha, 1/s.
  double damping() const { return 2 * omega_; }

  /// The energies of each body, and the kinetic one of each tool, which counts beside the elastic energy of all. True when all rest.
  bool at_rest(double t, const std::vector<Energies>& bodies, const std::vector<double>& of_tools) {
    restless_ = quiet_ = 0;
    bool quiet = true;
    double elastic = 0, most = 0;
    const auto judge = [&](double kinetic, std::size_t mover, double beside, double had) {
      Swing& swing = swing_of_[mover];
      const double omega = swing.omega > 0 ? swing.omega : 1 / slowest_of(mover);  // while nothing is known of it
      const double restless = kinetic + 0.5 * swing.F_MF / (omega * omega), below = std::max(fraction_ * std::max(beside, 1e-6 * had), least_);
      swing.below = below;
      if ((swing.omega == 0 && kinetic > 0) || swing.falls || restless > below) quiet = false;
      if (quiet_ == 0 || restless * quiet_ > restless_ * below) restless_ = restless, quiet_ = below;
    };
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      most_of_[b] = std::max(most_of_[b], bodies[b].elastic + bodies[b].kinetic);
      judge(bodies[b].kinetic, b, bodies[b].elastic, most_of_[b]);
      elastic += bodies[b].elastic;
      most += most_of_[b];
    }
    for (std::size_t k = 0; k < of_tools.size(); ++k) judge(of_tools[k], bodies.size() + k, elastic, most);
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
      for (double* value : {&swing.omega, &swing.v_Kv, &swing.v_Mv, &swing.F_MF, &swing.below}) a.number(*value);
      a.number(swing.falls);
    });
    a.list(most_of_);
  }

 private:
  static double of(double d_dF, double d_Md) { return d_Md > 0 && d_dF < 0 ? std::sqrt(-d_dF / d_Md) : 0; }

  /// A tool swings with the slowest of the bodies, s.
  double slowest_of(std::size_t mover) const { return mover < shortest_of_.size() ? shortest_of_[mover] : *std::max_element(shortest_of_.begin(), shortest_of_.end()); }

  /// Of a body or tool by its last window, or by the running one once that is longer; omega without what drifts; v its mean velocity
  /// there, without a drift of less energy than rest may have: `below`, J.
  struct Swing {
    double omega = 0, v_Kv = 0, v_Mv = 0, F_MF = 0, below = 0;
    bool falls = false;
  };

  double fraction_ = 0, least_ = 0, quiet_since_ = 0, looked_ = 0, restless_ = 0, quiet_ = 0;
  double omega_ = 0;               ///< of all together: what damps
  std::vector<double> shortest_of_;  ///< of each body, s
  std::vector<Swing> swing_of_;      ///< of each body, then of each tool
  std::vector<double> most_of_;    ///< of each body, J: the largest of its elastic and kinetic energy
};

}  // namespace forming_sim
