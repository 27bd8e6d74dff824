#pragma once
// Weight of the nodes.
#include <vector>

#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// f += m g. Give the physical masses, kg: mass scaling must not make a body heavier.
void add_gravity(const Vec3& gravity, const std::vector<double>& mass, NodeField& f);

/// Its work over a step, J: dt sum m g . (v_before + v_after) / 2.
double gravity_work(const Vec3& gravity, const std::vector<double>& mass, const NodeField& v_before,
                    const NodeField& v_after, double dt);

}  // namespace forming_sim
