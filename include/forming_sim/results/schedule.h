#pragma once
// When something is due again: at the first step at or after every multiple of
// an interval of simulated time, so that a resumed run keeps the same times.
#include <algorithm>
#include <cmath>

#include "forming_sim/scene/scene.h"
#include "forming_sim/simulation/stage_times.h"

namespace forming_sim {

class Schedule {
 public:
  /// interval: s; 0: never due.
  explicit Schedule(double interval) : interval_(interval) {}
  /// What was due up to `time` is done.
  void start(double time) { done_ = multiple(time); }
  /// Whether it becomes due after `from` and until `to`.
  bool due_between(double from, double to) const { return multiple(to) > multiple(from); }
  /// How often it becomes due until `time`.
  double times(double time) const { return multiple(time); }
  /// True once per multiple.
  bool due(double time) {
    if (!(interval_ > 0)) return false;
    const double now = multiple(time);
    if (now <= done_) return false;
    done_ = now;
    return true;
  }

 private:
  double multiple(double time) const { return interval_ > 0 ? std::floor(time / interval_ * (1 + 1e-12)) : 0; }
  double interval_;
  double done_ = 0;
};

/// Simulated time that `frames` are spread over, s. Settle stages mostly end long before their limits: together they count for
/// no more than the other stages, so that these get their share of frames, but a run to all limits has at most 20 times `frames`.
inline double time_of_frames(const std::vector<StageConfig>& stages) {
  double settling = 0, others = 0;
  for (const StageConfig& stage : stages) (stage.kind == "settle" ? settling : others) += longest_time(stage);
  return others > 0 ? std::max(others + std::min(settling, others), (others + settling) / 20) : settling;
}

/// Intervals of simulated time, s, with the defaults that OutputConfig states.
struct OutputIntervals {
  double frames = 0, history = 0, checkpoint = 0;
};
inline OutputIntervals output_intervals(const Scene& scene) {
  OutputIntervals intervals;
  const OutputConfig& output = scene.output;
  intervals.frames = output.interval > 0 ? output.interval : time_of_frames(scene.stages) / output.frames;
  intervals.history = output.history_interval > 0 ? output.history_interval : intervals.frames / 10;
  intervals.checkpoint = output.checkpoint_interval;
  return intervals;
}

}  // namespace forming_sim
