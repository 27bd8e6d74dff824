#include "forming_sim/loads/profile.h"

#include "forming_sim/config/fault.h"

namespace forming_sim {

ScalarProfile::ScalarProfile(const std::vector<double>& times, const std::vector<double>& values) {
  std::vector<Vec3> points;
  for (double value : values) points.push_back(Vec3(value, 0, 0));
  curve_ = Curve::linear(times, points);
}

VelocityProfile::VelocityProfile(const std::vector<double>& times, const std::vector<Vec3>& velocities,
                                 const std::string& shape) {
  if (shape == "linear")
    velocity_ = Curve::linear(times, velocities);
  else if (shape == "smooth")
    velocity_ = Curve::cubic(times, velocities);
  else
    throw Error(Code::invalid_scene,
                "profile: given \"" + shape + "\" for a velocity; give linear or smooth");
  path_ = velocity_.integral(0);
}

}  // namespace forming_sim
