#pragma once
// What a simulation is and where it stands, as result.h5 keeps it.
#include "forming_sim/results/frame.h"
#include "forming_sim/results/gauge.h"
#include "forming_sim/scene/scene.h"
#include "forming_sim/simulation/simulation.h"

namespace forming_sim {

/// meaning: of the scene (results/meaning.h).
ResultHeader take_header(const Simulation& simulation, const Scene& scene, const std::string& meaning);
/// measures: taken at the same step.
Frame take_frame(const Simulation& simulation, const Measures& measures);

}  // namespace forming_sim
