#pragma once
// How the stress of a simplex pulls at its edges: the force on edge m is -V sigma . x^m. Both forms of it are
// asked for on(e, m) = V sigma . x^m, e with its normals det x^m, and take a pressure.
#include "forming_sim/tensor/tensor.h"

namespace forming_sim {

/// From the stress.
template <class T, int D, bool Ring> struct StressPull {
  Symmetric<T, D> share;  ///< V/det sigma

  void add(const T& pressure) {
    const T part = T(kVolumePart<D, Ring>) * pressure;
    for (int c = 0; c < 3; ++c) share[c] += part;
  }
  Vector<T, D> on(const Edges<T, D, Ring>& e, int m) const { return share * e.normal[m]; }
  /// Of a ring: V sigma . x^3.
  T on_hoop(const Edges<T, D, true>& e) const { return e.normal[2][0] * share[2]; }
};

/// Of the stress factor A, Pa.
template <int D, bool Ring, class T> [[gnu::always_inline]] inline StressPull<T, D, Ring> pull_of(const Symmetric<T, D>& A, const T& factor = T(1)) {
  const T part = T(kVolumePart<D, Ring>) * factor;
  StressPull<T, D, Ring> pull;
  repeat<Symmetric<T, D>::size>([&](auto c) { pull.share[c] = part * A[c]; });
  return pull;
}

/// From a deviator f (B - s I) in space, where B x^m = x_k G^kl x_l . x^m = y^m, so that S is not needed:
/// V S . x^m = V f y^m - V/det f s (det x^m).
template <class T> struct WayPull {
  const Vector<T, 3>* y;  ///< y^m
  T along, across;        ///< V f, and what the normals are multiplied by

  void add(const T& pressure) { across += T(kVolumePart<3, false>) * pressure; }
  Vector<T, 3> on(const Edges<T, 3>& e, int m) const {
    Vector<T, 3> force = along * y[m];
    force += across * e.normal[m];
    return force;
  }
};
/// Of f y^m and f s; y: y^m; e: with its normals.
template <class T> [[gnu::always_inline]] inline WayPull<T> pull_of_ways(const Edges<T, 3>& e, const Vector<T, 3>* y, const T& f, const T& f_s) {
  const T part(kVolumePart<3, false>);
  return {y, part * f * e.det, -(part * f_s)};
}

}  // namespace forming_sim
