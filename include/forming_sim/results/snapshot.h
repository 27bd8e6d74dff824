#pragma once
// What a simulation is and where it stands, as result.h5 keeps it.
#include "forming_sim/results/frame.h"
#include "forming_sim/results/thickness.h"
#include "forming_sim/scene/scene.h"
#include "forming_sim/simulation/simulation.h"

namespace forming_sim {

ResultHeader take_header(const Simulation& simulation, const Scene& scene);
/// sheets: of the simulation's model.
Frame take_frame(const Simulation& simulation, const Thickness& sheets);

}  // namespace forming_sim
