// Velocities from formulas, against the same written here; what is no formula is refused with its place.
#include <gtest/gtest.h>

#include <cmath>

#include "forming_sim/config/fault.h"
#include "forming_sim/config/formula_field.h"

namespace forming_sim {
namespace {

std::string refusal_of(const std::vector<std::string>& formulas, const Vec3& X) {
  try {
    FormulaField(formulas).at(X);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::invalid_scene);
    return error.what();
  }
  return "";
}

TEST(FormulaField, IsWhatItsFormulasSay) {
  const FormulaField field({"2*sin(pi/2*x)*cos(y)", "-x^2 + z", "x > 0.5 ? y : -1e-3"});
  for (const Vec3& X : {Vec3(0.3, -0.2, 4), Vec3(0.7, 2, -1)}) {
    const Vec3 v = field.at(X);
    EXPECT_DOUBLE_EQ(v.x(), 2 * std::sin(M_PI / 2 * X.x()) * std::cos(X.y()));
    EXPECT_DOUBLE_EQ(v.y(), -X.x() * X.x() + X.z());
    EXPECT_DOUBLE_EQ(v.z(), X.x() > 0.5 ? X.y() : -1e-3);
  }
}

TEST(FormulaField, IsZeroAlongWhatHasNoFormula) {
  EXPECT_EQ(FormulaField({"x", "3"}).at(Vec3(1, 2, 3)), Vec3(1, 3, 0));
  EXPECT_EQ(FormulaField({}).at(Vec3(1, 2, 3)), Vec3(0, 0, 0));
}

TEST(FormulaField, SaysWhatIsWrongWithAFormula) {
  for (const std::string formula : {"2*sin(", "u + 1", "", "x y", "1, 2", "\"a\"", "x = "}) {
    const std::string said = refusal_of({"0", formula}, Vec3::Zero());
    EXPECT_NE(said.find("'" + formula + "'"), std::string::npos) << formula << ": " << said;
  }
  EXPECT_NE(refusal_of({"u + 1"}, Vec3::Zero()).find("\"u\""), std::string::npos);
}

TEST(FormulaField, NamesThePlaceWhereItIsNoNumber) {
  EXPECT_EQ(refusal_of({"1/x"}, Vec3(2, 0, 0)), "");
  const std::string said = refusal_of({"0", "1/x"}, Vec3(0, 5, 0));
  EXPECT_NE(said.find("'1/x'"), std::string::npos) << said;
  EXPECT_NE(said.find("(0, 5, 0)"), std::string::npos) << said;
  EXPECT_NE(refusal_of({"sqrt(x)"}, Vec3(-1, 0, 0)), "");
}

}  // namespace
}  // namespace forming_sim
