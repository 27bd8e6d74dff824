#pragma once
// The stable time step of a one-point cell, dt = 2/omega.
//
// Uniform part, as in time_step.h with S = sum_a g_a g_a^T V0 rho/m_a = sum_mk inertia_mk x^m x^k:
//   omega_1^2 = mu/rho tangent bound(S) + K/rho J^2 tr S.
// Hourglass part. With k_m the constants `stiffness`, dz_alpha,m = x^m . sum_a gamma_alpha,a dx_a
// where gamma = h - sum_m (x^m . sum_b h_b x_b) w_m, and at the start
//   omega_2^2 <= 1/rho lambda_max(sum_m k_m x^m x^m).
// Once a cell is bent, gamma has changed by z_alpha,m w_m, in the metric of the masses by not more
// than a share t of itself, t^2 = looseness sum_alpha z_alpha,m inertia_mk z_alpha,k; then
// omega_2^2 grows by (1 + t)^2.
// Both parts are sums of squares of linear forms. Those of one have at most the cosine
// c <= slant + t with those of the other in that metric, and so
//   omega^2 <= (omega_1^2 + omega_2^2)/2 + sqrt((omega_1^2 - omega_2^2)^2/4 + c^2 omega_1^2 omega_2^2).
// The guard of the corners adds what element/corner_guard.h says.
#include "forming_sim/element/hourglass.h"
#include "forming_sim/element/time_step.h"

namespace forming_sim {

template <class T, int D> class OnePointBound {
  using Cell = OnePoint<D>;

 public:
  T omega2;

  OnePointBound(const CellGroup& g, const Vector<T, D>*) : g_(g) {}

  /// sums: of the modes, CornerSums.
  void set(const Edges<T, D>& e, const double* memory, const T& V0, const double* constants, const Vector<T, D>* sums) {
    const T J = e.volume / V0;
    T item;
    Symmetric<T, D> S, H;  // sum_mk inertia_mk x^m x^k, sum_m k_m x^m x^m
    for (int i = 0; i < Symmetric<T, D>::size; ++i) S[i] = H[i] = T(0);
    for (int m = 0; m < D; ++m) {
      load(constants, Cell::stiffness + m, item);
      add_product(H, item, e.up[m], e.up[m]);
      for (int k = 0; k < D; ++k) {
        load(constants, Cell::inertia + kPair<D>[m][k], item);
        add_product(S, item, e.up[m], e.up[k]);
      }
    }
    T trace_S;
    const T rho(g_.density), tangent = point_tangent(g_.solid, e, J, memory);
    const T deviatoric = T(g_.solid.mu) / rho * tangent * shape_bound(S, trace_S);
    sum_ = trace_S * e.volume * e.volume / (rho * V0);
    const T uniform = deviatoric + T(g_.solid.K) * pressure_tangent(g_.solid, J) / (J * e.volume) * sum_;
    T turned(0);
    load(constants, Cell::looseness, item);
    for (int a = 0; a < Cell::modes; ++a) {
      T z[D];
      for (int m = 0; m < D; ++m) {
        load(constants, Cell::start + a * D + m, z[m]);
        z[m] = dot(e.up[m], sums[a]) - z[m];
      }
      for (int m = 0; m < D; ++m)
        for (int k = 0; k < D; ++k) {
          T inertia;
          load(constants, Cell::inertia + kPair<D>[m][k], inertia);
          turned += item * inertia * z[m] * z[k];
        }
    }
    const T t = sqrt(turned);
    const T modes = largest(H) / rho * (T(1) + t) * (T(1) + t);
    load(constants, Cell::slant, item);
    const T c = smaller(item + t, T(1)), half = T(0.5) * (uniform - modes);
    omega2 = T(0.5) * (uniform + modes) + sqrt(half * half + c * c * uniform * modes);
    V_ = e.volume;
  }

  /// rate: |dV/dt|/V, for the quadratic viscosity.
  StepRates<T> rates(const T& rate) const { return {omega2, viscous_damping<T, D>(g_, sum_, V_, V_, rate)}; }

 private:
  static T largest(const Symmetric<T, D>& H) {
    if constexpr (D == 3) {
      return largest_eigenvalue(H);
    } else {
      const T half = T(0.5) * (H[0] - H[1]);
      return T(0.5) * (H[0] + H[1]) + sqrt(half * half + H[3] * H[3]);
    }
  }

  const CellGroup& g_;
  T sum_, V_;
};

}  // namespace forming_sim
