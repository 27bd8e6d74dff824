#pragma once
// From a valid scene to what the solver runs.
#include "forming_sim/scene/scene.h"
#include "forming_sim/simulation/model.h"
#include "forming_sim/simulation/plan.h"

namespace forming_sim {

/// Meshes the blanks, reads the files, resolves the sets.
/// Throws SceneError with all faults that need the geometry.
Model build_model(const Scene& scene);
RunPlan build_plan(const Scene& scene);

}  // namespace forming_sim
