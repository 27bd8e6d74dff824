#include "forming_sim/contact/closest.h"

#include "forming_sim/contact/closest_pack.h"

namespace forming_sim {

ClosestEdges closest_on_edges(const Node& a0, const Node& a1, const Node& b0, const Node& b1) {
  const Vector<double, 3> r = between(b0, a0), u = between(a0, a1), v = between(b0, b1);
  const CrossingEdges<double> crossing = crossing_edges(r, u, v);
  if (crossing.inside) {
    const Node apart(crossing.apart[0], crossing.apart[1], crossing.apart[2], 0);
    return {crossing.s, crossing.t, apart, dot3(apart, apart), true};
  }
  const EndOnEdge<double> end = end_on_edge(r, u, v);
  return {end.s, end.t, node(end.apart[0], end.apart[1], end.apart[2]), end.squared, false};
}

const ClosestKernels& closest_kernels_of(Isa isa) {
  return isa == Isa::avx512 ? avx512::closest_kernels() : isa == Isa::avx2 ? avx2::closest_kernels() : sse2::closest_kernels();
}

}  // namespace forming_sim
