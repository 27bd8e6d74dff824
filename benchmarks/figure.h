#pragma once
// Curves that a command of forming_bench found: DIR/<name>.csv (series, x, y) and
// DIR/<name>.png, drawn by scripts/plot_curves.py.
#include <string>
#include <vector>

namespace forming_sim::bench {

/// Runs a script that lies beside this program with these words. Throws std::runtime_error where it fails.
void run_script(const std::string& name, const std::vector<std::string>& words);

class Figure {
 public:
  /// x, y: what the axes show, with units.
  Figure(std::string name, std::string title, std::string x, std::string y)
      : name_(std::move(name)), title_(std::move(title)), x_(std::move(x)), y_(std::move(y)) {}

  /// One point of a curve; curves keep the order in which they were first named.
  void add(const std::string& series, double x, double y);
  /// Both axes in powers of ten.
  void logarithmic() { logarithmic_ = true; }
  /// Both axes in the same scale: shapes.
  void equal_axes() { equal_ = true; }

  /// Writes both files; nothing where the directory is "" or there is no curve. Throws std::runtime_error
  /// where a file cannot be written or the picture cannot be drawn.
  void write(const std::string& directory) const;

 private:
  struct Series {
    std::string name;
    std::vector<double> x, y;
  };
  std::string name_, title_, x_, y_;
  std::vector<Series> series_;
  bool logarithmic_ = false, equal_ = false;
};

}  // namespace forming_sim::bench
