#pragma once
// How a body moves as a whole: V + w x (x - c), the rigid motion that is nearest to its nodes' velocities by their masses, among those that what holds it
// leaves it. Held and driven directions prescribe theirs, and so do tools across their surfaces: half a sheet that is held at its plane of symmetry moves
// as the whole sheet does, a body that is gripped as its grips, and a billet in its container as the ram.
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

/// A point whose velocity is told in some directions.
struct Hold {
  Node x, v;    ///< m, m/s
  Mat3 across;  ///< onto these directions: symmetric, its own square
};

class MovingBody {
 public:
  /// axisymmetric: nodes in the plane x, y, turned about y: nothing but the motion along y is that of a rigid body.
  MovingBody(int first_node, int nodes, bool axisymmetric);

  /// What is held from now on; nodes of other bodies do not count.
  void hold(const std::vector<HeldNode>& held);
  /// v: of all nodes; place(n): where node n is when it has that velocity. inverse_mass: 0: held in all directions. holds: beside the held nodes.
  template <class Place> BodyMotion motion(const std::vector<double>& inverse_mass, const NodeField& v, Place&& place, std::vector<Hold> holds = {}) const {
    std::array<Mass, kAsked> masses;
    int count = 0;
    for (const int n : asked_)
      if (inverse_mass[n] > 0) masses[count++] = {1 / inverse_mass[n], place(n), v[n]};
    for (const HeldNode& h : held_) holds.push_back({place(h.node), v[h.node], Mat3::Identity() - h.projector});
    return nearest(masses.data(), count, holds);
  }

 private:
  static constexpr std::size_t kAsked = 64, kHeldAsked = 16;
  struct Mass {
    double m;
    Node x, v;
  };
  BodyMotion nearest(const Mass* masses, int count, const std::vector<Hold>& holds) const;

  int first_node_, nodes_;
  bool axisymmetric_;
  std::vector<int> asked_;
  std::vector<HeldNode> held_;
};

}  // namespace forming_sim
