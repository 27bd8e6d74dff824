#pragma once
// Steps of nearly the same length.
//
// Each step alone may be stable, and steps of lengths that change feed the swings of a mesh all the same. What a
// leapfrog step of dt keeps of a swing of frequency omega is 1/2 v.(1 - (omega dt)^2/4) v + 1/2 omega^2 x^2: steps that change
// by a part d change that by up to 2 (omega dt)^2/(4 - (omega dt)^2) d of it (its derivative with dt), 8.5 d for the fastest swing that a safety of .9 leaves, more or less
// as the swing stands then. Over thousands of changes that comes to e to the number of them times the square of it, and to
// far more where the changes keep time with a swing, as they do where the swing makes the limit: bodies that swing freely
// for 1e5 steps whose length followed their limit gained up to a hundred times their energy. Changes that are slow beside the swing leave it what it has
// (v.v/omega is an adiabatic invariant). So a step goes after its limit in small parts.
#include <algorithm>

namespace forming_sim {

class SteadyStep {
 public:
  /// Once a step; limit: what the mesh bears now, with its safety, s. What the step is to be.
  double follow(double limit) {
    if (dt_ == 0) dt_ = limit;
    rises_ = limit > (rises_ ? 1 : kBand) * dt_;
    if (limit < dt_) dt_ = std::min(std::max(limit, (1 - kPart) * dt_), kOver * limit);
    else if (rises_) dt_ = std::min(limit, (1 + (limit > kFar * dt_ ? kLargePart : kPart)) * dt_);
    return dt_;
  }

  double dt() const { return dt_; }  ///< of the last step, s

  template <class Archive> void exchange(Archive& a) {
    a.number(dt_);
    a.raw(rises_);
  }

 private:
  static constexpr double kPart = 2e-4;  ///< of a step, by which it changes at most from one to the next
  static constexpr double kLargePart = 1e-3, kFar = 1.2;  ///< likewise while the limit is so many times the step: after a squeeze, say, that is over
  static constexpr double kOver = 1.01;  ///< of its limit where that falls faster: what the safety has room for (choose_dt() keeps it below the stable step)
  static constexpr double kBand = 1.02;  ///< of the step: limits that come and go within that change nothing
  double dt_ = 0;
  bool rises_ = false;
};

}  // namespace forming_sim
