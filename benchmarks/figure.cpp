#include "figure.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace forming_sim::bench {
void run_script(const std::string& name, const std::vector<std::string>& words) {
  // catkin puts and installs programs and scripts into one directory.
  std::vector<std::string> line{"/usr/bin/python3", (std::filesystem::read_symlink("/proc/self/exe").parent_path() / name).string()};
  line.insert(line.end(), words.begin(), words.end());
  std::vector<char*> argv;
  for (std::string& word : line) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    execv(argv[0], argv.data());
    _exit(127);
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) < 0 || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error("no picture: " + line[0] + " " + line[1] + " failed; it needs python3-matplotlib");
}

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
  if (directory.empty() || series_.empty()) return;
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
  std::vector<std::string> words{csv, "--title", title_, "--x", x_, "--y", y_,
                                 "--output", directory + "/" + name_ + ".png"};
  if (logarithmic_) words.push_back("--logarithmic");
  if (equal_) words.push_back("--equal");
  run_script("plot_curves.py", words);
}

}  // namespace forming_sim::bench
