#pragma once
// Finite rotations by rotation vectors: axis times angle, in radians.
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180;

/// W v = vector x v.
Mat3 skew(const Vec3& vector);

/// exp of the skew matrix of `vector` (Rodrigues): turns by |vector| about it.
Mat3 rotation_matrix(const Vec3& vector);

/// Angular velocity of rotation_matrix(vector(t)), in the world:
/// w = [I + (1 - cos a)/a^2 W + (a - sin a)/a^3 W^2] rate, W v = vector x v, a = |vector|.
Vec3 spin_of(const Vec3& vector, const Vec3& rate);

}  // namespace forming_sim
