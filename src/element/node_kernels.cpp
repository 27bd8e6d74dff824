// The loops over nodes, compiled once per vector width (see CMakeLists.txt).
#include "forming_sim/element/node_kernels.h"

#include <algorithm>
#include <type_traits>

#include "forming_sim/element/cell_group.h"
#include "forming_sim/tensor/pack.h"

namespace forming_sim {
namespace FORMING_SIM_ISA {
namespace {

Quad& record(double* field, long node) { return *reinterpret_cast<Quad*>(field + 4 * node); }
const Quad& record(const double* field, long node) { return *reinterpret_cast<const Quad*>(field + 4 * node); }

/// f of node n; Loaded: with its load.
template <int D, bool Loaded> [[gnu::always_inline]] inline Quad force(const NodalForces& f, long n) {
  const auto slot = [&](int k) { return f.slots + kRecord<D> * static_cast<long>(f.index[k]); };
  Quad sum = {0, 0, 0, 0};
  if constexpr (D == 2) {
    Pair of_slots = {0, 0};
    for (int k = f.start[n]; k < f.start[n + 1]; ++k) of_slots += *reinterpret_cast<const Pair*>(slot(k));
    sum = Quad{of_slots[0], of_slots[1], 0, 0};
  } else {
    for (int k = f.start[n]; k < f.start[n + 1]; ++k) sum += *reinterpret_cast<const Quad*>(slot(k));
  }
  if constexpr (Loaded) sum += record(f.load, n);
  return sum;
}

/// Nodes from which slots are fetched to those that add them up: where a body lies outside the cache, the processor does not guess
/// the place of a slot, which the tiles give.
constexpr long kNodesAhead = 24;
/// Fetches what some nodes from `n` on have, about.
template <int D> [[gnu::always_inline]] inline void fetch_slots(const NodalForces& f, long n) {
  const int* index = f.index + f.start[n];
  for (int k = 0; k < kSlotsFetched; ++k) __builtin_prefetch(f.slots + kRecord<D> * static_cast<long>(index[k]));
}

/// work(D, Loaded) with both as constants of the compiler.
template <class Work> void with_kind_of(const NodalForces& f, Work&& work) {
  constexpr std::integral_constant<int, 2> flat;
  constexpr std::integral_constant<int, 3> solid;
  if (f.dimension == 2) f.load ? work(flat, std::true_type()) : work(flat, std::false_type());
  else f.load ? work(solid, std::true_type()) : work(solid, std::false_type());
}

void sum(const NodalForces& forces, long first, long last, double* f) {
  with_kind_of(forces, [&](auto D, auto loaded) {
    for (long n = first; n < last; ++n) record(f, n) = force<D, loaded>(forces, n);
  });
}

bool is_zero(const double* u) { return u[0] == 0 && u[1] == 0 && u[2] == 0; }

template <bool may_rest> long kick(double keep, double push, double still, const double* v, const NodalForces& forces, const double* mass, long first, long last, double* to) {
  long resting = 0;
  with_kind_of(forces, [&](auto D, auto loaded) {
    const auto node = [&](long n, double over_mass) {
      const Quad f = force<D, loaded>(forces, n);
      record(to, n) = keep * record(v, n) + over_mass * f;
      if constexpr (may_rest) {
        if (!is_zero(v + 4 * n)) return;
        if constexpr (loaded)
          if (!is_zero(forces.load + 4 * n)) return;
        const Quad squares = f * f;
        if (over_mass * over_mass * ((squares[0] + squares[2]) + (squares[1] + squares[3])) > still * still) return;
        record(to, n) = Quad{0, 0, 0, 0};
        ++resting;
      }
    };
    long n = first;
    for (; n + 4 <= last; n += 4) {  // four divisions at once
      const Quad over_mass = push / *reinterpret_cast<const Quad*>(mass + n);
      fetch_slots<D>(forces, std::min(n + kNodesAhead, last));
      for (int k = 0; k < 4; ++k) node(n + k, over_mass[k]);
    }
    for (; n < last; ++n) node(n, push / mass[n]);
  });
  return resting;
}
long kick(double keep, double push, double still, const double* v, const NodalForces& forces, const double* mass, long first, long last, double* to) {
  return (still > 0 ? kick<true> : kick<false>)(keep, push, still, v, forces, mass, first, last, to);
}

double move(double dt, const double* v, const double* then, long first, long last, double* x) {
  double most = 0;
  if (then) {
    for (long n = first; n < last; ++n) {
      const Quad u = record(v, n), apart = u - record(then, n), squares = apart * apart;
      record(x, n) += dt * u;
      most = std::max(most, (squares[0] + squares[2]) + (squares[1] + squares[3]));
    }
  } else {
    for (long n = first; n < last; ++n) record(x, n) += dt * record(v, n);
  }
  return most;
}

long compare(const double* x, long first, long last, double* seen, char* moved) {
  long count = 0;
  for (long n = first; n < last; ++n) {
    const Quad now = record(x, n);
    const auto differs = now != record(seen, n);  // all bits of each number that does
    const int any = static_cast<int>((differs[0] | differs[1]) | (differs[2] | differs[3])) & 1;
    record(seen, n) = now;
    moved[n] = static_cast<char>(any);
    count += any;
  }
  return count;
}

}  // namespace

const NodeKernels& node_kernels() {
  static const NodeKernels k{sum, kick, move, compare};
  return k;
}

}  // namespace FORMING_SIM_ISA
}  // namespace forming_sim
