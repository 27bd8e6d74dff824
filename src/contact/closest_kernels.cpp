// Closest points in lanes, compiled once per vector width (see CMakeLists.txt);
// only raw arrays and types of this width's namespace are used here.
#include "forming_sim/contact/closest_pack.h"

#include "contact/lanes.h"
#include "forming_sim/contact/inside.h"
#include "forming_sim/contact/pair_shares.h"

namespace forming_sim {
namespace FORMING_SIM_ISA {
namespace {

using Place = Vector<Pack, 3>;

template <class NodeOf> [[gnu::always_inline]] inline Place places_of(const double* places, NodeOf&& node_of) {
  Place p;
  gather_records([&](int l) { return places + 4 * static_cast<long>(node_of(l)); }, p[0], p[1], p[2]);
  return p;
}

/// Adds node k of the pairs, of weight b.
template <class NodeOf> [[gnu::always_inline]] inline void add_share(const double* shares, int k, const Pack& b, NodeOf&& node_of, PairShares<Pack>& sum) {
  Pack inverse_mass, area, of_body, held;
  gather_records([&](int l) { return shares + 4 * static_cast<long>(node_of(l)); }, inverse_mass, area, of_body, held);
  sum.add(k, b, inverse_mass, area, of_body, held);
}
inline void store(const PairShares<Pack>& sum, SharesPack& to, int at) {
  sum.w.store(to.w + at);
  sum.mean_area().store(to.area + at);
  sum.movers.store(to.movers + at);
  sum.held.store(to.held + at);
}

// at: the first of the lanes that are dealt with, as many as a Pack has.

inline void face(const double* places, const double* shares, FacePack& p, int at) {
  const auto corner = [&](int k) { return places_of(places, [&](int l) { return p.corner[at + l][k]; }); };
  const Place a = corner(0), point = places_of(places, [&](int l) { return p.point[at + l]; });
  const Place r = point - a, u = corner(1) - a, v = corner(2) - a;
  const OverFace<Pack> f = over_face<Pack>(r, u, v);
  const OnBorder<Pack> border = on_border<Pack>(r, u, v);
  f.beta.store(p.beta + at);
  f.gamma.store(p.gamma + at);
  border.side.store(p.side + at);
  border.s.store(p.s + at);
  for (int k = 0; k < 3; ++k) select(f.inside, f.apart[k], border.apart[k]).store(p.apart[k] + at);
  select(f.inside, dot(f.apart, f.apart), border.squared).store(p.squared + at);
  select(f.inside, Pack(1.0), Pack(0.0)).store(p.inside + at);
  const Pack weight[4] = {1.0, f.beta + f.gamma - Pack(1.0), -f.beta, -f.gamma};
  PairShares<Pack> sum;
  add_share(shares, 0, weight[0], [&](int l) { return p.point[at + l]; }, sum);
  for (int k = 1; k < 4; ++k) add_share(shares, k, weight[k], [&](int l) { return p.corner[at + l][k - 1]; }, sum);
  store(sum, p.shares, at);
}

inline void segment(const double* places, const double* shares, FacePack& p, int at) {
  const auto corner = [&](int k) { return places_of(places, [&](int l) { return p.corner[at + l][k]; }); };
  const Place a = corner(0), r = places_of(places, [&](int l) { return p.point[at + l]; }) - a, u = corner(1) - a;
  const OverSegment<Pack> f = over_segment<Pack>({{r[0], r[1]}}, {{u[0], u[1]}});
  f.s.store(p.beta + at);
  for (int k = 0; k < 2; ++k) f.apart[k].store(p.apart[k] + at);
  Pack(0.0).store(p.apart[2] + at);
  dot(f.apart, f.apart).store(p.squared + at);
  select(f.inside, Pack(1.0), Pack(0.0)).store(p.inside + at);
  PairShares<Pack> sum;
  add_share(shares, 0, Pack(1.0), [&](int l) { return p.point[at + l]; }, sum);
  add_share(shares, 1, f.s - Pack(1.0), [&](int l) { return p.corner[at + l][0]; }, sum);
  add_share(shares, 2, -f.s, [&](int l) { return p.corner[at + l][1]; }, sum);
  store(sum, p.shares, at);
}

/// 0 where `away` from an edge (a point on it: a; its direction: u), across it, points into the slab of the facet with
/// the third corner c: along `inward` = c - a without its part along u, |inward| = |(c - a) x u| / |u|.
inline Pack outside(const Place& a, const Place& u, const Place& c, const Place& away, Pack wedge) {
  const Place r = c - a, n = cross(r, u);
  const Pack within = dot(away, r);
  const Pack limit = wedge * wedge * dot(n, n) * dot(away, away);
  return select(within > Pack(0.0), select(within * within * dot(u, u) > limit, Pack(0.0), Pack(1.0)), Pack(1.0));
}

inline void edge(const double* places, const double* shares, double wedge, EdgePack& p, int at) {
  const auto place = [&](int k) { return places_of(places, [&](int l) { return p.node[at + l][k]; }); };
  const Place a = place(0), b = place(2), u = place(1) - a, v = place(3) - b;
  const CrossingEdges<Pack> e = crossing_edges<Pack>(a - b, u, v);
  e.s.store(p.s + at);
  e.t.store(p.t + at);
  const Pack distance = sqrt(dot(e.apart, e.apart));
  select(e.inside, distance, sqrt(end_on_edge<Pack>(a - b, u, v).squared)).store(p.distance + at);
  const Place normal = (Pack(1.0) / distance) * e.apart, back = Pack(-1.0) * e.apart;
  for (int k = 0; k < 3; ++k) normal[k].store(p.normal[k] + at);
  select(e.inside, Pack(1.0), Pack(0.0)).store(p.inside + at);
  const Pack of_first = smaller(outside(a, u, place(4), back, wedge), outside(a, u, place(5), back, wedge));
  const Pack of_second = smaller(outside(b, v, place(6), e.apart, wedge), outside(b, v, place(7), e.apart, wedge));
  smaller(of_first, of_second).store(p.outside + at);
  const Pack weight[4] = {Pack(1.0) - e.s, e.s, e.t - Pack(1.0), -e.t};
  PairShares<Pack> sum;
  for (int k = 0; k < 4; ++k) add_share(shares, k, weight[k], [&](int l) { return p.node[at + l][k]; }, sum);
  store(sum, p.shares, at);
}

void faces(const double* places, const double* shares, FacePack* packs, long count) {
  each_part(count, [&](long i, int at) { face(places, shares, packs[i], at); });
}
void segments(const double* places, const double* shares, FacePack* packs, long count) {
  each_part(count, [&](long i, int at) { segment(places, shares, packs[i], at); });
}
void edges(const double* places, const double* shares, double wedge, EdgePack* packs, long count) {
  each_part(count, [&](long i, int at) { edge(places, shares, wedge, packs[i], at); });
}

}  // namespace

const ClosestKernels& closest_kernels() {
  static const ClosestKernels k{faces, segments, edges};
  return k;
}

}  // namespace FORMING_SIM_ISA
}  // namespace forming_sim
