// Every declaration keeps the rules of config/field.h.
#include <gtest/gtest.h>

#include <set>

#include "forming_sim/config/check.h"
#include "forming_sim/scene/scene.h"

namespace forming_sim {
namespace {

/// What a declaration says, and the default that stands beside it.
struct Declared {
  int type;  ///< number of its Config
  std::string name;
  Field field;
  std::optional<double> number;
  std::optional<Vec3> vector;
  std::optional<bool> flag;
  std::optional<std::string> text;
  std::vector<Fault> faults;  ///< of the default
};

/// Every field of a Config and of all Configs it can contain, each type once.
template <class Config> void collect(std::set<std::string>& seen, std::vector<Declared>& all) {
  if (!seen.insert(__PRETTY_FUNCTION__).second) return;
  const int type = static_cast<int>(seen.size());
  const Config config{};
  for_each_field(config, [&](const char* name, const auto& value, const Field& field) {
    using T = std::decay_t<decltype(value)>;
    Declared declared{type, name, field, {}, {}, {}, {}, {}};
    if constexpr (is_number<T>) declared.number = value;
    else if constexpr (std::is_same_v<T, Vec3>) declared.vector = value;
    else if constexpr (std::is_same_v<T, bool>) declared.flag = value;
    else if constexpr (std::is_same_v<T, std::string>) declared.text = value;
    if constexpr (!is_group<T>) {
      FaultList list(declared.faults);
      check_value(value, name, field, list);
    }
    all.push_back(std::move(declared));
    if constexpr (is_config<T>) collect<T>(seen, all);
    else if constexpr (is_group<T>) collect<typename T::value_type>(seen, all);
  });
}

const std::vector<Declared>& declared() {
  static const std::vector<Declared> all = [] {
    std::set<std::string> seen;
    std::vector<Declared> fields;
    collect<Scene>(seen, fields);
    return fields;
  }();
  return all;
}

TEST(Declarations, AreAllReached) {
  int types = 0;
  for (const Declared& d : declared()) types = std::max(types, d.type);
  EXPECT_EQ(types, 29);  // Scene, Body, Tool, Approach, Blank, Mesh, Formed, Trim, Set, ProfilePiece, Profile, Hardening, Layer, Anisotropy, RateDependence, Damage, FormingLimit, Material, Contact, Pair,
                         // Boundary, Pressure, Load, Motion, TimeStep, Stage, Output, Probe, Springback
  EXPECT_GT(declared().size(), 100u);
}

TEST(Declarations, ZeroIsOutOfRangeWhereTheDefaultIsNotZero) {
  for (const Declared& d : declared()) {
    if (d.number && *d.number != 0) {
      EXPECT_FALSE(d.field.contains(0)) << d.name << ": a message could not tell 0 from nothing";
    }
    if (d.vector) {
      EXPECT_TRUE(d.vector->isZero(0)) << d.name;
    }
    if (d.flag) {
      EXPECT_FALSE(*d.flag) << d.name;
    }
    if (d.text && !d.text->empty()) {
      const auto& words = d.field.choices();
      EXPECT_TRUE(!words.empty() && std::find(words.begin(), words.end(), "") == words.end()) << d.name;
    }
  }
}

TEST(Declarations, RequiredNumbersExcludeZeroOrSayThatItIsGiven) {
  for (const Declared& d : declared())
    if (d.number && d.field.is_required()) {
      EXPECT_TRUE(!d.field.contains(0) || d.field.zero_is_given()) << d.name;
    }
}

TEST(Declarations, DefaultsLieInRange) {
  for (const Declared& d : declared()) {
    if (d.field.is_required() || (d.text && d.text->empty())) continue;
    EXPECT_TRUE(d.faults.empty()) << (d.faults.empty() ? "" : d.faults.front().sentence());
  }
}

TEST(Declarations, AreDocumented) {
  for (const Declared& d : declared()) {
    EXPECT_GT(d.field.doc().size(), 8u) << d.name;
    EXPECT_EQ(d.field.doc().find('\n'), std::string::npos) << d.name;
    EXPECT_FALSE(d.field.unit().empty()) << d.name;
  }
}

TEST(Declarations, ConditionsNameASiblingAndItsChoices) {
  int conditions = 0;
  for (const Declared& d : declared()) {
    if (d.field.when_field().empty()) continue;
    ++conditions;
    const auto sibling = std::find_if(declared().begin(), declared().end(),
                                      [&](const Declared& other) { return other.type == d.type && other.name == d.field.when_field(); });
    ASSERT_NE(sibling, declared().end()) << d.name << " depends on " << d.field.when_field();
    EXPECT_TRUE(sibling->text.has_value()) << d.name;
    EXPECT_FALSE(d.field.when_values().empty()) << d.name;
    for (const std::string& word : d.field.when_values()) {
      const auto& words = sibling->field.choices();
      EXPECT_NE(std::find(words.begin(), words.end(), word), words.end()) << d.name << " when " << sibling->name << " is " << word;
    }
  }
  EXPECT_GT(conditions, 20);
}

TEST(Declarations, RangesHoldSomething) {
  for (const Declared& d : declared()) EXPECT_LT(d.field.min(), d.field.max()) << d.name;
}

}  // namespace
}  // namespace forming_sim
