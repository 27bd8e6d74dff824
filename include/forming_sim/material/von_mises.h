#pragma once
// The law of the package at one point: memory tensor, von Mises yield, isotropic
// hardening, in one layer or several. Written once for a double and for a Pack.
//
//   S = sum_i w_i S_i (3.68),  S_i = mu J^(-5/3) B_iD   (own law; (3.5) S = mu B_D as `paper`)
//   B_i = x_m x_k G_i^mk (3.69): every layer has a memory of its own
//   yield (3.70): q_S = mu J^(-5/3) q_B <= sigma_s(p),  q_B = sqrt(3/2 B_D : B_D); sigma_s(p) R where its rate raises it (material/rate.h)
//   correction (3.54): G <- a G + (1-a) G^x, so that B = a B' + (1-a) I (3.55)
//
// With (1-a) the plastic stretching of the correction is exactly
// D_p = -(1-a)/2 dev(B^-1) (ERRATA to 3.62), hence
//   d p = sqrt(2/3 D_p : D_p) = (1-a)/3 q(B^-1),
// and a is solved for together with the hardening (ERRATA to 3.63):
//   a q_S' = sigma_s(p + (1-a) k),  k = q(B'^-1)/3.
// What is asked of B'^-1 follows from B' = s I + D, D its deviator, m = D : D, d = det D, by Cayley and Hamilton:
//   det B' = s^3 - s m/2 + d,
//   q(B'^-1) det B' = sqrt(3/2 (s^2 m - 6 s d + m^2/6)),
//   D : dev(B'^-1) det B' = 3 d - s m.
//
// Memory of a point: G^X and p of every layer, one layer after the other.
#include "forming_sim/material/constants.h"
#include "forming_sim/material/rate_flow.h"
#include "forming_sim/tensor/tensor.h"

