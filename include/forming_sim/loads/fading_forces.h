#pragma once
// Forces on nodes that are there at once and fade: what a body was held by that has been let go.
#include <vector>

#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// f(t) = f (1 - 10 u^3 + 15 u^4 - 6 u^5), u = (t - start)/duration: level at both ends. They keep their direction.
/// What springs back moves against them. Where a body gives way instead, they would drive it on, and more the less it bears.
class FadingForces {
 public:
  /// nodes and their forces, N, from `start` for `duration`, s; at most until they have done the work `may_do`, J.
  void begin(double start, double duration, double may_do, std::vector<int> nodes, std::vector<Node> forces);
  /// f += forces at time t.
  void add(double t, NodeField& f) const;
  /// Takes the work that they do at time t, for `kick` s at the mean of two velocities, from what they may; whether any had to be dropped.
  bool work(double t, double kick, const NodeField& v_before, const NodeField& v);
  /// Drops what has faded away.
  void forget(double t);
  bool empty() const { return sets_.empty(); }
  double end() const;  ///< when the last of them is gone, s

  template <class Archive> void exchange(Archive& a) {
    std::size_t count = sets_.size();
    a.number(count);
    sets_.resize(count);
    for (Set& set : sets_) {
      a.number(set.start);
      a.number(set.duration);
      a.number(set.may_do);
      a.list(set.nodes);
      a.list(set.forces);
    }
  }

 private:
  struct Set {
    double start = 0, duration = 0, may_do = 0;
    std::vector<int> nodes;
    std::vector<Node> forces;
    double left(double t) const;  ///< share of the forces
  };
  std::vector<Set> sets_;
};

}  // namespace forming_sim
