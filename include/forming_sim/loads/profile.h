#pragma once
// Loads and prescribed velocities over time.
#include <string>
#include <vector>

#include "forming_sim/loads/curve.h"

namespace forming_sim {

/// A load over time, of the shapes of ScalarProfile; throws as that does.
Curve load_curve(const std::vector<double>& times, const std::vector<Vec3>& values, const std::string& shape);

/// A number over time, level before the first knot and after the last. shape
/// "linear": straight lines; "smooth": cubics that are level at the knots.
/// Throws Error(invalid_scene) for another shape and as Curve does. No knots: zero.
class ScalarProfile {
 public:
  ScalarProfile() = default;
  ScalarProfile(const std::vector<double>& times, const std::vector<double>& values, const std::string& shape = "linear");
  double at(double t) const { return curve_.at(t).x(); }

 private:
  Curve curve_;
};

/// A velocity over time, m/s: constant outside its knots. shape "linear":
/// straight lines; "smooth": cubics with zero acceleration at the knots.
/// Throws Error(invalid_scene) for another shape and as Curve does. No knots: zero.
class VelocityProfile {
 public:
  VelocityProfile() = default;
  VelocityProfile(const std::vector<double>& times, const std::vector<Vec3>& velocities,
                  const std::string& shape);
  Vec3 at(double t) const { return velocity_.at(t); }
  /// Over a step from t to t + dt: that in the middle of it, which is the mean but for the curvature of a smooth one; where a knot lies within, which may be as steep as it likes, the mean.
  Vec3 of_step(double t, double dt) const;
  /// Exact integral of the velocity, m.
  Vec3 displacement(double from, double to) const { return path_.at(to) - path_.at(from); }
  const std::vector<double>& times() const { return velocity_.times(); }

 private:
  Curve velocity_, path_;
};

}  // namespace forming_sim
