#pragma once
// Where a step spends its time: kept only for somebody who asks for it
// (forming_bench speed), at the price of reading a clock between the stages.
#include <chrono>

namespace forming_sim {

/// Wall time of the stages of a step, s, summed over the steps.
struct StepTimes {
  double bound = 0;     ///< stable time step of the elements
  double pressure = 0;  ///< pressures of the nodes, where they have some
  double cells = 0;     ///< elements: positions gathered, law, forces on the nodes of each cell
  double nodes = 0;     ///< forces of the cells summed by node, velocities, positions
};

/// Adds what has passed since the last stage ended to the one that ends now.
class StageClock {
 public:
  explicit StageClock(StepTimes* times) : times_(times) {
    if (times_) last_ = std::chrono::steady_clock::now();
  }
  void ends(double StepTimes::* stage) {
    if (!times_) return;
    const auto now = std::chrono::steady_clock::now();
    times_->*stage += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  StepTimes* times_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace forming_sim
