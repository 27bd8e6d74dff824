#include "forming_sim/contact/closest.h"

#include "forming_sim/contact/closest_pack.h"

namespace forming_sim {

ClosestEdges closest_on_edges(const Node& a0, const Node& a1, const Node& b0, const Node& b1) {
  const CrossingEdges<double> crossing = crossing_edges(between(b0, a0), between(a0, a1), between(b0, b1));
  if (crossing.inside) {
    const Node apart(crossing.apart[0], crossing.apart[1], crossing.apart[2], 0);
    return {crossing.s, crossing.t, apart, dot3(apart, apart), true};
  }
  const Node u = a1 - a0, v = b1 - b0, r = a0 - b0;
  ClosestEdges e;
  // Otherwise an end of one of them is closest.
  e.squared = -1;
  const auto offer = [&](double s, double t) {
    const Node d = r + s * u - t * v;
    const double squared = dot3(d, d);
    if (e.squared < 0 || squared < e.squared) e = {s, t, d, squared, false};
  };
  offer(0, closest_on_segment(a0, b0, b1));
  offer(1, closest_on_segment(a1, b0, b1));
  offer(closest_on_segment(b0, a0, a1), 0);
  offer(closest_on_segment(b1, a0, a1), 1);
  return e;
}

const ClosestKernels& closest_kernels_of(Isa isa) {
  return isa == Isa::avx512 ? avx512::closest_kernels() : isa == Isa::avx2 ? avx2::closest_kernels() : sse2::closest_kernels();
}

}  // namespace forming_sim
