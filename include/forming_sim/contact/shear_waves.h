#pragma once
// Where surfaces rub, waves of shear leave a body, as they do into a tool of steel.
//
// A rigid tool throws every wave back, and Coulomb's law adds to it: friction takes mu times the force across
// the surface into the motion along it. So the swings of a body that slides grow, by a part mu at each way
// through its thickness, until nodes lift off and slip back and friction on the whole is less than mu N.
// Two things that steel does and a rigid tool does not keep them down.
//
// A tool that has the impedance of the body takes such waves away. Its traction on a surface that moves
// with u along it is that of a half space, rho c_s u. Here it is, while the surfaces are pressed together, of a part kappa of that impedance (part_that_leaves),
//   tau = -z phi (u - u_s),   z = kappa rho c_s,  kappa = min(1, 2 mu)
// beside friction and not within its cone. u_s is what of u is steady while the surfaces are pressed, so that tau is nothing over a time longer than T:
//   v_s <- v_s + dv_r - e/(z A T) + (1 - phi) dt/(T + dt) (v - v_s)   of either surface; e: impulse of tau on what it stands for, A
//   phi <- phi + dt/(T + dt) (w or 0 - phi)                             w: pressed
// as if masses of z A T were dragged along by dashpots: over a long time they take no impulse, however contact comes and goes.
// Across the surface v_s follows as where phi is 0. dv_r is the change of the velocity that the body has there as a whole (body_motion.h):
// a body that gathers speed, turns or follows its grips and tools feels nothing. phi grows as contact lasts.
// A strike keeps Coulomb's law. What strikes is thrown back: of the impulses N across the surfaces that press a body, over the last T, its momentum P has changed by the part
//   s = min(|sum N|, P.n) / sum |N|,   n along sum N;   w = min(1, 2 (1 - s))
// A body that is pressed between tools, that rests or that slides as its weight presses it has s near 0, one that flies at a tool 1 until it has left it.
// (A washout of first order, rho c_s sT/(1 + sT): of small motion about steady sliding it takes energy at every frequency and gives it at none. But u_s begins
// with the speed of the surface, an energy that nobody paid, which comes back where the surface slows down: so where tau pushes the slip on it is no more than
// friction is, mu N, and both together do no work on the body; what is left over comes back later.)
//
// And friction answers to a change of the normal force with a delay T_N (friction_delay.h; Prakash and Clifton 1993; that sliding is
// well-posed with it: Ranjith and Rice, J. Mech. Phys. Solids 49, 2001).
// Either alone is not enough: without the delay friction above .2 feeds more than leaves, with the delay alone it feeds
// slower and as surely (test/support/slide_eigenvalues.h).
#include <algorithm>
#include <vector>

#include "forming_sim/contact/body_motion.h"

namespace forming_sim {

constexpr double kSteadyTime = 4;     ///< T, of the time H/c_s that a wave of shear takes through the thickness H: with half of it something grows at friction .3, and what T drags along is as T
constexpr double kMemoryShare = .25;  ///< T_N / T

/// kappa: friction gives a swing a part mu at each of its ways through the thickness, of kappa z a part 2 kappa/(1 + kappa) leaves there: this is twice what is needed at least.
/// (By the eigenvalues nothing grows with kappa = mu either. With kappa = 1 whatever the friction, a sheet that all but slides freely would be held as one that sticks.)
inline double part_that_leaves(double friction) { return std::min(1.0, 2 * friction); }

/// A body whose waves leave.
struct WaveBody {
  double impedance = 0;          ///< rho c_s, Pa s/m; 0: they stay
  double time = 0;               ///< T, s
  int first_node = 0, nodes = 0;  ///< all of its nodes
};

/// What a step did to a vertex of a surface that rubs.
struct RubbedNode {
  int node;
  double area = 0;                  ///< m2
  Node normal = Node::Zero();       ///< impulse across the surface, N s
  Node radiated = Node::Zero();     ///< sum e/kappa, N s
  // Of tools whose motion is told
  Node by_tools = Node::Zero();     ///< their part of `normal`, N s
  double told_before = 0, told = 0; ///< by_tools times the speed that they have there along it, in the step before and in this, N m
};

/// The steady motion of the vertices that rub, or did so lately.
class ShearWaves {
 public:
  ShearWaves() = default;
  /// nodes: of all bodies, which follow one another in the order of their nodes; modes: rigid_modes().
  ShearWaves(const std::vector<WaveBody>& bodies, std::size_t nodes, int modes);

  bool any() const { return !bodies_.empty(); }
  /// v_s of a node at the end of a step that is `steps` times as long as the last one, if its body goes on to change its speed as it did in that; last: phi.
  /// v: its velocity, which is steady where the node has not rubbed lately.
  Node steady(int node, double steps, const Node& v) const {
    const int i = place_[node];
    return i < 0 ? v : Node(rubs_[i].v + steps * rubs_[i].change);
  }
  /// Of a pair of surfaces, those of tools after those of bodies: the body, or of two the one with the smaller impedance.
  const WaveBody& of_pair(int first, int second) const;
  const WaveBody& of_node(int n) const { return bodies_[body_of(n)]; }

  /// Masses and what is held from now on.
  void hold(const std::vector<double>& inverse_mass, const std::vector<HeldNode>& held);
  /// After a step of dt, behind one of last_dt, that took the velocities from `before` to `after` and the nodes to x. pressed: the vertices with 1 in phi's law, in rising order.
  void follow(Team& team, double dt, double last_dt, const NodeField& x, const NodeField& before, const NodeField& after, const std::vector<RubbedNode>& pressed);

  // For checkpoints.
  std::vector<double> save() const;
  void restore(const std::vector<double>& saved);

 private:
  struct Rubbing {
    int node;
    Node v, change;  ///< v_s and phi; dv_r of the last step
  };
  /// What the masses of a body did in the last step, if it rubbed then.
  struct LastMasses {
    bool known = false;
    MassSums sums;
  };
  /// What has pressed a body where it rubs, and what it did, within the last T: sums that fade, N s.
  struct Presses {
    Node normal = Node::Zero(), momentum = Node::Zero();
    double size = 0;

    void add(double part, const Node& step_normal, double step_size, const Node& step_momentum);
    double w() const;
  };
  int body_of(int n) const;
  void find_asked(const WaveBody& body, const std::vector<RubbedNode>& pressed);
  void know_places();

  std::vector<WaveBody> bodies_;
  std::vector<MovingBody> moving_;
  std::vector<LastMasses> last_masses_, masses_;  ///< of every body; masses_: of the step
  std::vector<Rubbing> rubs_, next_;  ///< in rising order of their nodes
  std::vector<Presses> presses_;      ///< of every body
  std::vector<int> place_;            ///< of every node in rubs_, -1: none
  // Of one body in follow()
  std::vector<const RubbedNode*> asked_;  ///< vertices on tools whose motion is told
  std::vector<Hold> held_before_, held_after_;
};

}  // namespace forming_sim
