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

/// The fibres of a cell and the planes that they span, constants of one_point.h.
template <class T, int D> struct Fibres {
  Vector<T, D> along[D];  ///< u_i
  T slope[D];
  T cotangent[3], over_sine[3];  ///< 3D: of the plane across coordinate d

  explicit Fibres(const double* constants) {
    using Cell = OnePoint<D>;
    repeat<D>([&](auto i) {
      repeat<D>([&](auto m) { load(constants, Cell::fibres + D * i + m, along[i][m]); });
      load(constants, Cell::slopes + i, slope[i]);
    });
    if constexpr (D == 3)
      repeat<3>([&](auto d) {
        load(constants, Cell::skew + 2 * d, cotangent[d]);
        load(constants, Cell::skew + 2 * d + 1, over_sine[d]);
      });
  }
};

/// e_d and e_m from z, and the transposed map.
///
/// In 3D the strains a' = u_i . Z u_i, b' = u_j . Z u_j and c' = 2 u_i . sym(Z) u_j of the fibres are at hand first; with
/// t_1 = u_i and t_2 = (u_j - cos u_i)/sin the components along t_1 and t_2 follow.
template <class T, int D> struct HourglassStrain {
  Plane<T> plane[D];
  T warp[3];  ///< 3D: of the last mode

  void from(const Vector<T, D>* z, const Fibres<T, D>& f) {
    if constexpr (D == 2) {
      repeat<2>([&](auto i) { plane[i].a = f.slope[i] * dot(f.along[i], z[0]); });
    } else {
      repeat<3>([&](auto d) {
        constexpr int i = (d + 1) % 3, j = (d + 2) % 3;
        const Vector<T, 3> zi = f.slope[j] * z[i], zj = f.slope[i] * z[j];
        const T a = dot(f.along[i], zj), b = dot(f.along[j], zi), c = dot(f.along[i], zi) + dot(f.along[j], zj);
        const T cot = f.cotangent[d], over = f.over_sine[d];
        plane[d] = {a, over * over * b + cot * (cot * a - over * c), over * c - T(2) * cot * a};
        warp[d] = f.slope[d] * dot(f.along[d], z[3]);
      });
    }
  }
  /// With stresses in place of strains: dU/dz per volume.
  void gradient(const Fibres<T, D>& f, Vector<T, D>* g) const {
    if constexpr (D == 2) {
      g[0] = (T(1.0 / 3) * f.slope[0] * plane[0].a) * f.along[0];
      g[0] += (T(1.0 / 3) * f.slope[1] * plane[1].a) * f.along[1];
    } else {
      repeat<4>([&](auto k) { g[k] = {{T(0), T(0), T(0)}}; });
      repeat<3>([&](auto d) {
        constexpr int i = (d + 1) % 3, j = (d + 2) % 3;
        const Plane<T>& s = plane[d];
        const T cot = f.cotangent[d], over = f.over_sine[d];
        const T a = s.a + cot * (cot * s.b - T(2) * s.shear), b = over * over * s.b, c = over * (s.shear - cot * s.b);
        const T si = T(1.0 / 3) * f.slope[i], sj = T(1.0 / 3) * f.slope[j];
        g[j] += (si * a) * f.along[i];
        g[j] += (si * c) * f.along[j];
        g[i] += (sj * b) * f.along[j];
        g[i] += (sj * c) * f.along[i];
        g[3] += (T(1.0 / 9) * f.slope[d] * warp[d]) * f.along[d];
      });
    }
  }
};

/// g = dU/dz per volume of an elastic cell.
template <int D> void hourglass_stiffness(const SolidConstants& m, const Fibres<double, D>& fibres, const Vector<double, D>* z, Vector<double, D>* g) {
  const PlaneModuli<double> moduli(m);
  HourglassStrain<double, D> e, s;
  e.from(z, fibres);
  for (int d = 0; d < D; ++d) s.plane[d] = moduli.stress(e.plane[d]);
  if constexpr (D == 3)
    for (int d = 0; d < 3; ++d) s.warp[d] = moduli.E * e.warp[d];
  s.gradient(fibres, g);
}

/// sum_a h_alpha,a x_a of all modes; the signs are those of kHourglass.
template <class T, int D> void sum_modes(const Vector<T, D>* x, Vector<T, D>* sum) {
  repeat<D>([&](auto i) {
    if constexpr (D == 2) {
      sum[0][i] = (x[0][i] - x[1][i]) + (x[2][i] - x[3][i]);
    } else {
      T even[4], odd[4];  // in zeta
      repeat<4>([&](auto k) { even[k] = x[k + 4][i] + x[k][i], odd[k] = x[k + 4][i] - x[k][i]; });
      const T u = odd[2] - odd[0], v = odd[3] - odd[1];
      sum[0][i] = u + v;
      sum[1][i] = u - v;
      sum[2][i] = (even[0] - even[1]) + (even[2] - even[3]);
      sum[3][i] = (odd[0] - odd[1]) + (odd[2] - odd[3]);
    }
  });
}
/// f_a -= sum_alpha h_alpha,a r_alpha.
template <class T, int D> void take_modes(const Vector<T, D>* r, Vector<T, D>* f) {
  repeat<D>([&](auto i) {
    if constexpr (D == 2) {
      repeat<4>([&](auto a) { f[a][i] = a % 2 == 0 ? f[a][i] - r[0][i] : f[a][i] + r[0][i]; });
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
  });
}

}  // namespace forming_sim
