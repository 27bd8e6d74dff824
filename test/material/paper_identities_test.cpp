// The identities of the paper's appendices, by the package's own tensors: A.6, B.4, B.5
// and C.2, each for a number of random vectors and tensors.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "forming_sim/material/classical.h"
#include "forming_sim/material/hyperelastic.h"

namespace forming_sim {
namespace {

constexpr int kSamples = 200;

class Random {
 public:
  double number() { return along_(engine_); }
  template <int D> Symmetric<double, D> symmetric() {
    Symmetric<double, D> A;
    for (int i = 0; i < Symmetric<double, D>::size; ++i) A[i] = number();
    return A;
  }
  /// Right-handed edges that are not nearly flat.
  template <int D> Edges<double, D> edges() {
    Edges<double, D> e;
    do {
      for (int m = 0; m < D; ++m)
        for (int i = 0; i < D; ++i) e.x[m][i] = number();
    } while (simplex_volume<double, D>(e.x) < 0.02);
    find_reciprocal(e);
    return e;
  }

 private:
  std::mt19937 engine_{7};
  std::uniform_real_distribution<double> along_{-1, 1};
};

/// Components [row][column] of a symmetric tensor.
template <int D> double at(const Symmetric<double, D>& A, int i, int j) {
  if (i == j) return A[i];
  if (D == 2) return i + j == 1 ? A[3] : 0;
  return A[i + j == 1 ? 3 : i + j == 3 ? 4 : D == 3 ? 5 : 0];
}

template <int D> double J2(const Symmetric<double, D>& A) { return trace(cofactor(A)); }

// ---------------------------------------------------------------- A: invariants

/// J2 as the sum of minors is 1/2 [J1^2(A) - J1(A^2)], J3 = 1/6 [J1^3 - 3 J1 J1(A^2) + 2 J1(A^3)].
template <int D> void check_invariants() {
  Random random;
  for (int n = 0; n < kSamples; ++n) {
    const Symmetric<double, D> A = random.symmetric<D>(), A2 = square(A);
    const double J1 = trace(A), J1_2 = trace(A2), J1_3 = contract(A2, A);
    EXPECT_NEAR(J2(A), 0.5 * (J1 * J1 - J1_2), 1e-13);
    EXPECT_NEAR(contract(A, A), J1_2, 1e-13);
    EXPECT_NEAR(determinant(A, cofactor(A)), (J1 * J1 * J1 - 3 * J1 * J1_2 + 2 * J1_3) / 6, 1e-13);
  }
}
TEST(AppendixA, InvariantsInSpace) { check_invariants<3>(); }
TEST(AppendixA, InvariantsInPlaneStrain) { check_invariants<2>(); }

/// (A.6): J1(A_D) = 0, J2(A_D) = 1/6 J1^2(A) - 1/2 J1(A^2); the norm is sqrt(-3 J2(A_D)).
template <int D> void check_deviator() {
  Random random;
  for (int n = 0; n < kSamples; ++n) {
    const Symmetric<double, D> A = random.symmetric<D>(), A_D = deviator(A);
    const double J1 = trace(A), expected = J1 * J1 / 6 - 0.5 * trace(square(A));
    EXPECT_NEAR(trace(A_D), 0, 1e-15);
    EXPECT_NEAR(J2(A_D), expected, 1e-14);
    EXPECT_NEAR(mises(A_D), std::sqrt(-3 * expected), 1e-13);
  }
}
TEST(AppendixA, DeviatorInSpace) { check_deviator<3>(); }
TEST(AppendixA, DeviatorInPlaneStrain) { check_deviator<2>(); }

// ---------------------------------------------------------------- B: reciprocal vectors

/// (B.4): x_k . x^m = delta_km, x_m x^m = x^m x_m = I, V(x_m) V(x^m) = (1/d!)^2; and (B.3):
/// the reciprocal vectors of the reciprocal vectors are the edges.
template <int D> void check_reciprocal() {
  Random random;
  for (int n = 0; n < kSamples; ++n) {
    const Edges<double, D> e = random.edges<D>();
    for (int k = 0; k < D; ++k)
      for (int m = 0; m < D; ++m) EXPECT_NEAR(dot(e.x[k], e.up[m]), k == m ? 1 : 0, 1e-12);
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) {
        double sum = 0, other = 0;
        for (int m = 0; m < D; ++m) {
          sum += e.x[m][i] * e.up[m][j];
          other += e.up[m][i] * e.x[m][j];
        }
        EXPECT_NEAR(sum, i == j ? 1 : 0, 1e-12);
        EXPECT_NEAR(other, i == j ? 1 : 0, 1e-12);
      }
    const double factorial = D == 2 ? 2 : 6;
    EXPECT_NEAR(factorial * (simplex_volume<double, D>(e.up)) * factorial * e.volume, 1, 1e-12);
    Edges<double, D> back;
    for (int m = 0; m < D; ++m) back.x[m] = e.up[m];
    find_reciprocal(back);
    for (int m = 0; m < D; ++m)
      for (int i = 0; i < D; ++i) EXPECT_NEAR(back.up[m][i], e.x[m][i], 1e-12);
  }
}
TEST(AppendixB, ReciprocalVectorsInSpace) { check_reciprocal<3>(); }
TEST(AppendixB, ReciprocalVectorsInThePlane) { check_reciprocal<2>(); }

/// G^x of an element: x^m . x^k.
template <int D> Symmetric<double, D> metric(const Edges<double, D>& e) {
  Symmetric<double, D> G = metric_of_normals(e);
  for (int i = 0; i < Symmetric<double, D>::size; ++i) G[i] /= e.det * e.det;
  return G;
}

/// (B.5): G^x . G_x = G_x . G^x = I and G^x : G_x = 3, G_x with the components x_i . x_j. In
/// plane strain the third direction is a unit vector of both.
template <int D> void check_metrics() {
  Random random;
  for (int n = 0; n < kSamples; ++n) {
    const Edges<double, D> e = random.edges<D>();
    Edges<double, D> swapped;
    for (int m = 0; m < D; ++m) swapped.x[m] = e.up[m];
    find_reciprocal(swapped);
    const Symmetric<double, D> up = metric(e), down = metric(swapped);
    const double size = std::sqrt(contract(up, up) * contract(down, down));
    EXPECT_NEAR(contract(up, down), 3, 1e-13 * size);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        double one = 0, other = 0;
        for (int k = 0; k < 3; ++k) {
          one += at(up, i, k) * at(down, k, j);
          other += at(down, i, k) * at(up, k, j);
        }
        EXPECT_NEAR(one, i == j ? 1 : 0, 1e-13 * size);
        EXPECT_NEAR(other, i == j ? 1 : 0, 1e-13 * size);
      }
    // and so B = I where the initial configuration is the actual one.
    const Symmetric<double, D> B = push(up, e);
    for (int i = 0; i < Symmetric<double, D>::size; ++i) EXPECT_NEAR(B[i], i < 3 ? 1 : 0, 1e-13 * size);
  }
}
TEST(AppendixB, MetricsInSpace) { check_metrics<3>(); }
TEST(AppendixB, MetricsInPlaneStrain) { check_metrics<2>(); }

