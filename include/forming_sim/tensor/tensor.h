#pragma once
// Vectors and symmetric tensors of the direct notation, over a scalar T that is
// a double or a Pack. D = 2: vectors have two components, tensors keep their 33
// component. The third direction of such an element is a unit vector in plane
// strain, and the hoop of a ring where the section is turned about the y axis.
#include "forming_sim/tensor/pack.h"
#include "forming_sim/tensor/repeat.h"

namespace forming_sim {

template <class T, int D> struct Vector {
  T c[D];
  T& operator[](int i) { return c[i]; }
  const T& operator[](int i) const { return c[i]; }
  friend Vector operator+(const Vector& a, const Vector& b) {
    Vector r;
    repeat<D>([&](auto i) { r.c[i] = a.c[i] + b.c[i]; });
    return r;
  }
  friend Vector operator-(const Vector& a, const Vector& b) {
    Vector r;
    repeat<D>([&](auto i) { r.c[i] = a.c[i] - b.c[i]; });
    return r;
  }
  friend Vector operator-(const Vector& a) {
    Vector r;
    repeat<D>([&](auto i) { r.c[i] = -a.c[i]; });
    return r;
  }
  Vector& operator+=(const Vector& b) {
    repeat<D>([&](auto i) { c[i] += b.c[i]; });
    return *this;
  }
  Vector& operator-=(const Vector& b) {
    repeat<D>([&](auto i) { c[i] -= b.c[i]; });
    return *this;
  }
  friend Vector operator*(const T& s, const Vector& a) {
    Vector r;
    repeat<D>([&](auto i) { r.c[i] = s * a.c[i]; });
    return r;
  }
};

template <class T, int D> T dot(const Vector<T, D>& a, const Vector<T, D>& b) {
  T s = a[0] * b[0] + a[1] * b[1];
  if constexpr (D == 3) s += a[2] * b[2];
  return s;
}
template <class T> Vector<T, 3> cross(const Vector<T, 3>& a, const Vector<T, 3>& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

/// Symmetric tensor. D = 2: xx yy zz xy; D = 3: xx yy zz xy yz zx.
template <class T, int D> struct Symmetric {
  static constexpr int size = D == 2 ? 4 : 6;
  T c[size];
  T& operator[](int i) { return c[i]; }
  const T& operator[](int i) const { return c[i]; }
};

template <class T, int D> T trace(const Symmetric<T, D>& a) { return a[0] + a[1] + a[2]; }

/// A - tr(A)/3 I, also in plane strain.
template <class T, int D> Symmetric<T, D> deviator(const Symmetric<T, D>& a) {
  const T mean = trace(a) * T(1.0 / 3);
  Symmetric<T, D> r;
  repeat<Symmetric<T, D>::size>([&](auto i) {
    if constexpr (i < 3) r[i] = a[i] - mean;
    else r[i] = a[i];
  });
  return r;
}
/// A : B
template <class T, int D> T contract(const Symmetric<T, D>& a, const Symmetric<T, D>& b) {
  T off = a[3] * b[3];
  if constexpr (D == 3) off += a[4] * b[4] + a[5] * b[5];
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + T(2) * off;
}
/// von Mises norm q = sqrt(3/2 A_D : A_D) of a deviator.
template <class T, int D> T mises(const Symmetric<T, D>& deviator) {
  return sqrt(T(1.5) * contract(deviator, deviator));
}
template <class T, int D> Vector<T, D> operator*(const Symmetric<T, D>& a, const Vector<T, D>& x) {
  if constexpr (D == 2) {
    return {{a[0] * x[0] + a[3] * x[1], a[3] * x[0] + a[1] * x[1]}};
  } else {
    return {{a[0] * x[0] + a[3] * x[1] + a[5] * x[2], a[3] * x[0] + a[1] * x[1] + a[4] * x[2],
             a[5] * x[0] + a[4] * x[1] + a[2] * x[2]}};
  }
}
/// Cofactors of A (symmetric): A^-1 = cofactor / det.
template <class T, int D> Symmetric<T, D> cofactor(const Symmetric<T, D>& a) {
  Symmetric<T, D> r;
  if constexpr (D == 2) {
    r[0] = a[1] * a[2];
    r[1] = a[0] * a[2];
    r[2] = a[0] * a[1] - a[3] * a[3];
    r[3] = -(a[3] * a[2]);
  } else {
    r[0] = a[1] * a[2] - a[4] * a[4];
    r[1] = a[0] * a[2] - a[5] * a[5];
    r[2] = a[0] * a[1] - a[3] * a[3];
    r[3] = a[5] * a[4] - a[3] * a[2];
    r[4] = a[3] * a[5] - a[0] * a[4];
    r[5] = a[3] * a[4] - a[5] * a[1];
  }
  return r;
}
/// det A from A and its cofactors.
template <class T, int D> T determinant(const Symmetric<T, D>& a, const Symmetric<T, D>& cofactors) {
  if constexpr (D == 2) return a[2] * cofactors[2];
  else return a[0] * cofactors[0] + a[3] * cofactors[3] + a[5] * cofactors[5];
}

/// Edge vectors of an element that are stored: those of the simplex, and the hoop of a ring.
template <int D, bool Ring> constexpr int kEdges = D + (Ring ? 1 : 0);

constexpr double kTwoPi = 6.28318530717958647692;

/// The edge vectors x_1 .. x_D of a simplex (3.14), their reciprocal vectors
/// x^1 .. x^D (3.27), (3.28), and the volume V (3.18), (3.19), D = 2: area A.
///
/// Ring (D = 2): the triangle turned about the y axis. Its third edge vector is the
/// hoop per radian, x_3 = r e_3, r the mean radius of the corners, kept as x[2] = (r, 0);
/// x^3 = e_3 / r as up[2] = (1/r, 0); V = 2 pi r A, the whole circle.
template <class T, int D, bool Ring = false> struct Edges {
  Vector<T, D> x[kEdges<D, Ring>];   ///< x_m
  Vector<T, D> normal[kEdges<D, Ring>];  ///< det x^m
  T det;                             ///< x_1 . (x_2 x x_3), of a plane simplex with x_3 = e_3
  Vector<T, D> up[kEdges<D, Ring>];  ///< x^m, only where find_reciprocal was asked
  T volume;                          ///< likewise
};

/// V over det.
template <int D, bool Ring> constexpr double kVolumePart = D == 3 ? 1.0 / 6 : Ring ? 0.5 * kTwoPi : 0.5;

/// V alone.
template <class T, int D, bool Ring = false> T simplex_volume(const Vector<T, D>* x) {
  const T part(kVolumePart<D, Ring>);
  if constexpr (Ring) return part * x[2][0] * (x[0][0] * x[1][1] - x[0][1] * x[1][0]);
  else if constexpr (D == 2) return part * (x[0][0] * x[1][1] - x[0][1] * x[1][0]);
  else return part * dot(x[0], cross(x[1], x[2]));
}

/// det and det x^m, products of the edges without a division.
template <class T, int D, bool Ring> void find_normals(Edges<T, D, Ring>& e) {
  if constexpr (D == 3) {
    e.normal[0] = cross(e.x[1], e.x[2]);
    e.normal[1] = cross(e.x[2], e.x[0]);
    e.normal[2] = cross(e.x[0], e.x[1]);
  } else {
    e.normal[0] = {{e.x[1][1], -e.x[1][0]}};
    e.normal[1] = {{-e.x[0][1], e.x[0][0]}};
    if constexpr (Ring) {
      e.normal[2] = {{dot(e.x[0], e.normal[0]), T(0)}};
      for (int m = 0; m < 2; ++m) e.normal[m] = e.x[2][0] * e.normal[m];
    }
  }
  e.det = dot(e.x[0], e.normal[0]);
}

template <class T, int D, bool Ring> void find_reciprocal(Edges<T, D, Ring>& e) {
  find_normals(e);
  const T inverse = T(1) / e.det;
  repeat<kEdges<D, Ring>>([&](auto m) { e.up[m] = inverse * e.normal[m]; });
  e.volume = T(kVolumePart<D, Ring>) * e.det;
}

/// What the length of an element follows from: its volume; in a ring, too, the area of its section.
template <class T, int D, bool Ring> T extent(const Edges<T, D, Ring>& e) {
  if constexpr (Ring) return e.volume * e.up[2][0] * T(1 / kTwoPi);
  else return e.volume;
}

/// y^m = G^mk x_k.
template <class T, int D, bool Ring> [[gnu::always_inline]] inline void raise(const Symmetric<T, D>& G, const Edges<T, D, Ring>& e, Vector<T, D>* y) {
  repeat<D>([&](auto i) {
    if constexpr (D == 2) {
      y[0][i] = G[0] * e.x[0][i] + G[3] * e.x[1][i];
      y[1][i] = G[3] * e.x[0][i] + G[1] * e.x[1][i];
    } else {
      y[0][i] = G[0] * e.x[0][i] + G[3] * e.x[1][i] + G[5] * e.x[2][i];
      y[1][i] = G[3] * e.x[0][i] + G[1] * e.x[1][i] + G[4] * e.x[2][i];
      y[2][i] = G[5] * e.x[0][i] + G[4] * e.x[1][i] + G[2] * e.x[2][i];
    }
  });
}
/// B = x_m x_k G^mk (3.36) = x_m y^m; plane strain: B_33 = G^33, ring: r^2 G^33.
template <class T, int D, bool Ring> [[gnu::always_inline]] inline Symmetric<T, D> push(const Symmetric<T, D>& G, const Edges<T, D, Ring>& e, const Vector<T, D>* y) {
  Symmetric<T, D> B;
  if constexpr (D == 2) {
    B[0] = e.x[0][0] * y[0][0] + e.x[1][0] * y[1][0];
    B[1] = e.x[0][1] * y[0][1] + e.x[1][1] * y[1][1];
    B[2] = G[2];
    if constexpr (Ring) B[2] *= e.x[2][0] * e.x[2][0];
    B[3] = e.x[0][0] * y[0][1] + e.x[1][0] * y[1][1];
  } else {
    repeat<6>([&](auto k) {
      constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
      B[k] = e.x[0][row[k]] * y[0][column[k]] + e.x[1][row[k]] * y[1][column[k]] + e.x[2][row[k]] * y[2][column[k]];
    });
  }
  return B;
}
template <class T, int D, bool Ring> [[gnu::always_inline]] inline Symmetric<T, D> push(const Symmetric<T, D>& G, const Edges<T, D, Ring>& e) {
  Vector<T, D> y[D];
  raise(G, e, y);
  return push(G, e, y);
}

/// s^2 G^x from the s x^m, G^x the components x^m . x^k; plane strain: G^33 = 1, ring: 1/r^2.
template <int D, bool Ring, class T> [[gnu::always_inline]] inline Symmetric<T, D> metric_of(const Vector<T, D>* x, const T& s) {
  Symmetric<T, D> A;
  A[0] = dot(x[0], x[0]);
  A[1] = dot(x[1], x[1]);
  A[3] = dot(x[0], x[1]);
  if constexpr (D == 2) {
    if constexpr (Ring) A[2] = x[2][0] * x[2][0];
    else A[2] = s * s;
  } else {
    A[2] = dot(x[2], x[2]);
    A[4] = dot(x[1], x[2]);
    A[5] = dot(x[2], x[0]);
  }
  return A;
}
/// det^2 G^x.
template <class T, int D, bool Ring> Symmetric<T, D> metric_of_normals(const Edges<T, D, Ring>& e) { return metric_of<D, Ring>(e.normal, e.det); }

}  // namespace forming_sim
