#include "forming_sim/ros/prepare.h"

#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <system_error>
#include <thread>

#include "forming_sim/mesh/url.h"
#include "forming_sim/parallel/team.h"
#include "forming_sim/results/checkpoint.h"
#include "forming_sim/results/meaning.h"
#include "forming_sim/results/start.h"
#include "forming_sim/ros/convert.h"
#include "forming_sim/ros/publisher.h"
#include "forming_sim/scene/topic_name.h"
#include "forming_sim/scene/urls.h"
#include "forming_sim/scene/yaml.h"

namespace forming_sim {

namespace fs = std::filesystem;

namespace {

/// result.h5 keeps the text as the one of the run: it has to say what the message says.
void check_text(const std::string& scene_text, const Scene& scene, std::vector<Fault>& known) {
  const auto refuse = [&](const std::string& given) { known.push_back({Code::invalid_scene, "scene_text", given, "give the text that the scene was read from, or leave one of them out"}); };
  std::vector<Fault> faults;
  try {
    Scene told = read_scene(scene_text, "", faults);
    if (!faults.empty()) return refuse(faults.front().sentence());
    Scene said = scene;
    const auto of_told = urls_of(told), of_said = urls_of(said);  // a client spells them so that the server finds the files
    for (std::size_t i = 0; i < std::min(of_told.size(), of_said.size()); ++i)
      if (of_told[i].first == of_said[i].first) *of_told[i].second = *of_said[i].second;
    const std::string of_text = write_scene(told), of_scene = write_scene(scene);
    if (of_text != of_scene) refuse(first_difference(of_text, of_scene, "in the text", "in the scene"));
  } catch (const SceneError& error) {
    refuse(error.faults().front().sentence());
  }
}

/// Why nothing can be written in it; empty: it can.
std::string fault_of_directory(const fs::path& path) {
  std::error_code unknown;
  if (!fs::is_directory(path, unknown)) return path.string() + " is no directory";
  return access(path.c_str(), W_OK | X_OK) == 0 ? "" : "cannot write in the directory " + path.string();
}

}  // namespace

Prepared prepare(const SceneSpec& message, const std::string& scene_text, int threads) {
  Prepared prepared;
  try {
    std::vector<Fault> known;
    if (message.name.empty() && message.bodies.empty() && !scene_text.empty()) {
      std::error_code unknown;
      prepared.scene = read_scene(scene_text, fs::current_path(unknown).string(), known);
    } else {
      prepared.scene = scene_from(message, known);
      prepared.scene.text = scene_text.empty() ? write_scene(prepared.scene) : scene_text;
      if (known.empty() && !scene_text.empty()) check_text(scene_text, prepared.scene, known);
    }
    if (threads < 1 || threads > kMostThreads)
      known.push_back({Code::invalid_scene, "threads", std::to_string(threads), "give 1 to " + std::to_string(kMostThreads) + ", or 0 for the server's"});
    StartCheck start = check_start(prepared.scene, known, threads);
    prepared.faults = std::move(start.faults);
    prepared.notes = std::move(start.notes);
    prepared.simulation = std::move(start.simulation);
  } catch (const SceneError& error) {
    prepared.faults = error.faults();
  } catch (const Error& error) {
    if (error.code() == Code::cancelled) throw;
    prepared.faults.push_back({error.code(), "scene", error.what(), "change the scene so that it can start"});
  } catch (const std::exception& error) {
    prepared.faults.push_back({Code::internal_error, "scene", error.what(), "please report this as a defect"});
  }
  return prepared;
}

std::string make_output_directory(const std::string& given, const std::string& output_root, const std::string& scene) {
  fs::path path = local_path(given, Code::output_error);
  std::error_code error;
  if (given.empty()) {
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    localtime_r(&now, &local);
    char stamp[32];
    std::strftime(stamp, sizeof stamp, "%Y%m%d_%H%M%S", &local);
    constexpr std::size_t kLongest = 100;  // of the 255 bytes that a name may have
    const fs::path base = fs::path(local_path(output_root, Code::output_error)) / (topic_name(scene).substr(0, kLongest) + "_" + stamp);
    path = base;
    fs::create_directories(base.parent_path(), error);
    // Who makes it has it: another server may choose a name at the same time.
    for (int n = 2; !error && !fs::create_directory(path, error) && !error; ++n) path = base.string() + "_" + std::to_string(n);
  } else {
    fs::create_directories(path, error);
  }
  if (error) throw Error(Code::output_error, "cannot make the directory " + path.string() + " (" + error.message() + ")");
  if (const std::string why = fault_of_directory(path); !why.empty()) throw Error(Code::output_error, why);
  return fs::absolute(path).lexically_normal().string();
}

std::string fault_of_root(const std::string& output_root) {
  try {
    fs::path there = fs::absolute(local_path(output_root, Code::output_error));
    std::error_code unknown;
    while (!fs::exists(there, unknown) && there.has_relative_path()) there = there.parent_path();
    return fault_of_directory(there);
  } catch (const Error& error) {
    return error.what();
  }
}

bool is_readable_file(const std::string& path) {
  std::error_code unknown;
  return fs::is_regular_file(path, unknown) && access(path.c_str(), R_OK) == 0;
}

std::string check_resume(const std::string& given, Prepared& prepared) {
  if (given.empty()) return given;
  std::string file;
  const auto refuse = [&](const std::string& remedy) { prepared.faults.push_back({Code::resume_error, "resume", '"' + given + '"', remedy}); };
  try {
    file = local_path(given, Code::resume_error);
    if (is_readable_file(file)) require_same_run(load_checkpoint(file), meaning_of(prepared.scene), file);
    else refuse("give the checkpoint file of an earlier run on the server's machine");
  } catch (const Error& error) {
    refuse(error.what());
  }
  return file;
}

int choose_threads(int asked, int standard) {
  if (asked != 0) return asked;
  if (standard > 0) return standard;
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

}  // namespace forming_sim
