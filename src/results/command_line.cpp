#include "forming_sim/results/command_line.h"

#include <algorithm>
#include <charconv>
#include <set>
#include <thread>

#include "forming_sim/config/fault.h"
#include "forming_sim/config/words.h"
#include "forming_sim/mesh/url.h"
#include "forming_sim/parallel/team.h"

namespace forming_sim {

std::string offline_usage() {
  return R"(Runs a metal forming scene without ROS.

  forming_offline SCENE.yaml --output DIR [--threads N] [--resume FILE] [--quiet]
  forming_offline --validate SCENE.yaml     all faults of the scene, without running it
  forming_offline --estimate SCENE.yaml [--threads N]
                                            elements, time step, steps, wall time, memory
  forming_offline --plan SCENE.yaml [--threads N]
                                            what a step of the scene does and keeps, and nothing more
  forming_offline --schema [markdown]       every field that a scene may have
  forming_offline --help | --version

  --output DIR     where result.h5, result.xdmf, surface.xdmf, history.csv and summary.json go
  --threads N      threads of the solver; all cores unless given; changes no result
  --resume FILE    goes on from a checkpoint of the same scene
  --quiet          no progress line, no notes, no warnings and no table at the end: summary.json has them

Exit code: 0 success; 2 a wrong command line or a scene with faults; 1 anything else.
)";
}

int OfflineOptions::thread_count() const {
  return threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

namespace {

[[noreturn]] void refuse(const std::string& sentence) {
  throw Error(Code::invalid_scene, sentence + " See forming_offline --help.");
}

int read_threads(const std::string& text) {
  int threads = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), threads);
  if (error != std::errc() || end != text.data() + text.size() || threads < 1 || threads > kMostThreads) {
    refuse("--threads was given '" + text + "'; give a whole number from 1 to " + std::to_string(kMostThreads) + ".");
  }
  return threads;
}

/// The word that belongs to an option.
std::string value_of(const std::vector<std::string>& arguments, std::size_t& i) {
  const std::string& option = arguments[i];
  if (i + 1 >= arguments.size() || arguments[i + 1].empty() || arguments[i + 1].rfind("--", 0) == 0) {
    refuse(option + " was given without its value.");
  }
  return arguments[++i];
}

}  // namespace

std::vector<std::string> separated(const std::vector<std::string>& arguments) {
  std::vector<std::string> words;
  for (const std::string& word : arguments) {
    const std::size_t sign = word.rfind("--", 0) == 0 ? word.find('=') : std::string::npos;
    words.push_back(word.substr(0, sign));
    if (sign != std::string::npos) words.push_back(word.substr(sign + 1));
  }
  return words;
}

OfflineOptions read_options(const std::vector<std::string>& given_words) {
  using Task = OfflineOptions::Task;
  static const std::vector<std::string> known{"--output", "--threads", "--resume", "--quiet", "--validate", "--estimate", "--plan", "--schema", "--help", "--version"};
  const std::vector<std::string> arguments = separated(given_words);
  OfflineOptions options;
  std::set<std::string> given;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& word = arguments[i] == "-h" ? "--help" : arguments[i];
    if (word.rfind("-", 0) != 0) {
      if (!options.scene.empty()) refuse("Two scenes were given, '" + options.scene + "' and '" + word + "'; give one.");
      options.scene = local_path(word, Code::invalid_scene);
      if (word.empty()) refuse("The path of the scene is empty; give a YAML file.");
      continue;
    }
    if (std::find(known.begin(), known.end(), word) == known.end()) {
      const std::string meant = did_you_mean(word, known);
      refuse("The option " + word + " does not exist" + (meant.empty() ? "." : meant));
    }
    if (!given.insert(word).second) refuse(word + " was given twice.");
    if (word == "--output") options.output = local_path(value_of(arguments, i), Code::invalid_scene);
    else if (word == "--resume") options.resume = local_path(value_of(arguments, i), Code::invalid_scene);
    else if (word == "--threads") options.threads = read_threads(value_of(arguments, i));
    else if (word == "--quiet") options.quiet = true;
    else if (word == "--validate") options.task = Task::validate;
    else if (word == "--estimate") options.task = Task::estimate;
    else if (word == "--plan") options.task = Task::plan;
    else if (word == "--help") options.task = Task::help;
    else if (word == "--version") options.task = Task::version;
    else if (word == "--schema") options.task = Task::schema;
  }

  const int tasks = static_cast<int>(given.count("--validate") + given.count("--estimate") + given.count("--plan") + given.count("--schema") + given.count("--help") + given.count("--version"));
  if (tasks > 1) refuse("Give one of --validate, --estimate, --plan, --schema, --help and --version.");
  const std::set<std::string> allowed = options.task == Task::run        ? std::set<std::string>{"--output", "--threads", "--resume", "--quiet"}
                                        : options.task == Task::estimate ? std::set<std::string>{"--estimate", "--threads"}
                                       : options.task == Task::plan     ? std::set<std::string>{"--plan", "--threads"}
                                                                         : std::set<std::string>{"--validate", "--schema", "--help", "--version"};
  for (const std::string& option : given) {
    if (allowed.count(option) == 0) refuse(option + " does not go with what is asked for.");
  }
  if (options.task == Task::schema) {
    if (!options.scene.empty() && options.scene != "markdown") refuse("--schema was given '" + options.scene + "'; give markdown or nothing.");
    if (options.scene == "markdown") options.task = Task::schema_markdown;
    options.scene.clear();
  } else if (options.task != Task::help && options.task != Task::version && options.scene.empty()) {
    refuse("No scene was given; give the path of a YAML file.");
  }
  if (options.task == Task::run && options.output.empty()) refuse("No --output was given; give a directory for the results.");
  return options;
}

}  // namespace forming_sim
