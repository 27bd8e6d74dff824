#pragma once
// Pairs in lanes: kLanes pairs that share no node that can move, so that a visit of
// all of them at once is the same as one after the other. And the kernels that
// visit them, compiled once per vector width.
#include "forming_sim/tensor/isa.h"
#include "forming_sim/tensor/pack.h"

namespace forming_sim {

/// ContactPair (pair.h) in lanes: the same symbols. A lane that is not in use has layer 1,
/// all else 0.
struct alignas(64) PairPack {
  double weight[4][kLanes];
  double normal[3][kLanes];
  double gap[kLanes], layer[kLanes], stiffness[kLanes], w[kLanes];
  double impulse[kLanes], end_gap[kLanes];
  int node[4][kLanes];
  int nodes;          ///< the most of any lane
  int held;           ///< 1: nodes of these pairs may be held
};

/// Rub (pair.h) in lanes.
struct alignas(64) RubPack {
  double slip[3][kLanes];    ///< of friction alone
  double radiated[3][kLanes];
  double steady[3][kLanes];  ///< along the surface
  double friction[kLanes], most[kLanes], w[kLanes], beta[kLanes], own[kLanes], before[kLanes];
};

/// What the kernels change and read of the nodes.
struct Movers {
  double* v = nullptr;                          ///< [node][4]: velocity and, last, 1/m
  const double* const* projector = nullptr;     ///< [node]: 3 x 3 of held nodes, else null
};

struct PairKernels {
  /// Adds to the velocities what the impulses and slips that the packs start with make of them.
  void (*start)(const Movers& movers, const PairPack* packs, const RubPack* rubs, long count);
  /// A visit of `count` packs in their order: see sweeps.h. rubs: of the packs,
  /// one each; null: none rubs. Returns the largest change of a gap or of a slip distance, m.
  double (*sweep)(double dt, const Movers& movers, PairPack* packs, RubPack* rubs, long count);
  /// Sets end_gap. Returns whether every pair that can be moved ends with a gap > 0.
  bool (*end_gaps)(double dt, const Movers& movers, PairPack* packs, long count);
};

const PairKernels& pair_kernels_of(Isa isa);

namespace sse2 { const PairKernels& pair_kernels(); }
namespace avx2 { const PairKernels& pair_kernels(); }
namespace avx512 { const PairKernels& pair_kernels(); }

}  // namespace forming_sim
