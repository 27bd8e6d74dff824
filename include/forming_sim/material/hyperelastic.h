#pragma once
// The hyperelastic law (3.74) at one point, in the form that has an energy
// (ERRATA): with Bbar = J^(-2/3) B,
//
//   S = 1/J dev(h1 Bbar + h2 Bbar.Bbar)
//   W = h1/2 (tr Bbar - 3) + h2/4 (tr(Bbar.Bbar) - 3)      per initial volume
//
// and the pressure K (J - 1) beside it. At rest mu = h1 + 2 h2. The memory is
// G^X of the start, which nothing changes: the body returns to its shape.
#include "forming_sim/material/von_mises.h"

namespace forming_sim {

/// A.A of a symmetric tensor.
template <class T, int D> Symmetric<T, D> square(const Symmetric<T, D>& a) {
  Symmetric<T, D> r;
  if constexpr (D == 2) {
    r[0] = a[0] * a[0] + a[3] * a[3];
    r[1] = a[1] * a[1] + a[3] * a[3];
    r[2] = a[2] * a[2];
    r[3] = a[3] * (a[0] + a[1]);
  } else {
    r[0] = a[0] * a[0] + a[3] * a[3] + a[5] * a[5];
    r[1] = a[1] * a[1] + a[3] * a[3] + a[4] * a[4];
    r[2] = a[2] * a[2] + a[4] * a[4] + a[5] * a[5];
    r[3] = a[3] * (a[0] + a[1]) + a[4] * a[5];
    r[4] = a[4] * (a[1] + a[2]) + a[3] * a[5];
    r[5] = a[5] * (a[0] + a[2]) + a[3] * a[4];
  }
  return r;
}

template <class T, int D, bool Ring> Symmetric<T, D> isochoric(const Edges<T, D, Ring>& e, const T& J, const double* memory) {
  Symmetric<T, D> B = push(load_memory<T, D>(memory), e);
  const T j13 = inverse_cube_root(J);
  for (int i = 0; i < Symmetric<T, D>::size; ++i) B[i] *= j13 * j13;
  return B;
}

template <class T, int D, bool Ring>
[[gnu::noinline]] PointResponse<T, D> hyperelastic_step(const SolidConstants& m, Edges<T, D, Ring> e, const T& J, const double* memory) {
  const Symmetric<T, D> B = isochoric(e, J, memory);
  Symmetric<T, D> S = square(B);
  for (int i = 0; i < Symmetric<T, D>::size; ++i) S[i] = (T(m.h1) * B[i] + T(m.h2) * S[i]) / J;
  PointResponse<T, D> r;
  r.S = deviator(S);
  r.dissipation = T(0);
  return r;
}

/// Per initial volume, J/m3. Without the difference of near numbers, so that a body at rest has no energy: with Bbar = s I + D,
///   tr Bbar - 3 = 2 w, which deviatoric_energy() knows;  tr(Bbar.Bbar) - 3 = 3 (s - 1) (s + 1) + D:D,  3 (s - 1) = 2 w.
template <class T, int D, bool Ring>
[[gnu::noinline]] T hyperelastic_energy(const SolidConstants& m, Edges<T, D, Ring> e, const T& J, const double* memory) {
  const Symmetric<T, D> B = isochoric(e, J, memory);
  const Symmetric<T, D> d = deviator(B);
  const T s = trace(B) * T(1.0 / 3), w = deviatoric_energy(1, B, T(1));
  return T(m.h1) * w + T(0.25 * m.h2) * (T(2) * w * (s + T(1)) + contract(d, d));
}

/// Bound on the tangent modulus over mu, for the time step: h1 L + 9/4 h2 L^2 with
/// L = lambda_max(Bbar). A principal stretch is as stiff as h1 L + 3 h2 L^2 against the
/// 4/3 of the bound, a shear as h1 L + 2 h2 L^2.
template <class T, int D, bool Ring>
[[gnu::noinline]] T hyperelastic_tangent(const SolidConstants& m, Edges<T, D, Ring> e, const T& J, const double* memory) {
  const Symmetric<T, D> B = isochoric(e, J, memory);
  const T L = trace(B) * T(1.0 / 3) + T(2.0 / 3) * mises(deviator(B));
  return L * (T(m.h1) + T(2.25 * m.h2) * L) * T(1 / m.mu);
}

}  // namespace forming_sim
