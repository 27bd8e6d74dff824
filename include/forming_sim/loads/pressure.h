#pragma once
// Pressure on the deformed surface.
#include <string>
#include <vector>

#include "forming_sim/loads/config.h"
#include "forming_sim/loads/profile.h"
#include "forming_sim/mesh/mesh.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// One pressure with its facets in the joined numbering.
struct ResolvedPressure {
  ScalarProfile profile;
  std::vector<Facet> facets;
};

/// Takes the surface facets all of whose nodes are in the set.
/// Throws Error(invalid_scene) naming a set that is missing or holds no facet.
ResolvedPressure resolve(const PressureConfig& config, const std::string& body, const Mesh& mesh,
                         int first_node);

/// Forces of pressures that follow the deformed facets:
/// f = -p A n / (number of nodes) on each node of a facet, n outward, A n
///   2D, segment a b:     (y_b - y_a, x_a - x_b)       (per metre of width)
///   3D, triangle a b c:  (b - a) x (c - a) / 2
/// Axisymmetric, on node a of a segment a b, the integral of its shape function over the
/// cone: f_a = -p 2 pi (2 r_a + r_b)/6 (y_b - y_a, x_a - x_b).
/// On a closed surface this is minus the gradient of p V, V the enclosed volume:
/// exactly in 2D and in the axisymmetric case, where a surface may also close on the
/// axis, and in 3D since the sum over a node's triangles of A n / 3 is dV/dx.
class PressureSet {
 public:
  PressureSet() = default;
  PressureSet(std::vector<ResolvedPressure> pressures, int dimension, bool axisymmetric = false);

  bool empty() const { return pressures_.empty(); }
  /// f += forces at time t on positions x. Returns the sum of p A, N (N/m in 2D).
  double add(double t, const NodeField& x, NodeField& f) const;
  /// Work of those forces over a step, J: dt sum f . (v_before + v_after) / 2.
  double work(double t, const NodeField& x, const NodeField& v_before, const NodeField& v_after,
              double dt) const;

 private:
  /// What node k of a facet has of its area vector A n.
  Vec3 share(const Facet& facet, int k, const NodeField& x) const;

  std::vector<ResolvedPressure> pressures_;
  int dimension_ = 3;
  bool axisymmetric_ = false;
};

}  // namespace forming_sim
