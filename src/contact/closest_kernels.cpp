// Closest points in lanes, compiled once per vector width (see CMakeLists.txt);
// only raw arrays and types of this width's namespace are used here.
#include "forming_sim/contact/closest_pack.h"

#include "forming_sim/contact/closest_formula.h"

namespace forming_sim {
namespace FORMING_SIM_ISA {
namespace {

using Points = Triple<Pack>;

Points gather(const double* x, const int (&node)[kLanes]) {
  const double* from[kLanes];
  for (int l = 0; l < kLanes; ++l) from[l] = x + 4 * static_cast<long>(node[l]);
  Points p;
  gather_records(from, p.x, p.y, p.z);
  return p;
}

void store3(const Points& p, double (&to)[3][kLanes]) {
  p.x.store(to[0]);
  p.y.store(to[1]);
  p.z.store(to[2]);
}

void facets(const double* x, int corners, const int (*node)[kLanes], FacetLanes& found) {
  const Points p = gather(x, node[0]), a = gather(x, node[1]), b = gather(x, node[2]);
  const ClosestOfFacet<Pack> c = corners == 2 ? closest_of_segment_facet(p, a, b) : closest_of_triangle(p, a, b, gather(x, node[3]));
  c.feature.store(found.feature);
  c.which.store(found.which);
  for (int k = 0; k < 3; ++k) c.weight[k].store(found.weight[k]);
  store3(c.apart, found.apart);
  sqrt(c.squared).store(found.distance);
}

// 1 where `away` from the edge ab, across it, points out of the slab of the facet at the edge with the third corner
// `opposite`, -1: none; else 0. `inward`, across the edge too, has the length |r x u| / |u|.
Pack outside(const double* x, double wedge, const Points& a, const Points& b, const int (&opposite)[kLanes], const Points& away) {
  int corner[kLanes];
  alignas(64) double is_there[kLanes];
  for (int l = 0; l < kLanes; ++l) {
    is_there[l] = opposite[l] >= 0;
    corner[l] = opposite[l] >= 0 ? opposite[l] : 0;
  }
  const Pack zero(0.0), one(1.0);
  const Points r = gather(x, corner) - a, u = b - a, n = cross(r, u);
  const Pack within = dot(away, r);
  const Mask inside = (Pack::load(is_there) > zero) & (within > zero) & (within * within * dot(u, u) > Pack(wedge * wedge) * dot(n, n));
  return select(inside, zero, one);
}

void edges(const double* x, double wedge, const int (*node)[kLanes], EdgeLanes& found) {
  const Points a0 = gather(x, node[0]), a1 = gather(x, node[1]), b0 = gather(x, node[2]), b1 = gather(x, node[3]);
  const ClosestOfEdges<Pack> c = closest_of_edges(a0, a1, b0, b1);
  const Pack distance = sqrt(c.squared), one(1.0);
  c.s.store(found.s);
  c.t.store(found.t);
  store3(c.apart, found.apart);
  distance.store(found.distance);
  c.crossing.store(found.crossing);
  const Points normal = one / select(distance > Pack(0.0), distance, one) * c.apart, back = Pack(-1.0) * normal;
  (outside(x, wedge, a0, a1, node[4], back) * outside(x, wedge, a0, a1, node[5], back) * outside(x, wedge, b0, b1, node[6], normal) *
   outside(x, wedge, b0, b1, node[7], normal)).store(found.nearest);
}

}  // namespace

const ClosestKernels& closest_kernels() {
  static const ClosestKernels k{facets, edges};
  return k;
}

}  // namespace FORMING_SIM_ISA
}  // namespace forming_sim
