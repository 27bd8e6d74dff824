#include "forming_sim/results/run_files.h"

#include "forming_sim/results/fields.h"
#include "forming_sim/results/formed_parts.h"
#include "forming_sim/results/history.h"
#include "forming_sim/results/recorder.h"
#include "forming_sim/results/summary.h"
#include "forming_sim/results/text_file.h"

namespace forming_sim {

RunFiles open_run_files(const Simulation& simulation, const Scene& scene, const std::string& meaning, const std::string& directory,
                        const Checkpoint* checkpoint) {
  const OutputIntervals every = output_intervals(scene);
  const bool resumed = checkpoint != nullptr;
  RunFiles files;
  files.record = std::make_unique<RunRecord>(resumed ? RunRecord::from_json(checkpoint->record) : RunRecord());
  files.gauge = std::make_unique<Gauge>(simulation, scene.output.probes);
  RunRecord& record = *files.record;
  Gauge& gauge = *files.gauge;
  const auto add = [&](auto observer) { files.observers.push_back(std::move(observer)); };
  add(std::make_unique<Recorder>(scene.output, every.history, gauge, record));
  add(std::make_unique<Fields>(scene, meaning, directory, every.frames, resumed, gauge, record));
  add(std::make_unique<History>(in_directory(directory, "history.csv"), every.history, resumed, gauge, record));
  add(std::make_unique<Checkpoints>(meaning, in_directory(directory, "checkpoint.h5"), every.checkpoint, record));
  if (scene.output.formed) add(std::make_unique<FormedParts>(scene, in_directory(directory, "formed.h5")));
  add(std::make_unique<SummaryFile>(scene, directory, gauge, record));
  return files;
}

}  // namespace forming_sim
