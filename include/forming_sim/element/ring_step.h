#pragma once
// The stiffness bound of a ring element: a triangle turned about the y axis.
//
// Its strains are e_rr, e_yy, 2 e_ry from the shape gradients g_a, and the hoop strain
// e_33 = sum_a u_ra / (3r). With equal shares of the mass and no node held, the part of
// g_a that couples e_33 with the others sums to zero (sum_a g_a = 0) and S of
// time_step.h has S_33 = 1/(3 r^2). But a node on the axis does not move radially, and
// the shares are not equal (elements.cpp): both are told by `inertia`. The deviatoric
// strain has three components in an orthonormal basis,
//   (e_rr - e_yy)/sqrt2,  (e_rr + e_yy - 2 e_33)/sqrt6,  2 e_ry/sqrt2,
// linear in the nodal displacements with the coefficients c_a (radial) and d_a (axial);
// the stiffness 2 mu dev(e) has the eigenvalues (d+1)/rho 2 mu times those of
//   M = sum_a inertia_ra c_a c_a^T + inertia_ya d_a d_a^T.
#include "forming_sim/tensor/tensor.h"

namespace forming_sim {

/// Upper bound on the largest eigenvalue of a symmetric tensor that has no negative one:
/// t/3 + 2/3 sqrt(t^2 - 3 m) (t the trace, m the sum of the principal minors), then
/// Newton's method on the characteristic polynomial, which falls from there and never
/// passes the root.
template <class T> T largest_eigenvalue(const Symmetric<T, 3>& M) {
  const Symmetric<T, 3> cof = cofactor(M);
  const T t = trace(M), m = trace(cof), d = determinant(M, cof);
  T x = (t + T(2.0) * sqrt(larger(t * t - T(3.0) * m, T(0.0)))) * T(1.0 / 3);
  for (int i = 0; i < 4; ++i) {
    const T value = ((x - t) * x + m) * x - d, slope = (T(3.0) * x - T(2.0) * t) * x + m;
    x -= larger(value, T(0.0)) / larger(slope, T(1e-6) * x * x);
  }
  return x;
}

/// M grows by a node with the shape gradient (gr, gz), hoop = d e_33/d u_r and these inverse masses.
template <class T> void add_deviatoric(Symmetric<T, 3>& M, const T& radial, const T& axial, const T& gr, const T& gz, const T& hoop) {
  const double half = 0.70710678118654752, sixth = 0.40824829046386302;  // 1/sqrt2, 1/sqrt6
  const auto add = [&](const T& w, const T& p, const T& q, const T& s) {
    M[0] += w * p * p;
    M[1] += w * q * q;
    M[2] += w * s * s;
    M[3] += w * p * q;
    M[4] += w * q * s;
    M[5] += w * s * p;
  };
  add(radial, T(half) * gr, T(sixth) * (gr - T(2.0) * hoop), T(half) * gz);
  add(axial, T(-half) * gz, T(sixth) * gz, T(half) * gr);
}

/// Of one ring element: the inverse masses of its corners over 3/(rho V0), radial and
/// axial (0: held), the shape gradients g and hoop = 1/(3r).
template <class T> struct RingShapes {
  Vector<T, 2> g[3], inertia[3];
  T hoop;

  /// 2 lambda_max(M): stands for max(2 (I1/3 + sqrt(I1^2/9 - I2/3)), s1 + s2) of time_step.h.
  T deviatoric() const {
    Symmetric<T, 3> M;
    for (int i = 0; i < 6; ++i) M[i] = T(0.0);
    for (int a = 0; a < 3; ++a) add_deviatoric(M, inertia[a][0], inertia[a][1], g[a][0], g[a][1], hoop);
    return T(2.0) * largest_eigenvalue(M);
  }

  /// sum_a |dV/dx_a|^2 / (V^2 m_a), likewise: stands for tr S.
  T volumetric() const {
    T sum(0.0);
    for (int a = 0; a < 3; ++a)
      sum += inertia[a][0] * (g[a][0] + hoop) * (g[a][0] + hoop) + inertia[a][1] * g[a][1] * g[a][1];
    return sum;
  }
};

}  // namespace forming_sim
