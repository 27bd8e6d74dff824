#pragma once
// Numbers below 2.2e-308 count as nothing while one of these lives, in its thread.
// A force that fades by a part in every step, or the foot of a wave that has not yet
// arrived, falls to such numbers and stays there, and a processor takes a hundred
// cycles for each operation with one.
#include <pmmintrin.h>
#include <xmmintrin.h>

namespace forming_sim {

class DenormalsAreZero {
 public:
  DenormalsAreZero() : before_(_mm_getcsr()) { _mm_setcsr(before_ | _MM_FLUSH_ZERO_ON | _MM_DENORMALS_ZERO_ON); }
  ~DenormalsAreZero() { _mm_setcsr(before_); }
  DenormalsAreZero(const DenormalsAreZero&) = delete;
  DenormalsAreZero& operator=(const DenormalsAreZero&) = delete;

 private:
  unsigned before_;
};

}  // namespace forming_sim
