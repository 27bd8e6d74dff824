#pragma once
// How the kernels go through pairs that lie in lanes (pair_pack.h, closest_pack.h). For files that are compiled once per vector width only.
#include "forming_sim/tensor/pack.h"

namespace forming_sim {
namespace FORMING_SIM_ISA {

/// Calls work(i, at) for all lanes of `count` blocks of kLanes pairs: those of block i from `at` on, as many as a Pack has.
template <class Work> [[gnu::always_inline]] inline void each_part(long count, const Work& work) {
  for (long i = 0; i < count; ++i)
    for (int at = 0; at < kLanes; at += kWidth) work(i, at);
}

}  // namespace FORMING_SIM_ISA
}  // namespace forming_sim
