#include "forming_sim/config/words.h"

#include <gtest/gtest.h>

#include <limits>

#include "forming_sim/config/fault.h"

namespace forming_sim {
namespace {

TEST(Words, NumbersAreShortAndExact) {
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(70.5e9), "7.05e+10");
  EXPECT_EQ(number_text(-3), "-3");
  EXPECT_EQ(std::stod(number_text(1.0 / 3)), 1.0 / 3);
  EXPECT_EQ(number_text(std::numeric_limits<double>::quiet_NaN()), "nan");
}

TEST(Words, NearestKeyIsTheOneThatWasMeant) {
  const std::vector<std::string> keys{"density", "youngs_modulus", "poissons_ratio", "law", "hardening"};
  EXPECT_EQ(nearest_word("densty", keys), "density");
  EXPECT_EQ(nearest_word("dnesity", keys), "density");
  EXPECT_EQ(nearest_word("young_modulus", keys), "youngs_modulus");
  EXPECT_EQ(nearest_word("modulus", keys), "youngs_modulus");
  EXPECT_EQ(nearest_word("poisson_ratio", keys), "poissons_ratio");
  EXPECT_EQ(nearest_word("temperature", keys), "");
  EXPECT_EQ(nearest_word("", keys), "");
}

TEST(Words, ListsAndRanges) {
  EXPECT_EQ(one_of({"a"}), "a");
  EXPECT_EQ(one_of({"a", "b", "c"}), "a, b or c");
  EXPECT_EQ(range_text(Field().above(0).at_most(2)), "above 0 and at most 2");
  EXPECT_EQ(range_text(Field().below(0.5)), "below 0.5");
  EXPECT_EQ(given_text(std::vector<double>(8, 1.5)), "[1.5, 1.5, 1.5, 1.5, 1.5, 1.5, ... (8 in all)]");
}

TEST(Faults, SceneErrorSaysThemAll) {
  const SceneError error({{Code::invalid_scene, "a", "1", "give 2"}, {Code::invalid_scene, "b", "3", "give 4"}});
  EXPECT_STREQ(error.what(), "The scene has 2 faults.\na: given 1; give 2\nb: given 3; give 4");
  EXPECT_EQ(error.code(), Code::invalid_scene);
  EXPECT_EQ(SceneError({{Code::mesh_error, "a", "1", "give 2"}}).code(), Code::mesh_error);
}

TEST(Faults, EveryCodeHasAName) {
  for (int code = 0; code <= 11; ++code) EXPECT_STRNE(name_of(static_cast<Code>(code)), "unknown");
  EXPECT_STREQ(name_of(static_cast<Code>(99)), "unknown");
  EXPECT_STREQ(name_of(Code::limit_reached), "limit_reached");
}

}  // namespace
}  // namespace forming_sim
