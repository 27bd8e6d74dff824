#include "forming_sim/tensor/isa.h"

#include <cstring>
#include <string>

#include "forming_sim/config/fault.h"

namespace forming_sim {

Isa choose_isa(const char* name) {
  __builtin_cpu_init();
  const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool has_avx512 = has_avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                          __builtin_cpu_supports("avx512vl");
  if (name == nullptr) return has_avx512 ? Isa::avx512 : has_avx2 ? Isa::avx2 : Isa::sse2;
  if (std::strcmp(name, "sse2") == 0) return Isa::sse2;
  if (std::strcmp(name, "avx2") == 0 && has_avx2) return Isa::avx2;
  if (std::strcmp(name, "avx512") == 0 && has_avx512) return Isa::avx512;
  throw Error(Code::internal_error,
              std::string("vector kernels: given ") + name + "; this processor runs sse2" +
                  (has_avx2 ? ", avx2" : "") + (has_avx512 ? ", avx512" : ""));
}

}  // namespace forming_sim
