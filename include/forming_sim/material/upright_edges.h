#pragma once
// The trial state of a layer from its memory without B: what several layers of a point need of its edges is made once.
//
// The edges are made upright to each other (Gram and Schmidt),
//   x_0 = a_0,  x_1 = l_10 a_0 + a_1,  x_2 = l_20 a_0 + l_21 a_1 + a_2,   a_i . a_j = 0 for i != j,  a_i . a_i = d_i,
// so that (3.36) reads B = x_m x_k G^mk = a_i a_j C^ij with C = L^T G L, and in the directions of the a_i
//   B_ii = d_i C^ii,  B_ij^2 = d_i d_j C^ij^2,  B_01 B_12 B_20 = d_0 d_1 d_2 C^01 C^12 C^20:
// trace, D : D and det D follow without a root and without the components in space. With A = det^2 G^x,
//   d_0 d_1 = A^22,  d_0 d_1 d_2 = det^2,  l_21 = -A^12 / A^22,
// products of the normals: of flat elements the differences of near numbers are taken once, in the normals, as in every reciprocal vector.
#include "forming_sim/material/von_mises.h"

namespace forming_sim {

/// Of one point; plane strain: d_2 = 1, ring: r^2.
template <class T, int D> struct UprightEdges {
  T l[D == 3 ? 3 : 1];     ///< l_10, l_20, l_21
  T d[3];
};

/// e: with its normals.
template <class T, int D, bool Ring> [[gnu::always_inline]] inline UprightEdges<T, D> find_upright(const Edges<T, D, Ring>& e) {
  UprightEdges<T, D> at;
  const Symmetric<T, D> A = metric_of_normals(e);
  const T det2 = e.det * e.det;
  at.d[0] = dot(e.x[0], e.x[0]);
  const T over_d0 = T(1) / at.d[0];
  at.l[0] = dot(e.x[0], e.x[1]) * over_d0;
  if constexpr (D == 2) {
    at.d[1] = (Ring ? e.normal[2][0] * e.normal[2][0] : det2) * over_d0;
    at.d[2] = Ring ? e.x[2][0] * e.x[2][0] : T(1);
  } else {
    const T over_A = T(1) / A[2];
    at.l[1] = dot(e.x[0], e.x[2]) * over_d0;
    at.l[2] = -(A[4] * over_A);
    at.d[1] = A[2] * over_d0;
    at.d[2] = det2 * over_A;
  }
  return at;
}

/// G: the memory of the layer.
template <class T, int D> [[gnu::always_inline]] inline void find_trial(const Symmetric<T, D>& G, const UprightEdges<T, D>& at, Trial<T>& trial) {
  T b0, b1, b2;           // B_ii, and then those of D
  T p01, p12(0), p20(0);  // B_ij^2
  T triple(0);            // B_01 B_12 B_20
  if constexpr (D == 2) {
    const T C01 = G[3] + at.l[0] * G[1], C00 = (G[0] + at.l[0] * G[3]) + at.l[0] * C01;
    b0 = at.d[0] * C00;
    b1 = at.d[1] * G[1];
    b2 = at.d[2] * G[2];
    p01 = (at.d[0] * C01) * (at.d[1] * C01);
  } else {
    const T &l10 = at.l[0], &l20 = at.l[1], &l21 = at.l[2];
    const T w0 = G[0] + l10 * G[3] + l20 * G[5], w1 = G[3] + l10 * G[1] + l20 * G[4], w2 = G[5] + l10 * G[4] + l20 * G[2];
    const T C00 = w0 + l10 * w1 + l20 * w2, C01 = w1 + l21 * w2;
    const T C12 = G[4] + l21 * G[2], C11 = (G[1] + l21 * G[4]) + l21 * C12;
    b0 = at.d[0] * C00;
    b1 = at.d[1] * C11;
    b2 = at.d[2] * G[2];
    const T e01 = at.d[0] * C01, e12 = at.d[1] * C12, e20 = at.d[2] * w2;
    p01 = e01 * (at.d[1] * C01);
    p12 = e12 * (at.d[2] * C12);
    p20 = e20 * (at.d[0] * w2);
    triple = e01 * e12 * e20;
  }
  const T s = (b0 + b1 + b2) * T(1.0 / 3);
  b0 = b0 - s;
  b1 = b1 - s;
  b2 = b2 - s;
  const T squares = b0 * b0 + b1 * b1 + b2 * b2;
  trial.s = s;
  trial.m = squares + T(2) * (D == 2 ? p01 : p01 + p12 + p20);
  trial.d = D == 2 ? b2 * (b0 * b1 - p01) : b0 * (b1 * b2 - p12) - b1 * p20 - b2 * p01 + T(2) * triple;
}

}  // namespace forming_sim
