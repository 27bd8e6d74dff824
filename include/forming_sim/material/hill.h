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

/// The axes of the material; items: of the memory.
template <class T, int D, bool Ring> void find_axes(const Orthotropy& material, const Edges<T, D, Ring>& e, const double* items, Vector<T, D>* a) {
  Vector<T, D> f[2];  // the fibres
  repeat<2>([&](auto k) {
    T d[D];
    for (int m = 0; m < D; ++m) load(items, k * D + m, d[m]);
    f[k] = d[0] * e.x[0] + d[1] * e.x[1];
    if constexpr (D == 3) f[k] += d[2] * e.x[2];
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
template <class T, int D> const double* axes_of(const SolidConstants& m, const double* memory) { return memory + m.layers * kLayerItems<D> * lanes_of<T>; }

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
  /// In the frame whose axes are a.
  Symmetric<T, D> tensor(const HillModes& h, const Vector<T, D>* a) const {
    Symmetric<T, D> A;
    for (int i = 0; i < 3; ++i) A[i] = T(h.normal[0][i]) * y[0] + T(h.normal[1][i]) * y[1];
    for (int k = 2; k < count; ++k) A[k + 1] = T(1 / kRoot) * y[k];
    Vector<T, D> rows[D];  // of a, so that components() turns back
    repeat<D>([&](auto i) { repeat<D>([&](auto j) { rows[i][j] = a[j][i]; }); });
    return components(A, rows);
  }

 private:
  static constexpr double kRoot = 1.41421356237309504880;
};

/// 1/(1 + t), t >= 0; of a step as short as most are without a division: (1 - t)(1 + t^2)(1 + t^4) = (1 - t^8)/(1 + t).
template <class T> T inverse_beyond_one(const T& t) {
  if (any(t > T(1.0 / 256))) return T(1) / (T(1) + t);
  const T t2 = t * t;
  return (T(1) - t) * (T(1) + t2) * (T(1) + t2 * t2);
}

/// z of every lane that yields, 0 of others. y: the trial's; k, s: as above; at: sigma_s at p, and then after the flow; dg: of it.
template <class T, int D>
T solve_return(const HillModes& h, const HardeningCurve& hardening, const InModes<T, D>& y, const T& f, const T& k, const T& s, const T& p, YieldStress<T>& at, T& dg) {
  T q2(0);
  for (int i = 0; i < y.count; ++i) q2 += T(h.p[i]) * y.y[i] * y.y[i];
  const auto yields = q2 * f * f > at.value * at.value * T(1 + 2 * kOnTheSurface);
  const T trial = select(yields, f * sqrt(q2), at.value), per_s = k / (T(2) * s);
  const YieldStress<T> start = at;
  T z(0), low(0), high = (trial / at.value - T(1)) * T(1 / h.least), q;
  for (int round = 0; round < 60; ++round) {
    T falls(0);  // -q dq/dz
    q2 = T(0);
    for (int i = 0; i < y.count; ++i) {
      const T over = inverse_beyond_one(z * T(h.p[i])), one = y.y[i] * over, part = T(h.p[i]) * one * one;
      q2 += part;
      falls += T(h.p[i]) * part * over;
    }
    q = sqrt(q2);
    if (round > 0) at = yield_stress_beyond(hardening, p, start, z * q * per_s);
    const T value = select(yields, f * q - at.value, T(0));
    if (!any(absolute(value) > T(kOnTheSurface) * trial)) break;
    low = select(value > T(0), z, low);
    high = select(value < T(0), z, high);
    const T slope = f * falls / q + at.slope * per_s * (q - z * falls / q);
    T next = z + value / select(yields, slope, T(1));
    next = select(next > high, T(0.5) * (low + high), next);
    z = select(yields, select(next < low, T(0.5) * (low + high), next), T(0));
  }
  dg = z * q / (T(2) * s);
  return z;
}

/// q_H of a deviator S as 3/2 S : A S = q_H^2, for element/hourglass_flow.h.
template <class T, int D> class HillMetric {
 public:
  static constexpr bool is_one = false;
  double most;  ///< largest S : A S over S : S

  template <bool Ring> HillMetric(const SolidConstants& m, const Edges<T, D, Ring>& e, const double* axes) : most(modes_of<D>(m).most / 1.5), h_(modes_of<D>(m)) {
    find_axes(m.orthotropy, e, axes, a_);
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

/// And what its return was.
template <class T, int D> struct HillResponse : PointResponse<T, D> {
  Symmetric<T, D> trial;  ///< S before it, Pa
  T dp = T(0);            ///< plastic strain of the step
};

/// One step of layer k, whose memory starts at `memory`; axes: of the memory; factor: stress_factor(m, J).
template <class T, int D, bool Ring>
HillResponse<T, D> hill_layer_step(const SolidConstants& solid, int layer, const T& factor, const Edges<T, D, Ring>& e, const T& J, double* memory, const double* axes, Keep keep) {
  constexpr int size = Symmetric<T, D>::size;
  const HillModes& h = modes_of<D>(solid);
  const HardeningCurve& hardening = solid.layer[layer].hardening;
  HillResponse<T, D> r;
  r.dissipation = T(0);
  Symmetric<T, D> G = load_memory<T, D>(memory);
  Trial<T> trial;
  Symmetric<T, D> deviator = find_trial(push(G, e), trial);
  repeat<size>([&](auto i) { r.trial[i] = factor * deviator[i]; });
  const auto finish = [&] {
    repeat<size>([&](auto i) { r.S[i] = factor * deviator[i]; });
    return r;
  };
  if (hardening.kind == HardeningCurve::elastic || !any(T(h.most) * trial.m * factor * factor > T(hardening.lowest * hardening.lowest))) return finish();
  T p;
  load(memory, size, p);
  r.yield = yield_stress(hardening, p);
  r.knows_yield = true;
  Vector<T, D> a[D];
  find_axes(solid.orthotropy, e, axes, a);
  const InModes<T, D> y(h, components(deviator, a));
  InModes<T, D> N;
  T q2(0);
  for (int i = 0; i < y.count; ++i) {
    N.y[i] = T(h.p[i]) * y.y[i];
    q2 += N.y[i] * y.y[i];
  }
  if (!any(q2 * factor * factor > r.yield.value * r.yield.value * T(1 + 2 * kOnTheSurface))) return finish();
  const T over = T(1) / (T(3) * trial.s * trial.s - T(0.5) * trial.m);
  const T across = contract(cofactor(deviator), N.tensor(h, a)) / larger(q2, T(1e-300));  // cof(D) : N/q
  const T k = T(3) * trial.s * (trial.s - across) * over;
  T dg;
  const T z = solve_return(h, hardening, y, factor, k, trial.s, p, r.yield, dg);
  r.dp = k * dg;
  r.kept = smaller(r.yield.value / (factor * sqrt(larger(q2, T(1e-300)))), T(1));
  InModes<T, D> change;
  for (int i = 0; i < y.count; ++i) {
    const T zp = z * T(h.p[i]);
    change.y[i] = -(zp * inverse_beyond_one(zp)) * y.y[i];
  }
  Symmetric<T, D> dB = change.tensor(h, a);
  const Symmetric<T, D> before = deviator;
  repeat<size>([&](auto i) { deviator[i] += dB[i]; });
  // m' - m = -(D' + D) : dB
  Symmetric<T, D> both;
  repeat<size>([&](auto i) { both[i] = before[i] + deviator[i]; });
  const T m = contract(deviator, deviator), d = determinant(deviator, cofactor(deviator));
  const T fixed = T(-0.5) * trial.s * contract(both, dB) + (d - trial.d), over_m = T(1) / (T(3) * trial.s * trial.s - T(0.5) * m);
  T c = fixed * over_m;
  for (int round = 0; round < 20; ++round) {
    const T next = (fixed + c * c * (T(3) * trial.s - c)) * over_m;
    const bool found = !any(absolute(next - c) > T(1e-16) * trial.s);
    c = next;
    if (found) break;
  }
  r.dissipation = factor * J * (T(1.5) * c - contract(dB, dB) / (T(4) * trial.s));
  if (keep == Keep::yes) {
    repeat<3>([&](auto i) { dB[i] -= c; });
    Symmetric<T, D> dG = components(dB, e.up);
    if constexpr (Ring) dG[2] *= e.up[2][0] * e.up[2][0];
    repeat<size>([&](auto i) { store(memory, i, G[i] + dG[i]); });
    store(memory, size, p + r.dp);
  }
  return finish();
}

/// One step of all layers of a point.
template <class T, int D, bool Ring> [[gnu::noinline]] PointResponse<T, D> hill_step(const SolidConstants& m, Edges<T, D, Ring> e, const T& J, double* memory, Keep keep) {
  const T factor = stress_factor(m, J);
  const double* axes = axes_of<T, D>(m, memory);
  PointResponse<T, D> sum;
  repeat<Symmetric<T, D>::size>([&](auto i) { sum.S[i] = T(0); });
  sum.dissipation = T(0);
  for (int k = 0; k < m.layers; ++k, memory += kLayerItems<D> * lanes_of<T>) {
    const PointResponse<T, D> r = hill_layer_step(m, k, factor, e, J, memory, axes, keep);
    const T w(m.layer[k].weight);
    repeat<Symmetric<T, D>::size>([&](auto i) { sum.S[i] += w * r.S[i]; });
    sum.dissipation += w * r.dissipation;
  }
  return sum;
}

}  // namespace forming_sim
