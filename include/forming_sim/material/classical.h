#pragma once
// The classical method of Wilkins at one point (section 2), the baseline for
// comparisons: incremental Hooke law, Jaumann's rate, radial return, incremental
// pressure. It knows velocities and no initial configuration, and so it drifts.
//
//   (2.10)  S <- S + dt [2 mu dev D + W.S - S.W],  L = v_m x^m (3.26), D + W = L
//   (2.11)  p <- p + dt K tr D      (by the caller, who averages it over the cell)
//   (2.15)  S <- m S,  m q_S' = sigma_s(p + (1-m) q_S'/(3 mu))   radial return
//
// Memory of a point: S, plastic strain, pressure.
#include "forming_sim/material/von_mises.h"

namespace forming_sim {

/// dt (D + W) = L dt of a simplex whose edges moved by w_m = dt v_m: components
/// [row][column] of w_m x^m, and the third direction by itself: nothing in plane
/// strain, w_3 x^3 = dt v_r / r in a ring.
template <class T, int D, bool Ring = false> struct Increment {
  T L[D][D];
  T hoop;  ///< ring only
  Increment(const Edges<T, D, Ring>& e, const Vector<T, D>* w) {
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) {
        L[i][j] = w[0][i] * e.up[0][j];
        for (int m = 1; m < D; ++m) L[i][j] += w[m][i] * e.up[m][j];
      }
    if constexpr (Ring) hoop = w[2][0] * e.up[2][0];
  }
  /// tr L dt: nabla . v = v_m . x^m (3.26)
  T divergence() const {
    T sum = L[0][0] + L[1][1];
    if constexpr (D == 3) sum += L[2][2];
    if constexpr (Ring) sum += hoop;
    return sum;
  }
};

/// W.S - S.W, W = (L - L^T)/2: what the rotation of the step adds to S, to first order.
template <class T, int D, bool Ring> Symmetric<T, D> jaumann(const Increment<T, D, Ring>& d, const Symmetric<T, D>& S) {
  Symmetric<T, D> r;
  const T w = T(0.5) * (d.L[0][1] - d.L[1][0]);  // W_xy
  if constexpr (D == 2) {
    r[0] = T(2) * w * S[3];
    r[1] = T(-2) * w * S[3];
    r[2] = T(0);
    r[3] = w * (S[1] - S[0]);
  } else {
    const T wyz = T(0.5) * (d.L[1][2] - d.L[2][1]), wzx = T(0.5) * (d.L[2][0] - d.L[0][2]);
    // W = [[0, w, -wzx], [-w, 0, wyz], [wzx, -wyz, 0]]; S: xx yy zz xy yz zx
    r[0] = T(2) * (w * S[3] - wzx * S[5]);
    r[1] = T(2) * (wyz * S[4] - w * S[3]);
    r[2] = T(2) * (wzx * S[5] - wyz * S[4]);
    r[3] = w * (S[1] - S[0]) + wyz * S[5] - wzx * S[4];
    r[4] = wyz * (S[2] - S[1]) + wzx * S[3] - w * S[5];
    r[5] = wzx * (S[0] - S[2]) + w * S[4] - wyz * S[3];
  }
  return r;
}

/// S <- S + dt [2 mu dev D + W.S - S.W] (2.10), before the return
template <class T, int D, bool Ring> void advance(double mu, const Increment<T, D, Ring>& d, Symmetric<T, D>& S) {
  const Symmetric<T, D> turn = jaumann(d, S);
  const T third = d.divergence() * T(1.0 / 3);
  const T mu2(2 * mu);
  for (int i = 0; i < 3; ++i) {
    T stretch = i < D ? d.L[i < D ? i : 0][i < D ? i : 0] : Ring ? d.hoop : T(0);
    S[i] += mu2 * (stretch - third) + turn[i];
  }
  S[3] += T(mu) * (d.L[0][1] + d.L[1][0]) + turn[3];
  if constexpr (D == 3) {
    S[4] += T(mu) * (d.L[1][2] + d.L[2][1]) + turn[4];
    S[5] += T(mu) * (d.L[2][0] + d.L[0][2]) + turn[5];
  }
}

/// moved: w_m, the way of the edges in the step that led to e; null: S as it stands.
template <class T, int D, bool Ring>
[[gnu::noinline]] PointResponse<T, D> classical_step(const SolidConstants& m, Edges<T, D, Ring> e, const Vector<T, D>* moved, const T& J,
                                                     double* memory, Keep keep) {
  constexpr int size = Symmetric<T, D>::size;
  PointResponse<T, D> r;
  r.S = load_memory<T, D>(memory);
  r.dissipation = r.dp = T(0);
  if (!moved) return r;
  advance(m.mu, Increment<T, D, Ring>(e, moved), r.S);
  T p;
  load(memory, size, p);
  const HardeningCurve& h = m.layer[0].hardening;
  if (h.kind != HardeningCurve::elastic) {
    const T q = mises(r.S);
    const YieldStress<T> yield = yield_stress(h, p);
    const auto yields = q > yield.value;
    if (any(yields)) {
      const T k = q * T(1 / (3 * m.mu));
      YieldStress<T> reached = yield;
      const T safe_q = select(yields, q, yield.value);
      const T u = select(yields, solve_correction(h, safe_q, p, k, first_correction(safe_q, k, yield), reached), T(0));
      r.dp = u * k;
      p += r.dp;
      for (int i = 0; i < size; ++i) r.S[i] *= T(1) - u;  // (2.15)
      r.dissipation = J * (T(1) - u) * q * u * k;         // q_S dp
      r.kept = T(1) - u;
      r.yield = reached;
      r.knows_yield = true;
    }
  }
  if (keep == Keep::yes) {
    for (int i = 0; i < size; ++i) store(memory, i, r.S[i]);
    store(memory, size, p);
  }
  return r;
}

/// S:S/(4 mu) of the current volume, per initial volume: what a linear elastic body
/// with this stress would store. moved: as above, from where the memory is of; null: it is of here.
template <class T, int D, bool Ring>
T classical_energy(const SolidConstants& m, const Edges<T, D, Ring>& e, const T& J, const double* memory, const Vector<T, D>* moved = nullptr) {
  Symmetric<T, D> S = load_memory<T, D>(memory);
  if (moved) advance(m.mu, Increment<T, D, Ring>(e, moved), S);
  return J * contract(S, S) * T(1 / (4 * m.mu));
}

}  // namespace forming_sim
