#pragma once
// Does small motion grow in an elastic body that slides on a rigid line under Coulomb friction?
//
// Plane strain, x along the line in the direction of the slip, y off it. Every node of the base is pressed and slips the same
// way, so that u_y = 0 there, the line presses with the change of force N = (K u)_y, and friction is -mu N along x:
//   m u_x'' = -[(K u)_x + mu (K u)_y]    at the base
//   m u''   = -K u                       elsewhere
// or u'' = -A u. A is not symmetric: friction takes a row of y without its column. Where all its eigenvalues lambda are real and
// not negative nothing grows. A pair of complex ones is a swing that does, as e^(s t) with s^2 + alpha s + lambda = 0, alpha the
// damping per mass. Without damping it grows at |Im lambda| / (2 sqrt(Re lambda)), where that is small beside the frequency;
// damping ends it from alpha = |Im lambda| / sqrt(Re lambda) on: twice that rate.
//
// Nothing here is of the package's contact or time loop: K and the masses are those of its elements.
#include <algorithm>
#include <cmath>
#include <complex>

#include "forming_sim/contact/shear_waves.h"
#include "support/dense_limit.h"

namespace forming_sim::slide {

using Complex = std::complex<double>;

/// lambda, 1/s2, of a body in plane strain at x whose nodes `base` lie on the line.
inline Eigen::VectorXcd eigenvalues(Elements& elements, const NodeField& x, const std::vector<int>& base, double mu) {
  const Eigen::MatrixXd K = stiffness_over_mass(elements, x, 2);
  const auto of_base = [&](int component) { return std::find(base.begin(), base.end(), component / 2) != base.end(); };
  std::vector<int> free;
  for (int c = 0; c < K.rows(); ++c)
    if (!of_base(c) || c % 2 == 0) free.push_back(c);
  const int n = static_cast<int>(free.size());
  Eigen::MatrixXd A(n, n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) A(r, c) = K(free[r], free[c]) + (of_base(free[r]) ? mu * K(free[r] + 1, free[c]) : 0.0);
  return Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues();
}

/// What damps the swing (contact/shear_waves.h), where contact has lasted, of a body that does not move as a whole.
struct Damped {
  bool waves = true, delay = true;
  double impedance, time;  ///< rho c_s, Pa s/m; T, s
};

/// The largest real part of s, 1/s, with it. area: that the nodes of the base stand for, m2 per m of width.
///   m u_x'' = -(K u)_x - mu N_d - z A (u_x' - s),   N_d' = ((K u)_y - N_d)/T_N,   s' = (u_x' - s)/T     at the base
inline double fastest_growth(Elements& elements, const NodeField& x, const std::vector<int>& base, const std::vector<double>& area, double mu, const Damped& damped) {
  const Eigen::MatrixXd K = stiffness_over_mass(elements, x, 2);
  const auto of_base = [&](int component) { return std::find(base.begin(), base.end(), component / 2) != base.end(); };
  std::vector<int> free;
  for (int c = 0; c < K.rows(); ++c)
    if (!of_base(c) || c % 2 == 0) free.push_back(c);
  const int n = static_cast<int>(free.size()), b = static_cast<int>(base.size());
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(2 * n + 2 * b, 2 * n + 2 * b);  // u, u', N_d over the root of m, s
  S.block(0, n, n, n).setIdentity();
  for (int r = 0, k = 0; r < n; ++r) {
    for (int c = 0; c < n; ++c) S(n + r, c) = -K(free[r], free[c]);
    if (!of_base(free[r])) continue;
    const int memory = 2 * n + k, steady = 2 * n + b + k;
    for (int c = 0; c < n; ++c) {
      const double N = K(free[r] + 1, free[c]);
      (damped.delay ? S(memory, c) : S(n + r, c)) += damped.delay ? N / (kMemoryShare * damped.time) : -mu * N;
    }
    S(memory, memory) = -1 / (kMemoryShare * damped.time);
    if (damped.delay) S(n + r, memory) = -mu;
    const double beta = damped.waves ? damped.impedance * area[k] / elements.nodal_mass()[free[r] / 2] : 0;
    S(n + r, n + r) -= beta;
    S(n + r, steady) = beta;
    S(steady, n + r) = 1 / damped.time;
    S(steady, steady) = -1 / damped.time;
    ++k;
  }
  return Eigen::EigenSolver<Eigen::MatrixXd>(S, false).eigenvalues().real().maxCoeff();
}

/// s of the solution e^(s t) that grows faster, 1/s.
inline Complex growth(Complex lambda, double alpha) {
  const Complex root = std::sqrt(0.25 * alpha * alpha - lambda);
  return (root.real() < 0 ? -root : root) - 0.5 * alpha;
}
/// The same by steps of dt, v (1 + a/2) = v_before (1 - a/2) - dt A u with a = alpha dt, then u += dt v: of z = e^(s dt),
/// (1 + a/2) z^2 - (2 - lambda dt^2) z + 1 - a/2 = 0.
inline Complex growth(Complex lambda, double alpha, double dt) {
  const double a = alpha * dt;
  const Complex b = 2.0 - lambda * dt * dt, root = std::sqrt(b * b - (4 - a * a));
  const Complex z1 = (b + root) / (2 + a), z2 = (b - root) / (2 + a);
  return std::log(std::abs(z1) > std::abs(z2) ? z1 : z2) / dt;
}

/// The one that grows most without damping, of positive frequency. The motion as a whole along the line, lambda = 0, is none.
inline Complex fastest_growing(const Eigen::VectorXcd& lambda) {
  const double least = 1e-9 * lambda.cwiseAbs().maxCoeff();
  Complex most(0, 0);
  double rate = 0;
  for (const Complex& l : lambda)
    if (std::abs(l) > least && l.imag() > 0 && growth(l, 0).real() > rate) rate = growth(l, 0).real(), most = l;
  return most;
}

}  // namespace forming_sim::slide
