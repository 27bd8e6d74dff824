#pragma once
// Between which of its sets the thickness of a body is measured.
#include <string>
#include <utility>

#include "forming_sim/element/body.h"

namespace forming_sim {

/// `bottom` and `top`; where the mesh has not both, `inside` and `outside`, as a tube; of a section that is a rectangle at the start, with its four sides as
/// sets, twice as high as long and not about the axis, as the wall of a tube, `left` and `right`. Empty names: it is no sheet.
std::pair<std::string, std::string> sides_of_sheet(const BodyModel& body, bool axisymmetric);

}  // namespace forming_sim
