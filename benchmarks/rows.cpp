#include "rows.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace forming_sim::bench {

Row near(const std::string& name, const std::string& quantity, double found, double expected, double bound, double wall_time) {
  const double error = found / expected - 1;
  return {name, quantity, found, expected, error, wall_time, std::abs(error) <= bound, ""};
}
Row at_most(const std::string& name, const std::string& quantity, double found, double goal, double wall_time) {
  return {name, quantity, found, goal, goal == 0 ? found : found / goal - 1, wall_time, found <= goal, ""};
}
Row just(const std::string& name, const std::string& quantity, double found, double wall_time) {
  return {name, quantity, found, kNothing, kNothing, wall_time, true, ""};
}

void print(const std::vector<Row>& rows) {
  std::printf("%-44s %-40s %12s %12s %9s %9s  %s\n", "case", "quantity", "found", "expected", "error", "time/s", "holds");
  for (const Row& row : rows) {
    std::printf("%-44s %-40s %12.5g ", row.name.c_str(), row.quantity.c_str(), row.found);
    if (std::isnan(row.expected)) std::printf("%12s %9s", "", "");
    else std::printf("%12.5g %+8.2f%%", row.expected, 100 * row.error);
    std::printf(" %9.3g  %s\n", row.wall_time, std::isnan(row.expected) ? "" : row.holds ? "yes" : "no");
    if (!row.note.empty()) std::printf("    %s\n", row.note.c_str());
  }
}

void write(const std::string& directory, const std::string& command, const std::vector<Row>& rows) {
  std::filesystem::create_directories(directory);
  auto list = nlohmann::ordered_json::array();
  const auto number = [](double value) { return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(); };
  for (const Row& row : rows)
    list.push_back({{"case", row.name}, {"quantity", row.quantity}, {"found", number(row.found)}, {"expected", number(row.expected)},
                    {"error", number(row.error)}, {"wall_time_s", number(row.wall_time)}, {"holds", row.holds}, {"note", row.note}});
  const std::string path = (std::filesystem::path(directory) / (command + ".json")).string();
  std::ofstream file(path);
  file << list.dump(2) << "\n";
  file.close();
  if (!file) throw std::runtime_error("cannot write " + path);
}

}  // namespace forming_sim::bench
