#include "forming_sim/loads/profile.h"

#include <algorithm>

#include "forming_sim/config/fault.h"

namespace forming_sim {
namespace {

Curve curve_of(const std::vector<double>& times, const std::vector<Vec3>& values, const std::string& shape, const char* what) {
  if (shape == "linear") return Curve::linear(times, values);
  if (shape == "smooth") return Curve::cubic(times, values);
  throw Error(Code::invalid_scene, "profile: given \"" + shape + "\" for a " + what + "; give linear or smooth");
}

}  // namespace

Curve load_curve(const std::vector<double>& times, const std::vector<Vec3>& values, const std::string& shape) { return curve_of(times, values, shape, "load"); }

ScalarProfile::ScalarProfile(const std::vector<double>& times, const std::vector<double>& values,
                             const std::string& shape) {
  std::vector<Vec3> points;
  for (double value : values) points.push_back(Vec3(value, 0, 0));
  curve_ = load_curve(times, points, shape);
}

VelocityProfile::VelocityProfile(const std::vector<double>& times, const std::vector<Vec3>& velocities,
                                 const std::string& shape)
    : velocity_(curve_of(times, velocities, shape, "velocity")) {
  path_ = velocity_.integral(0);
}

Vec3 VelocityProfile::of_step(double t, double dt) const {
  const auto knot = std::upper_bound(times().begin(), times().end(), t);
  return knot != times().end() && *knot < t + dt ? Vec3(displacement(t, t + dt) / dt) : at(t + 0.5 * dt);
}

}  // namespace forming_sim
