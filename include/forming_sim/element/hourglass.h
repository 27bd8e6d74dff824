#pragma once
// What a one-point cell does with the shapes that its mean deformation does not see.
//
// About the centre the deformation gradient is F (I + Z), Z = sum_alpha F^-1 q_alpha (x) grad h_alpha,
// and Z is the variation of the logarithmic strain across the cell, also where F is a large
// plastic stretch. Of its parts that vary linearly with one coordinate only those are kept that lie in the
// plane of the fibres u_i, u_j, the cell's edges along the other two: in 3D the plane tensor with
//
//   u_i . e_d u_i = a_i z_j . u_i,   u_j . e_d u_j = a_j z_i . u_j,
//   2 u_i . e_d u_j = a_j z_i . u_i + a_i z_j . u_j,   d, i, j cyclic,
//
// (times xi_d; z, u = `fibres` and a = `slopes` of one_point.h), in 2D e_i = a_i z . u_i along u_i and nothing
// along E_3. The stress that goes with them is plane: it has no component across that plane. Thus a
// bent cell is neither too stiff in shear, at any ratio of its edges, nor near nu = 1/2, and its
// bending is exact, with E/(1-nu^2) in plane strain (the assumed strain of Belytschko and
// Bindeman, 1991, 1993; in a parallelogram it is the quadrilateral of Pian and Sumihara, 1984). The part that varies with two
// coordinates, xi eta zeta, is uniaxial: e = a_m z . u_m along each u_m. The energy is quadratic,
//
//   U = V0 [ 1/6 sum_d s_d : (e_d - ep_d) + 1/18 sum_m E (e_m - ep_m)^2 ],
//   s_d = C (e_d - ep_d),  C the moduli of plane stress,
//
// 1/3 and 1/9 the means of xi_d^2 and (xi eta)^2; the nodal forces are its gradient, with that of
// F^-1 in it, so that momenta and rotations are exact.
//
// Plasticity. ep of each coordinate is a memory, with p', the variation of its plastic strain. Mean stress and s_d share the
// yield surface of element/hourglass_flow.h: where a coordinate is outside, what the law has returned is taken back, and mean and
// variation flow together, one coordinate after the other. Where the whole cell flows, s follows the tangent of the hardening
// curve along the flow and relaxes across it, as the points of a fine mesh would; where S = 0, s is bounded such that the moment
// of the cell is that of the rectangle of yield stress. The last mode relaxes as the mean does.
// What the variation dissipates beside the mean is s : d ep V0/3.
#include <array>
#include <utility>

#include "forming_sim/element/hourglass_flow.h"
#include "forming_sim/element/one_point_ring.h"
#include "forming_sim/material/law.h"

