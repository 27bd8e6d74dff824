#pragma once
// A vector at every initial position that formulas give: velocities as those of a swing or of a ring that shrinks, the imperfection of a blank.
#include <memory>
#include <string>
#include <vector>

#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// One formula a coordinate, of x, y, z (m) and pi, in the language of muParser: + - * / ^, sin cos exp sqrt abs ...,
/// comparisons, and condition ? then : else. Coordinates without a formula are 0.
class FormulaField {
 public:
  /// Throws Error(invalid_scene) with what is wrong with a formula, and where in it.
  explicit FormulaField(const std::vector<std::string>& formulas);
  ~FormulaField();
  /// Throws Error(invalid_scene) naming a formula that is no finite number at X.
  Vec3 at(const Vec3& X) const;

 private:
  struct Formulas;
  std::unique_ptr<Formulas> formulas_;
};

}  // namespace forming_sim
