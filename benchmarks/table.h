#pragma once
// Tables of numbers that a command reads: CSV with a header row; lines that begin with #
// are comments. What is wrong is said with file, line, column, value and what is right.
#include <string>
#include <vector>

namespace forming_sim::bench {

struct Table {
  std::string path;
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
  std::vector<int> lines;  ///< of the file, from 1, one per row

  /// Number of a column, -1 where there is none.
  int find(const std::string& column) const;
  /// Number of a column. Throws std::runtime_error where there is none.
  int at(const std::string& column) const;
  /// "FILE, line 7, column F11"; column -1: the line only.
  std::string place(std::size_t row, int column = -1) const;
};

/// Throws std::runtime_error for a file that cannot be read or has no rows, columns without a
/// name or of the same name, rows that are too short or too long, cells that are no finite number.
Table read_table(const std::string& path);

/// Path of a file of the package, "scenes/hem.yaml": in the installed share folder beside this program, else
/// in the source folder it was built from. Throws std::runtime_error with the places tried.
std::string share_file(const std::string& name);

}  // namespace forming_sim::bench
