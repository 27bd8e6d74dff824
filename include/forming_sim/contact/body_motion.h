#pragma once
// How a body moves as a whole: as a rigid body that is held, in two parts. Held and driven nodes prescribe their velocities in the directions in which they
// are held, and so do tools across their surfaces: half a sheet that is held at its plane of symmetry moves as the whole sheet does, a body that is gripped as
// its grips, and a billet in its container as the ram.
//
// Its own part is that of its masses in what is left free: the rigid motion p with the least of  sum m |p - v|^2 + K sum (n.p)^2,  n the held directions.
// However the holds lie, it is not more than the motion of the masses, so that what goes with it takes energy from a body that swings against its holds and gives none.
//
// The told part follows the holds,  p with the least of  sum (n.(p - v))^2,  as far as they lead it. What they lead hardly (a sheet on two shoulders, along them) they do not:
// the inclination of the one against the other would throw it about. And as far as they agree: a punch that moves into a sheet on a die that
// rests moves no rigid body, and tells the sheet nothing.
//
// All masses count: of a swing, which has no momentum, some of them see a motion that the body does not make. As a reference of friction that motion fed
// the swing (`sliding_swing`: DampedABlockOfSquarePlanFeelsWhatItShould). Of what is held or touched by tools some nodes are asked.
#include <vector>

#include "forming_sim/contact/held_node.h"
#include "forming_sim/contact/mass_sums.h"

namespace forming_sim {

/// V + w x (x - c).
struct WholeMotion {
  Node c = Node::Zero(), v = Node::Zero();  ///< m, m/s
  Vec3 w = Vec3::Zero();                    ///< 1/s

  Node at(const Node& x) const {
    const Node r = x - c;
    return v + node(w[1] * r[2] - w[2] * r[1], w[2] * r[0] - w[0] * r[2], w[0] * r[1] - w[1] * r[0]);
  }
};

struct BodyMotion {
  WholeMotion own, told;  ///< about the same c
  double agreed = 0;      ///< 1: the holds are those of a rigid motion, 0: of none

  /// own + part told.
  WholeMotion with(double part) const { return {own.c, own.v + part * told.v, own.w + part * told.w}; }
  Node at(const Node& x) const { return with(agreed).at(x); }
};
/// From one motion of a body to the next; told motion counts by how far the holds agree in the latter.
struct ChangeOfMotion {
  WholeMotion was, is;

  ChangeOfMotion() = default;
  ChangeOfMotion(const BodyMotion& before, const BodyMotion& after) : was(before.with(after.agreed)), is(after.with(after.agreed)) {}
  /// Change of velocity of a point of the body that was at `from`, and is at `to`.
  Node at(const Node& from, const Node& to) const { return is.at(to) - was.at(from); }
};

/// A point whose velocity along a direction is told.
struct Hold {
  Node x;        ///< m
  Node along;    ///< n, of length 1
  double speed;  ///< m/s
};

/// Modes of rigid motion that nodes have: 6, in the plane x, y 3; of a section that is turned about y the motion along y alone.
constexpr int rigid_modes(int dimension, bool axisymmetric) { return dimension == 3 ? 6 : axisymmetric ? 1 : 3; }

class MovingBody {
 public:
  /// modes: rigid_modes().
  MovingBody(int first_node, int nodes, int modes);

  /// Masses and what is held from now on. inverse_mass, held: of all nodes, those of other bodies do not count; 0: held in all directions. Returns whether masses have changed.
  bool hold(const std::vector<double>& inverse_mass, const std::vector<HeldNode>& held);
  /// How the masses move that stand at x - back v. x, v: of all nodes.
  MassSums masses(Team& team, const NodeField& x, const NodeField& v, double back) const { return sum_masses(team, mass_, first_node_, x, v, back); }
  /// v: of all nodes; place(n): where node n is when it has that velocity; masses: with these. holds: beside the held nodes, which are added to them.
  template <class Place> BodyMotion motion(const MassSums& masses, const NodeField& v, Place&& place, std::vector<Hold>& holds) const {
    const double points = static_cast<double>(holds.size() + held_points_);
    for (const HeldAlong& h : held_) holds.push_back({place(h.node), h.along, h.along.dot(v[h.node])});
    return modes_ == 1 ? of<1>(masses, holds, points) : modes_ == 3 ? of<3>(masses, holds, points) : of<6>(masses, holds, points);
  }

 private:
  static constexpr std::size_t kHeldAsked = 16;
  /// A direction in which a node is held.
  struct HeldAlong {
    int node;
    Node along;
  };
  /// points: that have the holds.
  template <int modes> static BodyMotion of(const MassSums& masses, const std::vector<Hold>& holds, double points);

  int first_node_, nodes_, modes_;
  std::vector<double> mass_;  ///< kg; 0: held in all directions
  std::vector<HeldAlong> held_;
  std::size_t held_points_ = 0;
};

}  // namespace forming_sim
