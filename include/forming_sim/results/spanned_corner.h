#pragma once
// Corners of tools that lie under the middle of a body's face, whose ends lie on both sides of the corner: metal that flows around it flows around
// the chord of the cell, as if the corner were rounded by that. What it takes to press or extrude is then too large, in backward extrusion with 12 cells by a fifth.
#include <string>
#include <vector>

#include "forming_sim/results/run_record.h"
#include "forming_sim/simulation/simulation.h"

namespace forming_sim {

/// Now: the face that stands off farthest, between its nodes from the surface of the tool, over its length. Of bodies that are no sheets (for these: results/sharp_bend.h) and are
/// folded about the corner, by tools that bear a tenth of their force there. gap: Frame::contact_gap. element: a face's of the surface.
SpannedCorner farthest_spanned_corner(const Simulation& simulation, const std::vector<float>& gap);

}  // namespace forming_sim
