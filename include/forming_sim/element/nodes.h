#pragma once
// The nodes' part of a step, symplectic Euler (3.39), shared by the threads of a run.
#include <vector>

#include "forming_sim/parallel/team.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// to = ((1 - a) v + kick f/m) / (1 + a), a = damping kick/2: the kick in a time of `kick` s with forces f (N), masses m
/// (kg) and damping (1/s) at the mean of the two velocities.
void kick_nodes(Team& team, const NodeField& v, const NodeField& f, const std::vector<double>& mass, double kick, double damping, NodeField& to);

/// x += dt v.
void move_nodes(Team& team, double dt, const NodeField& v, NodeField& x);

}  // namespace forming_sim
