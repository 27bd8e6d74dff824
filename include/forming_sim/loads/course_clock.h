#pragma once
// Since when what is given over times acts.
#include <cmath>
#include <limits>

namespace forming_sim {

/// A course acts from the beginning of a stage on, and its times count from there; that of stage 0 from the start of the run.
class CourseClock {
 public:
  CourseClock() = default;
  explicit CourseClock(int stage) : stage_(stage), began_(stage == 0 ? 0 : std::numeric_limits<double>::infinity()) {}

  /// A stage begins at the time t of the run.
  void begin(int stage, double t) {
    if (stage == stage_) began_ = t;
  }
  bool runs() const { return std::isfinite(began_); }
  /// The course's own time at the time t of the run; below 0: it does not act yet.
  double at(double t) const { return t - began_; }
  /// The run's time at a time of the course.
  double of_run(double own) const { return own + began_; }

 private:
  int stage_ = 0;
  double began_ = 0;
};

}  // namespace forming_sim
