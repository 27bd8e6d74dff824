#pragma once
// Tools that forces drive along their guides: how fast they go is found with the impulses, in the same sweeps.
//
//   u = J/M,   J = sum over the tool's pairs and ties of their impulses on it along the guide,
//
// u the velocity that contact adds to that of the tool alone. A faster tool presses more: J falls with u by no more than the mass
// m of all that presses, each node counted as often as pairs share it. So after each sweep
//
//   u <- (J + m u)/(M + m),
//
// which comes near without overshoot whatever M is.
#include <vector>

#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// What a pair is to such a tool.
struct DrivenPair {
  long pair;     ///< its number
  double share;  ///< an impulse of the pair is so many on the tool: 1 or -1
  double along;  ///< its normal impulse is so many along the guide
  double mass;   ///< by which its impulses change with u at most, kg
  bool rubs;
};

struct DrivenTool {
  int tool = -1;
  Node guide = Node::Zero();
  double inverse_mass = 0;   ///< 1/M
  double speed = 0;          ///< along the guide without contact, m/s
  double push = 0;           ///< u, m/s
  std::vector<int> entries;  ///< of the workspace: what moves with it
  std::vector<DrivenPair> pairs;
  std::vector<int> ties;     ///< numbers of its ties
};

}  // namespace forming_sim
