#include "forming_sim/config/formula_field.h"

#include <muParser.h>

#include <cmath>
#include <sstream>

#include "forming_sim/config/fault.h"

namespace forming_sim {

struct FormulaField::Formulas {
  std::vector<std::string> texts;
  std::vector<mu::Parser> parsers;
  Vec3 X = Vec3::Zero();  ///< what x, y, z stand for
};

FormulaField::~FormulaField() = default;

FormulaField::FormulaField(const std::vector<std::string>& formulas) : formulas_(std::make_unique<Formulas>()) {
  formulas_->texts = formulas;
  const Vec3 somewhere(0.7310585, 0.8807970, 0.9525741);
  Vec3& X = formulas_->X;
  X = somewhere;
  for (const std::string& formula : formulas) {
    try {
      mu::Parser parser;
      parser.DefineVar("x", &X.x());
      parser.DefineVar("y", &X.y());
      parser.DefineVar("z", &X.z());
      parser.DefineConst("pi", M_PI);
      parser.SetExpr(formula);
      parser.Eval();  // it is read only now
      if (X != somewhere) throw mu::Parser::exception_type("it changes x, y or z");
      if (parser.GetNumResults() != 1) throw mu::Parser::exception_type("it has several parts");
      formulas_->parsers.push_back(parser);
    } catch (const mu::Parser::exception_type& error) {
      throw Error(Code::invalid_scene, "give a formula of x, y, z and pi: '" + formula + "' is none, " + error.GetMsg());
    }
  }
}

Vec3 FormulaField::at(const Vec3& X) const {
  formulas_->X = X;
  Vec3 value = Vec3::Zero();
  for (std::size_t i = 0; i < formulas_->parsers.size(); ++i) {
    value[i] = formulas_->parsers[i].Eval();
    if (formulas_->X != X) throw Error(Code::invalid_scene, "give a formula that changes none of x, y, z: '" + formulas_->texts[i] + "' does");
    if (std::isfinite(value[i])) continue;
    std::ostringstream text;
    text << "give a formula that is a number everywhere on the body: '" << formulas_->texts[i] << "' is " << value[i] << " at (" << X.x() << ", "
         << X.y() << ", " << X.z() << ") m";
    throw Error(Code::invalid_scene, text.str());
  }
  return value;
}

}  // namespace forming_sim
