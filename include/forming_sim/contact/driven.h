#pragma once
// Tools that move as they are pushed, along a guide or about an axle: how fast they go is found with the impulses, in the same sweeps.
//
//   u = J/M,   J = sum over the tool's pairs and ties of (their impulses on it).d(x),   d(x) = guide + axle x (x - centre),
//
// u the velocity (about an axle the spin) that contact adds to that of the tool alone, d(x) u that of its point x; about an axle M is
// the moment of inertia. A faster tool presses more: J falls with u by no more than the mass m of all that presses (d^2 times it),
// each node counted as often as pairs share it. So after each sweep
//
//   u <- (J + m u)/(M + m),
//
// which comes near without overshoot whatever M is. Where a tool gives way along a guide and about an axle, a pair may see both as one: with m12 the
// product of its d's, each counts it by |m12| sqrt(m1/m2) more, so that the two together stay on this side too.
#include <cmath>
#include <vector>

#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// What a pair or tie is to such a tool.
struct DrivenLink {
  long link;     ///< its number
  Node on;       ///< its impulses times this add up to J: sum of its weights of the tool's points, d(x) each
  Node answer;   ///< its impulse changes by this times a change of u at most, kg; kg m
  double along;  ///< of a pair: so much of its normal impulse
  double mass;   ///< by which its part of J changes with u at most, kg; kg m2
  bool rubs;
};

struct DrivenTool {
  int tool = -1, freedom = 0;
  double inverse_mass = 0;  ///< 1/M
  double speed = 0;         ///< without contact, m/s; rad/s
  double last_speed = 0;    ///< in the step before
  double push = 0;          ///< u
  double reach = 1;         ///< |d| of its point that goes farthest
  struct Entry {
    int entry;  ///< of the workspace: what moves with it
    Node along; ///< d(x)
  };
  std::vector<Entry> entries;
  std::vector<DrivenLink> pairs, ties;

  /// Of two freedoms of one tool that have been gathered.
  static void see_each_other(DrivenTool& a, DrivenTool& b);
  /// How far u alone takes any of its points in dt, m.
  double way(double u, double dt) const { return std::abs(u) * reach * dt; }
};

}  // namespace forming_sim
