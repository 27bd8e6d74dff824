#pragma once
// The most that friction passes on where surfaces stick under high pressure: the shear stress at which what lies between them, or
// the body beneath, flows.
//
//   |q| <= min(mu j, tau_max kick A)
//
// q, j: impulses of a pair along and across the surfaces; tau_max: friction_limit, Pa; kick: the time that they act over; A: the area
// that the pair stands for now. A node of a body has the part of its faces that looks along the pair's normal, so that beside
// an edge the faces around the corner do not count, and its pairs share that as they shared its normal impulse in the step before: of a node that was pressed already a pair that comes anew has none for a step.
// Where two bodies meet it is that of the body with less of it in all: of the other, coarser, nodes count that are hardly covered. A node at the border
// of what touches counts whole, so that a narrow tool is given up to half a cell too much on either side.
#include <array>
#include <vector>

#include "forming_sim/contact/features.h"
#include "forming_sim/contact/pair.h"

namespace forming_sim {

class ShearLimit {
 public:
  ShearLimit() = default;  ///< none
  /// Of the surfaces whose relations have a friction_limit.
  ShearLimit(const Features& f, bool axisymmetric);
  bool any() const { return !facets_.empty(); }
  /// Sets Rub::most of the pairs that have a limit. x: places of the bodies' nodes now; kick, s. The pairs' impulses tell the shares.
  void set(const Features& f, const NodeField& x, double kick, const Workspace& work, const LargeArray<ContactPair>& pairs, std::vector<Rub>& rubs);

 private:
  std::vector<int> facets_;           ///< of bodies that rub within a limit
  bool axisymmetric_ = false;
  NodeField face_;                    ///< of every node its share of the area vectors of its faces, m^2
  std::vector<double> sum_;           ///< per entry of the workspace: of |b| j, N s
  std::vector<std::array<double, 2>> areas_, totals_;  ///< of the two surfaces: per pair; per two surfaces, m^2
};

}  // namespace forming_sim
