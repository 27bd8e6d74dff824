// The sums over the masses of a body, compiled once per vector width (see CMakeLists.txt).
#include "forming_sim/contact/mass_sums.h"
#include "forming_sim/tensor/pack.h"

namespace forming_sim {
namespace FORMING_SIM_ISA {
namespace {

Quad record(const double* field, long node = 0) { return *reinterpret_cast<const Quad*>(field + 4 * node); }
/// The next component of each: y, z, x.
Quad next(const Quad& a) { return __builtin_shufflevector(a, a, 1, 2, 0, 3); }

void add(const double* mass, const double* x, const double* v, double back, long first, long last, MassSums& sums) {
  const Quad from = record(sums.from);
  Quad moment = record(sums.first), momentum = record(sums.momentum), square = record(sums.square), mixed = record(sums.mixed), ahead = record(sums.ahead), behind = record(sums.behind);
  double all = sums.mass;
  for (long n = first; n < last; ++n) {
    const double m = mass[n];
    const Quad u = record(v, n), r = record(x, n) - back * u - from, mr = m * r, mu = m * u, r_next = next(r);
    all += m;
    moment += mr;
    momentum += mu;
    square += mr * r;
    mixed += mr * r_next;
    ahead += mu * r_next;
    behind += next(mu) * r;
  }
  sums.mass = all;
  const auto store = [](const Quad& a, double* to) { *reinterpret_cast<Quad*>(to) = a; };
  store(moment, sums.first);
  store(momentum, sums.momentum);
  store(square, sums.square);
  store(mixed, sums.mixed);
  store(ahead, sums.ahead);
  store(behind, sums.behind);
}

}  // namespace

const MassKernels& mass_kernels() {
  static const MassKernels k{add};
  return k;
}

}  // namespace FORMING_SIM_ISA
}  // namespace forming_sim
