// Closest points in lanes, compiled once per vector width (see CMakeLists.txt);
// only raw arrays and types of this width's namespace are used here.
#include "forming_sim/contact/closest_pack.h"

#include "forming_sim/contact/inside.h"

namespace forming_sim {
namespace FORMING_SIM_ISA {
namespace {

using Place = Vector<Pack, 3>;

inline Place places_of(const double* places, const int (&node)[kLanes]) {
  Place p;
  gather_records([&](int l) { return places + 4 * static_cast<long>(node[l]); }, p[0], p[1], p[2]);
  return p;
}

inline void face(const double* places, FacePack& p) {
  const Place a = places_of(places, p.corner[0]);
  const OverFace<Pack> f = over_face<Pack>(places_of(places, p.point) - a, places_of(places, p.corner[1]) - a, places_of(places, p.corner[2]) - a);
  f.beta.store(p.beta);
  f.gamma.store(p.gamma);
  for (int k = 0; k < 3; ++k) f.apart[k].store(p.apart[k]);
  select(f.inside, Pack(1.0), Pack(0.0)).store(p.inside);
}

/// 0 where `away` from an edge (a point on it: a; its direction: u), across it, points into the slab of the facet with
/// the third corner c: along `inward` = c - a without its part along u, |inward| = |(c - a) x u| / |u|.
inline Pack outside(const Place& a, const Place& u, const Place& c, const Place& away, Pack wedge) {
  const Place r = c - a, n = cross(r, u);
  const Pack within = dot(away, r);
  const Pack limit = wedge * wedge * dot(n, n) * dot(away, away);
  return select(within > Pack(0.0), select(within * within * dot(u, u) > limit, Pack(0.0), Pack(1.0)), Pack(1.0));
}

inline void edge(const double* places, double wedge, EdgePack& p) {
  const Place a = places_of(places, p.node[0]), b = places_of(places, p.node[2]);
  const Place u = places_of(places, p.node[1]) - a, v = places_of(places, p.node[3]) - b;
  const CrossingEdges<Pack> e = crossing_edges<Pack>(a - b, u, v);
  e.s.store(p.s);
  e.t.store(p.t);
  const Pack distance = sqrt(dot(e.apart, e.apart));
  distance.store(p.distance);
  const Place normal = (Pack(1.0) / distance) * e.apart, back = Pack(-1.0) * e.apart;
  for (int k = 0; k < 3; ++k) normal[k].store(p.normal[k]);
  select(e.inside, Pack(1.0), Pack(0.0)).store(p.inside);
  Pack out = outside(a, u, places_of(places, p.opposite[0]), back, wedge);
  out = smaller(out, outside(a, u, places_of(places, p.opposite[1]), back, wedge));
  out = smaller(out, outside(b, v, places_of(places, p.opposite[2]), e.apart, wedge));
  smaller(out, outside(b, v, places_of(places, p.opposite[3]), e.apart, wedge)).store(p.outside);
}

void faces(const double* places, FacePack* packs, long count) {
  for (long i = 0; i < count; ++i) face(places, packs[i]);
}
void edges(const double* places, double wedge, EdgePack* packs, long count) {
  for (long i = 0; i < count; ++i) edge(places, wedge, packs[i]);
}

}  // namespace

const ClosestKernels& closest_kernels() {
  static const ClosestKernels k{faces, edges};
  return k;
}

}  // namespace FORMING_SIM_ISA
}  // namespace forming_sim
