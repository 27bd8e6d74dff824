#pragma once
// What the nodes of a pair make of it, summed node by node. T: double, or a Pack of pairs.
#include "forming_sim/tensor/pack.h"

namespace forming_sim {

template <class T> struct PairShares {
  T w = 0.0;           ///< sum b^2/m, 1/kg: the inverse mass of the pair where no direction is held
  T area = 0.0;        ///< of its nodes of bodies
  T bodies = 0.0;      ///< how many these are
  T movers = 0.0;      ///< 2^k for every node k that can move
  T held = 0.0;        ///< how many of those have held directions

  /// Adds node k, of weight b; the rest is its Share (pair.h).
  void add(int k, const T& b, const T& inverse_mass, const T& node_area, const T& of_body, const T& node_held) {
    const T none(0.0);
    w = w + b * b * inverse_mass;
    area = area + node_area;
    bodies = bodies + of_body;
    movers = movers + select(inverse_mass > none, T(1 << k), none);
    held = held + select(inverse_mass > none, node_held, none);
  }
  /// The area that the pair stands for: the mean of its nodes of bodies.
  T mean_area() const { return select(bodies > T(0.0), area / bodies, T(0.0)); }
};

}  // namespace forming_sim
