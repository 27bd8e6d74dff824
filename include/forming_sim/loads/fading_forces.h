#pragma once
// Forces on nodes that are there at once and fade: what a body was held by that has been let go.
#include <vector>

#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// What held a node, N.
struct HoldingForce {
  int node = -1;
  Node force = Node::Zero();
};

/// f(t) = f (1 - 10 u^3 + 15 u^4 - 6 u^5), u = (t - start)/duration: level at both ends.
/// What springs back moves against them. Where a body gives way instead, they would drive it on, and more the less it bears.
class FadingForces {
 public:
  /// From `start` for `duration`, s; at most until one more step would do more work than `may_do` in all, J.
  void begin(double start, double duration, double may_do, std::vector<HoldingForce> forces);
  /// f += forces at time t.
  void add(double t, NodeField& f);
  /// Takes the work that those that were added do for `kick` s at the mean of two velocities from what they may; whether any had to be dropped.
  bool work(double kick, const NodeField& v_before, const NodeField& v);
  /// Drops what has faded away.
  void forget(double t);
  bool empty() const { return sets_.empty(); }
  double end() const;  ///< when the last of them is gone, s

  template <class Archive> void exchange(Archive& a) {
    a.each(sets_, [&](Set& set) {
      for (double* value : {&set.start, &set.duration, &set.may_do}) a.number(*value);
      a.each(set.forces, [&](HoldingForce& held) {
        a.number(held.node);
        a.numbers(held.force.data(), 3);
      });
    });
  }

 private:
  struct Set {
    double start = 0, duration = 0, may_do = 0;
    std::vector<HoldingForce> forces;
    double left = 1;  ///< of the forces, by the last add()
  };
  std::vector<Set> sets_;
};

}  // namespace forming_sim
