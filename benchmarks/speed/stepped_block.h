#pragma once
// A block of about so many elements that does whole steps, with its stages timed: elements, nodes,
// and the time-step bound as seldom as a quiet run asks for it. Its nodes are so heavy that the
// forces do not change the given motion; everything else is what a run without contact does.
#include <memory>
#include <string>
#include <vector>

#include "speed/families.h"

namespace forming_sim::bench {

class SteppedBlock {
 public:
  /// elements: about how many; layers: of plasticity, all alike, that harden by a curve.
  SteppedBlock(const SpeedFamily& family, const SpeedMotion& motion, long elements, int threads, int layers = 1, const char* curve = "voce");

  /// Times of the stages of one step, s, from the quickest of some turns of some steps each.
  StepTimes measure(int turns);

  long elements() const { return elements_; }  ///< those that ask a law: points of one-point cells
  /// Bytes that a step reads and writes, every array as often as a pass of the step goes over it.
  double step_bytes() const;
  const char* kernels() const { return engine_->kernel_name(); }

 private:
  StepTimes turn(long steps);

  const SpeedMotion motion_;
  NodeField x_, v_, v_before_;
  std::vector<double> mass_;
  std::unique_ptr<Elements> engine_;
  StepTimes times_;
  long elements_ = 0;
  bool nodal_pressure_;
};

/// The sum of the stages, s.
inline double whole(const StepTimes& t) { return t.bound + t.pressure + t.cells + t.nodes; }

}  // namespace forming_sim::bench
