#pragma once
// Hill's anisotropic yield (material/orthotropy.h) for the law of material/von_mises.h, at one point.
//
// The stress is that of the isotropic law, S = f B_D, f = mu J^(-5/3); only its yield and flow know directions. In modes,
// where S = sum_i f y_i, q_H = f q, q^2 = sum_i p_i y_i^2, the plastic stretching D_p = dg N, N = dq_H/dS = sum_i p_i y_i/q, takes
//
//   B_D <- B_D' - 2 s dg N:    y_i = y_i'/(1 + z p_i),  z = 2 s dg/q,
//   yield: f q(z) = sigma_s(p + k dg),                  q(z)^2 = sum_i p_i (y_i'/(1 + z p_i))^2,
//
// B' = s I + D the trial state. Left of the root q falls towards it with a slope that flattens, so that Newton's iteration from
// z = 0 comes to it from one side; a bracket is kept for curves with corners.
//
// Flow changes no volume: det B stays, s^3 - s m/2 + d = det B with m = D : D, d = det D. So s falls by
//
//   c = [s'(m' - m)/2 + d - d' + 3 s' c^2 - c^3] / (3 s'^2 - m/2),
//
// and with it the stored energy, by 3/2 f J c per initial volume, of which the stress that is left, which is the one that moves the nodes,
// does all but what is of second order in the change, f J (D - D') : (D - D')/(4 s): that is dissipated. To first order it is
// J q_H k dg, which is what the plastic strain p counts, with k = 3 s'(s' - cof(D) : N/q)/(3 s'^2 - m/2), nearly 1.
//
// Axes: material/orthotropy.h. Memory: that of material/von_mises.h, and behind all layers d^m of the two fibres, which nothing changes.
#include "forming_sim/material/edge_pull.h"
#include "forming_sim/material/von_mises.h"