namespace forming_sim {

/// What a law answers for one step of a point.
template <class T, int D> struct PointResponse {
  Symmetric<T, D> S;  ///< Cauchy stress beside the pressure, Pa
  T dissipation;      ///< plastic work of the step per initial volume, J/m3
  T kept = T(1);      ///< of a single layer: S over that of the trial, 1: elastic
  bool knows_yield = false;  ///< of a single layer: whether the law asked for `yield`
  YieldStress<T> yield;      ///< at its p after the step, raised by its rate
  T dp;                      ///< of a single layer: plastic strain of the step
};

/// Numbers of memory of one layer: G^X and p.
template <int D> constexpr int kLayerItems = Symmetric<double, D>::size + 1;

/// Whether a law stores what a step did to its memory.
enum class Keep { yes, no };

/// u = 1 - a of (1-u) q = sigma_s(p + u k), where the parabola at u = 0 has its root to second order; at: sigma_s at p.
template <class T> T first_correction(const T& q, const T& k, const YieldStress<T>& at) {
  const T over_slope = T(1) / (q + k * at.slope), first = (q - at.value) * over_slope;
  return smaller(first * (T(1) - T(0.5) * k * k * at.bend * first * over_slope), T(1));
}

/// Where the rate raises it, (1-u) q = sigma_s(p + u k) R(u k/dt); u: about its value without a rate; at: as below, times R.
template <class T> [[gnu::noinline, gnu::flatten]] T correction_at_rate(const HardeningCurve& h, const T& q, const T& p, const T& k, const T& u, YieldStress<T>& at) {
  const YieldStress<T> start = at;
  const T safe_k = larger(k, T(1e-300));
  const T w = log_of_flow(h.rate, q, q / safe_k, u * k, start, [&](const T& dp) { return yield_stress_beyond(h, p, start, dp); }, at);
  return select(q > start.value, exp(w) / safe_k, T(0));
}

/// The same to round-off, from there on by Newton inside a bracket; at: sigma_s at p, and then at p + u k.
template <class T> T solve_correction(const HardeningCurve& h, const T& q, const T& p, const T& k, T u, YieldStress<T>& at) {
  if (h.rate.kind != RateLaw::none) return correction_at_rate(h, q, p, k, u, at);
  const YieldStress<T> start = at;
  T low(0), high(1);
  for (int i = 0; i < 60; ++i) {
    at = yield_stress_beyond(h, p, start, u * k);
    const T value = (T(1) - u) * q - at.value;
    if (!any(absolute(value) > T(kOnTheSurface) * q)) break;
    low = select(value > T(0), u, low);
    high = select(value > T(0), high, u);
    T next = u + value / (q + k * at.slope);
    next = select(next > high, T(0.5) * (low + high), next);
    u = select(next < low, T(0.5) * (low + high), next);
  }
  return u;
}

/// Coefficient n of the Taylor series of J^(-5/3) about J = 1.
constexpr double series_of_power(int n) { return n == 0 ? 1.0 : series_of_power(n - 1) * (-5.0 / 3 - (n - 1)) / n; }

/// J^(-5/3) for J > 0. For |J - 1| <= 0.02, where metals are, by its series to the ninth power, and to the sixth for
/// |J - 1| <= 0.004, in pairs of terms that do not wait for each other: to round-off.
template <class T> T power_minus_five_thirds(const T& J) {
  const T d = J - T(1), away = absolute(d);
  constexpr double c[10] = {series_of_power(0), series_of_power(1), series_of_power(2), series_of_power(3), series_of_power(4),
                            series_of_power(5), series_of_power(6), series_of_power(7), series_of_power(8), series_of_power(9)};
  const auto pair = [&](int n) { return T(c[n]) + T(c[n + 1]) * d; };
  const T d2 = d * d;
  if (!any(away > T(0.004))) return (pair(0) + d2 * pair(2)) + d2 * d2 * (pair(4) + d2 * T(c[6]));
  if (any(away > T(0.02))) {
    const T j13 = inverse_cube_root(J);
    const T j23 = j13 * j13;
    return j23 * j23 * j13;
  }
  const T d4 = d2 * d2;
  return (pair(0) + d2 * pair(2)) + d4 * ((pair(4) + d2 * pair(6)) + d4 * pair(8));
}

/// S per B_D: mu J^(-5/3), or mu as printed.
template <class T> T stress_factor(const SolidConstants& m, const T& J) {
  return m.law == Law::paper ? T(m.mu) : T(m.mu) * power_minus_five_thirds(J);
}

/// What is asked of the trial state B' = s I + D (3.51) of a layer: m = D : D, d = det D.
template <class T> struct Trial {
  T s, m, d;
};
/// And D.
template <class T, int D> [[gnu::always_inline]] inline Symmetric<T, D> find_trial(const Symmetric<T, D>& B, Trial<T>& trial) {
  trial.s = trace(B) * T(1.0 / 3);
  Symmetric<T, D> deviator;
  repeat<Symmetric<T, D>::size>([&](auto i) { deviator[i] = i < 3 ? B[i] - trial.s : B[i]; });
  trial.m = contract(deviator, deviator);
  trial.d = determinant(deviator, cofactor(deviator));
  return deviator;
}

/// q_S'^2 of the stress S' = factor D that it would have; factor: stress_factor(m, J), here and below.
template <class T> T trial_square(const Trial<T>& trial, const T& factor) { return T(1.5) * trial.m * factor * factor; }
/// Which trial states lie outside of the yield surface.
template <class T> auto yields(const Trial<T>& trial, const T& factor, const YieldStress<T>& yield) {
  return trial_square(trial, factor) > yield.value * yield.value * T(1 + 2 * kOnTheSurface);
}
/// Those that do so at the lowest stress that the curve knows: none other has to be asked for its root.
template <class T> auto may_yield(const HardeningCurve& h, const Trial<T>& trial, const T& factor) { return trial_square(trial, factor) > T(h.lowest * h.lowest); }

/// How a trial state flows.
template <class T> struct Flow {
  T q;     ///< q_S'; of what does not yield sigma_s, so that its correction is none
  T k;     ///< plastic strain per u = 1 - a: q(B'^-1)/3
  T u;     ///< u to second order
  T work;  ///< -D : dev(B'^-1)
};
template <class T> [[gnu::always_inline]] inline Flow<T> find_flow(const Trial<T>& trial, const T& factor, const YieldStress<T>& yield) {
  const T &s = trial.s, &m = trial.m, &d = trial.d;
  const T over_det = T(1) / (s * (s * s - T(0.5) * m) + d);
  Flow<T> flow;
  flow.k = sqrt(T(1.5) * (s * (s * m - T(6) * d) + m * m * T(1.0 / 6))) * (over_det * T(1.0 / 3));
  flow.q = select(yields(trial, factor, yield), sqrt(trial_square(trial, factor)), yield.value);
  flow.u = first_correction(flow.q, flow.k, yield);
  flow.work = (s * m - T(3) * d) * over_det;
  return flow;
}

/// What a correction makes of a layer: u, its p, dissipation, and the yield stress after it.
template <class T> struct Correction {
  T u, p, dissipation;
  YieldStress<T> yield;
};
template <class T>
[[gnu::always_inline]] inline Correction<T> correct(const HardeningCurve& hardening, const T& factor, const Flow<T>& flow, const T& J, const T& p, YieldStress<T> yield) {
  const T u = solve_correction(hardening, flow.q, p, flow.k, flow.u, yield);
  // J S : D_p with the stress after the correction, which is the one that moves the nodes
  return {u, p + u * flow.k, factor * (T(1) - u) * J * T(0.5) * u * flow.work, yield};
}

/// What a layer answers, as if the body were made of it. B: the trial B' (3.51); J: V/V0 of the element; p: plastic strain, updated.
template <class T, int D>
PointResponse<T, D> update_layer(const HardeningCurve& hardening, const T& factor, const Symmetric<T, D>& B, const T& J, T& p) {
  PointResponse<T, D> r;
  Trial<T> trial;
  const Symmetric<T, D> deviator = find_trial(B, trial);
  r.dissipation = r.dp = T(0);
  if (hardening.kind != HardeningCurve::elastic && any(may_yield(hardening, trial, factor))) {
    r.yield = yield_stress(hardening, p);
    r.knows_yield = true;
    if (any(yields(trial, factor, r.yield))) {
      const Flow<T> flow = find_flow(trial, factor, r.yield);
      const Correction<T> c = correct(hardening, factor, flow, J, p, r.yield);
      r.kept = T(1) - c.u;
      r.dissipation = c.dissipation;
      r.yield = c.yield;
      r.dp = c.u * flow.k;
      p = c.p;
    }
  }
  const T kept = r.kept * factor;
  repeat<Symmetric<T, D>::size>([&](auto i) { r.S[i] = kept * deviator[i]; });
  return r;
}

/// G^X of the layer whose memory starts at `from`.
template <class T, int D> Symmetric<T, D> load_memory(const double* from) {
  Symmetric<T, D> G;
  repeat<Symmetric<T, D>::size>([&](auto i) { load(from, i, G[i]); });
  return G;
}

/// (3.54) of the layer whose memory starts at `memory`: G <- a G + (1-a) G^x, u = 1 - a, and (1-a) G^x = share A; its p is stored already.
template <class T, int D> void keep_flow(double* memory, const T& u, const T& share, const Symmetric<T, D>& A) {
  const T a = T(1) - u;
  const Symmetric<T, D> G = load_memory<T, D>(memory);
  repeat<Symmetric<T, D>::size>([&](auto c) { store(memory, c, a * G[c] + share * A[c]); });
}

/// One step of layer k of a point whose reciprocal vectors are at hand; its memory of that layer starts at `memory`; factor: stress_factor(m, J).
template <class T, int D, bool Ring>
PointResponse<T, D> layer_step(const SolidConstants& m, int k, const T& factor, const Edges<T, D, Ring>& e, const T& J, double* memory, Keep keep) {
  constexpr int size = Symmetric<T, D>::size;
  T p;
  load(memory, size, p);
  const T before = p;
  const PointResponse<T, D> r = update_layer(m.layer[k].hardening, factor, push(load_memory<T, D>(memory), e), J, p);
  if (keep == Keep::yes && any(p > before)) {
    store(memory, size, p);
    const T u = T(1) - r.kept;
    keep_flow(memory, u, u, metric_of<D, Ring>(e.up, T(1)));
  }
  return r;
}

/// One step of all layers of a point.
template <class T, int D, bool Ring>
PointResponse<T, D> von_mises_step(const SolidConstants& m, const Edges<T, D, Ring>& e, const T& J, double* memory, Keep keep) {
  const T factor = stress_factor(m, J);
  if (m.layers == 1) return layer_step(m, 0, factor, e, J, memory, keep);
  PointResponse<T, D> sum;
  repeat<Symmetric<T, D>::size>([&](auto i) { sum.S[i] = T(0); });
  sum.dissipation = T(0);
  for (int k = 0; k < m.layers; ++k, memory += kLayerItems<D> * stride_of<T>) {
    const PointResponse<T, D> r = layer_step(m, k, factor, e, J, memory, keep);
    const T w(m.layer[k].weight);
    repeat<Symmetric<T, D>::size>([&](auto i) { sum.S[i] += w * r.S[i]; });
    sum.dissipation += w * r.dissipation;
  }
  return sum;
}

/// Stored energy per initial volume, J/m3, of the deviatoric part:
/// mu/2 J^(-2/3) (tr B - 3 (det B)^(1/3)), which is zero where B is spherical.
/// Without the difference of near numbers: with B = s I + B_D,
///   det B = s^3 (1 - e),  e = B_D:B_D / (2 s^2) - det B_D / s^3,
///   1 - (1 - e)^(1/3) = e / (1 + y + y^2),  y = (1 - e)^(1/3).
template <class T, int D> T deviatoric_energy(double mu, const Symmetric<T, D>& B, const T& J) {
  const T s = trace(B) * T(1.0 / 3);
  const Symmetric<T, D> B_D = deviator(B);
  const T e = (T(0.5) * contract(B_D, B_D) - determinant(B_D, cofactor(B_D)) / s) / (s * s);
  const T root = inverse_cube_root(T(1) - e);
  const T y = (T(1) - e) * root * root;
  const T j13 = inverse_cube_root(J);
  return T(1.5 * mu) * j13 * j13 * s * e / (T(1) + y + y * y);
}

template <class T, int D, bool Ring>
T von_mises_energy(const SolidConstants& m, const Edges<T, D, Ring>& e, const T& J, const double* memory) {
  T sum(0);
  for (int k = 0; k < m.layers; ++k, memory += kLayerItems<D> * stride_of<T>)
    sum += T(m.layer[k].weight) * deviatoric_energy(m.mu, push(load_memory<T, D>(memory), e), J);
  return sum;
}

/// Bound on the tangent modulus over mu, for the time step: J^(-2/3) lambda_max(B), with
/// lambda_max <= tr B/3 + 2/3 q_B; of several layers the mean.
template <class T, int D, bool Ring>
T von_mises_tangent(const SolidConstants& m, const Edges<T, D, Ring>& e, const T& J, const double* memory) {
  T sum(0);
  for (int k = 0; k < m.layers; ++k, memory += kLayerItems<D> * stride_of<T>) {
    const Symmetric<T, D> B = push(load_memory<T, D>(memory), e);
    sum += T(m.layer[k].weight) * (trace(B) * T(1.0 / 3) + T(2.0 / 3) * mises(deviator(B)));
  }
  if (m.law == Law::paper) return J * sum;
  const T j13 = inverse_cube_root(J);
  return j13 * j13 * sum;
}

}  // namespace forming_sim
