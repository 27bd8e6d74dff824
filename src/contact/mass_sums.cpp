#include "forming_sim/contact/mass_sums.h"

#include <algorithm>
#include <array>

namespace forming_sim {

const MassKernels& mass_kernels_of(Isa isa) {
  return isa == Isa::avx512 ? avx512::mass_kernels() : isa == Isa::avx2 ? avx2::mass_kernels() : sse2::mass_kernels();
}

MassSums sum_masses(Team& team, const std::vector<double>& mass, int first, const NodeField& x, const NodeField& v, double back) {
  constexpr long kChunk = 4096, kMostChunks = 64;  // nodes; as many sums, however many threads there are
  static const MassKernels& kernels = mass_kernels_of(choose_isa());
  const long nodes = static_cast<long>(mass.size()), size = std::max(kChunk, (nodes + kMostChunks - 1) / kMostChunks), chunks = (nodes + size - 1) / size;
  MassSums all;
  if (nodes == 0) return all;
  std::copy(x[first].data(), x[first].data() + 4, all.from);
  const auto add = [&](long chunk, MassSums& sums) {
    kernels.add(mass.data(), x[first].data(), v[first].data(), back, chunk * size, std::min(nodes, (chunk + 1) * size), sums);
  };
  if (chunks == 1) {
    add(0, all);
    return all;
  }
  std::array<MassSums, kMostChunks> parts;
  std::fill_n(parts.begin(), chunks, all);
  team.share(chunks, 3, [&](long from, long to) {
    for (long chunk = from; chunk < to; ++chunk) add(chunk, parts[chunk]);
  });
  for (long chunk = 0; chunk < chunks; ++chunk) {
    const MassSums& part = parts[chunk];
    all.mass += part.mass;
    for (const auto of : {&MassSums::first, &MassSums::momentum, &MassSums::square, &MassSums::mixed, &MassSums::ahead, &MassSums::behind})
      for (int i = 0; i < 4; ++i) (all.*of)[i] += (part.*of)[i];
  }
  return all;
}

}  // namespace forming_sim
