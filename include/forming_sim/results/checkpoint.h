#pragma once
// checkpoint.h5: all that a run needs to go on as if it had not been stopped.
#include <string>
#include <vector>

#include "forming_sim/results/run_record.h"
#include "forming_sim/results/schedule.h"
#include "forming_sim/simulation/simulation.h"

namespace forming_sim {

struct Checkpoint {
  std::string version, scene;   ///< package version; what the scene means (results/meaning.h)
  double time = 0;              ///< s
  long step = 0;
  std::vector<char> state;      ///< Simulation::save()
  std::string record;           ///< RunRecord::to_json()
};

/// To a temporary name, then renamed: the file is the old or the new one, whole.
/// Throws Error(output_error).
void save_checkpoint(const std::string& path, const Checkpoint& checkpoint);

/// Throws Error(resume_error): missing, cut off, damaged (checksums), not a checkpoint.
Checkpoint load_checkpoint(const std::string& path);

/// meaning: of the scene (results/meaning.h). Throws Error(resume_error) where it was written by another version or for
/// another scene, naming the first line that differs.
void require_same_run(const Checkpoint& checkpoint, const std::string& meaning, const std::string& path);

/// Writes checkpoint.h5 at intervals and on cancel.
class Checkpoints : public Observer {
 public:
  /// meaning: of the scene at the start; its files may change later.
  Checkpoints(const std::string& meaning, const std::string& path, double interval, RunRecord& record)
      : meaning_(meaning), path_(path), schedule_(interval), record_(record) {}
  void on_start(const Simulation& simulation) override { schedule_.start(simulation.time()); }
  void on_step(const Simulation& simulation) override;
  void on_stage_end(const Simulation& simulation, int index) override;
  void on_end(const Simulation& simulation, Code code, const std::string& message) override;

 private:
  Checkpoint take(const Simulation& simulation) const;
  std::string meaning_;
  std::string path_;
  Schedule schedule_;
  RunRecord& record_;
  /// Taken after a step, written after the next: a step that ends its stage is
  /// no place to go on from, and only then is it known that it did not.
  std::vector<Checkpoint> waiting_;
  bool due_ = false;
};

}  // namespace forming_sim
