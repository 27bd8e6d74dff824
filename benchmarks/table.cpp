#include "table.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace forming_sim::bench {
namespace {

std::string trimmed(const std::string& text) {
  const char* blank = " \t\r";
  const auto begin = text.find_first_not_of(blank);
  if (begin == std::string::npos) return "";
  std::string inner = text.substr(begin, text.find_last_not_of(blank) - begin + 1);
  if (inner.size() > 1 && inner.front() == '"' && inner.back() == '"') inner = inner.substr(1, inner.size() - 2);
  return inner;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(trimmed(cell));
  if (!line.empty() && line.back() == ',') cells.emplace_back();
  return cells;
}

std::string names(const std::vector<std::string>& columns) {
  std::string all;
  for (const std::string& column : columns) all += (all.empty() ? "" : ", ") + column;
  return all;
}

}  // namespace

int Table::find(const std::string& column) const {
  const auto found = std::find(columns.begin(), columns.end(), column);
  return found == columns.end() ? -1 : static_cast<int>(found - columns.begin());
}

int Table::at(const std::string& column) const {
  const int found = find(column);
  if (found < 0) throw std::runtime_error(path + ": there is no column " + column + "; given are " + names(columns));
  return found;
}

std::string Table::place(std::size_t row, int column) const {
  return path + ", line " + std::to_string(lines[row]) + (column < 0 ? "" : ", column " + columns[column]);
}

Table read_table(const std::string& path) {
  Table table;
  table.path = path;
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path)) throw std::runtime_error(path + " cannot be read; give the path of a CSV file");
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (number == 1 && line.compare(0, 3, "\xEF\xBB\xBF") == 0) line.erase(0, 3);  // byte order mark
    if (trimmed(line).empty() || line[0] == '#') continue;
    const std::vector<std::string> cells = cells_of(line);
    const std::string here = path + ", line " + std::to_string(number);
    if (table.columns.empty()) {
      for (std::size_t k = 0; k < cells.size(); ++k) {
        if (cells[k].empty()) throw std::runtime_error(here + ": column " + std::to_string(k + 1) + " has no name; the first row names the columns");
        if (std::count(cells.begin(), cells.end(), cells[k]) > 1) throw std::runtime_error(here + ": column " + cells[k] + " comes twice; right is once");
      }
      table.columns = cells;
      continue;
    }
    if (cells.size() != table.columns.size())
      throw std::runtime_error(here + ": given " + std::to_string(cells.size()) + " values; right are " + std::to_string(table.columns.size()) + " for " + names(table.columns));
    std::vector<double> row;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      char* end = nullptr;
      row.push_back(std::strtod(cells[k].c_str(), &end));
      if (cells[k].empty() || *end != '\0' || !std::isfinite(row.back()))
        throw std::runtime_error(here + ", column " + table.columns[k] + ": given \"" + cells[k] + "\"; right is a finite number");
    }
    table.rows.push_back(row);
    table.lines.push_back(number);
  }
  if (table.columns.empty()) throw std::runtime_error(path + " is empty; right is a row with the names of the columns, then rows of numbers");
  if (table.rows.empty()) throw std::runtime_error(path + " has no rows of numbers after the names " + names(table.columns));
  return table;
}

std::string share_file(const std::string& name) {
  namespace fs = std::filesystem;
  // catkin installs programs into PREFIX/lib/forming_sim and the rest into PREFIX/share/forming_sim.
  const fs::path program = fs::read_symlink("/proc/self/exe").parent_path();
  std::string tried;
  for (const fs::path& place : {program / "../../share/forming_sim", fs::path(FORMING_SIM_SOURCE_DIR)}) {
    const fs::path path = (place / name).lexically_normal();
    if (fs::exists(path)) return path.string();
    tried += (tried.empty() ? "" : ", ") + path.string();
  }
  throw std::runtime_error("there is no file " + name + " (tried " + tried + "); install the package, or run the program of its build");
}

}  // namespace forming_sim::bench
