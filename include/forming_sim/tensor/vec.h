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
inline Node node(const Vec3& v) { return Node(v.x(), v.y(), v.z(), 0); }

}  // namespace forming_sim
