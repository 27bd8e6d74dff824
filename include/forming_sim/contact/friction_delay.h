#pragma once
// Friction answers to a change of the normal force N with a delay (shear_waves.h): it follows (1 - phi) N + phi N_d, with of every node
//   N_d <- N_d + (kick N - given)/T_N,   given = kick ((1 - phi) N + phi (a N + (1 - a) N_d)),  a = kick/(T_N + kick);  not pressed: 0
// With phi = 1 that is the mean of N over the time T_N. What friction is not given now it is given later: however N jumps, its
// impulse is mu times that of N, but for mu N_d T_N that is still to come.
//
// Nodes remember, not pairs: as a corner of a tool leaves a cell and the next one comes, or a node slides from facet to facet, pairs come
// and go and the force on the node does not. What a node remembers its pairs share as they shared its force in the step before.
#include <vector>

#include "forming_sim/contact/pair.h"
#include "forming_sim/contact/shear_waves.h"

namespace forming_sim {

class FrictionDelay {
 public:
  /// Gives the pairs that rub what they follow: own and before of their Rub. Their impulses are those of the step before, from which the sweeps start.
  void recall(const Workspace& work, const LargeArray<ContactPair>& pairs, std::vector<Rub>& rubs);
  /// After a step, whose impulses the pairs have. nodes: of all bodies.
  void follow(const Workspace& work, const LargeArray<ContactPair>& pairs, const std::vector<Rub>& rubs, std::size_t nodes, const ShearWaves& waves);

  /// N_d of every node, N; none before the first step.
  std::vector<double>& delayed() { return delayed_; }
  const std::vector<double>& delayed() const { return delayed_; }

 private:
  std::vector<double> delayed_, sum_;  ///< N; per entry, N s
};

}  // namespace forming_sim
