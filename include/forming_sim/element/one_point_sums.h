#pragma once
// The corners of a one-point cell as the sums that its edges and its modes are made of, and back.
//
// Edges are x_m = sum_a w_ma x_a with sum_a w_ma = 0, so that every w_ma is a sum of the signs xi_i,a of the corners' sides and
// h_alpha,a of the modes,
//   w_ma = sum_i linear_im xi_i,a + sum_alpha twist_alpha,m h_alpha,a,
// and no corner has to be multiplied: x_m = sum_i linear_im (sum_a xi_i,a x_a) + sum_alpha twist_alpha,m (sum_a h_alpha,a x_a).
// Of a parallelepiped, and of any quadrilateral that is not turned into a ring, all `twist` are nothing, and left out.
#include "forming_sim/element/one_point.h"
#include "forming_sim/tensor/tensor.h"

namespace forming_sim {

/// Whether a cell, or any of a block, has them.
template <class T, int D> bool is_twisted(const double* constants) {
  T most;
  load(constants, OnePoint<D>::twisted, most);
  return any(most > T(0));
}

/// w_ma.
template <class T, int D> T corner_weight(const double* constants, int a, int m) {
  T w(0), share;
  for (int i = 0; i < D; ++i) {
    load(constants, OnePoint<D>::linear + i * D + m, share);
    w += T(kCornerSides[a][i]) * share;
  }
  for (int k = 0; k < OnePoint<D>::modes; ++k) {
    load(constants, OnePoint<D>::twist + k * D + m, share);
    w += T(kHourglass<D>[k][a]) * share;
  }
  return w;
}

/// sum_a xi_i,a x_a and sum_a h_alpha,a x_a.
template <class T, int D> struct CornerSums {
  static constexpr int half = OnePoint<D>::nodes / 2;
  Vector<T, D> side[D], mode[OnePoint<D>::modes];

  /// Corners a and a + half, of which the first pair sets the sums.
  template <int a> [[gnu::always_inline]] void add(const Vector<T, D>& low, const Vector<T, D>& high) {
    const Vector<T, D> both = low + high, between = low - high;
    const auto add_to = [&](Vector<T, D>& sum, auto sign, auto opposite) __attribute__((always_inline)) {
      constexpr bool plus = sign() > 0;
      const Vector<T, D>& x = sign() == opposite() ? both : between;
      if constexpr (a == 0) repeat<D>([&](auto i) { sum[i] = plus ? x[i] : -x[i]; });
      else if constexpr (plus) sum += x;
      else sum -= x;
    };
    repeat<D>([&](auto i) { add_to(side[i], std::integral_constant<int, kCornerSides[a][i]>(), std::integral_constant<int, kCornerSides[a + half][i]>()); });
    repeat<OnePoint<D>::modes>([&](auto k) { add_to(mode[k], std::integral_constant<int, kHourglass<D>[k][a]>(), std::integral_constant<int, kHourglass<D>[k][a + half]>()); });
  }
  /// x: of all corners.
  void add_all(const Vector<T, D>* x) {
    repeat<half>([&](auto a) { add<a>(x[a], x[a + half]); });
  }

  /// edge: an array of vectors, or where one starts. (A reference to it can be seen through when a pointer cannot.)
  template <class Vectors> void find_edges(const double* constants, Vectors& edge) const {
    T share;
    repeat<D>([&](auto m) {
      repeat<D>([&](auto i) {
        load(constants, OnePoint<D>::linear + i * D + m, share);
        if constexpr (i == 0) edge[m] = share * side[i];
        else edge[m] += share * side[i];
      });
    });
    if (!is_twisted<T, D>(constants)) return;
    repeat<D>([&](auto m) {
      repeat<OnePoint<D>::modes>([&](auto k) {
        load(constants, OnePoint<D>::twist + k * D + m, share);
        edge[m] += share * mode[k];
      });
    });
  }
};

/// The edges x_m of a cell whose corners stand at x; of a ring too the hoop x_3 = (sum_a o_a r_a, 0).
template <int D, bool Ring, class T> void find_one_point_edges(const double* constants, const Vector<T, D>* x, Vector<T, D>* edge) {
  CornerSums<T, D> sums;
  sums.add_all(x);
  sums.find_edges(constants, edge);
  if constexpr (Ring) {
    edge[2] = {{T(0), T(0)}};
    for (int a = 0; a < OnePoint<2>::nodes; ++a) {
      T share;
      load(constants, OnePoint<2, true>::hoop + a, share);
      edge[2][0] += share * x[a][0];
    }
  }
}

/// The forces on the corners, sum_m w_ma f_m - sum_alpha h_alpha,a r_alpha, of forces f_m on the edges and r_alpha = dU/d(sum_a h_alpha,a x_a).
template <class T, int D> class CornerForces {
  static constexpr int half = OnePoint<D>::nodes / 2, modes = OnePoint<D>::modes;

 public:
  CornerForces(const double* constants, const Vector<T, D>* on_edge, const Vector<T, D>* r) {
    Vector<T, D> side[D], mode[modes];
    T share;
    repeat<D>([&](auto i) {
      repeat<D>([&](auto m) {
        load(constants, OnePoint<D>::linear + i * D + m, share);
        if constexpr (m == 0) side[i] = share * on_edge[m];
        else side[i] += share * on_edge[m];
      });
    });
    repeat<modes>([&](auto k) { repeat<D>([&](auto i) { mode[k][i] = -r[k][i]; }); });
    if (is_twisted<T, D>(constants))
      repeat<modes>([&](auto k) {
        repeat<D>([&](auto m) {
          load(constants, OnePoint<D>::twist + k * D + m, share);
          mode[k] += share * on_edge[m];
        });
      });
    second_ = side[1];
    if constexpr (D == 2) {
      along_[0] = side[0] - mode[0];
      along_[1] = side[0] + mode[0];
    } else {
      along_[0] = side[0] - mode[2];
      along_[1] = side[0] + mode[2];
      third_[0] = side[2] - mode[0];
      third_[1] = side[2] + mode[0];
      third_along_[0] = mode[1] - mode[3];
      third_along_[1] = mode[1] + mode[3];
    }
  }

  /// On corners a and a + half.
  template <int a> [[gnu::always_inline]] void at(Vector<T, D>& low, Vector<T, D>& high) const {
    if constexpr (D == 2) {
      low = in_plane<a>();
      high = in_plane<a + half>();
    } else {
      constexpr int eta = kCornerSides[a][1] > 0;
      const Vector<T, D> even = in_plane<a>(), odd = kCornerSides[a][0] > 0 ? third_[eta] + third_along_[eta] : third_[eta] - third_along_[eta];
      low = even - odd;
      high = even + odd;
    }
  }

 private:
  /// xi side_1 + eta side_2 + xi eta mode, of a corner by its first two sides.
  template <int a> [[gnu::always_inline]] Vector<T, D> in_plane() const {
    constexpr int xi = kCornerSides[a][0], eta = kCornerSides[a][1];
    const Vector<T, D>& along = along_[eta > 0];
    if constexpr (xi > 0) return eta > 0 ? along + second_ : along - second_;
    else return eta > 0 ? second_ - along : -(along + second_);
  }

  Vector<T, D> second_, along_[2];
  Vector<T, D> third_[D == 3 ? 2 : 1], third_along_[D == 3 ? 2 : 1];
};

}  // namespace forming_sim
