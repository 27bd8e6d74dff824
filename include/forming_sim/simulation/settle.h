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
#include <cstddef>
#include <utility>
#include <vector>

#include "forming_sim/simulation/ways.h"

namespace forming_sim {

class Settle {
 public:
  static constexpr int kInterval = 10;    ///< steps between two looks at the windows

  /// Of a body that is looked at: its energies, J.
  struct Energies {
    double kinetic = 0, elastic = 0;
  };

  Settle() = default;
  /// shortest_of: s, time for which each body must be quiet (size^2 / (thickness wave
  /// speed), about the slowest swing of a strip). tools: in how many ways tools may settle with the bodies, as movers behind these.
  /// least_of: J, of which positions of each body tell nothing: one that has less rests.
  Settle(double start, std::vector<double> shortest_of, std::vector<double> least_of, std::size_t tools, double fraction)
      : fraction_(fraction), quiet_since_(start), looked_(start), shortest_of_(std::move(shortest_of)),
        least_of_(std::move(least_of)), swing_of_(shortest_of_.size() + tools), most_of_(shortest_of_.size(), 0.0) {}

  /// What a body or tool has done in its window up to now, by steps of dt, s; led: it is led on. True when the window is over.
  bool over(std::size_t mover, const Way& way, double dt, bool led);
  /// A tool that presses on the bodies no more.
  void forget(std::size_t mover) { swing_of_[mover] = Swing(); }
  /// omega of all together, each by the energy of its mean motion.
  void take_together(double dt);
  /// alpha, 1/s.
  double damping() const { return 2 * omega_; }

  /// The energies of each body, and the kinetic one of each tool, which counts beside the elastic energy of all. True when all rest.
  bool at_rest(double t, const std::vector<Energies>& bodies, const std::vector<double>& of_tools);
  /// The bodies are not on their own yet: what they were held by fades.
  void not_yet(double t) { quiet_since_ = t; }
  /// They were quiet when they were last looked at: they rest when they stay so.
  bool is_quiet() const { return looked_ > quiet_since_; }
  /// Kinetic and releasable energy of the body farthest from rest when they were last looked at, and what it should be below, J.
  double restless() const { return restless_; }
  std::size_t most_restless() const { return static_cast<std::size_t>(mover_); }  ///< whose: of the bodies, and after them of the tools that at_rest() was told
  double quiet() const { return quiet_; }
  /// For so long they have to be quiet, s.
  double shortest() const {
    double longest = 0;
    for (std::size_t b = 0; b < shortest_of_.size(); ++b)
      if (most_of_[b] > least_of_[b]) longest = std::max(longest, shortest_of_[b]);
    return longest;
  }

  template <class Archive> void exchange(Archive& a) {
    for (double* value : {&fraction_, &quiet_since_, &looked_, &omega_, &restless_, &quiet_, &mover_}) a.number(*value);
    a.list(shortest_of_);
    a.list(least_of_);
    a.each(swing_of_, [&](Swing& swing) {
      for (double* value : {&swing.omega, &swing.v_Kv, &swing.v_Mv, &swing.F_MF, &swing.below}) a.number(*value);
      a.number(swing.falls);
    });
    a.list(most_of_);
  }

 private:
  /// A tool swings with the slowest of the bodies, s.
  double slowest_of(std::size_t mover) const { return mover < shortest_of_.size() ? shortest_of_[mover] : *std::max_element(shortest_of_.begin(), shortest_of_.end()); }

  /// Of a body or tool by its last window, or by the running one once that is longer; omega without what drifts; v its mean velocity
  /// there, without a drift of less energy than rest may have: `below`, J.
  struct Swing {
    double omega = 0, v_Kv = 0, v_Mv = 0, F_MF = 0, below = 0;
    bool falls = false;
  };

  double fraction_ = 0, quiet_since_ = 0, looked_ = 0, restless_ = 0, quiet_ = 0, mover_ = 0;
  double omega_ = 0;               ///< of all together: what damps
  std::vector<double> shortest_of_;  ///< of each body, s
  std::vector<double> least_of_;     ///< of each body, J
  std::vector<Swing> swing_of_;      ///< of each body, then of each tool
  std::vector<double> most_of_;    ///< of each body, J: the largest of its elastic and kinetic energy
};

}  // namespace forming_sim
