#pragma once
// How much its rate raises the yield stress of a layer of a one-point cell whose mean and variation flow together (element/flow_together.h).
//
// R follows from the plastic strain dp of the step, and dp from R. With a given R they flow as far as
//   dp = B (R_most - R)
// very nearly: R_most is how many times the trial is outside of the surface of sigma_s, where nothing flows, and B that of the
// radial return at first, sigma_s/(3 mu), and then that of the first flow. From the second flow on it is the line through the last two:
// coordinates flow from different R on, so that it is bent. Between flows R is where the line meets R(dp/dt).
#include "forming_sim/material/rate_flow.h"

namespace forming_sim {

template <class T> class RateOfFlow {
 public:
  static constexpr int kFlows = 4;  ///< the last goes by the R that three have led to; a bent cell then bears its moment to 3e-3 (rate_elements_test)

  /// most: R_most, at least 1; radial: sigma_s/(3 mu).
  RateOfFlow(const RateLaw& law, const T& most, const T& radial) : law_(law), most_(most), radial_(radial), B_(radial), dp_(0), last_(most) { meet(); }

  const T& R() const { return R_; }
  /// R of the next flow, after the last has come to dp.
  void follow(const T& dp) {
    const T way = last_ - R_;
    const auto apart = absolute(way) > T(1e-9);
    B_ = select(apart, smaller(larger((dp - dp_) / select(apart, way, T(1)), T(0.1) * radial_), T(10) * radial_), B_);
    most_ = R_ + dp / B_;
    dp_ = dp;
    last_ = R_;
    meet();
  }

 private:
  void meet() {
    const YieldStress<T> level{B_, T(0), T(0)};
    YieldStress<T> at = level;
    const T w = log_of_flow(law_, B_ * most_, T(1), B_ * (most_ - T(1)), level, [&](const T&) { return level; }, at);
    R_ = select(most_ > T(1), rate_factor(law_, w).value, T(1));
  }

  const RateLaw& law_;
  T most_, radial_, B_, R_;
  T dp_, last_;  ///< of the flow that was followed last, and its R
};

}  // namespace forming_sim