namespace forming_sim {

/// v_m . A . v_k, with the third direction of a section by itself.
template <class T, int D> Symmetric<T, D> components(const Symmetric<T, D>& A, const Vector<T, D>* v) {
  Symmetric<T, D> r;
  const Vector<T, D> w0 = A * v[0], w1 = A * v[1];
  r[0] = dot(v[0], w0);
  r[1] = dot(v[1], w1);
  r[3] = dot(v[1], w0);
  if constexpr (D == 2) {
    r[2] = A[2];
  } else {
    const Vector<T, D> w2 = A * v[2];
    r[2] = dot(v[2], w2);
    r[4] = dot(v[2], w1);
    r[5] = dot(v[2], w0);
  }
  return r;
}

template <class T> Vector<T, 2> unit(const Vector<T, 2>& a) { return (T(1) / sqrt(dot(a, a))) * a; }
template <class T> Vector<T, 3> unit(const Vector<T, 3>& a) { return (T(1) / sqrt(dot(a, a))) * a; }

/// The axes of the material; x: the edges; items: of the memory.
template <class T, int D> void find_axes(const Orthotropy& material, const Vector<T, D>* x, const double* items, Vector<T, D>* a) {
  Vector<T, D> f[2];  // the fibres
  repeat<2>([&](auto k) {
    T d[D];
    for (int m = 0; m < D; ++m) load(items, k * D + m, d[m]);
    f[k] = d[0] * x[0] + d[1] * x[1];
    if constexpr (D == 3) f[k] += d[2] * x[2];
  });
  if constexpr (D == 2) {  // the second turned back by a quarter lies on the other side of the first axis
    const T w(material.second_fibre);
    a[0] = unit(Vector<T, 2>{{f[0][0] + w * f[1][1], f[0][1] - w * f[1][0]}});
    a[1] = {{-a[0][1], a[0][0]}};
  } else {
    a[2] = unit(cross(f[0], f[1]));
    a[0] = unit(f[0] + cross(f[1], a[2]));
    a[1] = cross(a[2], a[0]);
  }
}

/// The memory of the axes, of a point whose memory starts at `memory`.
template <class T, int D> const double* axes_of(const SolidConstants& m, const double* memory) { return memory + m.layers * kLayerItems<D> * stride_of<T>; }

template <int D> const HillModes& modes_of(const SolidConstants& m) { return D == 2 ? m.orthotropy.plane : m.orthotropy.space; }

/// Components along the unit tensors of a deviator given in the frame of the axes, and back.
template <class T, int D> struct InModes {
  static constexpr int count = D == 2 ? 3 : 5;
  T y[count];

  InModes() = default;
  InModes(const HillModes& h, const Symmetric<T, D>& A) {
    for (int k = 0; k < 2; ++k) y[k] = T(h.normal[k][0]) * A[0] + T(h.normal[k][1]) * A[1] + T(h.normal[k][2]) * A[2];
    for (int k = 2; k < count; ++k) y[k] = T(kRoot) * A[k + 1];
  }
  /// In the frame of the axes.
  Symmetric<T, D> tensor(const HillModes& h) const {
    Symmetric<T, D> A;
    for (int i = 0; i < 3; ++i) A[i] = T(h.normal[0][i]) * y[0] + T(h.normal[1][i]) * y[1];
    for (int k = 2; k < count; ++k) A[k + 1] = T(1 / kRoot) * y[k];
    return A;
  }
  /// In the frame in which the axes are a.
  Symmetric<T, D> tensor(const HillModes& h, const Vector<T, D>* a) const {
    Vector<T, D> rows[D];  // of a, so that components() turns back
    repeat<D>([&](auto i) { repeat<D>([&](auto j) { rows[i][j] = a[j][i]; }); });
    return components(tensor(h), rows);
  }

 private:
  static constexpr double kRoot = 1.41421356237309504880;
};

/// 1/(1 + z p_i) of every i; of a step as short as most are without a division: (1 - t)(1 + t^2)(1 + t^4) = (1 - t^8)/(1 + t), t = z p_i.
template <class T, int D> void find_kept_shares(const HillModes& h, const T& z, T* kept) {
  const bool is_short = !any(z * T(h.most) > T(1.0 / 256));
  for (int i = 0; i < InModes<T, D>::count; ++i) {
    const T t = z * T(h.p[i]), t2 = t * t;
    kept[i] = is_short ? (T(1) - t) * (T(1) + t2) * (T(1) + t2 * t2) : T(1) / (T(1) + t);
  }
}

/// What is asked of the trial state of a point that flows, and then how it does.
template <class T, int D> struct HillFlow {
  Vector<T, D> a[D];  ///< axes of the material
  InModes<T, D> y;    ///< D
  T q2, falls;        ///< sum_i p_i y_i^2, sum_i p_i^2 y_i^2
  T k, p;             ///< as above; plastic strain before the step
  T z, dg;            ///< z of every lane that yields, 0 of others
};

/// q2 and falls after the return by z.
template <class T, int D> void find_squares(const HillModes& h, const T& z, const InModes<T, D>& y, T& q2, T& falls) {
  T kept[InModes<T, D>::count];
  find_kept_shares<T, D>(h, z, kept);
  q2 = falls = T(0);
  for (int i = 0; i < InModes<T, D>::count; ++i) {
    const T one = y.y[i] * kept[i], part = T(h.p[i]) * one * one;
    q2 += part;
    falls += T(h.p[i]) * part * kept[i];
  }
}

/// As below where the rate raises the yield stress: f q(z) = sigma_s(p + dp) R(dp/dt), dp = k z q(z)/(2s), by Newton's iteration in ln z
/// as in material/rate_flow.h, from the least z of which it is known that it is too large.
template <class T, int D> [[gnu::noinline, gnu::flatten]] void solve_return_at_rate(const HillModes& h, const HardeningCurve& hardening, const T& f, const T& s, YieldStress<T>& at, HillFlow<T, D>& flow) {
  const auto yields = flow.q2 * f * f > at.value * at.value * T(1 + 2 * kOnTheSurface);
  const T trial = select(yields, f * sqrt(larger(flow.q2, T(1e-300))), at.value), per = select(yields, flow.k / (T(2) * s), T(1));
  const YieldStress<T> start = at;
  LogSearch<T> search{T(kFarBelow), log_of_share((trial / at.value - T(1)) * T(1 / h.least))};
  T q2, falls;
  find_squares(h, exp(search.high), flow.y, q2, falls);
  T q = sqrt(larger(q2, T(1e-300))), w = smaller(search.high, log_strain_of(hardening.rate, trial / at.value) - log_of_share(per * q)), z;
  for (int round = 0; round < 100; ++round) {
    z = exp(w);
    find_squares(h, z, flow.y, q2, falls);
    q2 = larger(q2, T(1e-300));
    q = sqrt(q2);
    const T dp = per * z * q;
    const YieldStress<T> there = yield_stress_beyond(hardening, flow.p, start, select(yields, dp, T(0)));
    const RateFactor<T> R = rate_factor(hardening.rate, w + log_of_share(per * q));
    at = {R.value * there.value, R.value * there.slope, T(0)};
    const T value = f * q - at.value;
    const auto off = yields & (absolute(value) > T(kOnTheSurface) * trial);
    if (!any(off)) break;
    const T slope = z * f * falls / q + (at.slope * dp + there.value * R.slope) * (T(1) - z * falls / q2);
    w = select(off, search.next(w, value, select(yields, slope, T(1))), w);
  }
  at.value = select(yields, at.value, start.value);
  at.slope = select(yields, at.slope, start.slope);
  flow.z = select(yields, z, T(0));
  flow.dg = flow.z * q / (T(2) * s);
}

/// Solves f q(z) = sigma_s(p + k dg) for z. f, s: as above; at: sigma_s at p, and then after the flow.
/// Newton's iteration of 1/(f q) - 1/sigma_s, which were all p_i one, as without anisotropy, would be linear in z.
template <class T, int D> void solve_return(const HillModes& h, const HardeningCurve& hardening, const T& f, const T& s, YieldStress<T>& at, HillFlow<T, D>& flow) {
  T q2 = flow.q2, q = sqrt(q2), falls = flow.falls;  // -q dq/dz
  if (hardening.rate.kind != RateLaw::none) return solve_return_at_rate(h, hardening, f, s, at, flow);
  const auto yields = q2 * f * f > at.value * at.value * T(1 + 2 * kOnTheSurface);
  const T trial = select(yields, f * q, at.value), per_s = flow.k / (T(2) * s), f_per_s = f * per_s;
  const YieldStress<T> start = at;
  T z(0), low(0), high = (trial / at.value - T(1)) * T(1 / h.least);
  for (int round = 0; round < 60; ++round) {
    const T value = select(yields, f * q - at.value, T(0));
    if (!any(absolute(value) > T(kOnTheSurface) * trial)) break;
    low = select(value > T(0), z, low);
    high = select(value < T(0), z, high);
    const T slope = at.value * at.value * falls + q2 * f_per_s * at.slope * (q2 - z * falls);
    T next = z + value * q2 * at.value / select(yields, slope, T(1));
    next = select(next > high, T(0.5) * (low + high), next);
    z = select(yields, select(next < low, T(0.5) * (low + high), next), T(0));
    find_squares(h, z, flow.y, q2, falls);
    q = sqrt(q2);
    at = yield_stress_beyond(hardening, flow.p, start, z * q * per_s);
  }
  flow.z = z;
  flow.dg = z * q / (T(2) * s);
}

/// q_H of a deviator S as 3/2 S : A S = q_H^2, for element/hourglass_flow.h.
template <class T, int D> class HillMetric {
 public:
  static constexpr bool is_one = false;
  double most;  ///< largest S : A S over S : S

  template <bool Ring> HillMetric(const SolidConstants& m, const Edges<T, D, Ring>& e, const double* axes) : most(modes_of<D>(m).most / 1.5), h_(modes_of<D>(m)) {
    find_axes(m.orthotropy, e.x, axes, a_);
  }
  Symmetric<T, D> operator()(const Symmetric<T, D>& S) const {
    InModes<T, D> y(h_, components(S, a_));
    for (int i = 0; i < y.count; ++i) y.y[i] *= T(h_.p[i] / 1.5);
    return y.tensor(h_, a_);
  }

 private:
  const HillModes& h_;
  Vector<T, D> a_[D];
};

/// A point in a step.
template <class T, int D, bool Ring> struct HillPoint {
  Vector<T, D> x[kEdges<D, Ring>];  ///< edges
  T J, factor;                      ///< stress_factor(m, J)
  double* memory;                   ///< where that of the point starts

  Edges<T, D, Ring> edges() const {
    Edges<T, D, Ring> e;
    repeat<kEdges<D, Ring>>([&](auto m) { e.x[m] = x[m]; });
    return e;
  }
};
/// e: its edges.
template <class T, int D, bool Ring> HillPoint<T, D, Ring> hill_point(const SolidConstants& m, const Edges<T, D, Ring>& e, const T& J, double* memory) {
  HillPoint<T, D, Ring> point;
  repeat<kEdges<D, Ring>>([&](auto k) { point.x[k] = e.x[k]; });
  point.J = J;
  point.factor = stress_factor(m, J);
  point.memory = memory;
  return point;
}

/// What a layer answers, and what its return was.
template <class T, int D> struct HillResponse : PointResponse<T, D> {
  bool flowed;            ///< any of its lanes has; else there is no
  Symmetric<T, D> trial;  ///< S before it, Pa
};

/// One step of layer k of n points, at most N, in passes as in material/von_mises_points.h.
template <int N, class T, int D, bool Ring>
[[gnu::noinline, gnu::flatten]] void hill_layer_step(const SolidConstants& solid, int layer, int n, const HillPoint<T, D, Ring>* points, Keep keep, HillResponse<T, D>* responses) {
  constexpr int size = Symmetric<T, D>::size;
  const HillModes& h = modes_of<D>(solid);
  const HardeningCurve& hardening = solid.layer[layer].hardening;
  const auto memory_of = [&](int i) { return points[i].memory + layer * kLayerItems<D> * stride_of<T>; };
  Symmetric<T, D> deviator[N];
  Trial<T> trial[N];
  HillFlow<T, D> flow[N];
  bool flows[N] = {};
  for (int i = 0; i < n; ++i) {
    const HillPoint<T, D, Ring>& at = points[i];
    HillResponse<T, D>& r = responses[i];
    r.dissipation = r.dp = T(0);
    r.kept = T(1);
    r.knows_yield = false;
    deviator[i] = find_trial(push(load_memory<T, D>(memory_of(i)), at.edges()), trial[i]);
    if (hardening.kind == HardeningCurve::elastic || !any(T(h.most) * trial[i].m * at.factor * at.factor > T(hardening.lowest * hardening.lowest))) continue;
    HillFlow<T, D>& its = flow[i];
    load(memory_of(i), size, its.p);
    r.yield = yield_stress(hardening, its.p);
    r.knows_yield = true;
    find_axes(solid.orthotropy, at.x, axes_of<T, D>(solid, at.memory), its.a);
    const Symmetric<T, D> own = components(deviator[i], its.a);
    its.y = InModes<T, D>(h, own);
    InModes<T, D> qN;
    its.q2 = its.falls = T(0);
    for (int c = 0; c < its.y.count; ++c) {
      qN.y[c] = T(h.p[c]) * its.y.y[c];
      its.q2 += qN.y[c] * its.y.y[c];
      its.falls += qN.y[c] * qN.y[c];
    }
    flows[i] = any(its.q2 * at.factor * at.factor > r.yield.value * r.yield.value * T(1 + 2 * kOnTheSurface));
    if (!flows[i]) continue;
    const T s = trial[i].s, q2 = larger(its.q2, T(1e-300));
    const T over = T(1) / (q2 * (T(3) * s * s - T(0.5) * trial[i].m));
    its.k = T(3) * s * (q2 * s - contract(cofactor(own), qN.tensor(h))) * over;  // cof(D) : N/q = cof(D) : qN/q^2
  }
  for (int i = 0; i < n; ++i)
    if (flows[i]) solve_return(h, hardening, points[i].factor, trial[i].s, responses[i].yield, flow[i]);
  for (int i = 0; i < n; ++i) {
    if (!flows[i]) continue;
    const HillPoint<T, D, Ring>& at = points[i];
    HillResponse<T, D>& r = responses[i];
    HillFlow<T, D>& its = flow[i];
    const T s = trial[i].s;
    repeat<size>([&](auto c) { r.trial[c] = at.factor * deviator[i][c]; });
    r.dp = its.k * its.dg;
    r.kept = smaller(r.yield.value / (at.factor * sqrt(larger(its.q2, T(1e-300)))), T(1));
    T kept[InModes<T, D>::count];
    find_kept_shares<T, D>(h, its.z, kept);
    for (int c = 0; c < its.y.count; ++c) its.y.y[c] *= -(its.z * T(h.p[c]) * kept[c]);
    Symmetric<T, D> dB = its.y.tensor(h, its.a), both = deviator[i];
    repeat<size>([&](auto c) {
      deviator[i][c] += dB[c];
      both[c] += deviator[i][c];
    });
    // m' - m = -(D' + D) : dB
    const T m = contract(deviator[i], deviator[i]), d = determinant(deviator[i], cofactor(deviator[i]));
    const T fixed = T(-0.5) * s * contract(both, dB) + (d - trial[i].d), over_m = T(1) / (T(3) * s * s - T(0.5) * m);
    T fall = fixed * over_m;  // c
    for (int round = 0; round < 20; ++round) {
      const T next = (fixed + fall * fall * (T(3) * s - fall)) * over_m;
      const bool found = !any(absolute(next - fall) > T(1e-16) * s);
      fall = next;
      if (found) break;
    }
    r.dissipation = at.factor * at.J * (T(1.5) * fall - contract(dB, dB) / (T(4) * s));
    if (keep == Keep::no) continue;
    repeat<3>([&](auto c) { dB[c] -= fall; });
    Edges<T, D, Ring> e = at.edges();
    find_reciprocal(e);
    Symmetric<T, D> dG = components(dB, e.up);
    if constexpr (Ring) dG[2] *= e.up[2][0] * e.up[2][0];
    const Symmetric<T, D> G = load_memory<T, D>(memory_of(i));
    repeat<size>([&](auto c) { store(memory_of(i), c, G[c] + dG[c]); });
    store(memory_of(i), size, its.p + r.dp);
  }
  for (int i = 0; i < n; ++i) {
    responses[i].flowed = flows[i];
    repeat<size>([&](auto c) { responses[i].S[c] = points[i].factor * deviator[i][c]; });
  }
}

/// One step of all layers of n points, at most N.
template <int N, class T, int D, bool Ring>
void hill_steps(const SolidConstants& m, int n, const HillPoint<T, D, Ring>* points, Keep keep, PointResponse<T, D>* sums) {
  HillResponse<T, D> layer[N];
  int k = 0;
  do {
    hill_layer_step<N>(m, k, n, points, keep, layer);
    const T w(m.layer[k].weight);
    for (int i = 0; i < n; ++i) {
      const auto add = [&](T& sum, const T& part) { sum = k == 0 ? w * part : sum + w * part; };
      repeat<Symmetric<T, D>::size>([&](auto c) { add(sums[i].S[c], layer[i].S[c]); });
      add(sums[i].dissipation, layer[i].dissipation);
    }
  } while (++k < m.layers);
}
/// Of one point.
template <class T, int D, bool Ring> PointResponse<T, D> hill_step(const SolidConstants& m, const Edges<T, D, Ring>& e, const T& J, double* memory, Keep keep) {
  const HillPoint<T, D, Ring> point = hill_point(m, e, J, memory);
  PointResponse<T, D> response;
  hill_steps<1>(m, 1, &point, keep, &response);
  return response;
}

/// A step of points that come in bundles, as in material/von_mises_points.h.
template <int N, int M, class T, int D, bool Ring, class Bundle> [[gnu::always_inline]] inline void hill_points(const SolidConstants& m, Bundle* bundles, int count) {
  HillPoint<T, D, Ring> points[N * M];
  PointResponse<T, D> responses[N * M];
  for (int b = 0; b < count; ++b) {
    bundles[b].open();
    for (int s = 0; s < N; ++s) {
      Edges<T, D, Ring> e;
      bundles[b].edges(s, e);
      points[b * N + s] = hill_point(m, e, bundles[b].ratio(s, e), bundles[b].memory(s));
    }
  }
  hill_steps<N * M>(m, count * N, points, Keep::yes, responses);
  for (int b = 0; b < count; ++b) {
    auto&& sum = bundles[b].start_forces();
    for (int s = 0; s < N; ++s) {
      Edges<T, D, Ring> e = points[b * N + s].edges();
      find_normals(e);
      bundles[b].dissipate(s, responses[b * N + s].dissipation);
      bundles[b].respond(s, e, pull_of<D, Ring>(responses[b * N + s].S), sum);
    }
    bundles[b].close(sum);
  }
}

}  // namespace forming_sim
