#pragma once
// What forming_offline is asked for. Unknown options are errors.
#include <string>
#include <vector>

namespace forming_sim {

struct OfflineOptions {
  enum class Task { help, version, schema, schema_markdown, validate, estimate, plan, run };
  Task task = Task::run;
  std::string scene;   ///< path of the YAML file
  std::string output;  ///< directory
  std::string resume;  ///< checkpoint, empty: from the start
  int threads = 0;     ///< 0: all cores
  bool quiet = false;

  /// threads, or what this machine has.
  int thread_count() const;
};

/// Reads the arguments after the program's name.
/// Throws Error(invalid_scene) with a sentence for an unknown or repeated option, a
/// value that is missing or cannot be one, and for options that do not go together.
OfflineOptions read_options(const std::vector<std::string>& arguments);

/// --option=value as two words, as most programs take it.
std::vector<std::string> separated(const std::vector<std::string>& arguments);

/// What `--help` prints.
std::string offline_usage();

}  // namespace forming_sim
