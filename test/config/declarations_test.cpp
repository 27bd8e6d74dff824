// Every declaration keeps the rules of config/field.h.
#include <gtest/gtest.h>

#include <set>

#include "forming_sim/config/check.h"
#include "forming_sim/scene/scene.h"

namespace forming_sim {
namespace {

/// Visits a Config and all Configs it can contain, each type once.
template <class Config, class Visit> void for_each_type(Visit&& visit, std::set<std::string>& seen) {
  if (!seen.insert(__PRETTY_FUNCTION__).second) return;
  Config config{};
  visit(config);
  for_each_field(config, [&](const char*, auto& value, const Field&) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (is_config<T>) for_each_type<T>(visit, seen);
    else if constexpr (is_group<T>) for_each_type<typename T::value_type>(visit, seen);
  });
}

template <class Check> int check_all(Check&& check) {
  std::set<std::string> seen;
  int fields = 0;
  for_each_type<Scene>([&](auto& config) {
    const auto& constant = config;
    for_each_field(constant, [&](const std::string& name, const auto& value, const Field& field) {
      ++fields;
      check(config, name, value, field);
    });
  }, seen);
  return fields;
}

TEST(Declarations, AreAllReached) {
  std::set<std::string> seen;
  int types = 0;
  for_each_type<Scene>([&](auto&) { ++types; }, seen);
  EXPECT_EQ(types, 21);  // Scene, Body, Tool, Blank, Mesh, Set, ProfilePiece, Profile, Hardening, Layer, Material, Contact, Pair,
                         // Boundary, Pressure, Motion, TimeStep, Stage, Output, Probe, Springback
  EXPECT_GT(check_all([](auto&, const std::string&, const auto&, const Field&) {}), 100);
}

TEST(Declarations, ZeroIsOutOfRangeWhereTheDefaultIsNotZero) {
  check_all([](auto&, const std::string& name, const auto& value, const Field& field) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (is_number<T>) {
      if (value == 0) return;
      EXPECT_FALSE(field.contains(0)) << name << ": a message could not tell 0 from nothing";
    } else if constexpr (std::is_same_v<T, Vec3>) {
      EXPECT_TRUE(value.isZero(0)) << name;
    } else if constexpr (std::is_same_v<T, bool>) {
      EXPECT_FALSE(value) << name;
    } else if constexpr (std::is_same_v<T, std::string>) {
      if (!value.empty()) {
        const auto& words = field.choices();
        EXPECT_TRUE(!words.empty() && std::find(words.begin(), words.end(), "") == words.end()) << name;
      }
    }
  });
}

TEST(Declarations, RequiredNumbersExcludeZeroOrSayThatItIsGiven) {
  check_all([](auto&, const std::string& name, const auto& value, const Field& field) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (is_number<T>) {
      if (!field.is_required()) return;
      EXPECT_TRUE(!field.contains(0) || field.zero_is_given()) << name;
    }
  });
}

TEST(Declarations, DefaultsLieInRange) {
  check_all([](auto&, const std::string& name, const auto& value, const Field& field) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (!is_group<T>) {
      if (field.is_required()) return;
      std::vector<Fault> faults;
      FaultList list(faults);
      if constexpr (std::is_same_v<T, std::string>) {
        if (value.empty()) return;
      }
      check_value(value, name, field, list);
      EXPECT_TRUE(faults.empty()) << (faults.empty() ? "" : faults.front().sentence());
    }
  });
}

TEST(Declarations, AreDocumented) {
  check_all([](auto&, const std::string& name, const auto&, const Field& field) {
    EXPECT_GT(field.doc().size(), 8u) << name;
    EXPECT_EQ(field.doc().find('\n'), std::string::npos) << name;
    EXPECT_FALSE(field.unit().empty()) << name;
  });
}

TEST(Declarations, ConditionsNameASiblingAndItsChoices) {
  int conditions = 0;
  check_all([&](auto& config, const std::string& name, const auto&, const Field& field) {
    if (field.when_field().empty()) return;
    ++conditions;
    bool found = false;
    for_each_field(config, [&](const std::string& sibling, const auto& value, const Field& declared) {
      if (sibling != field.when_field()) return;
      found = true;
      const bool is_text = std::is_same_v<std::decay_t<decltype(value)>, std::string>;
      EXPECT_TRUE(is_text) << name;
      EXPECT_FALSE(field.when_values().empty()) << name;
      for (const std::string& word : field.when_values()) {
        const auto& words = declared.choices();
        EXPECT_NE(std::find(words.begin(), words.end(), word), words.end()) << name << " when " << sibling << " is " << word;
      }
    });
    EXPECT_TRUE(found) << name << " depends on " << field.when_field();
  });
  EXPECT_GT(conditions, 20);
}

TEST(Declarations, RangesHoldSomething) {
  check_all([](auto&, const std::string& name, const auto&, const Field& field) { EXPECT_LT(field.min(), field.max()) << name; });
}

}  // namespace
}  // namespace forming_sim
