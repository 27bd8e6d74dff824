#pragma once
// Tractions and forces that keep their direction while the body turns and stretches under them: dead loads.
#include <string>
#include <vector>

#include "forming_sim/loads/config.h"
#include "forming_sim/loads/course_clock.h"
#include "forming_sim/loads/curve.h"
#include "forming_sim/mesh/mesh.h"

namespace forming_sim {

/// One load with its nodes in the joined numbering.
struct ResolvedLoad {
  Curve value;                ///< Pa or N over time
  std::vector<int> nodes;
  std::vector<double> share;  ///< of each node: of a traction its area at the start, m2 (m in 2D); of a force its part, all together 1
  CourseClock clock = {};
};

/// Areas are those that the faces with all their nodes in the set give their corners (mesh/faces.h). A force on a set without a
/// face is shared evenly.
/// Throws Error(invalid_scene) naming a set that is missing or empty, a traction on one that holds no face, and as Curve does.
ResolvedLoad resolve(const LoadConfig& config, const std::string& body, const Mesh& mesh, int first_node, bool axisymmetric);

/// Their forces do not depend on positions: f_a = t(time) A_a is minus the gradient of -sum_a t(time) A_a . x_a.
class DeadLoadSet {
 public:
  DeadLoadSet() = default;
  explicit DeadLoadSet(std::vector<ResolvedLoad> loads) : loads_(std::move(loads)) {}

  bool empty() const { return loads_.empty(); }
  /// A stage begins at time t.
  void begin(int stage, double t) {
    for (ResolvedLoad& load : loads_) load.clock.begin(stage, t);
  }
  /// f += forces at time t.
  void add(double t, NodeField& f) const;

 private:
  std::vector<ResolvedLoad> loads_;
};

}  // namespace forming_sim
