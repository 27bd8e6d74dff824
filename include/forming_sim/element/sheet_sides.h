#pragma once
// Between which of its sets the thickness of a body is measured.
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "forming_sim/element/body.h"

namespace forming_sim {

/// `bottom` and `top`; where the mesh has not both, `inside` and `outside`, as a tube; of a section that is a rectangle at the start, with its four sides as
/// sets (but for an end that has been trimmed away), twice as high as long and not about the axis, as the wall of a tube, `left` and `right`. Empty names:
/// it is no sheet.
std::pair<std::string, std::string> sides_of_sheet(const BodyModel& body, bool axisymmetric);

/// Corners of a facet of its surface in the joined numbering; a segment repeats its second one.
std::array<int, 3> joined_corners(const BodyModel& body, int facet);

/// Facets of the surface whose nodes are all in this set of the mesh.
std::vector<int> facets_within(const Mesh& mesh, const std::string& set);

}  // namespace forming_sim
