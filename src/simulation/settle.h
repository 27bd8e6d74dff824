#pragma once
// Kinetic damping: a body released from its tools swings towards equilibrium;
// each time its kinetic energy has passed a peak it stands near a minimum of the
// potential energy, and all velocities are set to zero there. It rests when the
// kinetic energy has stayed below a fraction of the elastic energy for a while
// that is long against the slowest swing seen.
namespace forming_sim {

class Settle {
 public:
  Settle() = default;
  /// shortest: s, a lower bound of the slowest swing (size^2 / (thickness wave speed)).
  Settle(double start, double shortest, double fraction, double elastic)
      : shortest_(shortest), fraction_(fraction), elastic_(elastic), last_stop_(start), quiet_since_(start) {}

  struct Verdict { bool stop_motion, at_rest; };
  /// After each step: time and kinetic energy. stop_motion: set the velocities to zero.
  Verdict observe(double t, double kinetic) {
    if (kinetic > fraction_ * elastic_) quiet_since_ = t;
    Verdict verdict{false, false};
    if (kinetic < previous_ && t - last_stop_ > 0.05 * shortest_) {
      verdict.stop_motion = true;
      longest_swing_ = longest_swing_ > t - last_stop_ ? longest_swing_ : t - last_stop_;
      last_stop_ = t;
      previous_ = 0;
    } else {
      previous_ = kinetic;
    }
    const double window = 2 * longest_swing_ > shortest_ ? 2 * longest_swing_ : shortest_;
    verdict.at_rest = t - quiet_since_ > window;
    return verdict;
  }

 private:
  double shortest_ = 0, fraction_ = 0, elastic_ = 0;
  double last_stop_ = 0, quiet_since_ = 0, previous_ = 0, longest_swing_ = 0;
};

}  // namespace forming_sim
