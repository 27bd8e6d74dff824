#pragma once
// What the masses of a body are and how they move, all together; and the kernel that adds them up, compiled once per vector width.
#include <vector>

#include "forming_sim/parallel/team.h"
#include "forming_sim/tensor/isa.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// Sums over nodes at r from `from`, with the velocities v. Raw numbers, since Eigen's types lie differently where vectors are wider.
struct MassSums {
  double from[4] = {};      ///< m
  double mass = 0;          ///< kg
  double first[4] = {};     ///< m r
  double momentum[4] = {};  ///< m v
  double square[4] = {};    ///< m r_i r_i
  double mixed[4] = {};     ///< m r_i r_j; i, j cyclic here and below
  double ahead[4] = {};     ///< m v_i r_j
  double behind[4] = {};    ///< m v_j r_i
};

struct MassKernels {
  /// Adds nodes [first, last) to `sums`, which stand at x - back v. mass: 0 counts for nothing; x, v: records of four numbers.
  void (*add)(const double* mass, const double* x, const double* v, double back, long first, long last, MassSums& sums);
};

const MassKernels& mass_kernels_of(Isa isa);

namespace sse2 { const MassKernels& mass_kernels(); }
namespace avx2 { const MassKernels& mass_kernels(); }
namespace avx512 { const MassKernels& mass_kernels(); }

/// Of nodes first, ..., whose masses are given. The same with any number of threads.
MassSums sum_masses(Team& team, const std::vector<double>& mass, int first, const NodeField& x, const NodeField& v, double back);

}  // namespace forming_sim
