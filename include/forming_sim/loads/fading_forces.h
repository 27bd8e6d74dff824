#pragma once
// Forces on nodes that are there at once and fade: what a body was held by that has been let go.
#include <vector>

#include "forming_sim/mesh/faces.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// What held a node, N. With a surface, of a tool that pressed on it, it turns as that does; else it keeps its direction.
struct HoldingForce {
  int node = -1;
  bool on_surface = false;
  Node force = Node::Zero();
};

/// f(t) = f (1 - 10 u^3 + 15 u^4 - 6 u^5), u = (t - start)/duration: level at both ends.
/// Pressures on both faces of a sheet that kept their directions would turn it on, as a force along it of p t does that makes it buckle; the tools did not. So
/// forces of tools turn from the normal that their node had to the one it has. What they are together by that more or less than before would drive the body as a whole:
/// as much is taken from all of its nodes, by their masses, along the ways that are free to it.
/// What springs back moves against them. Where a body gives way instead, they would drive it on, and more the less it bears.
class FadingForces {
 public:
  /// A body: its nodes, its mass, kg, and the projector on the directions in which none of them is held.
  struct OfBody {
    int first_node = 0, nodes = 0;
    double mass = 0;
    Mat3 free = Mat3::Identity();
  };
  /// From `start` for `duration`, s; at most until one more step would do more work than `may_do` in all, J. surface: of the bodies, at x.
  void begin(double start, double duration, double may_do, const OfBody& body, std::vector<HoldingForce> forces, const std::vector<Face>& surface, const NodeField& x);
  /// f += forces at time t, of bodies at x.
  void add(double t, const NodeField& x, const std::vector<double>& mass, NodeField& f);
  /// Takes the work that those that were added do for `kick` s at the mean of two velocities from what they may; whether any had to be dropped.
  bool work(double kick, const std::vector<double>& mass, const NodeField& v_before, const NodeField& v);
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
      a.number(set.body.first_node);
      a.number(set.body.nodes);
      a.number(set.body.mass);
      a.numbers(set.body.free.data(), 9);
      a.list(set.forces);
      a.list(set.normals);
      a.list(set.corners);
      a.list(set.faces);
    }
  }

 private:
  /// Corner k of face f, whose node has a force that turns.
  struct Corner {
    int face, k, force;
  };
  struct Set {
    double start = 0, duration = 0, may_do = 0;
    OfBody body;
    std::vector<HoldingForce> forces;
    std::vector<Node> normals;  ///< at the start, of length 1; 0: keeps its direction
    std::vector<Face> faces;
    std::vector<Corner> corners;
    // By the last add()
    std::vector<Node> added;             ///< of every force, N
    Node acceleration = Node::Zero();    ///< that all nodes have less, m/s2
    std::vector<Node> normals_at(const NodeField& x) const;
  };
  std::vector<Set> sets_;
};

}  // namespace forming_sim
