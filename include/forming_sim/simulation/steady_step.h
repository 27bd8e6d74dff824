#pragma once
// Steps of nearly the same length.
//
// Each step alone may be stable, and steps of lengths that change feed the swings of a mesh all the same. What a
// leapfrog step of dt keeps of a swing of frequency omega is 1/2 v.(1 - (omega dt)^2/4) v + 1/2 omega^2 x^2: steps that change
// by a part d change that by up to 2 (omega dt)^2/(4 - (omega dt)^2) d of it (its derivative with dt), 8.5 d for the fastest swing that a safety of .9 leaves, more or less
// as the swing stands then. Over thousands of changes that comes to e to the number of them times the square of it, and to
// far more where the changes keep time with a swing, as they do where the swing makes the limit: bodies that swing freely
// for 1e5 steps whose length followed their limit gained up to a hundred times their energy. Changes that are slow beside the swing leave it what it has
// (v.v/omega is an adiabatic invariant). So a step is what the mesh has borne for hundreds of steps, for thousands where its limit comes
// and goes, and where that changes goes after it in small parts.
#include <algorithm>

namespace forming_sim {

class SteadyStep {
 public:
  /// Steps; a limit is felt for one to two times as many. Each time it falls where it had risen it is felt for longer: what has come and gone will do so again.
  static constexpr int kAtFirst = 250, kLonger = 4, kAtMost = 2000;

  /// Once a step; limit: what the mesh bears now, with its safety, s. What the step is to be.
  double follow(double limit) {
    if (dt_ == 0) dt_ = lately_ = before_ = limit;
    if (++counted_ > while_) {
      before_ = lately_;
      lately_ = limit;
      counted_ = 1;
    }
    lately_ = std::min(lately_, limit);
    const double borne = std::min(lately_, before_);
    rises_ = borne > (rises_ ? 1 : kBand) * dt_;
    if (limit < dt_ && rose_) {
      while_ = std::min(kLonger * while_, kAtMost);
      rose_ = false;
    }
    rose_ = rose_ || rises_;
    if (limit < dt_) dt_ = std::min(std::max(limit, (1 - kPart) * dt_), kOver * limit);
    else if (rises_) dt_ = std::min(borne, (1 + (borne > kFar * dt_ ? kLargePart : kPart)) * dt_);
    return dt_;
  }

  double dt() const { return dt_; }  ///< of the last step, s

  template <class Archive> void exchange(Archive& a) {
    for (double* value : {&dt_, &lately_, &before_}) a.number(*value);
    for (int* value : {&counted_, &while_}) a.number(*value);
    for (bool* value : {&rises_, &rose_}) a.raw(*value);
  }

 private:
  static constexpr double kPart = 2e-4;  ///< of a step, by which it changes at most from one to the next
  static constexpr double kLargePart = 1e-3, kFar = 1.2;  ///< likewise while the mesh has borne so many times the step: after a squeeze, say, that is over
  static constexpr double kOver = 1.01;  ///< of its limit where that falls faster: what the safety has room for (choose_dt() keeps it below the stable step)
  static constexpr double kBand = 1.02;  ///< of the step: less than that is not gone after upwards
  double dt_ = 0;
  double lately_ = 0, before_ = 0;  ///< the least limits of the last `counted_` steps and of as many as while_ before them, s
  int counted_ = 0, while_ = kAtFirst;
  bool rises_ = false, rose_ = false;
};

}  // namespace forming_sim
