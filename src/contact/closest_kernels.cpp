// Closest points in lanes, compiled once per vector width (see CMakeLists.txt);
// only raw arrays and types of this width's namespace are used here.
#include "forming_sim/contact/closest_pack.h"

#include "forming_sim/contact/inside.h"

namespace forming_sim {
namespace FORMING_SIM_ISA {
namespace {

using Place = Vector<Pack, 3>;

template <class NodeOf> [[gnu::always_inline]] inline Place places_of(const double* places, NodeOf&& node_of) {
  const double* from[kLanes];
  for (int l = 0; l < kLanes; ++l) from[l] = places + 4 * static_cast<long>(node_of(l));
  Place p;
  gather_records(from, p[0], p[1], p[2]);
  return p;
}

inline void face(const double* places, FacePack& p) {
  const auto corner = [&](int k) { return places_of(places, [&](int l) { return p.corner[l][k]; }); };
  const Place a = corner(0), point = places_of(places, [&](int l) { return p.point[l]; });
  const OverFace<Pack> f = over_face<Pack>(point - a, corner(1) - a, corner(2) - a);
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
  const auto place = [&](int k) { return places_of(places, [&](int l) { return p.node[l][k]; }); };
  const Place a = place(0), b = place(2), u = place(1) - a, v = place(3) - b;
  const CrossingEdges<Pack> e = crossing_edges<Pack>(a - b, u, v);
  e.s.store(p.s);
  e.t.store(p.t);
  const Pack distance = sqrt(dot(e.apart, e.apart));
  distance.store(p.distance);
  const Place normal = (Pack(1.0) / distance) * e.apart, back = Pack(-1.0) * e.apart;
  for (int k = 0; k < 3; ++k) normal[k].store(p.normal[k]);
  select(e.inside, Pack(1.0), Pack(0.0)).store(p.inside);
  const Pack of_first = smaller(outside(a, u, place(4), back, wedge), outside(a, u, place(5), back, wedge));
  const Pack of_second = smaller(outside(b, v, place(6), e.apart, wedge), outside(b, v, place(7), e.apart, wedge));
  smaller(of_first, of_second).store(p.outside);
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
