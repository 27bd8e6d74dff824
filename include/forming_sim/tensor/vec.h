#pragma once
// Vectors of the current configuration. A model of dimension 2 lives in z = 0 and
// uses the same types, so that everything but the element kernels and the
// contact geometry is written once.
#include <Eigen/Core>

#include "forming_sim/parallel/large_array.h"

namespace forming_sim {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// A nodal record: x, y, z and a fourth component that stays zero, so that a
/// node is loaded whole (32 bytes).
using Node = Eigen::Vector4d;
using NodeField = LargeArray<Node>;

inline Vec3 vec3(const Node& node) { return node.head<3>(); }
/// Written in halves: a record that is written number by number and then loaded whole waits for the writes.
inline Node node(double x, double y, double z) {
  typedef double Half __attribute__((vector_size(16), may_alias));
  Node record;
  Half* halves = reinterpret_cast<Half*>(record.data());
  halves[0] = Half{x, y};
  halves[1] = Half{z, 0};
  return record;
}
inline Node node(const Vec3& v) { return node(v.x(), v.y(), v.z()); }

}  // namespace forming_sim
