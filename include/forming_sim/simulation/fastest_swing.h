#pragma once
// A bound on the fastest swing of a mesh: the largest eigenvalue of M^-1 K, K the elastic
// tangent at the present state with plastic flow held. K as it is when flow goes on is not
// stiffer, and held nodes only slow the mesh down. K takes a vector by a difference of the
// forces (Elements::elastic_forces), so that all cells, laws and pressures are covered by what
// the steps themselves do. What acts at the end of a step in closed form, contact and ties,
// does not count; nor does bulk viscosity, which element/step_bounds.h adds.
#include "forming_sim/element/elements.h"
#include "forming_sim/loads/boundary.h"
#include "forming_sim/simulation/lanczos.h"

namespace forming_sim {

/// nodal: the rates at x, whose largest is a bound already and never passed. run: another start
/// of the iteration for every number. In 1/s2. Not for Law::classical.
SpectrumBound fastest_swing(Elements& elements, const NodeField& x, const NodalRates& nodal, const BoundarySet& held, int dimension, long run);

}  // namespace forming_sim
