#pragma once
// The yield surface that the mean stress of a one-point cell and its variation across the cell
// share.
//
// With S the mean deviator, s the stress at the faces of one coordinate (hourglass.h), m = h dev s
// and H = d sigma_s/dp, p' the variation of the plastic strain, a cell can bear what satisfies
//
//   Q_n + mu <= 1,   mu = Q_m/2 + sqrt(Q_m^2/4 + Q_nm^2),
//   (Q_n, Q_m, Q_nm) = 3/2 (S:S, m:m, S:m) / sigma_s^2,   m = h (dev s - H p'/sigma_s S).
//
// This is the surface of Ivanov (1967) for plates and shells. In one direction it is
// |m| <= 1 - n^2, what a rectangle of yield stress bears about any neutral axis, and
// h = 2/3 makes it so; where the whole cell flows one way, s is that of the hardening
// alone.
//
// Flow is normal to it in (S, s/3), the stresses that work on the mean and on ep. On the surface a
// flow with multiplier L takes d p = 2 L/sigma_s, such that sigma_s dp is what it dissipates, and
// d p' = S : d ep / sigma_s.
#include "forming_sim/element/hourglass_strain.h"
#include "forming_sim/material/hardening.h"

namespace forming_sim {

/// s at the faces over the m of the yield surface.
constexpr double kFaceStress = 2.0 / 3;

/// The mean of a layer while its cell flows.
template <class T, int D> struct MeanFlow {
  Symmetric<T, D> S;       ///< Pa
  Symmetric<T, D> strain;  ///< plastic, of this step
  T modulus;               ///< of S: twice that of shear, Pa
  T sigma, slope;          ///< sigma_s and H, Pa
  T p;                     ///< d p of this step

  void flow(int i, const T& rate) {
    strain[i] += rate;
    S[i] -= modulus * rate;
  }
  void harden(const T& dp) {
    p += dp;
    sigma += slope * dp;
  }
};

/// What one coordinate's surface finds.
template <class T, int D> struct Normal {
  T excess;                     ///< Q_n + mu - 1
  Symmetric<T, D> mean, varied;  ///< d(Q_n + mu) by S and by s, 1/Pa
  T along;                      ///< varied : S
  T edge;                       ///< |Q_nm| - Q_m/2: above 0 the surface has an edge ahead, where Q_nm changes its sign
};

/// The plane in which s lies, of the unit vectors t_1 and t_2 (in 2D t_2 = e_3): where a body has turned, they have
/// turned with it.
template <class T, int D> struct PlaneOf {
  Symmetric<T, D> first, second, across;  ///< t_1 t_1, t_2 t_2, sym(t_1 t_2)

  /// fibres: those that take z, turned with the cell.
  PlaneOf(const Fibres<T, D>& turned, const double* constants, int d) {
    T slope;
    const int i = D == 2 ? d : (d + 1) % 3;
    load(constants, OnePoint<D>::slopes + i, slope);
    const Vector<T, D> t = T(1) / slope * turned.along[i];
    if constexpr (D == 2) {
      first = dyad(t, t);
      second = {{T(0), T(0), T(1), T(0)}};
      across = {{T(0), T(0), T(0), T(0)}};
    } else {
      const Skew<T> skew(constants, d);  // t_2 = (u_j - cos u_i)/sin
      const Vector<T, 3> v = skew.second / slope * turned.along[(d + 2) % 3] - skew.cotangent * t;
      first = dyad(t, t);
      second = dyad(v, v);
      across = dyad(t, v);
    }
  }
  Symmetric<T, D> deviator(const Plane<T>& s) const {
    const T mean = T(1.0 / 3) * (s.a + s.b), twice = T(2) * s.shear;
    Symmetric<T, D> r;
    for (int n = 0; n < Symmetric<T, D>::size; ++n) r[n] = s.a * first[n] + s.b * second[n] + twice * across[n];
    for (int n = 0; n < 3; ++n) r[n] -= mean;
    return r;
  }
  /// Components of a tensor in the plane, the shear twice.
  Plane<T> part(const Symmetric<T, D>& a) const { return {contract(first, a), contract(second, a), T(2) * contract(across, a)}; }

 private:
  static Symmetric<T, D> dyad(const Vector<T, D>& t, const Vector<T, D>& v) {
    const T half(0.5);
    if constexpr (D == 2) return {{t[0] * v[0], t[1] * v[1], T(0), half * (t[0] * v[1] + t[1] * v[0])}};
    else return {{t[0] * v[0], t[1] * v[1], t[2] * v[2], half * (t[0] * v[1] + t[1] * v[0]), half * (t[1] * v[2] + t[2] * v[1]), half * (t[2] * v[0] + t[0] * v[2])}};
  }
};

/// m/h = dev s - H p'/sigma_s S.
template <class T, int D> Symmetric<T, D> own_part(const MeanFlow<T, D>& mean, const Symmetric<T, D>& S, const Plane<T>& s, const T& rise, const PlaneOf<T, D>& at) {
  const T back = mean.slope * rise / mean.sigma;
  Symmetric<T, D> m = at.deviator(s);
  for (int i = 0; i < Symmetric<T, D>::size; ++i) m[i] -= back * S[i];
  return m;
}

template <class T, int D> Normal<T, D> normal(const MeanFlow<T, D>& mean, const Plane<T>& s, const T& rise, const PlaneOf<T, D>& at) {
  constexpr double h = kFaceStress;
  const T one = T(1) / mean.sigma, scale = T(1.5) * one * one, back = mean.slope * rise * one;
  const Symmetric<T, D> m = own_part<T, D>(mean, mean.S, s, rise, at);
  const T Qn = scale * contract(mean.S, mean.S), Qm = T(h * h) * scale * contract(m, m), Qnm = T(h) * scale * contract(mean.S, m);
  const T root = sqrt(T(0.25) * Qm * Qm + Qnm * Qnm), safe = T(1) / larger(root, T(1e-30));
  Normal<T, D> r;
  r.excess = Qn + T(0.5) * Qm + root - T(1);
  const T cross = T(h) * scale * Qnm * safe, own = T(h * h) * scale * (T(1) + T(0.5) * Qm * safe);
  for (int i = 0; i < Symmetric<T, D>::size; ++i) {
    r.varied[i] = own * m[i] + cross * mean.S[i];
    r.mean[i] = T(2) * scale * mean.S[i] + cross * m[i] - back * r.varied[i];
  }
  r.along = contract(r.varied, mean.S);
  r.edge = absolute(Qnm) - T(0.5) * Qm;
  return r;
}

/// One coordinate flows where share is 1: mean, ep and p' (rise) follow; what the variation dissipates per initial volume.
/// At the edge where the whole cell flows one way and m comes to lie across S, it goes no further; where m is more than that,
/// the surface is smooth there, and S, however small, is no reason to stop.
template <class T, int D>
T flow_to_surface(MeanFlow<T, D>& mean, const PlaneModuli<T>& moduli, const Plane<T>& strain, const T& share, Plane<T>& ep, T& rise, const PlaneOf<T, D>& at) {
  constexpr int size = Symmetric<T, D>::size;
  const Plane<T> s = moduli.stress(strain - ep);
  const Normal<T, D> n = normal<T, D>(mean, s, rise, at);
  const Plane<T> direction = at.part(n.varied), softer = moduli.stress(direction);
  // Newton's step on root = sqrt(Q_n + mu), which is of first degree in the stresses: far outside it is the radial return.
  const T root = sqrt(larger(T(1) + n.excess, T(1))), over = T(1) / mean.sigma, to_root = T(1) / (root * mean.sigma);
  const T resistance = mean.modulus * contract(n.mean, n.mean) + T(3) * work(softer, direction) +
                       mean.slope * over * over * (T(4) * root * root * root + T(3) * n.along * n.along);
  T L = share * T(2) * root * (root - T(1)) / resistance;
  Symmetric<T, D> S = mean.S;
  for (int i = 0; i < size; ++i) S[i] -= mean.modulus * L * n.mean[i];
  const T three = T(3) * L;
  const T before = contract(mean.S, own_part<T, D>(mean, mean.S, s, rise, at));
  const T after = contract(S, own_part<T, D>(mean, S, s - Plane<T>{three * softer.a, three * softer.b, three * softer.shear}, rise, at));
  const auto turned = (before * after < T(0)) & (n.edge > T(0));
  L *= select(turned, before / select(turned, before - after, T(1)), T(1));
  const Plane<T> rate{T(3) * L * direction.a, T(3) * L * direction.b, T(3) * L * direction.shear};
  ep = {ep.a + rate.a, ep.b + rate.b, ep.shear + rate.shear};
  rise += T(3) * L * n.along * to_root;
  for (int i = 0; i < size; ++i) mean.flow(i, L * n.mean[i]);
  mean.harden(T(2) * L * over * root);
  return T(1.0 / 3) * work(moduli.stress(strain - ep), rate);
}

/// The mean alone: back to Q_n = 1, along S.
template <class T, int D> void flow_of_mean(MeanFlow<T, D>& mean) {
  const T q = sqrt(T(1.5) * contract(mean.S, mean.S)), stiff = T(1.5) * mean.modulus;
  const T dp = larger(q - mean.sigma, T(0)) / (stiff + mean.slope), factor = T(1.5) * dp / larger(q, mean.sigma);
  for (int i = 0; i < Symmetric<T, D>::size; ++i) mean.flow(i, factor * mean.S[i]);
  mean.harden(dp);
}

}  // namespace forming_sim
