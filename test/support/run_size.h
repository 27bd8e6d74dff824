#pragma once
// What a run took.
#include "forming_sim/simulation/simulation.h"

namespace forming_sim {

struct RunSize {
  long cells = 0, elements = 0;  ///< elements: simplices, what a step updates
  long unknowns = 0;             ///< components of all nodes' motion
  long steps = 0;
  double wall_time = 0;          ///< s
};

inline RunSize size_of(const Mesh& mesh, long steps, double wall_time) {
  RunSize size{0, mesh.simplex_count(), static_cast<long>(mesh.nodes.size()) * mesh.dimension, steps, wall_time};
  for (const Cells& cells : mesh.cells) size.cells += cells.count();
  return size;
}
inline RunSize size_of(const Simulation& sim) {
  RunSize sum{0, 0, 0, sim.steps(), sim.wall_time()};
  for (const BodyModel& body : sim.model().bodies) {
    const RunSize one = size_of(body.mesh, 0, 0);
    sum.cells += one.cells;
    sum.elements += one.elements;
    sum.unknowns += one.unknowns;
  }
  return sum;
}

}  // namespace forming_sim
