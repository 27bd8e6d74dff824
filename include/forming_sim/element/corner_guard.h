#pragma once
// What keeps a corner of a one-point cell from turning inside out.
//
// The mean deformation says nothing of a single corner, and what varies about it (element/hourglass.h) yields with the
// body: where one node is pressed into its cell the area there could become negative while V/V0 stays next to 1. Of
// every corner a
//   q_a = j_a / (c_a J),   j_a = det(e_i), e_i the cell's edges that meet there,  J = det(x_m),
// its share in the cell's area or volume over what that was at the start (c_a = j_a/J then), resists by
//   U = theta K V0 1/N sum_a q_0/4 u_a^4/(1 - u_a),   u_a = 1 - q_a/q_0, nothing where q_a >= q_0,
// N the number of corners: without bound where q_a comes to 0. Where a cell is stretched, sheared or compressed as a
// whole all q are 1. With
//   dq_a = 1/(c_a J) sum_i dj_a/de_i . de_i - q_a sum_m x^m . dx_m
// the forces are its gradient. J of a ring is that of its section.
//
// The resistance of a corner is theta K r, r = u^3 (4 - 3u)/(4 (1 - u)^2): at half of q_0 it is .03 K, what some eight
// times the yield stress of a metal is. q_0 leaves free what cells do in the tables of docs/speed_and_error.md.
//
// Rings are held up to u_1 only: beyond, r stays r(u_1), and U = ... q_0 [1/4 u_1^4/(1 - u_1) + r(u_1) (u - u_1)]. Billets that
// flow around an edge of a die (45 degrees, 10 or 20 cells a radius) have to fold their cells, those of crossed triangles too, whose
// corners come to q = -2 to -5; where none may pass 0 the billet cannot leave the die, and is compressed elastically in it. What
// varies across such cells fades (element/hourglass.h), and a corner inside out does not end the run.
//
// Of the stiffness, in the metric of the cell's own masses rho V0 share_b,
//   omega^2 <= theta K/(N rho) sum_a [ r'/q_0 |dq|^2 + r B ],  B >= the largest eigenvalue of -d2q,
//   r' = dr/du = u^2 (6 - 8u + 3u^2)/(2 (1 - u)^3),  |dq|^2 = sum_b |dq/dx_b|^2/share_b.
// With L = sum_b g_b (x) dx_b, g_b = sum_m w_mb x^m, d2J/J is (tr L)^2 - tr L^2, not larger than 2 |L|^2 <= 2 t,
// t = sum_b |g_b|^2/share_b, and with the smallest share
//   B = |d2j|/(c_a J share) + 2 |q| t + 2 |dq| sqrt(t),   |d2j| = sqrt 3 in a section, 4 sum_i |e_i| in space.
// The bound of a step takes the u that will be at its end (src/element/corner_pack.h).
//
// `near` of one_point.h: up to that square of the strains that vary across the cell no q can be below q_0, and nobody
// asks for it (src/element/corner_reach.h).
#include "forming_sim/element/one_point_sums.h"
#include "forming_sim/tensor/tensor.h"

