#pragma once
// The law of the package at one point: memory tensor, von Mises yield, isotropic
// hardening. One file, written once for a double and for a Pack.
//
//   S = mu J^(-5/3) B_D                    (own law; (3.5) S = mu B_D as `paper`)
//   yield: q_S = mu J^(-5/3) q_B <= sigma_s(p),  q_B = sqrt(3/2 B_D : B_D)
//   correction (3.54): G <- a G + (1-a) G^x, so that B = a B' + (1-a) I (3.55)
//
// With (1-a) the plastic stretching of the correction is exactly
// D_p = -(1-a)/2 dev(B^-1) (ERRATA to 3.62), hence
//   d p = sqrt(2/3 D_p : D_p) = (1-a)/3 q(B^-1),
// and a is solved for together with the hardening (ERRATA to 3.63):
//   a q_S' = sigma_s(p + (1-a) k),  k = q(B'^-1)/3.
#include "forming_sim/material/hardening.h"
#include "forming_sim/tensor/tensor.h"

namespace forming_sim {

/// Constants of an isotropic elastic-plastic solid.
struct SolidConstants {
  double K = 0;        ///< bulk modulus, Pa
  double mu = 0;       ///< shear modulus, Pa
  bool paper = false;  ///< S = mu B_D as printed
  HardeningCurve hardening;
};

template <class T, int D> struct PointResult {
  Symmetric<T, D> S;  ///< deviatoric Cauchy stress, Pa
  T a;                ///< 1: elastic
  T dissipation;      ///< plastic work of the step per initial volume, J/m3
};

/// u = 1 - a of (1-u) q = sigma_s(p + u k): Newton inside a bracket, to round-off.
template <class T> T solve_correction(const HardeningCurve& h, T q, T p, T k, T sigma) {
  T u(0), low(0), high(1);
  T value = q - sigma, slope = q;
  for (int i = 0; i < 60; ++i) {
    const YieldStress<T> y = yield_stress(h, p + u * k);
    value = (T(1) - u) * q - y.value;
    slope = q + k * y.slope;
    low = select(value > T(0), u, low);
    high = select(value > T(0), high, u);
    if (!any(absolute(value) > T(1e-13) * q)) break;
    T next = u + value / slope;
    next = select(next > high, T(0.5) * (low + high), next);
    u = select(next < low, T(0.5) * (low + high), next);
  }
  return u;
}

/// B: the trial B' (3.51); J: V/V0 of the element; p: plastic strain, updated.
template <class T, int D>
PointResult<T, D> update_point(const SolidConstants& m, const Symmetric<T, D>& B, const T& J, T& p) {
  PointResult<T, D> r;
  T factor(m.mu);  // stress per B_D
  if (!m.paper) {
    const T j13 = inverse_cube_root(J);
    const T j23 = j13 * j13;
    factor = T(m.mu) * j23 * j23 * j13;
  }
  r.S = deviator(B);
  r.a = T(1);
  r.dissipation = T(0);
  if (m.hardening.kind != HardeningCurve::elastic) {
    const T q = factor * mises(r.S);
    const T sigma = yield_stress(m.hardening, p).value;
    const auto yields = q > sigma;
    if (any(yields)) {
      const Symmetric<T, D> cof = cofactor(B);
      const T det = determinant(B, cof);
      const T q_inverse = mises(deviator(cof)) / det;
      const T k = q_inverse * T(1.0 / 3);
      const T safe_q = select(yields, q, sigma);  // lanes that do not yield solve to u = 0
      const T u = select(yields, solve_correction(m.hardening, safe_q, p, k, sigma), T(0));
      r.a = T(1) - u;
      p += u * k;
      // J S : D_p with the stress after the correction, which is the one that moves the nodes;
      // B_D : dev(B^-1) = 3 - tr B tr B^-1 / 3
      const T minus_contraction = trace(B) * trace(cof) / (T(3) * det) - T(3);
      r.dissipation = factor * r.a * J * T(0.5) * u * minus_contraction;
    }
  }
  factor *= r.a;
  for (int i = 0; i < Symmetric<T, D>::size; ++i) r.S[i] = factor * r.S[i];
  return r;
}

/// Stored energy per initial volume, J/m3, of the deviatoric part:
/// mu/2 J^(-2/3) (tr B - 3 (det B)^(1/3)), which is zero where B is spherical.
/// Without the difference of near numbers: with B = s I + B_D,
///   det B = s^3 (1 - e),  e = B_D:B_D / (2 s^2) - det B_D / s^3,
///   1 - (1 - e)^(1/3) = e / (1 + y + y^2),  y = (1 - e)^(1/3).
template <class T, int D> T deviatoric_energy(const SolidConstants& m, const Symmetric<T, D>& B, const T& J) {
  const T s = trace(B) * T(1.0 / 3);
  const Symmetric<T, D> B_D = deviator(B);
  const T e = (T(0.5) * contract(B_D, B_D) - determinant(B_D, cofactor(B_D)) / s) / (s * s);
  const T root = inverse_cube_root(T(1) - e);
  const T y = (T(1) - e) * root * root;
  const T j13 = inverse_cube_root(J);
  return T(1.5 * m.mu) * j13 * j13 * s * e / (T(1) + y + y * y);
}

}  // namespace forming_sim
