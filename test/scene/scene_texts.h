#pragma once
// Scenes that the tests of the scene room start from.
#include <string>

#include <gtest/gtest.h>

#include "forming_sim/scene/schema.h"
#include "forming_sim/scene/yaml.h"

namespace forming_sim {

/// The text with its first `from` replaced; the test fails where it is not there.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

inline std::vector<Fault> faults_of(const std::string& yaml) {
  std::vector<Fault> faults;
  read_scene(yaml, ".", faults);
  return faults;
}

inline std::string sentences(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults) text += fault.sentence() + "\n";
  return text;
}

inline const Fault* fault_at(const std::vector<Fault>& faults, const std::string& field) {
  for (const Fault& fault : faults) {
    if (fault.field == field) return &fault;
  }
  return nullptr;
}

/// The example reads without a fault and holds what the change makes of it, with
/// exactly one fault at `field` whose sentence contains `word`.
inline void expect_fault(const std::string& yaml, const std::string& field, const std::string& word) {
  const std::vector<Fault> faults = faults_of(yaml);
  ASSERT_EQ(faults.size(), 1u) << sentences(faults);
  EXPECT_EQ(faults.front().field, field) << faults.front().sentence();
  EXPECT_NE(faults.front().sentence().find(word), std::string::npos) << faults.front().sentence();
}

/// A valid scene read from YAML.
inline Scene scene_of(const std::string& yaml) {
  std::vector<Fault> faults;
  Scene scene = read_scene(yaml, ".", faults);
  EXPECT_TRUE(faults.empty()) << sentences(faults);
  return scene;
}

}  // namespace forming_sim
