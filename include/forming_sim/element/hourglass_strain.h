#pragma once
// The strains that vary across a one-point cell, from the amplitudes z of its modes, and back
// from stresses to the gradient of the energy; element/hourglass.h says what they mean.
#include "forming_sim/element/one_point.h"
#include "forming_sim/tensor/tensor.h"

namespace forming_sim {

/// A plane strain or stress tensor: normal components and the shear (of a strain: twice).
template <class T> struct Plane {
  T a = T(0), b = T(0), shear = T(0);
};

/// Elastic moduli as Young's, that of plane stress over 1, Poisson's ratio.
template <class T> struct PlaneModuli {
  double E, plane, nu, mu;
  explicit PlaneModuli(const SolidConstants& m)
      : E(9 * m.K * m.mu / (3 * m.K + m.mu)), plane(0), nu((3 * m.K - 2 * m.mu) / (2 * (3 * m.K + m.mu))), mu(m.mu) {
    plane = E / (1 - nu * nu);
  }
  Plane<T> stress(const Plane<T>& e) const {
    return {T(plane) * (e.a + T(nu) * e.b), T(plane) * (T(nu) * e.a + e.b), T(mu) * e.shear};
  }
};
template <class T> Plane<T> operator-(const Plane<T>& x, const Plane<T>& y) { return {x.a - y.a, x.b - y.b, x.shear - y.shear}; }
/// s : e
template <class T> T work(const Plane<T>& s, const Plane<T>& e) { return s.a * e.a + s.b * e.b + s.shear * e.shear; }

/// e_d and e_m from z, and the transposed map; slopes: A of the cell.
template <class T, int D> struct HourglassStrain {
  Plane<T> plane[D];
  T warp[3];  ///< 3D: of the last mode

  void from(const T (*z)[D], const T* A) {
    if constexpr (D == 2) {
      for (int i = 0; i < 2; ++i) plane[i].a = A[2 * i] * z[0][0] + A[2 * i + 1] * z[0][1];
    } else {
      const auto& at = kPair<3>;
      for (int d = 0; d < 3; ++d) {
        const int i = (d + 1) % 3, j = (d + 2) % 3;
        plane[d].a = A[at[j][i]] * z[i][i] + A[i] * z[j][i];
        plane[d].b = A[j] * z[i][j] + A[at[i][j]] * z[j][j];
        plane[d].shear = A[j] * z[i][i] + A[at[j][i]] * z[i][j] + A[at[i][j]] * z[j][i] + A[i] * z[j][j];
        warp[d] = A[d] * z[3][d];
      }
    }
  }
  /// With stresses in place of strains: dU/dz per volume.
  void gradient(const T* A, T (*g)[D]) const {
    if constexpr (D == 2) {
      for (int m = 0; m < 2; ++m) g[0][m] = T(1.0 / 3) * (A[m] * plane[0].a + A[2 + m] * plane[1].a);
    } else {
      const auto& at = kPair<3>;
      for (int k = 0; k < 3; ++k)
        for (int m = 0; m < 3; ++m) g[k][m] = T(0);
      for (int d = 0; d < 3; ++d) {
        const int i = (d + 1) % 3, j = (d + 2) % 3;
        const Plane<T>& s = plane[d];
        g[i][i] += A[at[j][i]] * s.a + A[j] * s.shear;
        g[j][i] += A[i] * s.a + A[at[i][j]] * s.shear;
        g[i][j] += A[j] * s.b + A[at[j][i]] * s.shear;
        g[j][j] += A[at[i][j]] * s.b + A[i] * s.shear;
        g[3][d] = T(1.0 / 9) * A[d] * warp[d];
      }
      for (int k = 0; k < 3; ++k)
        for (int m = 0; m < 3; ++m) g[k][m] *= T(1.0 / 3);
    }
  }
};

/// g = dU/dz per volume of an elastic cell.
template <int D> void hourglass_stiffness(const SolidConstants& m, const double* A, const double (*z)[D], double (*g)[D]) {
  const PlaneModuli<double> moduli(m);
  HourglassStrain<double, D> e, s;
  e.from(z, A);
  for (int d = 0; d < D; ++d) s.plane[d] = moduli.stress(e.plane[d]);
  if constexpr (D == 3)
    for (int d = 0; d < 3; ++d) s.warp[d] = moduli.E * e.warp[d];
  s.gradient(A, g);
}

/// sum_a h_alpha,a x_a of all modes; the signs are those of kHourglass.
template <class T, int D> void sum_modes(const Vector<T, D>* x, Vector<T, D>* sum) {
  for (int i = 0; i < D; ++i) {
    if constexpr (D == 2) {
      sum[0][i] = (x[0][i] - x[1][i]) + (x[2][i] - x[3][i]);
    } else {
      T even[4], odd[4];  // in zeta
      for (int k = 0; k < 4; ++k) even[k] = x[k + 4][i] + x[k][i], odd[k] = x[k + 4][i] - x[k][i];
      const T u = odd[2] - odd[0], v = odd[3] - odd[1];
      sum[0][i] = u + v;
      sum[1][i] = u - v;
      sum[2][i] = (even[0] - even[1]) + (even[2] - even[3]);
      sum[3][i] = (odd[0] - odd[1]) + (odd[2] - odd[3]);
    }
  }
}
/// f_a -= sum_alpha h_alpha,a r_alpha.
template <class T, int D> void take_modes(const Vector<T, D>* r, Vector<T, D>* f) {
  for (int i = 0; i < D; ++i) {
    if constexpr (D == 2) {
      for (int a = 0; a < 4; ++a) f[a][i] = a % 2 == 0 ? f[a][i] - r[0][i] : f[a][i] + r[0][i];
    } else {
      const T p = r[0][i] + r[1][i], m = r[0][i] - r[1][i], low = r[2][i] - r[3][i], high = r[2][i] + r[3][i];
      f[0][i] -= p + low;
      f[1][i] -= m - low;
      f[2][i] += p - low;
      f[3][i] += m + low;
      f[4][i] += p - high;
      f[5][i] += m + high;
      f[6][i] -= p + high;
      f[7][i] -= m - high;
    }
  }
}

}  // namespace forming_sim
