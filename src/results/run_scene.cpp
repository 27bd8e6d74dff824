#include "forming_sim/results/run_scene.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "forming_sim/mesh/url.h"
#include "forming_sim/results/directory_lock.h"
#include "forming_sim/results/meaning.h"
#include "forming_sim/results/result_file.h"
#include "forming_sim/results/run_files.h"
#include "forming_sim/results/snapshot.h"
#include "forming_sim/results/start.h"
#include "forming_sim/results/summary.h"
#include "forming_sim/results/text_file.h"
#include "forming_sim/scene/validate.h"

namespace forming_sim {
namespace {

/// formed.h5 is written at the end: not over one that is read, nor where a directory has its name.
void require_room_for_parts(const Scene& scene, const std::string& directory) {
  if (!scene.output.formed) return;
  const std::string path = in_directory(directory, "formed.h5");
  std::error_code none;
  if (std::filesystem::is_directory(path, none)) throw Error(Code::output_error, path + " is a directory, and the run's formed.h5 goes there: move it away");
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (scene.bodies[i].formed && std::filesystem::equivalent(resolve_url(scene.bodies[i].formed->url, scene.base_directory), path, none))
      throw Error(Code::output_error, "body " + scene.bodies[i].name + " is read from " + path + ", over which this run would write its own parts: give another output directory");
}

/// built: the run at its start, or null: it is built of the model.
Outcome run_valid(const Scene& scene, const std::string& directory, int threads, const std::string& resume_file,
                  const std::atomic<bool>& cancel, const std::vector<Observer*>& extra, std::unique_ptr<Simulation> built, Model model) {
  make_output_directory(directory);
  const DirectoryLock lock(directory);
  require_room_for_parts(scene, directory);
  const std::string meaning = meaning_of(scene);
  std::optional<Checkpoint> checkpoint;
  if (!resume_file.empty()) {
    checkpoint = load_checkpoint(resume_file);
    require_same_run(*checkpoint, meaning, resume_file);
  }
  if (!built) built = build_run(scene, std::move(model), threads);
  Simulation& simulation = *built;
  if (checkpoint) {
    simulation.restore(checkpoint->state);
    require_first_part(in_directory(directory, "result.h5"), take_header(simulation, scene, meaning));
  }
  std::error_code unknown;
  // Of another run; this one's come later.
  std::filesystem::remove(in_directory(directory, "summary.json"), unknown);
  if (!checkpoint) std::filesystem::remove(in_directory(directory, "checkpoint.h5"), unknown);
  if (!checkpoint && scene.output.formed) std::filesystem::remove(in_directory(directory, "formed.h5"), unknown);
  RunFiles files = open_run_files(simulation, scene, meaning, directory, checkpoint ? &*checkpoint : nullptr);
  for (const auto& observer : files.observers) simulation.add(*observer);
  for (Observer* observer : extra) simulation.add(*observer);
  return simulation.run(cancel);
}

}  // namespace

void note_refusal(const Scene& scene, const std::string& directory, const std::vector<Fault>& faults, Code code,
                  const std::string& message) {
  try {
    make_output_directory(directory);
    const DirectoryLock lock(directory);
    nlohmann::ordered_json summary = summarize_refusal(scene, faults, code, message);
    std::error_code none;
    if (std::filesystem::exists(in_directory(directory, "result.h5"), none))
      summary["warnings"] = {"the other files in this directory, result.h5 among them, are of an earlier run"};
    write_summary(directory, summary);
  } catch (const Error&) {
    // The reason of the refusal is told to the caller; it matters more.
  }
}

Outcome run_scene(const Scene& scene, const std::string& directory, int threads, const std::string& resume_file,
                  const std::atomic<bool>& cancel, const std::vector<Observer*>& extra, std::unique_ptr<Simulation> built) {
  try {
    CheckedModel checked;
    if (!built) {
      checked = validated_model(scene);
      if (!checked.faults.empty()) throw SceneError(std::move(checked.faults));
    }
    return run_valid(scene, directory, threads, resume_file, cancel, extra, std::move(built), std::move(checked.model));
  } catch (const SceneError& error) {
    note_refusal(scene, directory, error.faults(), error.code(), error.what());
    throw;
  } catch (const Error& error) {
    // What could not be written because of the directory is no business of what stands in it; and a run that cannot be resumed keeps the summary that it has.
    const bool kept = error.code() == Code::resume_error && std::filesystem::exists(std::filesystem::path(directory) / "summary.json");
    if (error.code() != Code::output_error && !kept) note_refusal(scene, directory, {}, error.code(), error.what());
    return {error.code(), error.what()};
  } catch (const std::exception& error) {
    note_refusal(scene, directory, {}, Code::internal_error, error.what());
    return {Code::internal_error, error.what()};
  }
}

}  // namespace forming_sim
