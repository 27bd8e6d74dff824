#pragma once
// From the rates of the cells to the stable step of the mesh.
//
// A step dt of the central difference is stable where dt^2 K + 2 dt C <= 4 M as
// quadratic forms: K the stiffness, C the bulk viscosity, which knows the velocity of
// half a step ago, M the masses. For one frequency omega and one damping c,
//   dt = 2/omega (sqrt(1 + xi^2) - xi),  xi = c/(2 omega).
//
// Of each cell element/time_step.h bounds K_c <= omega2_c M_c and C_c <= c_c M_c, M_c the
// cell's own share of its nodes' masses. Three bounds on the mesh follow from that:
//   element  omega^2 <= max over the cells of omega2_c;
//   node     omega^2 <= max over the nodes of sum_c m_cn omega2_c / m_n: K <= sum_c omega2_c M_c,
//            and both sides of that are diagonal. Never below `element`, above it where a
//            small cell hangs on nodes that its neighbours make heavy, or that were given mass;
//   global   the largest eigenvalue itself, from simulation/lanczos.h.
#include <vector>

#include "forming_sim/element/cell_group.h"

namespace forming_sim {

/// [group][block] of Elements.
using CellRates = std::vector<std::vector<BlockRates>>;

/// The cell that limits `element`: its stable step, s, and the number of its first simplex.
struct CellLimit {
  double dt = 1e300;
  int element = -1;
};

/// Per node: sum_c m_cn omega2_c, N/m, and sum_c m_cn c_c, kg/s.
struct NodalRates {
  std::vector<double> stiffness, damping;
  /// Mass, kg, with which node n is stable at a step dt.
  double mass_for(std::size_t n, double dt) const { return 0.25 * dt * (dt * stiffness[n] + 2 * damping[n]); }
};

/// The node that limits `node`: its stable step, s, and its number.
struct NodeLimit {
  double dt = 1e300;
  int node = -1;
};
NodeLimit slowest_node(const NodalRates& rates, const std::vector<double>& mass);

/// omega2: 1/s2, damping: 1/s. A NaN gives a NaN.
double stable_step(double omega2, double damping);

}  // namespace forming_sim
