#pragma once
// Gauss-Seidel sweeps over the pairs: each visit replaces a pair's impulse by
// the one that goes with its end-of-step gap, all others held, and its friction
// impulse by the nearest one within the Coulomb cone.
#include <vector>

#include "forming_sim/contact/ties.h"

namespace forming_sim {

/// One visit of every pair, in their order; changes work.v. Returns the largest
/// change of a gap or of a slip distance, m.
double sweep(double dt, Workspace& work, std::vector<ContactPair>& pairs, std::vector<Rub>& rubs);

struct SweepResult {
  int sweeps = 0;
  bool open = true;       ///< every pair that can be moved ends with a gap > 0
};
/// Sweeps until every pair ends with a gap > 0 and nothing changes by more than
/// `tolerance`, at most `most` times; in each sweep ties come before pairs. Sets end_gap.
SweepResult solve_pairs(double dt, double tolerance, int most, Workspace& work, std::vector<TiePair>& ties, std::vector<ContactPair>& pairs,
                        std::vector<Rub>& rubs);

}  // namespace forming_sim
