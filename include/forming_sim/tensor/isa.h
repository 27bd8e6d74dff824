#pragma once
// Which vector instructions this processor has: kernels are compiled once for each
// set (see CMakeLists.txt), and chosen at run time.

namespace forming_sim {

enum class Isa { sse2, avx2, avx512 };

/// The widest set that this processor runs; `name` ("sse2", "avx2", "avx512") asks
/// for one. Throws Error(internal_error) where the processor lacks it.
Isa choose_isa(const char* name = nullptr);

}  // namespace forming_sim
