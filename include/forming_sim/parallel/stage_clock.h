#pragma once
// The wall time of stages: read only for somebody who asks for it (forming_bench costs, speed), since a look at a
// clock between all stages of a small step is a hundredth of it.
#include <chrono>

namespace forming_sim {

/// Adds what has passed since the last stage ended to the one that ends now. Times: seconds a stage, as members.
template <class Times> class StageClock {
 public:
  /// Of nobody: it does nothing.
  explicit StageClock(Times* times) : times_(times) { begins(); }
  /// What has passed until now is of no stage.
  void begins() {
    if (times_) last_ = std::chrono::steady_clock::now();
  }
  void ends(double Times::* stage) {
    if (!times_) return;
    const auto now = std::chrono::steady_clock::now();
    times_->*stage += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  Times* times_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace forming_sim
