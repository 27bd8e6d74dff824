#pragma once
// Vectors and rotations as messages.
#include <Eigen/Geometry>

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Vector3.h>

#include "forming_sim/tensor/vec.h"

namespace forming_sim {

inline geometry_msgs::Point point_message(const Vec3& v) {
  geometry_msgs::Point p;
  p.x = v.x();
  p.y = v.y();
  p.z = v.z();
  return p;
}

inline geometry_msgs::Vector3 vector_message(const Vec3& v) {
  geometry_msgs::Vector3 m;
  m.x = v.x();
  m.y = v.y();
  m.z = v.z();
  return m;
}

inline geometry_msgs::Pose pose_message(const Vec3& position, const Mat3& rotation) {
  const Eigen::Quaterniond q(rotation);
  geometry_msgs::Pose pose;
  pose.position = point_message(position);
  pose.orientation.w = q.w();
  pose.orientation.x = q.x();
  pose.orientation.y = q.y();
  pose.orientation.z = q.z();
  return pose;
}

/// A unit vector normal to n (n not zero).
inline Vec3 any_normal_to(const Vec3& n) {
  Vec3 axis = Vec3::Zero();
  Eigen::Index least = 0;
  n.cwiseAbs().minCoeff(&least);
  axis[least] = 1;
  return n.cross(axis).normalized();
}

}  // namespace forming_sim
