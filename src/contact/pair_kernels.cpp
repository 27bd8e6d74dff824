// One visit of pairs in lanes, compiled once per vector width (see CMakeLists.txt);
// only raw arrays and types of this width's namespace are used here.
#include "forming_sim/contact/pair_pack.h"

#include "contact/lanes.h"
#include "forming_sim/contact/law.h"

namespace forming_sim {
namespace FORMING_SIM_ISA {
namespace {

struct Triple {
  Pack x, y, z;
};
// at: the first of the lanes that are dealt with, as many as a Pack has.

inline Triple load3(const double (*from)[kLanes], int at) { return {Pack::load(from[0] + at), Pack::load(from[1] + at), Pack::load(from[2] + at)}; }
inline void store3(const Triple& a, double (*to)[kLanes], int at) {
  a.x.store(to[0] + at);
  a.y.store(to[1] + at);
  a.z.store(to[2] + at);
}
inline Triple operator*(Pack s, const Triple& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Triple operator+(const Triple& a, const Triple& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Triple operator-(const Triple& a, const Triple& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Triple choose(Mask where, const Triple& a, const Triple& b) { return {select(where, a.x, b.x), select(where, a.y, b.y), select(where, a.z, b.z)}; }
inline Triple only(Mask where, const Triple& a) { return {select(where, a.x, Pack(0.0)), select(where, a.y, Pack(0.0)), select(where, a.z, Pack(0.0))}; }
inline Pack dot(const Triple& a, const Triple& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// u = sum_k b_k v_k; factor: b_k / m_k.
inline Triple relative(const Movers& movers, const PairPack& p, int at, Pack (&factor)[4]) {
  Triple u{Pack(0.0), Pack(0.0), Pack(0.0)};
  for (int k = 0; k < p.nodes; ++k) {
    Triple v;
    Pack inverse_mass;
    gather_records([&](int l) { return movers.v + 4 * static_cast<long>(p.node[k][at + l]); }, v.x, v.y, v.z, inverse_mass);
    const Pack b = Pack::load(p.weight[k] + at);
    u = u + b * v;
    factor[k] = b * inverse_mass;
  }
  return u;
}

/// v_k += b_k / m_k P_k j.
inline void push(const Movers& movers, const PairPack& p, int at, const Pack (&factor)[4], const Triple& j) {
  Quad impulse[kWidth];
  to_records(j.x, j.y, j.z, impulse);
  alignas(Lanes) double share[kWidth];
  for (int k = 0; k < p.nodes; ++k) {
    factor[k].store(share);
    for (int l = 0; l < kWidth; ++l) {
      if (share[l] == 0) continue;
      const int n = p.node[k][at + l];
      Quad along = impulse[l];
      if (p.held)
        if (const double* P = movers.projector[n])
          along = Quad{P[0] * along[0] + P[1] * along[1] + P[2] * along[2], P[3] * along[0] + P[4] * along[1] + P[5] * along[2],
                       P[6] * along[0] + P[7] * along[1] + P[8] * along[2], 0};
      *reinterpret_cast<Quad*>(movers.v + 4 * static_cast<long>(n)) += share[l] * along;
    }
  }
}

/// The impulse j of the pair becomes the one that goes with its end-of-step gap, all others held; its friction
/// likewise, then the nearest within the Coulomb cone.
inline Pack visit(double dt, const Movers& movers, PairPack& p, RubPack* rub, int at) {
  Pack factor[4];
  const Triple u = relative(movers, p, at, factor), normal = load3(p.normal, at);
  const Pack before = Pack::load(p.impulse + at), layer = Pack::load(p.layer + at), w = Pack::load(p.w + at), zero(0.0);
  const Pack vn = dot(normal, u);
  const Pack now = Pack::load(p.gap + at) + Pack(dt) * vn;  // the end gap as things stand
  const Pack g = now - Pack(dt) * w * before;          // without this pair
  const Mask movable = w > zero;
  if (!any(movable & ((g < layer) | (absolute(before) > zero)))) return zero;
  Pack h;
  const Pack j = select(movable, end_impulse(g, layer, Pack::load(p.stiffness + at), w, dt, h), zero);
  Pack change = select(movable, absolute(h - now), zero);
  j.store(p.impulse + at);
  Triple impulse = (j - before) * normal;
  if (rub) {
    // Along the surface friction q and what takes waves away, e: u = u0 + w (q + e), e = -beta (u - u_s).
    const Triple had_q = load3(rub->slip, at), had_e = load3(rub->radiated, at), slip = u - vn * normal, steady = load3(rub->steady, at);
    const Pack rub_w = Pack::load(rub->w + at);
    const Pack most = select(j > zero, smaller(Pack::load(rub->friction + at) * (Pack::load(rub->own + at) * j + Pack::load(rub->before + at)), Pack::load(rub->most + at)), zero);
    const Pack beta = select(j > zero, Pack::load(rub->beta + at), zero);
    const Triple free = slip - rub_w * (had_q + had_e) + (beta * rub_w) * steady;  // (1 + beta w) u without friction
    Triple q = Pack(-1.0) / rub_w * free;
    const Pack size = sqrt(dot(q, q));
    q = only(movable, select(size > most, most / size, Pack(1.0)) * q);
    const Triple end = Pack(1.0) / (Pack(1.0) + beta * rub_w) * (free + rub_w * q);
    Triple e = only(movable, beta * (steady - end));
    // What waves bring back pushes the slip on by no more than friction holds it: both together never do work on the body.
    const Pack radiated = sqrt(dot(e, e));
    const Mask feeds = (dot(e, end) > zero) & (radiated > most);
    if (any(feeds)) {
      e = choose(feeds, most / radiated * e, e);
      const Triple rest = slip - rub_w * (had_q + had_e) + rub_w * e;
      const Triple stick = Pack(-1.0) / rub_w * rest;
      const Pack of_stick = sqrt(dot(stick, stick));
      q = choose(feeds, only(movable, select(of_stick > most, most / of_stick, Pack(1.0)) * stick), q);
    }
    store3(q, rub->slip, at);
    store3(e, rub->radiated, at);
    const Triple more = (q - had_q) + (e - had_e);
    impulse = impulse + more;
    change = larger(change, sqrt(dot(more, more)) * rub_w * Pack(dt));
  }
  push(movers, p, at, factor, impulse);
  return change;
}

void start(const Movers& movers, const PairPack* packs, const RubPack* rubs, long count) {
  each_part(count, [&](long i, int at) {
    const PairPack& p = packs[i];
    Pack factor[4];
    for (int k = 0; k < p.nodes; ++k)
      factor[k] = Pack::load(p.weight[k] + at) * Pack(lanes_from([&](int l) { return movers.v[4 * static_cast<long>(p.node[k][at + l]) + 3]; }));
    Triple impulse = Pack::load(p.impulse + at) * load3(p.normal, at);
    if (rubs) impulse = impulse + load3(rubs[i].slip, at);
    push(movers, p, at, factor, impulse);
  });
}

double sweep(double dt, const Movers& movers, PairPack* packs, RubPack* rubs, long count) {
  Pack change(0.0);
  if (rubs) each_part(count, [&](long i, int at) { change = larger(change, visit(dt, movers, packs[i], rubs + i, at)); });
  else each_part(count, [&](long i, int at) { change = larger(change, visit(dt, movers, packs[i], nullptr, at)); });
  double most = 0;
  for (int l = 0; l < kWidth; ++l)
    if (!(change[l] <= most)) most = change[l];
  return most;
}

bool end_gaps(double dt, const Movers& movers, PairPack* packs, long count) {
  const Pack zero(0.0);
  Pack open(1.0);
  each_part(count, [&](long i, int at) {
    PairPack& p = packs[i];
    Pack factor[4];
    const Pack h = Pack::load(p.gap + at) + Pack(dt) * dot(load3(p.normal, at), relative(movers, p, at, factor));
    h.store(p.end_gap + at);
    open = select(h > zero, open, select(Pack::load(p.w + at) > zero, zero, open));
  });
  return !any(open < Pack(1.0));
}

}  // namespace

const PairKernels& pair_kernels() {
  static const PairKernels k{start, sweep, end_gaps};
  return k;
}

}  // namespace FORMING_SIM_ISA
}  // namespace forming_sim
