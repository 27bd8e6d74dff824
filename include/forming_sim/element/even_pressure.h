#pragma once
// What keeps the pressure of a free mesh next to nu = 1/2 from going up and down from node to node.
//
// With one pressure a node, theta_n = V_n/V_n0 - 1, a body whose volume can hardly change has patterns of pressure that move next to
// nothing: what a coarse stress leaves of them is as large as K. So K acts on means alone, and what differs from node to
// node is held by no more than K_r:
//   theta_s = the mean theta_n of the nodes of s,
//   U = sum_n K_r V_n0/2 theta_n^2 + sum_s (K - K_r) V_s0/2 theta_s^2,
//   p_n = (1/V_n0) dU/dtheta_n = K_r theta_n + (K - K_r)/V_n0 sum_s V_s0/(d+1) theta_s,
// the sums over the simplices s around n. Where theta is uniform p = K theta; for any other U is less than with K in every node, whose bound
// of the step holds here too. Steel and aluminium have K < kRough mu, and nothing of this.
#include <algorithm>

namespace forming_sim {

constexpr double kRough = 3;  ///< K_r/mu

/// K_r, Pa.
inline double rough_bulk(double K, double mu) { return std::min(K, kRough * mu); }

}  // namespace forming_sim
