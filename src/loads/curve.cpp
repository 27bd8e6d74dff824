#include "forming_sim/loads/curve.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "forming_sim/config/fault.h"

namespace forming_sim {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

/// Slopes at the knots of the cubic spline with zero slope at both ends:
/// continuity of the curvature at an inner knot k, h = t_{k+1} - t_k, asks
/// h_k s_{k-1} + 2 (h_{k-1} + h_k) s_k + h_{k-1} s_{k+1} = 3 (h_k d_{k-1} + h_{k-1} d_k), d the chords'
/// slopes.
std::vector<Vec3> spline_slopes(const std::vector<double>& t, const std::vector<Vec3>& y) {
  const int n = static_cast<int>(t.size());
  std::vector<Vec3> slopes(n, Vec3::Zero());
  if (n < 3) return slopes;
  std::vector<double> diagonal(n), upper(n);
  // Thomas: eliminate downwards, then substitute back; diagonally dominant.
  for (int k = 1; k < n - 1; ++k) {
    const double before = t[k] - t[k - 1], after = t[k + 1] - t[k];
    const Vec3 right = 3 * (after / before * (y[k] - y[k - 1]) + before / after * (y[k + 1] - y[k]));
    const double factor = k == 1 ? 0 : after / diagonal[k - 1];
    diagonal[k] = 2 * (before + after) - factor * (k == 1 ? 0 : upper[k - 1]);
    upper[k] = before;
    slopes[k] = right - factor * slopes[k - 1];
  }
  for (int k = n - 2; k >= 1; --k) slopes[k] = (slopes[k] - upper[k] * slopes[k + 1]) / diagonal[k];
  return slopes;
}

}  // namespace

Curve Curve::with_knots(const std::vector<double>& times, const std::vector<Vec3>& values) {
  if (times.size() != values.size())
    throw Error(Code::invalid_scene, "times: given " + std::to_string(times.size()) + " knots with " +
                                         std::to_string(values.size()) + " values; give one value per time");
  for (size_t k = 0; k < times.size(); ++k) {
    if (!std::isfinite(times[k]) || !values[k].allFinite())
      throw Error(Code::invalid_scene, "times[" + std::to_string(k) +
                                           "]: the time or its value is not finite; give finite numbers");
    if (k > 0 && times[k] <= times[k - 1])
      throw Error(Code::invalid_scene, "times[" + std::to_string(k) + "]: given " + number(times[k]) +
                                           " s after " + number(times[k - 1]) +
                                           " s; times must increase from knot to knot");
  }
  Curve curve;
  curve.times_ = times;
  Piece zero;
  zero.fill(Vec3::Zero());
  curve.pieces_.assign(times.empty() ? 0 : times.size() - 1, zero);
  for (size_t k = 0; k < curve.pieces_.size(); ++k) curve.pieces_[k][0] = values[k];
  if (!times.empty()) {
    curve.first_ = values.front();
    curve.last_ = values.back();
  }
  return curve;
}

Curve Curve::linear(const std::vector<double>& times, const std::vector<Vec3>& values) {
  Curve curve = with_knots(times, values);
  for (size_t k = 0; k < curve.pieces_.size(); ++k) curve.pieces_[k][1] = values[k + 1] - values[k];
  return curve;
}

Curve Curve::cubic(const std::vector<double>& times, const std::vector<Vec3>& values) {
  Curve curve = with_knots(times, values);
  for (size_t k = 0; k < curve.pieces_.size(); ++k) {
    const Vec3 rise = values[k + 1] - values[k];
    curve.pieces_[k][2] = 3 * rise;
    curve.pieces_[k][3] = -2 * rise;
  }
  return curve;
}

Curve Curve::quintic(const std::vector<double>& times, const std::vector<Vec3>& values) {
  Curve curve = with_knots(times, values);
  for (size_t k = 0; k < curve.pieces_.size(); ++k) {
    const Vec3 rise = values[k + 1] - values[k];
    curve.pieces_[k][3] = 10 * rise;
    curve.pieces_[k][4] = -15 * rise;
    curve.pieces_[k][5] = 6 * rise;
  }
  return curve;
}

Curve Curve::spline(const std::vector<double>& times, const std::vector<Vec3>& values) {
  Curve curve = with_knots(times, values);
  const std::vector<Vec3> slopes = spline_slopes(times, values);
  for (size_t k = 0; k < curve.pieces_.size(); ++k) {
    const double span = times[k + 1] - times[k];
    const Vec3 rise = values[k + 1] - values[k], left = span * slopes[k], right = span * slopes[k + 1];
    curve.pieces_[k][1] = left;
    curve.pieces_[k][2] = 3 * rise - 2 * left - right;
    curve.pieces_[k][3] = left + right - 2 * rise;
  }
  return curve;
}

Vec3 Curve::at(double t) const {
  if (times_.empty()) return Vec3::Zero();
  if (t <= times_.front()) return first_ + (t - times_.front()) * slope_before_;
  if (t >= times_.back()) return last_ + (t - times_.back()) * slope_after_;
  const size_t k = std::upper_bound(times_.begin(), times_.end(), t) - times_.begin() - 1;
  const double u = (t - times_[k]) / (times_[k + 1] - times_[k]);
  const Piece& c = pieces_[k];
  return c[0] + u * (c[1] + u * (c[2] + u * (c[3] + u * (c[4] + u * c[5]))));
}

Vec3 Curve::slope(double t) const {
  if (times_.empty()) return Vec3::Zero();
  if (t < times_.front()) return slope_before_;
  if (t >= times_.back()) return slope_after_;
  const size_t k = std::upper_bound(times_.begin(), times_.end(), t) - times_.begin() - 1;
  const double span = times_[k + 1] - times_[k], u = (t - times_[k]) / span;
  const Piece& c = pieces_[k];
  return (c[1] + u * (2 * c[2] + u * (3 * c[3] + u * (4 * c[4] + u * 5 * c[5])))) / span;
}

Curve Curve::integral(double zero_at) const {
  Curve sum;
  if (times_.empty()) return sum;
  sum.times_ = times_;
  Vec3 value = Vec3::Zero();
  for (size_t k = 0; k < pieces_.size(); ++k) {
    const Piece& c = pieces_[k];
    if (!c[5].isZero(0))
      throw Error(Code::internal_error,
                  "the integral of a quintic curve was asked for; its degree 6 is not kept");
    const double span = times_[k + 1] - times_[k];
    Piece piece;
    piece[0] = value;
    for (int j = 0; j < 5; ++j) piece[j + 1] = span / (j + 1) * c[j];
    for (int j = 1; j <= 5; ++j) value += piece[j];
    sum.pieces_.push_back(piece);
  }
  sum.last_ = value;
  sum.slope_before_ = first_;
  sum.slope_after_ = last_;
  const Vec3 shift = sum.at(zero_at);
  for (Piece& piece : sum.pieces_) piece[0] -= shift;
  sum.first_ -= shift;
  sum.last_ -= shift;
  return sum;
}

}  // namespace forming_sim
