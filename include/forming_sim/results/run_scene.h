#pragma once
// From a scene to the files of its run: what every program of the package does.
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "forming_sim/scene/scene.h"
#include "forming_sim/simulation/simulation.h"

namespace forming_sim {

/// Validates the scene, makes the directory, runs it and leaves result.h5,
/// result.xdmf, surface.xdmf, history.csv, summary.json and checkpoint.h5 there.
/// resume_file: a checkpoint.h5 to go on from; "": from the start.
/// extra: further observers, called after those of the files, so that they find the
/// files complete at the end. Not owned.
/// built: the scene's simulation at its start where check_start() (results/start.h) has built it already, with its threads.
/// Throws SceneError where the scene is refused. Every other failure is in the
/// outcome. summary.json is left in either case where the directory is writable.
Outcome run_scene(const Scene& scene, const std::string& directory, int threads, const std::string& resume_file,
                  const std::atomic<bool>& cancel, const std::vector<Observer*>& extra = {},
                  std::unique_ptr<Simulation> built = nullptr);

/// Leaves a summary.json that says why a run did not start, where that is possible: not where another run holds the directory.
void note_refusal(const Scene& scene, const std::string& directory, const std::vector<Fault>& faults, Code code, const std::string& message);

}  // namespace forming_sim
