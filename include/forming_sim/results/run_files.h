#pragma once
// The files of a run, as observers.
#include <memory>
#include <string>
#include <vector>

#include "forming_sim/results/checkpoint.h"
#include "forming_sim/results/gauge.h"

namespace forming_sim {

/// result.h5 with result.xdmf and surface.xdmf, history.csv, checkpoint.h5, summary.json in a
/// directory that is there. Owns what the observers share; `scene` must outlive it.
/// Add the observers in their order; the summary is the last.
struct RunFiles {
  std::unique_ptr<RunRecord> record;
  std::unique_ptr<Gauge> gauge;
  std::vector<std::unique_ptr<Observer>> observers;
};

/// meaning: of the scene (results/meaning.h); checkpoint: from which the simulation was restored, or null.
/// Throws SceneError (probes), Error(resume_error).
RunFiles open_run_files(const Simulation& simulation, const Scene& scene, const std::string& meaning, const std::string& directory,
                        const Checkpoint* checkpoint);

}  // namespace forming_sim
