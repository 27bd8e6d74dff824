#pragma once
// Weight of the nodes.
#include <vector>

#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// f += m g. Give the physical masses, kg: mass scaling must not make a body heavier.
void add_gravity(const Vec3& gravity, const std::vector<double>& mass, NodeField& f);

}  // namespace forming_sim
