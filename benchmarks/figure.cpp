#include "figure.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace forming_sim::bench {
namespace {

/// The script beside this program: where catkin puts and installs both.
std::filesystem::path script() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "plot_curves.py";
}

void run(const std::vector<std::string>& words) {
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    execv(argv[0], argv.data());
    _exit(127);
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) < 0 || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error("no picture: " + words[0] + " " + words[1] + " failed; it needs python3-matplotlib");
}

}  // namespace

void Figure::add(const std::string& series, double x, double y) {
  if (series_.empty() || series_.back().name != series) {
    std::size_t k = 0;
    while (k < series_.size() && series_[k].name != series) ++k;
    if (k < series_.size()) {
      series_[k].x.push_back(x);
      series_[k].y.push_back(y);
      return;
    }
    series_.push_back({series, {}, {}});
  }
  series_.back().x.push_back(x);
  series_.back().y.push_back(y);
}

void Figure::write(const std::string& directory) const {
  if (directory.empty()) return;
  std::filesystem::create_directories(directory);
  const std::string csv = directory + "/" + name_ + ".csv";
  {
    std::ofstream out(csv);
    out.precision(12);
    out << "series,x,y\n";
    for (const Series& s : series_)
      for (std::size_t i = 0; i < s.x.size(); ++i) out << '"' << s.name << "\"," << s.x[i] << ',' << s.y[i] << '\n';
    if (!out.flush()) throw std::runtime_error(csv + " cannot be written");
  }
  std::vector<std::string> words{"/usr/bin/python3", script().string(), csv, "--title", title_, "--x", x_, "--y", y_,
                                 "--output", directory + "/" + name_ + ".png"};
  if (logarithmic_) words.push_back("--logarithmic");
  if (equal_) words.push_back("--equal");
  run(words);
}

}  // namespace forming_sim::bench
