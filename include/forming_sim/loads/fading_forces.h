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
/// What springs back moves against them. Where bodies give way instead, they would drive them on, and more the less these bear. Of what holds bodies that hang together, and of what lets go
/// of them one after the other, one may do work that another takes: so all of it together may do no more than they had.
class FadingForces {
 public:
  /// From `start` for `duration`, s, on one of the bodies that hang together; at most until one more step would do more work than `may_do` in all, J, with all that still acts on any of them:
  /// what that might still do is forgotten, but where it acts on other bodies too and is more.
  void begin(double start, double duration, const std::vector<int>& together, double may_do, std::vector<HoldingForce> forces);
  /// The same, of what balances the forces that act on them already: it fades as these do, where a fifth of them is left; whether it is.
  bool join(const std::vector<int>& together, double may_do, const std::vector<HoldingForce>& forces);
  /// f += forces at time t.
  void add(double t, NodeField& f);
  /// Takes the work that those that were added do for `kick` s at the mean of two velocities from what they may; whether any had to be dropped.
  bool work(double kick, const NodeField& v_before, const NodeField& v);
  /// Takes the work that other things which let go of a body have done from what those that act on it may, J.
  void count(int body, double work);
  /// Drops what has faded away.
  void forget(double t);
  bool empty() const { return groups_.empty(); }
  double end() const;  ///< when the last of them is gone, s

  template <class Archive> void exchange(Archive& a) {
    a.each(groups_, [&](Group& group) {
      a.each(group.bodies, [&](int& body) { a.number(body); });
      a.number(group.may_do);
      a.each(group.sets, [&](Set& set) {
        for (double* value : {&set.start, &set.duration}) a.number(*value);
        a.each(set.forces, [&](HoldingForce& held) {
          a.number(held.node);
          a.numbers(held.force.data(), 3);
        });
      });
    });
  }

 private:
  static constexpr double kLeft = 0.2;  ///< of forces with which others may still go
  struct Set {
    double start = 0, duration = 0;
    std::vector<HoldingForce> forces;
    double left = 1;  ///< of the forces, by the last add()
  };
  struct Group {
    std::vector<int> bodies;  ///< increasing
    double may_do = 0;        ///< J
    std::vector<Set> sets;
  };
  std::vector<Group> groups_;
};

}  // namespace forming_sim
