// Runs a scene without ROS: forming_offline SCENE.yaml --output DIR
#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "forming_sim/results/command_line.h"
#include "forming_sim/results/estimate.h"
#include "forming_sim/results/plan_text.h"
#include "forming_sim/results/progress_line.h"
#include "forming_sim/results/run_scene.h"
#include "forming_sim/results/start.h"
#include "forming_sim/results/version.h"
#include "forming_sim/scene/schema.h"
#include "forming_sim/scene/yaml.h"

namespace {

using namespace forming_sim;

std::atomic<bool> cancel{false};

int run(const OfflineOptions& options, const Scene& scene, std::unique_ptr<Simulation> start) {
  const auto stop = [](int) { cancel = true; };
  std::signal(SIGINT, stop);
  std::signal(SIGTERM, stop);
  if (std::signal(SIGHUP, stop) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup asks to be left alone
  ProgressLine progress(isatty(STDERR_FILENO));
  EndTable table(options.output);
  std::vector<Observer*> watchers;
  if (!options.quiet) watchers = {&progress, &table};
  const Outcome outcome = run_scene(scene, options.output, options.thread_count(), options.resume, cancel, watchers, std::move(start));
  std::fprintf(stderr, "%s: %s\n", name_of(outcome.code), outcome.message.c_str());
  return outcome.code == Code::success ? 0 : 1;
}

int perform(const OfflineOptions& options) {
  using Task = OfflineOptions::Task;
  std::string text;
  if (options.task == Task::help) text = offline_usage();
  else if (options.task == Task::version) text = package_version() + std::string("\n");
  else if (options.task == Task::schema) text = schema_text();
  else if (options.task == Task::schema_markdown) text = schema_markdown();
  else {
    std::vector<Fault> known;
    const Scene scene = read_scene_file(options.scene, known);
    StartCheck start = check_start(scene, known, options.thread_count());
    if (!start.faults.empty()) {
      const SceneError refused(start.faults);
      if (options.task == Task::run) note_refusal(scene, options.output, refused.faults(), refused.code(), refused.what());
      throw refused;
    }
    if (options.task == Task::run) return run(options, scene, std::move(start.simulation));
    for (const std::string& note : start.notes) std::fprintf(stderr, "note: %s\n", note.c_str());
    if (options.task == Task::validate) text = "The scene has no faults.\n";
    else {
      if (options.task == Task::plan) text = plan_text(*start.simulation);
      text += estimate_text(estimate_run(*start.simulation));
    }
  }
  std::fputs(text.c_str(), stdout);
  return std::fflush(stdout) == 0 && std::ferror(stdout) == 0 ? 0 : 1;
}

/// Where one of the standard files is closed, the first file of a run would get its number, and what is printed.
void open_standard_files() {
  for (int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(file, F_GETFD) < 0 && open("/dev/null", O_RDWR) < 0) std::_Exit(1);
}

}  // namespace

int main(int argc, char** argv) {
  open_standard_files();
  std::signal(SIGXFSZ, SIG_IGN);  // a limit of file sizes is a full disk: the write says so
  try {
    return perform(read_options({argv + 1, argv + argc}));
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.code() == Code::invalid_scene || dynamic_cast<const SceneError*>(&error) ? 2 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "internal error: %s\n", error.what());
    return 1;
  }
}
