#pragma once
// A velocity over the initial position that formulas give: the shape of a swing, a ring that shrinks.
#include <memory>
#include <string>
#include <vector>

#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// One formula a coordinate, m/s, of x, y, z (m) and pi, in the language of muParser: + - * / ^, sin cos exp sqrt abs ...,
/// comparisons, and condition ? then : else. Coordinates without a formula are 0.
class VelocityField {
 public:
  /// Throws Error(invalid_scene) with what is wrong with a formula, and where in it.
  explicit VelocityField(const std::vector<std::string>& formulas);
  ~VelocityField();
  /// Throws Error(invalid_scene) naming a formula that is no finite number at X.
  Vec3 at(const Vec3& X) const;

 private:
  struct Formulas;
  std::unique_ptr<Formulas> formulas_;
};

}  // namespace forming_sim
