// The loops over nodes, compiled once per vector width (see CMakeLists.txt).
#include "forming_sim/element/node_kernels.h"

#include "forming_sim/element/cell_group.h"

namespace forming_sim {
namespace FORMING_SIM_ISA {
namespace {

Quad& record(double* field, long node) { return *reinterpret_cast<Quad*>(field + 4 * node); }
const Quad& record(const double* field, long node) { return *reinterpret_cast<const Quad*>(field + 4 * node); }

void sum(int dimension, const int* start, const int* index, const double* slots, long first, long last, double* f) {
  if (dimension == 2) {
    for (long n = first; n < last; ++n) {
      Pair sum = {0, 0};
      for (int k = start[n]; k < start[n + 1]; ++k) sum += *reinterpret_cast<const Pair*>(slots + kRecord<2> * static_cast<long>(index[k]));
      record(f, n) = Quad{sum[0], sum[1], 0, 0};
    }
  } else {
    for (long n = first; n < last; ++n) {
      Quad sum = {0, 0, 0, 0};
      for (int k = start[n]; k < start[n + 1]; ++k) sum += record(slots, index[k]);
      record(f, n) = sum;
    }
  }
}

void kick(double keep, double push, const double* v, const double* f, const double* mass, long first, long last, double* to) {
  const auto node = [&](long n, double over_mass) { record(to, n) = keep * record(v, n) + over_mass * record(f, n); };
  long n = first;
  for (; n + 4 <= last; n += 4) {  // four divisions at once
    const Quad over_mass = push / *reinterpret_cast<const Quad*>(mass + n);
    for (int k = 0; k < 4; ++k) node(n + k, over_mass[k]);
  }
  for (; n < last; ++n) node(n, push / mass[n]);
}

void move(double dt, const double* v, long first, long last, double* x) {
  for (long n = first; n < last; ++n) record(x, n) += dt * record(v, n);
}

}  // namespace

const NodeKernels& node_kernels() {
  static const NodeKernels k{sum, kick, move};
  return k;
}

}  // namespace FORMING_SIM_ISA
}  // namespace forming_sim
