#pragma once
// What the tests of whole runs share: runs that are cancelled, and files that are read and compared.
#include <gtest/gtest.h>

#include <atomic>
#include <sstream>
#include <string>
#include <vector>

#include "forming_sim/results/result_reader.h"
#include "forming_sim/results/run_scene.h"
#include "results/small_scene.h"

namespace forming_sim {

inline const std::atomic<bool> kNever{false};

/// Cancels the run after a number of steps.
class CancelAfter : public Observer {
 public:
  CancelAfter(long steps) : steps_(steps) {}
  void on_step(const Simulation& simulation) override { cancel = simulation.steps() >= steps_; }
  std::atomic<bool> cancel{false};

 private:
  long steps_;
};

inline std::vector<std::vector<std::string>> read_csv(const std::string& path) {
  std::istringstream text(read_text(path));
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(text, line);) {
    EXPECT_EQ(line.back(), '\r');
    line.pop_back();
    rows.emplace_back();
    std::istringstream cells(line + ",");
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

/// What takes wall-clock time or tells of the resume is not compared.
inline nlohmann::json comparable(nlohmann::json summary) {
  for (const char* key : {"wall_time_s", "output_time_s", "ns_per_element_step", "resumed_at_s"}) summary.erase(key);
  return summary;
}

/// Compares line by line, so that a difference is told by its line alone.
inline void expect_same_text(const std::string& path, const std::string& expected_path) {
  std::istringstream text(read_text(path)), expected(read_text(expected_path));
  std::string line, expected_line;
  for (int number = 1; std::getline(expected, expected_line); ++number) {
    ASSERT_TRUE(std::getline(text, line)) << path << " ends before line " << number;
    ASSERT_EQ(line, expected_line) << "line " << number;
  }
  EXPECT_FALSE(std::getline(text, line)) << path << " goes on with: " << line;
}

inline void expect_same_frames(const std::string& path, const std::string& expected_path) {
  const ResultReader file(path), expected(expected_path);
  ASSERT_EQ(file.frames().size(), expected.frames().size());
  for (std::size_t i = 0; i < file.frames().size(); ++i) {
    const Frame a = file.frame(i), b = expected.frame(i);
    EXPECT_EQ(a.time, b.time);
    EXPECT_EQ(a.step, b.step);
    EXPECT_EQ(a.stage, b.stage);
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.velocities, b.velocities);
    EXPECT_EQ(a.plastic_strain, b.plastic_strain);
    EXPECT_EQ(a.damage, b.damage);
    EXPECT_EQ(a.stress, b.stress);
    EXPECT_EQ(a.tools[0].force, b.tools[0].force);
  }
}

}  // namespace forming_sim
