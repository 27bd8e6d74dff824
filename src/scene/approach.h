#pragma once
// Tools that are put where they first touch the bodies.
#include <vector>

#include "forming_sim/config/fault.h"
#include "forming_sim/scene/scene.h"
#include "forming_sim/simulation/model.h"

namespace forming_sim {

/// Moves the tools of the model that have an approach, one after the other, and notes by how much.
void approach_tools(const Scene& scene, Model& model, std::vector<Fault>& faults);

}  // namespace forming_sim
