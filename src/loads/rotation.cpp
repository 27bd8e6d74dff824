#include "forming_sim/loads/rotation.h"

#include <Eigen/Geometry>
#include <cmath>

namespace forming_sim {

Mat3 skew(const Vec3& v) {
  Mat3 w;
  w << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return w;
}

// R = I + sin a / a W + (1 - cos a) / a^2 W^2, with 1 - cos a = 2 sin^2(a/2).
Mat3 rotation_matrix(const Vec3& vector) {
  const double angle = vector.norm();
  const Mat3 w = skew(vector);
  if (angle < 1e-8) return Mat3::Identity() + w + 0.5 * w * w;
  const double half = std::sin(0.5 * angle) / angle;
  return Mat3::Identity() + std::sin(angle) / angle * w + 2 * half * half * w * w;
}

Vec3 spin_of(const Vec3& vector, const Vec3& rate) {
  const double angle = vector.norm(), square = angle * angle;
  double first = 0.5 - square / 24, second = 1.0 / 6 - square / 120;
  if (angle > 1e-2) {
    const double half = std::sin(0.5 * angle) / angle;
    first = 2 * half * half;
    second = (angle - std::sin(angle)) / (square * angle);
  }
  const Vec3 turned = vector.cross(rate);
  return rate + first * turned + second * vector.cross(turned);
}

}  // namespace forming_sim
