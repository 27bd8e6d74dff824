#pragma once
// Can a scene without faults in its fields start?
#include <memory>
#include <string>
#include <vector>

#include "forming_sim/scene/scene.h"
#include "forming_sim/simulation/simulation.h"

namespace forming_sim {

struct StartCheck {
  std::vector<Fault> faults;       ///< all that keeps a scene from running
  std::vector<std::string> notes;  ///< of a scene without faults: with what warnings its run begins
  std::unique_ptr<Simulation> simulation;  ///< of a scene without faults: its run at the start
};

/// Looks for what validate() finds; where it finds nothing also for what shows only where the run is built: bodies
/// inside tools, ties that find nothing, more steps than any machine makes.
/// known: faults of reading the scene. Throws Error(cancelled) where this thread is told to stop (parallel/interrupt.h).
StartCheck check_start(const Scene& scene, std::vector<Fault> known, int threads);

/// The run of a valid scene at its start; reactions are kept of the nodes of its probes. model: as build_model() makes it of the scene.
/// Throws SceneError, also where the run would take more than 1e12 steps.
std::unique_ptr<Simulation> build_run(const Scene& scene, Model model, int threads);

}  // namespace forming_sim
