#pragma once
// Continuous check: do two features touch while their nodes move in straight
// lines? Conservative: the answer "no" is certain.
//
// From the closest points a plane between the features is known; the time up to
// which it still parts all nodes is safe, and so is the time in which the volume
// that the nodes span does not change its sign. Advance to the later of the two,
// find the closest points anew, and so on: features that slide past each other,
// or turn about each other, need one turn.
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// Point 0 against the segment (2D, corners = 2) or triangle (corners = 3) of
/// the points after it; x: places now, d: displacements. They count as touching
/// where they meet on the way, are found nearer than `least` at a turn or at the
/// end, or the question cannot be decided in 200 turns.
bool point_meets_facet(int corners, const Node* x, const Node* d, double least);

/// Segment 0-1 against segment 2-3.
bool edges_meet(const Node* x, const Node* d, double least);

}  // namespace forming_sim
