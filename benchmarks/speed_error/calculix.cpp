// Runs ccx and reads what it printed.
#include "speed_error/calculix.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "forming_sim/results/text_file.h"
#include "scratch.h"

namespace forming_sim::bench {
namespace fs = std::filesystem;
namespace {

/// Starts `program -i name` in a directory on one thread, its words in name.log; the status of its end.
int wait_for(const std::string& program, const std::string& directory, const std::string& name, int limit) {
  const std::string log = directory + "/" + name + ".log";
  const pid_t child = fork();
  if (child == 0) {
    const int out = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    const rlimit seconds{static_cast<rlim_t>(limit), static_cast<rlim_t>(limit)};
    if (out < 0 || dup2(out, 1) < 0 || dup2(out, 2) < 0 || chdir(directory.c_str()) != 0 || setrlimit(RLIMIT_CPU, &seconds) != 0) _exit(127);
    setenv("OMP_NUM_THREADS", "1", 1);
    execl(program.c_str(), program.c_str(), "-i", name.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) < 0) throw std::runtime_error(program + " could not be started");
  return status;
}

/// The last sentence of the log that begins with *ERROR, on one line; "" where there is none.
std::string last_error(const std::string& log) {
  const std::size_t at = log.rfind("*ERROR");
  if (at == std::string::npos) return "";
  std::istringstream words(log.substr(at, std::min<std::size_t>(200, log.find("\n\n", at) - at)));
  std::string sentence;
  for (std::string word; words >> word;) sentence += (sentence.empty() ? "" : " ") + word;
  return sentence;
}

std::vector<Printed> read_printed(const std::string& path) {
  std::vector<Printed> tables;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    const std::size_t set = line.find(" for set "), time = line.find(" and time ");
    std::istringstream words(line);
    if (set != std::string::npos && time != std::string::npos) {
      Printed table;
      words >> table.what;
      table.set = line.substr(set + 9, time - set - 9);
      table.time = std::stod(line.substr(time + 10));
      tables.push_back(table);
      continue;
    }
    std::vector<double> row;
    for (std::string word; words >> word;) row.push_back(std::strtod(word.c_str(), nullptr));  // NaN too
    if (!row.empty() && !tables.empty()) tables.back().rows.push_back(row);
  }
  return tables;
}

}  // namespace

std::string find_calculix() {
  std::istringstream path(std::getenv("PATH") ? std::getenv("PATH") : "");
  for (std::string directory; std::getline(path, directory, ':');)
    if (access((directory + "/ccx").c_str(), X_OK) == 0) return directory + "/ccx";
  return "";
}

bool calculix_or_say(Report& report) {
  if (!find_calculix().empty()) return true;
  report.no_answer("CalculiX", "not installed: apt-get install calculix-ccx", 0, true);
  return false;
}

CalculixRun::CalculixRun(const Deck& deck, const std::string& name, const Request& request, int limit) {
  const Scratch scratch;
  const std::string directory = request.directory.empty() ? scratch.path() : fs::absolute(request.directory).string() + "/calculix";
  fs::create_directories(directory);
  const std::string base = directory + "/" + name;
  for (const char* ending : {".dat", ".sta"}) fs::remove(base + ending);  // of a run before
  replace_file(base + ".inp", deck.text());
  const Clock clock;
  const int status = wait_for(find_calculix(), directory, name, limit);
  wall_time_ = clock.seconds();
  printed_ = read_printed(base + ".dat");
  std::ifstream increments(base + ".sta");
  for (std::string line; std::getline(increments, line);) {
    long step = 0;
    increments_ += (std::istringstream(line) >> step) ? 1 : 0;
  }
  const std::string log = read_text(base + ".log");
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL)) failure_ = "stopped after " + std::to_string(limit) + " s, increment " + std::to_string(increments_);
  else if (log.find("Job finished") == std::string::npos) failure_ = last_error(log);
  if (failure_.empty() && log.find("Job finished") == std::string::npos) failure_ = "ended without a word";
}

const Printed& CalculixRun::last(const std::string& what, const std::string& set) const {
  for (auto table = printed_.rbegin(); table != printed_.rend(); ++table)
    if (table->what == what && table->set == set) return *table;
  throw std::runtime_error("CalculiX printed no " + what + " of set " + set);
}

}  // namespace forming_sim::bench
