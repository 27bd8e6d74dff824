#pragma once
// Where a step of the elements spends its time, for who asks for it.

namespace forming_sim {

/// Wall time of the stages of a step, s, summed over the steps.
struct StepTimes {
  double bound = 0;     ///< stable time step of the elements
  double pressure = 0;  ///< pressures of the nodes, where they have some
  double cells = 0;     ///< elements: positions gathered, law, forces on the nodes of each cell
  double nodes = 0;     ///< forces of the cells summed by node, velocities, positions
};

}  // namespace forming_sim
