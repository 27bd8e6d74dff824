#pragma once
// A path in space over time, made of polynomials between knots. Every motion
// and prescribed velocity of the package is one of these, so that values,
// slopes and integrals are exact and never summed up step by step.
#include <array>
#include <vector>

#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// Piecewise polynomial of degree 5 at most. Outside the knots it goes on as a
/// straight line, which is level unless the curve is an integral.
/// The builders throw Error(invalid_scene) when times are not finite and
/// strictly increasing, or values differ from times in number or are not finite.
/// No knots: zero everywhere. One knot: constant.
class Curve {
 public:
  Curve() = default;
  /// Straight lines between knots.
  static Curve linear(const std::vector<double>& times, const std::vector<Vec3>& values);
  /// 3 u^2 - 2 u^3 between knots: slope zero at every knot.
  static Curve cubic(const std::vector<double>& times, const std::vector<Vec3>& values);
  /// 10 u^3 - 15 u^4 + 6 u^5 between knots: slope and curvature zero at every knot.
  static Curve quintic(const std::vector<double>& times, const std::vector<Vec3>& values);
  /// Cubic spline through the knots: slope and curvature continuous, slope zero at both ends.
  static Curve spline(const std::vector<double>& times, const std::vector<Vec3>& values);

  Vec3 at(double t) const;
  /// d/dt; at a knot that of the piece to its right.
  Vec3 slope(double t) const;
  /// The curve whose slope is this one and which is zero at t = `zero_at`.
  /// Throws Error(internal_error) for pieces of degree 5.
  Curve integral(double zero_at) const;

  const std::vector<double>& times() const { return times_; }

 private:
  /// Coefficients of u^0 .. u^5, u = (t - times_[k]) / (times_[k+1] - times_[k]).
  using Piece = std::array<Vec3, 6>;
  static Curve with_knots(const std::vector<double>& times, const std::vector<Vec3>& values);

  std::vector<double> times_;
  std::vector<Piece> pieces_;                        ///< one fewer than times_
  Vec3 first_ = Vec3::Zero(), last_ = Vec3::Zero();  ///< values at the outer knots
  Vec3 slope_before_ = Vec3::Zero(), slope_after_ = Vec3::Zero();
};

}  // namespace forming_sim
