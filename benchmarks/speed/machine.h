#pragma once
// What this machine gives at most, measured in the run that it is compared with.
#include <string>

namespace forming_sim::bench {

/// Bytes a second of a[i] = b[i] + s c[i] over arrays that no cache holds, shared by so many threads:
/// two doubles read and one written, as the step's bytes are counted (what a cache fetches before a write is not).
double triad_bandwidth(int threads);

/// Operations a second of multiplications with addition (two each) in registers, at the width of the
/// kernels of that name ("sse2": none such, a multiplication and an addition each), on so many threads.
double arithmetic_peak(const std::string& kernels, int threads);

}  // namespace forming_sim::bench
