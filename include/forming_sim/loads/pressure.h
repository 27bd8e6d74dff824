#pragma once
// Pressure on the deformed surface.
#include <string>
#include <vector>

#include "forming_sim/loads/config.h"
#include "forming_sim/loads/course_clock.h"
#include "forming_sim/loads/profile.h"
#include "forming_sim/mesh/faces.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// One pressure with its faces in the joined numbering.
struct ResolvedPressure {
  ScalarProfile profile;
  std::vector<Face> faces;
  CourseClock clock = {};
};

/// Takes the surface faces all of whose nodes are in the set.
/// Throws Error(invalid_scene) naming a set that is missing or holds no face.
ResolvedPressure resolve(const PressureConfig& config, const std::string& body, const Mesh& mesh,
                         int first_node);

/// Forces of pressures that follow the deformed faces: f = -p times the corner's share of the face's area vector A n
/// (mesh/faces.h), n outward, per metre of width in 2D.
/// On a closed surface this is minus the gradient of p V, V the enclosed volume:
/// exactly in 2D and in the axisymmetric case, where a surface may also close on the
/// axis, and in 3D since the sum over a node's triangles of A n / 3 is dV/dx, and a bilinear face encloses the mean of what its two
/// divisions into triangles do.
class PressureSet {
 public:
  PressureSet() = default;
  explicit PressureSet(std::vector<ResolvedPressure> pressures, bool axisymmetric = false);

  bool empty() const { return pressures_.empty(); }
  /// A stage begins at time t.
  void begin(int stage, double t) {
    for (ResolvedPressure& pressure : pressures_) pressure.clock.begin(stage, t);
  }
  /// f += forces at time t on positions x.
  void add(double t, const NodeField& x, NodeField& f) const;

 private:
  std::vector<ResolvedPressure> pressures_;
  bool axisymmetric_ = false;
};

}  // namespace forming_sim