// ---------------------------------------------------------------- C: the Jaumann rate

/// A tensor of constant components A_ks in a basis e'_k: the symmetric part of
/// x_m x_k A^mk with the basis as edges.
template <int D> Symmetric<double, D> in_basis(const Symmetric<double, D>& A, const Vector<double, D>* basis) {
  Edges<double, D> e;
  for (int m = 0; m < D; ++m) e.x[m] = basis[m];
  return push(A, e);
}

/// (C.1), (C.2): the rate of a tensor whose components stay in a basis that turns with the
/// angular velocity omega is gamma = A.Omega - Omega.A, Omega = epsilon . omega, which
/// classical.h takes from the velocities of an element's edges.
template <int D> void check_jaumann() {
  Random random;
  for (int n = 0; n < kSamples; ++n) {
    const Symmetric<double, D> A = random.symmetric<D>();
    const Vector<double, 3> omega{{D == 3 ? random.number() : 0, D == 3 ? random.number() : 0, random.number()}};
    // The basis at time t coincides with the fixed one; at t + h it has turned: e' = e cos + (n x e) sin + n (n . e)(1 - cos).
    const auto turned = [&](const Vector<double, 3>& x, double t) {
      const double rate = std::sqrt(dot(omega, omega)), c = std::cos(rate * t), s = std::sin(rate * t);
      const Vector<double, 3> axis = (1 / rate) * omega;
      Vector<double, 3> r = c * x;
      r += s * cross(axis, x);
      r += ((1 - c) * dot(axis, x)) * axis;
      return r;
    };
    const auto at_time = [&](double t) {
      Vector<double, D> basis[D];
      for (int m = 0; m < D; ++m) {
        Vector<double, 3> e{{m == 0 ? 1. : 0., m == 1 ? 1. : 0., m == 2 ? 1. : 0.}};
        e = turned(e, t);
        for (int i = 0; i < D; ++i) basis[m][i] = e[i];
      }
      return in_basis(A, basis);
    };
    // The edges of some element turn with the basis and stretch besides, which must not matter.
    const Edges<double, D> e = random.edges<D>();
    const Symmetric<double, D> stretching = random.symmetric<D>();
    Vector<double, D> velocity[D];
    for (int m = 0; m < D; ++m) {
      Vector<double, 3> x{{e.x[m][0], e.x[m][1], 0}};
      if constexpr (D == 3) x[2] = e.x[m][2];
      const Vector<double, 3> w = cross(omega, x);
      velocity[m] = stretching * e.x[m];
      for (int i = 0; i < D; ++i) velocity[m][i] += w[i];
    }
    const Symmetric<double, D> gamma = jaumann(Increment<double, D>(e, velocity), A);
    const double h = 1e-4;
    const Symmetric<double, D> plus = at_time(h), minus = at_time(-h);
    for (int i = 0; i < Symmetric<double, D>::size; ++i) EXPECT_NEAR(gamma[i], (plus[i] - minus[i]) / (2 * h), 1e-6) << i;
    // It turns the tensor only: trace and norm stay.
    EXPECT_NEAR(trace(gamma), 0, 1e-12);
    EXPECT_NEAR(contract(gamma, A), 0, 1e-12);
    if (n == 0) {
      EXPECT_GT(contract(gamma, gamma), 1e-3);
    }
  }
}
TEST(AppendixC, JaumannRateInSpace) { check_jaumann<3>(); }
TEST(AppendixC, JaumannRateInPlaneStrain) { check_jaumann<2>(); }

}  // namespace
}  // namespace forming_sim
