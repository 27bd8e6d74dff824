#pragma once
// Whose an element is.
#include <algorithm>

#include "forming_sim/simulation/model.h"

namespace forming_sim {

/// element: 0 or more and below Model::element_count().
inline const BodyModel& body_of_element(const Model& model, int element) {
  return *std::find_if(model.bodies.begin(), model.bodies.end(), [element](const BodyModel& body) { return element < body.first_element + body.element_count; });
}

}  // namespace forming_sim