namespace forming_sim {

/// Memory of one layer: ep (2D: along E_i and E_3; 3D: two normal strains, shear) and p' of every
/// coordinate, in 3D the plastic part of the last mode.
template <int D> constexpr int kPlaneItems = D == 2 ? 3 : 4;
template <int D> constexpr int kHourglassItems = D * kPlaneItems<D> + (D == 3 ? 3 : 0);
/// Numbers of memory of a cell beside those of its point.
template <int D> int hourglass_items(const SolidConstants& m) { return m.law == Law::hyperelastic ? 0 : m.layers * kHourglassItems<D>; }

/// Place of (i, j) in a symmetric tensor.
inline constexpr int kFull[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

template <class T, int D, bool Ring = false> class Hourglass {
  using Cell = OnePoint<D, Ring>;

 public:
  /// constants: of the cell; e: its edges, with their reciprocal vectors; sums: sum_a h_alpha,a x_a of its corners, CornerSums; x: of a
  /// ring, the corners. Nothing is found yet: that is work to do while the law of the mean waits for its roots.
  Hourglass(const PlaneModuli<T>& moduli, const double* constants, const Edges<T, D, Ring>& e, const Vector<T, D>* sums, const Vector<T, D>* x)
      : moduli_(moduli), edges_(e), sums_(sums), x_(x), constants_(constants) {}

  /// The strains that vary across the cell.
  void find_strains() {
    fibres_ = Fibres<T, D>(constants_, edges_.up);
    strain_.from(sums_, fibres_, constants_);
    const auto less_start = [&](int item, T& strain) {
      T start;
      load(constants_, Cell::strain + item, start);
      strain -= start;
    };
    repeat<D>([&](auto d) {
      less_start(D == 2 ? d : 3 * d, strain_.plane[d].a);
      if constexpr (D == 3) {
        less_start(3 * d + 1, strain_.plane[d].b);
        less_start(3 * d + 2, strain_.plane[d].shear);
        less_start(9 + d, strain_.warp[d]);
      }
    });
    if constexpr (Ring) hoop_ = HoopStrain<T>(constants_, edges_, x_, strain_);
    far_ = any(strain_.square() > loaded(Cell::near));
  }
  /// The strains are so large that a corner may be in the range of its guard (element/corner_guard.h).
  bool far() const { return far_; }

  /// Stresses of a body without plasticity.
  void set_elastic() {
    repeat<D>([&](auto d) { stress_.plane[d] = moduli_.stress(strain_.plane[d]); });
    if constexpr (D == 3) repeat<3>([&](auto d) { stress_.warp[d] = T(moduli_.E * (1.0 / 3)) * strain_.warp[d]; });
  }
  /// One step of a body of one layer whose law has answered `point` and stored its memory. Where the cell yields by
  /// its variation, mean and variation flow together, and both answers change.
  void set_layer(const SolidConstants& m, const LayerConstants& layer, const T& factor, const T& J, PointResponse<T, D>& point, double* memory,
                 double* hourglass_memory) {
    stress_ = step_of_layer(m, layer, factor, J, point, memory, hourglass_memory);
  }
  /// The same of one layer among others; stresses are first set to zero.
  void clear() {
    repeat<D>([&](auto d) { stress_.plane[d] = {T(0), T(0), T(0)}; });
    if constexpr (D == 3) repeat<3>([&](auto d) { stress_.warp[d] = T(0); });
  }
  void add_layer(const SolidConstants& m, const LayerConstants& layer, const T& factor, const T& J, PointResponse<T, D>& point, double* memory,
                 double* hourglass_memory) {
    const Strain s = step_of_layer(m, layer, factor, J, point, memory, hourglass_memory);
    const T w(layer.weight);
    repeat<D>([&](auto d) {
      stress_.plane[d].a += w * s.plane[d].a;
      stress_.plane[d].b += w * s.plane[d].b;
      if constexpr (D == 3) {
        stress_.plane[d].shear += w * s.plane[d].shear;
        stress_.warp[d] += w * s.warp[d];
      }
    });
  }

  /// Stored energy per initial volume, J/m3; memory: hourglass_items.
  T energy(const SolidConstants& m, const double* memory) const {
    if (m.law == Law::hyperelastic) return layer_energy(nullptr);
    T sum(0);
    for (int k = 0; k < m.layers; ++k, memory += kHourglassItems<D> * lanes_of<T>) sum += T(m.layer[k].weight) * layer_energy(memory);
    return sum;
  }

  T z(int mode, int m) const {
    T start;
    load(constants_, Cell::start + mode * D + m, start);
    return dot(edges_.up[m], sums_[mode]) - start;
  }

  /// The gradient of U. r: by the sums of the modes, r_alpha = dU/d(sum_a h_alpha,a x_a). With it the edges bear
  /// sum_alpha r_alpha (sum_alpha . x^m), since d x^m = -(x^m . d x_k) x^k, and the corners -sum_alpha h_alpha,a r_alpha.
  void gradient(const T& V0, Vector<T, D>* r) const {
    stress_.gradient(fibres_, constants_, r);
    const T third = T(1.0 / 3) * V0;
    repeat<Cell::modes>([&](auto k) { r[k] = third * r[k]; });
  }
  /// Of a ring: what its hoops pull at corner a beside that.
  T hoop_force(const T& V0, int a) const {
    return T(1.0 / 3) * V0 * (stress_.plane[0].b * hoop_.rate(1, a) + stress_.plane[1].b * hoop_.rate(0, a));
  }

  /// Of a ring: d of the fibre strain e_d, and of the hoop strain that varies with coordinate i, by x_a (r_a).
  Vector<T, D> fibre_rate(int d, int a) const {
    T gamma(kHourglass<D>[0][a]);
    for (int m = 0; m < D; ++m) gamma -= dot(edges_.up[m], sums_[0]) * corner_weight<T, D>(constants_, a, m);
    return gamma * fibres_.along[d];
  }
  T hoop_rate(int i, int a) const { return hoop_.rate(i, a); }

 private:
  using Strain = HourglassStrain<T, D>;

  T loaded(int item) const {
    T value;
    load(constants_, item, value);
    return value;
  }

  static Plane<T> load_plane(const double* memory, int d) {
    Plane<T> ep;
    load(memory, d * kPlaneItems<D>, ep.a);
    load(memory, d * kPlaneItems<D> + 1, ep.b);
    if constexpr (D == 3) load(memory, d * kPlaneItems<D> + 2, ep.shear);
    else ep.shear = T(0);
    return ep;
  }
  static void store_plane(const Plane<T>& ep, double* memory, int d) {
    store(memory, d * kPlaneItems<D>, ep.a);
    store(memory, d * kPlaneItems<D> + 1, ep.b);
    if constexpr (D == 3) store(memory, d * kPlaneItems<D> + 2, ep.shear);
  }

  /// The cell's axes E_m turned as its edges are: the orthonormal vectors nearest to the edges' directions, the rotation of their
  /// polar decomposition. Not F^-1 S F, in which shear would grow with the ratio of the stretches.
  struct Axes {
    Vector<T, D> e[D];
    explicit Axes(const Edges<T, D, Ring>& edges) {
      T length[D];
      for (int m = 0; m < D; ++m) length[m] = sqrt(dot(edges.x[m], edges.x[m]));
      if constexpr (D == 2) {  // e_1 and e_2 turned back by a quarter lie on either side of it
        const Vector<T, 2>&x = edges.x[0], &y = edges.x[1];
        const Vector<T, 2> a = {{length[1] * x[0] + length[0] * y[1], length[1] * x[1] - length[0] * y[0]}};
        e[0] = T(1) / sqrt(dot(a, a)) * a;
        e[1] = {{-e[0][1], e[0][0]}};
      } else {  // A <- (A + A^-T)/2: what is apart by d is so by d^2/2 then
        Edges<T, D> a;
        T apart(1);
        const T one = T(1) / (length[0] * length[1] * length[2]);
        for (int m = 0; m < D; ++m) a.x[m] = one * length[(m + 1) % 3] * length[(m + 2) % 3] * edges.x[m];
        for (int k = 0; k < 5 && any(apart > T(1e-16)); ++k) {
          find_reciprocal(a);
          apart = T(0);
          for (int m = 0; m < D; ++m) {
            const Vector<T, D> d = a.up[m] - a.x[m];
            apart += dot(d, d);
            a.x[m] += T(0.5) * d;
          }
        }
        for (int m = 0; m < D; ++m) e[m] = a.x[m];
      }
    }
  };
  template <std::size_t... d> static std::array<PlaneOf<T, D>, D> planes_of(const Fibres<T, D>& turned, const double* constants, std::index_sequence<d...>) {
    return {PlaneOf<T, D>(turned, constants, static_cast<int>(d))...};
  }

  /// G^mk = x^m . B x^k.
  static void pull(const Edges<T, D, Ring>& edges, const Symmetric<T, D>& B, Symmetric<T, D>& G) {
    Vector<T, D> Bx[D];
    for (int m = 0; m < D; ++m) Bx[m] = B * edges.up[m];
    for (int m = 0; m < D; ++m) G[m] = dot(edges.up[m], Bx[m]);
    G[3] = dot(edges.up[0], Bx[1]);
    if constexpr (D == 2) {
      G[2] = Ring ? B[2] * edges.up[2][0] * edges.up[2][0] : B[2];
    } else {
      G[4] = dot(edges.up[1], Bx[2]);
      G[5] = dot(edges.up[2], Bx[0]);
    }
  }

  /// memory: of the layer; null without plasticity.
  T layer_energy(const double* memory) const {
    T sum(0);
    for (int d = 0; d < D; ++d) {
      const Plane<T> elastic = memory ? strain_.plane[d] - load_plane(memory, d) : strain_.plane[d];
      sum += T(1.0 / 6) * work(moduli_.stress(elastic), elastic);
    }
    if constexpr (D == 3)
      for (int d = 0; d < 3; ++d) {
        T ep(0);
        if (memory) load(memory, 3 * kPlaneItems<D> + d, ep);
        const T elastic = strain_.warp[d] - ep;
        sum += T(moduli_.E / 18) * elastic * elastic;
      }
    return sum;
  }

  /// The stresses of a layer after its step, those of the last mode over 3.
  Strain step_of_layer(const SolidConstants& m, const LayerConstants& layer, const T& factor, const T& J, PointResponse<T, D>& point, double* memory,
                       double* hourglass_memory) {
    Strain s = plane_stresses(hourglass_memory);
    T limit(1e300), left(1);  // of the last mode
    if (layer.hardening.kind != HardeningCurve::elastic) {
      if (!point.knows_yield) {
        T p;
        load(memory, Symmetric<T, D>::size, p);
        point.yield = yield_stress(layer.hardening, p);
      }
      limit = point.yield.value;
      left = point.kept;
      if (may_yield(point, s, hourglass_memory)) {
        Outside outside(edges_, strain_, point);
        const Flowed after = flow(m, moduli_, constants_, outside, factor, J, memory, hourglass_memory);
        point.S = after.S;
        point.dissipation = after.dissipation;
        limit = after.limit;
        left = after.left;
        s = plane_stresses(read_again(hourglass_memory));
      }
    }
    if constexpr (D == 3) relax(limit, left, s.warp, point.dissipation, hourglass_memory);
    return s;
  }

  Strain plane_stresses(const double* memory) const {
    Strain s;
    repeat<D>([&](auto d) { s.plane[d] = moduli_.stress(strain_.plane[d] - load_plane(memory, d)); });
    return s;
  }

  /// A layer after mean and variation have flowed together: its S and dissipation, and of the last mode the
  /// limit and the share that is left.
  struct Flowed {
    Symmetric<T, D> S;
    T dissipation, limit, left;
  };
  /// What it starts from, copied number by number: what is passed as a whole has to lie in memory from its beginning on, also
  /// where nothing flows.
  struct Outside {
    Edges<T, D, Ring> edges;  ///< their vectors only
    Strain strain;
    PointResponse<T, D> point;

    [[gnu::always_inline]] Outside(const Edges<T, D, Ring>& e, const Strain& s, const PointResponse<T, D>& p) {
      repeat<kEdges<D, Ring>>([&](auto m) { repeat<D>([&](auto i) { edges.x[m][i] = e.x[m][i]; }); });
      repeat<D>([&](auto d) { strain.plane[d] = {s.plane[d].a, s.plane[d].b, s.plane[d].shear}; });
      repeat<Symmetric<T, D>::size>([&](auto i) { point.S[i] = p.S[i]; });
      point.dissipation = p.dissipation;
      point.kept = p.kept;
      point.yield = {p.yield.value, p.yield.slope, p.yield.bend};
    }
  };
  /// All coordinates, one after the other. Out of line: what a step without such a flow has in registers stays there.
  [[gnu::noinline]] static Flowed flow(const SolidConstants& m, const PlaneModuli<T>& moduli, const double* constants, Outside& outside, const T& factor, const T& J,
                                       double* memory, double* hourglass_memory) {
    const Strain& strain = outside.strain;
    PointResponse<T, D>& point = outside.point;
    Edges<T, D, Ring>& edges = outside.edges;
    find_reciprocal(edges);
    constexpr int size = Symmetric<T, D>::size;
    const Axes axes(edges);
    const Fibres<T, D> turned(constants, axes.e);
    MeanFlow<T, D> mean;
    repeat<size>([&](auto i) { mean.S[i] = point.S[i]; });
    T varied(0);  // what the variation dissipates
    mean.modulus = T(2) * factor;
    mean.sigma = point.yield.value, mean.slope = point.yield.slope, mean.p = T(0);
    const T over = T(1) / mean.sigma, SS = contract(mean.S, mean.S);
    // Of every coordinate; share: 1 where its variation takes part, else 0.
    const auto at = planes_of(turned, constants, std::make_index_sequence<D>());
    Plane<T> ep[D];
    T rise[D], share[D], most(0);
    repeat<D>([&](auto d) {
      ep[d] = load_plane(hourglass_memory, d);
      load(hourglass_memory, d * kPlaneItems<D> + kPlaneItems<D> - 1, rise[d]);
      const Plane<T> s = moduli.stress(strain.plane[d] - ep[d]);
      const Products<T> q{SS, work(s, at[d].part(mean.S)), work(s, deviatoric(s))};
      share[d] = select(is_outside(Quadratic<T>(q, over, mean.slope * rise[d] * over), 1 + 1e-12), T(1), T(0));
      most = larger(most, share[d]);
    });
    if (any(most > T(0))) {
      // From the trial on: what the law has returned is taken back.
      const T returned = most * (T(1) / point.kept - T(1)), softer = T(1) / mean.modulus;
      for (int i = 0; i < size; ++i) mean.S[i] *= T(1) + returned;
      mean.harden(-(T(2.0 / 3) * softer * returned * sqrt(T(1.5) * SS)));
      repeat<D>([&](auto d) {
        if (!any(share[d] > T(0))) return;
        varied += flow_to_surface<T, D>(mean, moduli, strain.plane[d], share[d], ep[d], rise[d], at[d]);
        store_plane(ep[d], hourglass_memory, d);
        store(hourglass_memory, d * kPlaneItems<D> + kPlaneItems<D> - 1, rise[d]);
      });
      flow_of_mean(mean);
      take_mean_flow(m, factor, J, edges, mean.S, mean.p, point, memory);
      point.dissipation += varied;
    }
    T left(1);
    if constexpr (D == 3) left = smaller(point.kept * mean.sigma / larger(mean.sigma + T(3) * T(moduli.mu) * mean.p, T(0.5) * mean.sigma), T(1));
    return {point.S, point.dissipation, mean.sigma, left};
  }

  /// Whether a coordinate can be outside its surface, without directions: Q_n + mu <= Q_n + n m + m^2 with n^2 = Q_n and
  /// m <= h (s + H |p'| n/sigma_s), s the norm of the face stress over sigma_s. Asked first, times sigma_s^4, without roots and divisions:
  /// n <= 1 since the law has answered, m^2 <= 2 h^2 (s^2 + (H p'/sigma_s)^2).
  static bool may_yield(const PointResponse<T, D>& point, const Strain& stress, const double* hourglass_memory) {
    constexpr double h = kFaceStress, limit = 1 + 1e-12;
    const T n2 = T(1.5) * contract(point.S, point.S), sigma2 = point.yield.value * point.yield.value;
    T q2, rise;  // of the coordinates the largest: squared norm of the face stress, |p'|
    repeat<D>([&](auto d) {
      T p;
      load(hourglass_memory, d * kPlaneItems<D> + kPlaneItems<D> - 1, p);
      const Plane<T>& s = stress.plane[d];
      const T q2_d = s.a * (s.a - s.b) + s.b * s.b + T(3) * s.shear * s.shear;
      q2 = d == 0 ? q2_d : larger(q2, q2_d);
      rise = d == 0 ? absolute(p) : larger(rise, absolute(p));
    });
    const T back = point.yield.slope * rise, m2 = T(2 * h * h) * (q2 + back * back), left = larger(T(limit) * sigma2 - n2 - m2, T(0));
    if (!any(n2 * m2 > left * left)) return false;
    const T one = T(1) / point.yield.value, n = sqrt(n2) * one, m = T(h) * (sqrt(q2) + absolute(back) * n) * one;
    return any(n * n + n * m + m * m > T(limit));
  }

  /// The mean, S after the law's step, has flowed to `after`. The classical law's memory is that, its plastic strain (S - S')/(2 factor).
  /// In B = s I + d it is d <- d' = after/factor, and s such that det B = s^3 - s d:d/2 + det d stays; what B stores falls by
  /// 3/2 factor J (s - s'), of which the stress that is left does all but what is of second order in the change, (d - d'):(d - d')/(4 s).
  /// With it, too, what the law returned before is dissipated, along S.
  static void take_mean_flow(const SolidConstants& m, const T& factor, const T& J, const Edges<T, D, Ring>& edges, const Symmetric<T, D>& after, const T& dp, PointResponse<T, D>& point, double* memory) {
    constexpr int size = Symmetric<T, D>::size;
    const T over = T(1) / factor, SS = contract(point.S, point.S), left = contract(after, after), along = contract(after, point.S);
    T flowed = T(0.5) * over * (along - left);  // S' : D_p
    Symmetric<T, D> kept = after;
    if (m.law != Law::classical) {
      const auto det = [](const Symmetric<T, D>& S) { return determinant(S, cofactor(S)); };
      const T s = trace(push(load_memory<T, D>(memory), edges)) * T(1.0 / 3), over2 = over * over;
      const T per = T(1) / (T(3) * s * s - T(0.5) * over2 * left);  // 1/s = 3 s per, to the order that is asked for
      const T fall = over2 * (T(0.5) * s * (SS - left) + over * (det(after) - det(point.S))) * per;
      flowed = factor * (T(1.5) * fall - T(0.75) * s * per * over2 * (SS - T(2) * along + left));
      Symmetric<T, D> B;
      for (int i = 0; i < size; ++i) B[i] = i < 3 ? over * after[i] + (s - fall) : over * after[i];
      pull(edges, B, kept);
    }
    for (int i = 0; i < size; ++i) store(memory, i, kept[i]);
    point.dissipation = point.dissipation * (along / larger(SS, T(1e-30) * T(m.mu * m.mu))) + J * flowed;
    point.S = after;
    T p;
    load(memory, size, p);
    store(memory, size, p + dp);
  }

  /// The last mode, of hexahedra: it relaxes as a stress does that is not along the flow, and does not pass the yield stress.
  void relax(const T& limit, const T& kept, T* warp, T& dissipation, double* memory) const {
    T ep[3], elastic[3], most(0);
    repeat<3>([&](auto d) {
      load(memory, 3 * kPlaneItems<D> + d, ep[d]);
      elastic[d] = strain_.warp[d] - ep[d];
      most = larger(most, absolute(elastic[d]));
    });
    const bool beyond = any(T(moduli_.E) * most > limit);
    if (beyond || any(kept < T(1)))
      repeat<3>([&](auto d) {
        T left = kept;
        if (beyond) left = smaller(left, limit / larger(T(moduli_.E) * absolute(elastic[d]), limit));
        const T rate = (T(1) - left) * elastic[d];
        store(memory, 3 * kPlaneItems<D> + d, ep[d] + rate);
        elastic[d] *= left;
        dissipation += T(moduli_.E * (1.0 / 9)) * elastic[d] * rate;
      });
    repeat<3>([&](auto d) { warp[d] = T(moduli_.E * (1.0 / 3)) * elastic[d]; });
  }

  const PlaneModuli<T>& moduli_;
  const Edges<T, D, Ring>& edges_;
  const Vector<T, D>*sums_, *x_;
  const double* constants_;
  std::conditional_t<Ring, HoopStrain<T>, int> hoop_;
  Fibres<T, D> fibres_;
  Strain strain_, stress_;
  bool far_;
};

/// One step of a law of material/von_mises.h at the centre and of the variation about it. memory, hourglass_memory: of the cell, the latter
/// kHourglassItems of each layer. one: the body has a single layer.
template <bool one, class T, int D, bool Ring>
PointResponse<T, D> von_mises_with_hourglass(const SolidConstants& m, const Edges<T, D, Ring>& e, const T& J, double* memory, Hourglass<T, D, Ring>& hourglass,
                                             double* hourglass_memory) {
  const T factor = stress_factor(m, J);
  if constexpr (one) {
    PointResponse<T, D> r = layer_step(m, 0, factor, e, J, memory, Keep::yes);
    hourglass.find_strains();
    hourglass.set_layer(m, m.layer[0], factor, J, r, memory, hourglass_memory);
    return r;
  }
  PointResponse<T, D> sum;
  repeat<Symmetric<T, D>::size>([&](auto i) { sum.S[i] = T(0); });
  sum.dissipation = T(0);
  hourglass.find_strains();
  hourglass.clear();
  for (int k = 0; k < m.layers; ++k) {
    PointResponse<T, D> r = layer_step(m, k, factor, e, J, memory, Keep::yes);
    hourglass.add_layer(m, m.layer[k], factor, J, r, memory, hourglass_memory);
    const T w(m.layer[k].weight);
    repeat<Symmetric<T, D>::size>([&](auto i) { sum.S[i] += w * r.S[i]; });
    sum.dissipation += w * r.dissipation;
    memory += kLayerItems<D> * lanes_of<T>;
    hourglass_memory += kHourglassItems<D> * lanes_of<T>;
  }
  return sum;
}

/// The same of any law; a hyperelastic body has no hourglass_memory. moved: as in point_step().
template <class T, int D, bool Ring>
PointResponse<T, D> step_with_hourglass(const SolidConstants& m, const Edges<T, D, Ring>& e, const Vector<T, D>* moved, const T& J, double* memory,
                                        Hourglass<T, D, Ring>& hourglass, double* hourglass_memory) {
  if (m.law == Law::hyperelastic) {
    hourglass.find_strains();
    hourglass.set_elastic();
    return hyperelastic_step(m, e, J, memory);
  }
  if (m.law == Law::classical) {
    PointResponse<T, D> r = classical_step(m, e, moved, J, memory, Keep::yes);
    hourglass.find_strains();
    hourglass.set_layer(m, m.layer[0], T(m.mu), J, r, memory, hourglass_memory);
    return r;
  }
  return m.layers == 1 ? von_mises_with_hourglass<true>(m, e, J, memory, hourglass, hourglass_memory)
                       : von_mises_with_hourglass<false>(m, e, J, memory, hourglass, hourglass_memory);
}

}  // namespace forming_sim
