#pragma once
// The nodes' part of a step, symplectic Euler (3.39), shared by the threads of a run.
#include <functional>
#include <vector>

#include "forming_sim/element/nodal_forces.h"
#include "forming_sim/element/node_team.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// A body, and what the rounding of its cells may accelerate a node by.
struct RestingBody {
  int first_node = 0, nodes = 0;
  double rounding = 0;  ///< m/s2
};

/// The kick in a time of `time` s with damping (1/s) at the mean of the two velocities:
/// v <- keep v + push f/m = ((1 - a) v + time f/m) / (1 + a), a = damping time/2.
/// A node that rests, bears no load and would be accelerated by at most `rounding` of its body goes on to rest: cells that are as they were at the start pull by what
/// their rounding leaves, and would set going in a few steps what nothing has touched (element/stillness.h). Without `resting` nothing is looked at.
struct Kick {
  double keep, push;
  const std::vector<RestingBody>* resting;  ///< all bodies, or null

  Kick(double time, double damping, const std::vector<RestingBody>* bodies = nullptr) : resting(bodies) {
    const double a = 0.5 * damping * time;
    keep = (1 - a) / (1 + a);
    push = time / (1 + a);
  }
};

/// f of all nodes. Here and below a team goes through as many nodes as the fields have.
void sum_nodes(const NodeTeam& team, const NodalForces& forces, NodeField& f);
/// f of one node, the same to the last bit.
Node force_on(long node, const NodalForces& forces);

/// to = v after the kick; mass: kg. Returns how many nodes go on to rest.
long kick_nodes(const NodeTeam& team, const Kick& kick, const NodeField& v, const NodalForces& forces, const std::vector<double>& mass, NodeField& to);

/// x += dt v. Returns the largest |v - then|^2, 0 without `then`.
double move_nodes(const NodeTeam& team, double dt, const NodeField& v, const NodeField* then, NodeField& x);

/// What move_nodes and kick_nodes return.
struct KickedAndMoved {
  double apart;
  long resting;
};
/// Both, a part of the nodes at a time, which a core's cache holds meanwhile: v = v_before after the kick, then hold(first, last)
/// for what else acts on the velocities of the nodes [first, last), then x += dt v.
KickedAndMoved kick_and_move_nodes(const NodeTeam& team, const Kick& kick, const NodeField& v_before, const NodalForces& forces, const std::vector<double>& mass,
                                   const std::function<void(long first, long last)>& hold, double dt, const NodeField* then, NodeField& v, NodeField& x);

/// moved = does x differ from seen, node by node; seen = x. Returns how many do.
long compare_nodes(const NodeTeam& team, const NodeField& x, NodeField& seen, std::vector<char>& moved);

}  // namespace forming_sim
