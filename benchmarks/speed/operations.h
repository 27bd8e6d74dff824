#pragma once
// How many operations an element's step takes.
#include "speed/families.h"

namespace forming_sim::bench {

/// Additions, multiplications, divisions, roots, minima and maxima of the element, its nodes' share in the forces included;
/// of a step in which it yields, or of one in which it does not. Counted by running the law and
/// the geometry that the kernels run with a scalar that counts.
double operations_of_step(const SpeedFamily& family, const SpeedMotion& motion);

}  // namespace forming_sim::bench
