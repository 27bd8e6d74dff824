#pragma once
// How a body moves as a whole: V + w x (x - c), the rigid motion that is nearest to its nodes' velocities by their masses, among those that what holds it
// leaves it. Held and driven directions prescribe theirs: half a sheet that is held at its plane of symmetry moves as the whole sheet does,
// and a body that is gripped as its grips.
//
// Some nodes are asked, not all: of a body that swings they tell its motion as a whole up to a part of the swing.
#include <array>
#include <vector>

#include "forming_sim/contact/held_node.h"

namespace forming_sim {

struct BodyMotion {
  Node c = Node::Zero(), v = Node::Zero();  ///< m, m/s
  Vec3 w = Vec3::Zero();                    ///< 1/s

  Node at(const Node& x) const {
    const Node r = x - c;
    return v + Node(w[1] * r[2] - w[2] * r[1], w[2] * r[0] - w[0] * r[2], w[0] * r[1] - w[1] * r[0], 0);
  }
};

class MovingBody {
 public:
  /// axisymmetric: nodes in the plane x, y, turned about y: nothing but the motion along y is that of a rigid body.
  MovingBody(int first_node, int nodes, bool axisymmetric);

  /// What is held from now on; nodes of other bodies do not count.
  void hold(const std::vector<HeldNode>& held);
  /// v: of all nodes; place(n): where node n is when it has that velocity. inverse_mass: 0: held in all directions.
  template <class Place> BodyMotion motion(const std::vector<double>& inverse_mass, const NodeField& v, Place&& place) const {
    Samples s;
    for (const int n : asked_)
      if (inverse_mass[n] > 0) s.masses[s.count++] = {1 / inverse_mass[n], place(n), v[n]};
    for (std::size_t i = 0; i < held_.size(); ++i) s.held[i] = {0, place(held_[i].node), v[held_[i].node]};
    return nearest(s);
  }

 private:
  static constexpr std::size_t kAsked = 64, kHeldAsked = 16;
  struct Sample {
    double m;
    Node x, v;
  };
  struct Samples {
    std::array<Sample, kAsked> masses;
    int count = 0;  ///< of them
    std::array<Sample, kHeldAsked> held;  ///< of held_
  };
  BodyMotion nearest(const Samples& samples) const;

  int first_node_, nodes_;
  bool axisymmetric_;
  std::vector<int> asked_;
  std::vector<HeldNode> held_;
};

}  // namespace forming_sim
