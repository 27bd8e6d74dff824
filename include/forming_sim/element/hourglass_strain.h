#pragma once
// The strains that vary across a one-point cell, from the amplitudes z of its modes, and back
// from stresses to the gradient of the energy; element/hourglass.h says what they mean.
#include "forming_sim/element/one_point_sums.h"
#include "forming_sim/tensor/tensor.h"

namespace forming_sim {

/// A plane strain or stress tensor: normal components and the shear (of a strain: twice).
template <class T> struct Plane {
  T a, b, shear;
};

/// Elastic moduli as Young's, that of plane stress over 1, Poisson's ratio.
struct PlaneModuli {
  double E, plane, nu, mu;
  explicit PlaneModuli(const SolidConstants& m)
      : E(9 * m.K * m.mu / (3 * m.K + m.mu)), plane(0), nu((3 * m.K - 2 * m.mu) / (2 * (3 * m.K + m.mu))), mu(m.mu) {
    plane = E / (1 - nu * nu);
  }
  template <class T> Plane<T> stress(const Plane<T>& e) const {
    return {T(plane) * (e.a + T(nu) * e.b), T(plane) * (T(nu) * e.a + e.b), T(mu) * e.shear};
  }
};
template <class T> Plane<T> operator-(const Plane<T>& x, const Plane<T>& y) { return {x.a - y.a, x.b - y.b, x.shear - y.shear}; }
/// s : e
template <class T> T work(const Plane<T>& s, const Plane<T>& e) { return s.a * e.a + s.b * e.b + s.shear * e.shear; }

/// By what the amplitudes z of the modes make strains of the fibres: a_i u_i, a_i = `slopes` of one_point.h.
template <class T, int D> struct Fibres {
  Vector<T, D> along[D];

  Fibres() = default;
  /// base: in which the components that are kept are given. With the vectors E_m of the start they take z; with x^m, since
  /// z_alpha,m = x^m . sum_a h_alpha,a x_a - start_alpha,m, they take the sums of the modes.
  template <class Items> Fibres(const Items& constants, const Vector<T, D>* base) {
    repeat<D>([&](auto i) {
      repeat<D>([&](auto m) {
        T component;
        load(constants, OnePoint<D>::fibres + D * i + m, component);
        if constexpr (m == 0) along[i] = component * base[m];
        else along[i] += component * base[m];
      });
    });
  }
};

/// Of the angle between the fibres u_i and u_j of the plane across coordinate d: one_point.h.
template <class T> struct Skew {
  T cotangent, over_sine2, first, second;
  template <class Items> Skew(const Items& constants, int d) {
    constexpr int at = OnePoint<3>::skew;
    load(constants, at + 4 * d, cotangent);
    load(constants, at + 4 * d + 1, over_sine2);
    load(constants, at + 4 * d + 2, first);
    load(constants, at + 4 * d + 3, second);
  }
};

/// e_d and e_m from z, and the transposed map.
///
/// In 3D the strains of the fibres are at hand first, A = a_i u_i . z_j, B = a_j u_j . z_i, and C/sin their shear over the sine;
/// with t_1 = u_i and t_2 = (u_j - cos u_i)/sin the components along t_1 and t_2 follow:
///   e_11 = A,  2 e_12 = C/sin - 2 cot A,  e_22 = B/sin^2 - cot (2 e_12 + cot A).
template <class T, int D> struct HourglassStrain {
  Plane<T> plane[D];
  T warp[3];  ///< 3D: of the last mode

  void from(const Vector<T, D>* z, const Fibres<T, D>& f, const double* constants) {
    if constexpr (D == 2) {
      repeat<2>([&](auto i) { plane[i] = {dot(f.along[i], z[0]), T(0), T(0)}; });
    } else {
      repeat<3>([&](auto d) {
        constexpr int i = (d + 1) % 3, j = (d + 2) % 3;
        const Skew<T> skew(constants, d);
        Plane<T>& e = plane[d];
        e.a = dot(f.along[i], z[j]);
        e.shear = skew.first * dot(f.along[i], z[i]) + skew.second * dot(f.along[j], z[j]) - T(2) * skew.cotangent * e.a;
        e.b = skew.over_sine2 * dot(f.along[j], z[i]) - skew.cotangent * (e.shear + skew.cotangent * e.a);
        warp[d] = dot(f.along[d], z[3]);
      });
    }
  }
  /// Number by number.
  void set(const HourglassStrain& s) {
    repeat<D>([&](auto d) {
      plane[d].a = s.plane[d].a;
      plane[d].b = s.plane[d].b;
      if constexpr (D == 2) {
        plane[d].shear = T(0);
      } else {
        plane[d].shear = s.plane[d].shear;
        warp[d] = s.warp[d];
      }
    });
  }
  void clear() {
    repeat<D>([&](auto d) { plane[d] = {T(0), T(0), T(0)}; });
    if constexpr (D == 3) repeat<3>([&](auto d) { warp[d] = T(0); });
  }
  void add(const T& w, const HourglassStrain& s) {
    repeat<D>([&](auto d) {
      plane[d].a += w * s.plane[d].a;
      plane[d].b += w * s.plane[d].b;
      if constexpr (D == 3) {
        plane[d].shear += w * s.plane[d].shear;
        warp[d] += w * s.warp[d];
      }
    });
  }
  /// The sum of their squares, of a ring without the hoops.
  T square() const {
    if constexpr (D == 2) {
      return plane[0].a * plane[0].a + plane[1].a * plane[1].a;
    } else {
      T sum(0), second(0);
      repeat<3>([&](auto d) {
        sum += plane[d].a * plane[d].a;
        second += warp[d] * warp[d];
        sum += plane[d].b * plane[d].b;
        second += plane[d].shear * plane[d].shear;
      });
      return sum + second;
    }
  }
  /// With stresses in place of strains, those of the last mode over 3: 3 dU/dz per volume.
  void gradient(const Fibres<T, D>& f, const double* constants, Vector<T, D>* g) const {
    if constexpr (D == 2) {
      g[0] = plane[0].a * f.along[0];
      g[0] += plane[1].a * f.along[1];
    } else {
      repeat<3>([&](auto d) {
        constexpr int i = (d + 1) % 3, j = (d + 2) % 3;
        const Skew<T> skew(constants, d);
        const Plane<T>& s = plane[d];
        const T shear = s.shear - skew.cotangent * s.b, a = s.a - skew.cotangent * (skew.cotangent * s.b + T(2) * shear);
        const auto add = [&](auto k, const T& by_i, const T& by_j) {  // the first time g_k is set: that of d = 0 has none yet, nor j of d = 1
          constexpr bool first = d == 0 || (d == 1 && k == (d + 2) % 3);
          if constexpr (first) g[k] = by_i * f.along[i];
          else g[k] += by_i * f.along[i];
          g[k] += by_j * f.along[j];
        };
        add(std::integral_constant<int, i>(), skew.first * shear, skew.over_sine2 * s.b);
        add(std::integral_constant<int, j>(), a, skew.second * shear);
        if constexpr (d == 0) g[3] = warp[d] * f.along[d];
        else g[3] += warp[d] * f.along[d];
      });
    }
  }
};

/// g = dU/dz per volume of an elastic cell. fibres: those that take z.
template <int D> void hourglass_stiffness(const SolidConstants& m, const Fibres<double, D>& fibres, const double* constants, const Vector<double, D>* z, Vector<double, D>* g) {
  const PlaneModuli moduli(m);
  HourglassStrain<double, D> e, s;
  e.from(z, fibres, constants);
  for (int d = 0; d < D; ++d) s.plane[d] = moduli.stress(e.plane[d]);
  if constexpr (D == 3)
    for (int d = 0; d < 3; ++d) s.warp[d] = moduli.E / 3 * e.warp[d];
  s.gradient(fibres, constants, g);
  for (int k = 0; k < OnePoint<D>::modes; ++k) g[k] = 1.0 / 3 * g[k];
}

}  // namespace forming_sim
