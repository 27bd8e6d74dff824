#pragma once
// What a run will cost, told before it starts.
#include <string>

#include "forming_sim/scene/scene.h"

namespace forming_sim {

struct RunEstimate {
  long nodes = 0, elements = 0;
  double time_step_s = 0;   ///< stable step in the initial configuration
  double sim_time_s = 0;    ///< all stages, settling by its limit
  double steps = 0;         ///< sim_time_s / time_step_s; the step shrinks as cells are squeezed
  double wall_time_s = 0;   ///< steps times the time of a step measured here, before most contact has begun
  double memory_bytes = 0;  ///< of this process with the simulation in it
};

/// Builds the simulation and takes its first steps, for at most a second.
/// The scene must be valid. Throws what build_model and Simulation throw, and
/// Error(mesh_error) where the first steps already fail.
RunEstimate estimate_cost(const Scene& scene, int threads);

/// A few lines for a terminal.
std::string estimate_text(const RunEstimate& estimate);

}  // namespace forming_sim