namespace forming_sim {

constexpr double kCornerGuard = 0.1, kFreeCorner = 0.4;  ///< theta, q_0
constexpr double kHeldInRings = 0.25;  ///< u_1
constexpr double kPressedCorner = 0.2;  ///< below this q the stiffness grows so fast that every step asks for its limit (but in rings); the run tells how many cells there were
constexpr double kLeastCorner = 0.1;  ///< a corner with less than this part of its even share at the start has no guard

/// The corner next to a along each coordinate.
inline constexpr int kNextCorner[8][3] = {{1, 3, 4}, {0, 2, 5}, {3, 1, 6}, {2, 0, 7}, {5, 7, 0}, {4, 6, 1}, {7, 5, 2}, {6, 4, 3}};

template <class T> T edge_determinant(const Vector<T, 2>* e) { return e[0][0] * e[1][1] - e[0][1] * e[1][0]; }
template <class T> T edge_determinant(const Vector<T, 3>* e) { return dot(e[0], cross(e[1], e[2])); }
/// d det/d e_i
template <class T> void edge_cofactors(const Vector<T, 2>* e, Vector<T, 2>* c) {
  c[0] = {{e[1][1], -e[1][0]}};
  c[1] = {{-e[0][1], e[0][0]}};
}
template <class T> void edge_cofactors(const Vector<T, 3>* e, Vector<T, 3>* c) {
  for (int i = 0; i < 3; ++i) c[i] = cross(e[(i + 1) % 3], e[(i + 2) % 3]);
}

/// A cell whose corners are at x. edges, up: x_m and x^m.
template <class T, int D, bool Ring> class CornerGuard {
  using Cell = OnePoint<D, Ring>;
  static constexpr int N = Cell::nodes;

 public:
  T q[N];  ///< 1 where there is no guard

  CornerGuard(const double* constants, const Vector<T, D>* x, const Vector<T, D>* edges, const Vector<T, D>* up)
      : constants_(constants), x_(x), up_(up), over_J_(T(1) / edge_determinant(edges)) {
    for (int a = 0; a < N; ++a) {
      const T scale = this->scale(a);
      Vector<T, D> e[D];
      edges_at(a, e);
      q[a] = select(scale > T(0), scale * edge_determinant(e), T(1));
    }
  }

  T least() const {
    T least = q[0];
    for (int a = 1; a < N; ++a) least = smaller(least, q[a]);
    return least;
  }

  /// U over theta K V0.
  T energy() const {
    T sum(0);
    for (int a = 0; a < N; ++a) {
      const T held = held_part(u(a)), square = held * held;
      sum += square * square / (T(1) - held);
      if constexpr (Ring) sum += T(4) * resistance(held) * (u(a) - held);
    }
    return T(0.25 * kFreeCorner / N) * sum;
  }

  /// Its gradient by the nodes, likewise.
  void gradient(Vector<T, D>* of_node) const {
    T mean(0);
    for (int b = 0; b < N; ++b) of_node[b] = T(0) * x_[b];
    for (int a = 0; a < N; ++a) {
      if (!any(u(a) > T(0))) continue;
      const T slope = T(-1.0 / N) * resistance(u(a));
      mean -= slope * q[a];
      add_at_corner(a, slope, of_node);
    }
    for (int b = 0; b < N; ++b) of_node[b] += mean * mean_gradient(b);
  }

  /// The bound of omega^2 over theta K/rho. ahead: the q of which u is taken, q or what they will be.
  T stiffness(const T* ahead) const {
    T share[N], least_share(1), t(0);
    Vector<T, D> g[N];
    for (int b = 0; b < N; ++b) {
      load(constants_, Cell::share + b, share[b]);
      least_share = smaller(least_share, share[b]);
      g[b] = mean_gradient(b);
      t += dot(g[b], g[b]) / share[b];
    }
    T sum(0);
    for (int a = 0; a < N; ++a) {
      const T u = u_of(ahead[a]);
      if (!any(u > T(0))) continue;
      Vector<T, D> slope[N];
      for (int b = 0; b < N; ++b) slope[b] = -q[a] * g[b];
      add_at_corner(a, T(1), slope);
      T square(0);
      for (int b = 0; b < N; ++b) square += dot(slope[b], slope[b]) / share[b];
      const T bent = second(a) * scale(a) / least_share + T(2) * absolute(q[a]) * t + T(2) * sqrt(square * t);
      sum += T(1 / kFreeCorner) * resistance_slope(u) * square + resistance(u) * bent;
    }
    return T(1.0 / N) * sum;
  }

 private:
  static T u_of(const T& q) { return larger(T(1) - T(1 / kFreeCorner) * q, T(0)); }
  T u(int a) const { return u_of(q[a]); }
  static T held_part(const T& u) {
    if constexpr (Ring) return smaller(u, T(kHeldInRings));
    return u;
  }
  /// r and r'
  static T resistance(const T& any_u) {
    const T u = held_part(any_u);
    return T(0.25) * u * u * u * (T(4) - T(3) * u) / ((T(1) - u) * (T(1) - u));
  }
  /// In rings beyond u_1, where it is 0, that of u_1: a corner may come back in the step.
  static T resistance_slope(const T& any_u) {
    const T u = held_part(any_u), left = T(1) - u;
    return T(0.5) * u * u * (T(6) - T(8) * u + T(3) * u * u) / (left * left * left);
  }
  /// 1/(c_a J)
  T scale(int a) const {
    T corner;
    load(constants_, Cell::corner + a, corner);
    return corner * over_J_;
  }
  void edges_at(int a, Vector<T, D>* e) const {
    for (int i = 0; i < D; ++i) e[i] = T(-kCornerSides[a][i]) * (x_[kNextCorner[a][i]] - x_[a]);
  }
  /// g_b = sum_m w_mb x^m, d ln J/d x_b.
  Vector<T, D> mean_gradient(int b) const {
    Vector<T, D> g = T(0) * up_[0];
    for (int m = 0; m < D; ++m) g += corner_weight<T, D>(constants_, b, m) * up_[m];
    return g;
  }
  /// factor times the part of dq_a that the edges of the corner make.
  void add_at_corner(int a, const T& factor, Vector<T, D>* of_node) const {
    Vector<T, D> e[D], c[D];
    edges_at(a, e);
    edge_cofactors(e, c);
    for (int i = 0; i < D; ++i) {
      const Vector<T, D> part = T(kCornerSides[a][i]) * factor * scale(a) * c[i];
      of_node[a] += part;
      of_node[kNextCorner[a][i]] -= part;
    }
  }
  /// |d2j|
  T second(int a) const {
    if constexpr (D == 2) return T(1.7320508075688772);
    Vector<T, D> e[D];
    edges_at(a, e);
    T sum(0);
    for (int i = 0; i < D; ++i) sum += sqrt(dot(e[i], e[i]));
    return T(4) * sum;
  }

  const double* constants_;
  const Vector<T, D>*x_, *up_;
  T over_J_;
};

}  // namespace forming_sim
