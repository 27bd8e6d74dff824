#include "forming_sim/results/checkpoint.h"

#include <filesystem>

#include "forming_sim/files/hdf5_file.h"
#include "forming_sim/results/version.h"
#include "forming_sim/scene/yaml.h"

namespace forming_sim {
void save_checkpoint(const std::string& path, const Checkpoint& checkpoint) {
  write_whole_file(path, [&](Hdf5Group& root) {
    root.write_checked("version", checkpoint.version);
    root.set("time", checkpoint.time);
    root.set("step", std::int64_t{checkpoint.step});
    root.write_checked("scene", checkpoint.scene);
    root.write_checked("record", checkpoint.record);
    root.write_checked("state", std::string(checkpoint.state.begin(), checkpoint.state.end()));
  });
}

Checkpoint load_checkpoint(const std::string& path) {
  std::error_code unknown;
  if (!std::filesystem::exists(path, unknown))
    throw Error(Code::resume_error, "the checkpoint " + path + " does not exist; give the checkpoint.h5 of a run");
  try {
    const Hdf5File file(path, Hdf5File::Mode::read);
    const Hdf5Group root = file.root();
    if (!root.has("state") || !root.has("record") || !root.has("scene"))
      throw Error(Code::resume_error, path + " is not a checkpoint; give the checkpoint.h5 of a run");
    Checkpoint checkpoint;
    checkpoint.version = root.read_checked("version");
    checkpoint.scene = root.read_checked("scene");
    checkpoint.record = root.read_checked("record");
    const std::string state = root.read_checked("state");
    checkpoint.state.assign(state.begin(), state.end());
    checkpoint.time = root.number("time");
    checkpoint.step = root.integer("step");
    return checkpoint;
  } catch (const Error& error) {
    if (error.code() == Code::resume_error) throw;
    throw Error(Code::resume_error, "the checkpoint is damaged or not one of this package: " + std::string(error.what()));
  }
}

void require_same_run(const Checkpoint& checkpoint, const std::string& meaning, const std::string& path) {
  if (checkpoint.version != package_version())
    throw Error(Code::resume_error, path + " was written by version " + checkpoint.version + ", this is version " +
                                        package_version() + "; resume with the version that wrote it");
  if (checkpoint.scene != meaning)
    throw Error(Code::resume_error, path + " was written for another scene (" +
                                        first_difference(checkpoint.scene, meaning, "in the checkpoint", "in the scene") +
                                        "); resume with the scene that wrote it");
}

void Checkpoints::on_step(const Simulation& simulation) {
  if (!waiting_.empty()) save_checkpoint(path_, waiting_.back());
  waiting_.clear();
  if (!schedule_.due(simulation.time()) && !due_) return;
  due_ = false;
  waiting_.push_back(take(simulation));
}

void Checkpoints::on_stage_end(const Simulation&, int) {
  due_ = !waiting_.empty();
  waiting_.clear();
}

void Checkpoints::on_end(const Simulation& simulation, Code code, const std::string&) {
  waiting_.clear();
  if (code == Code::cancelled) save_checkpoint(path_, take(simulation));
}

Checkpoint Checkpoints::take(const Simulation& simulation) const {
  return {package_version(), meaning_, simulation.time(), simulation.steps(), simulation.save(),
          record_.to_json()};
}

}  // namespace forming_sim
