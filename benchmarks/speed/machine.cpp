#include "speed/machine.h"

#include <algorithm>
#include <vector>

#include "forming_sim/parallel/team.h"
#include "rows.h"

namespace forming_sim::bench {
namespace {

constexpr int kRounds = 1 << 16;
constexpr int kChains = 12;  // independent ones: more than the latency of one times two units

/// kRounds steps sum <- sum factor + term in each of kChains registers of type Lanes.
template <class Lanes> [[gnu::always_inline]] inline double chains(double seed) {
  Lanes sum[kChains] = {};
  const Lanes factor = Lanes{} + (1 - seed), term = Lanes{} + seed;
  for (int i = 0; i < kRounds; ++i) {
#pragma GCC unroll 12
    for (int k = 0; k < kChains; ++k) {
      sum[k] = sum[k] * factor + term;
      asm volatile("" : "+x"(sum[k]));  // every value is needed
    }
  }
  double all = 0;
#pragma GCC unroll 12
  for (int k = 0; k < kChains; ++k) all += sum[k][0];
  return all;
}

typedef double Two __attribute__((vector_size(16)));
typedef double Four __attribute__((vector_size(32)));
typedef double Eight __attribute__((vector_size(64)));

double chains_sse2(double seed) { return chains<Two>(seed); }
[[gnu::target("avx2,fma")]] double chains_avx2(double seed) { return chains<Four>(seed); }
[[gnu::target("avx512f,avx512dq,avx512vl,fma")]] double chains_avx512(double seed) { return chains<Eight>(seed); }

}  // namespace

double triad_bandwidth(int threads) {
  constexpr long count = 12 << 20;  // doubles: three arrays of 100 MB
  Team team(threads);
  std::vector<double> a(count), b(count, 1.0), c(count, 2.0);
  const double time = least_time([&] {
    team.share(count, 1, [&](long first, long last) {
      for (long i = first; i < last; ++i) a[i] = b[i] + 3.0 * c[i];
    });
  });
  return 3.0 * sizeof(double) * count / time;
}

double arithmetic_peak(const std::string& kernels, int threads) {
  const bool eight = kernels == "avx512", four = kernels == "avx2";
  const auto run = eight ? chains_avx512 : four ? chains_avx2 : chains_sse2;
  Team team(threads);
  std::vector<double> sink(threads);
  const double time = least_time([&] {
    team.share(threads, 1, [&](long first, long last) {
      for (long i = first; i < last; ++i) sink[i] = run(1e-3);
    });
  });
  return 2.0 * (eight ? 8 : four ? 4 : 2) * kChains * kRounds * threads / time;
}

}  // namespace forming_sim::bench
