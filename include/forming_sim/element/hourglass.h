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
// yield surface of element/hourglass_flow.h: where a coordinate is outside, mean and variation flow together
// (element/flow_together.h). Where the whole cell flows, s follows the tangent of the hardening
// curve along the flow and relaxes across it, as the points of a fine mesh would; where S = 0, s is bounded such that the moment
// of the cell is that of the rectangle of yield stress. The last mode relaxes as the mean does.
// What the variation dissipates beside the mean is s : d ep V0/3.
//
// Fading, in rings. A cell that flows around an edge of a die folds: |e|, which is of order 1 where a corner turns inside out,
// comes to several times that, and its s would dissipate what no fine mesh does. Where |e|^2 = sum_d e_d^2 (of the fibres) is beyond
// e_0^2 = `near` of one_point.h, below which every corner has more than q_0 of its share (element/corner_guard.h), s is bounded by
//   |s_d| <= sigma_s e_0^2/|e|^2   (|.| von Mises' of the face),
// and what is more than that goes into ep_d, as flow along s_d does.
#include "forming_sim/element/flow_together.h"
#include "forming_sim/element/one_point_ring.h"
#include "forming_sim/material/law.h"

namespace forming_sim {

/// Numbers of memory of a cell beside those of its point.
template <int D> int hourglass_items(const SolidConstants& m) { return m.law == Law::hyperelastic ? 0 : m.layers * kHourglassItems<D>; }

/// Place of (i, j) in a symmetric tensor.
inline constexpr int kFull[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

template <class T, int D, bool Ring = false> class Hourglass {
  using Cell = OnePoint<D, Ring>;

 public:
  /// constants: of the cell.
  Hourglass(const PlaneModuli& moduli, const double* constants) : moduli_(moduli), constants_(constants) {}

  /// The strains that vary across the cell: work to do while the law of the mean waits for its roots. e: its edges, with their
  /// reciprocal vectors; sums: sum_a h_alpha,a x_a of its corners, CornerSums; x: of a ring, the corners.
  void find_strains(const Edges<T, D, Ring>& e, const Vector<T, D>* sums, const Vector<T, D>* x) {
    fibres_ = Fibres<T, D>(constants_, e.up);
    strain_.from(sums, fibres_, constants_);
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
    if constexpr (Ring) hoop_ = HoopStrain<T>(constants_, e, x, strain_);
    far_ = any(strain_.square() > loaded(Cell::near));
  }
  /// The strains are so large that a corner may be in the range of its guard (element/corner_guard.h).
  bool far() const { return far_; }

  /// Stresses of a body without plasticity.
  void set_elastic() {
    repeat<D>([&](auto d) { stress_.plane[d] = moduli_.stress(strain_.plane[d]); });
    if constexpr (D == 3) repeat<3>([&](auto d) { stress_.warp[d] = T(moduli_.E * (1.0 / 3)) * strain_.warp[d]; });
  }
  /// The trial of the stresses of a layer whose law has answered `point` and stored its memory; whether mean and variation may have to flow together.
  /// most: of the metric of the yield surface.
  bool try_layer(const LayerConstants& layer, PointResponse<T, D>& point, const double* memory, const double* hourglass_memory, double most = 1) {
    find_plane_stresses(hourglass_memory);
    limit_ = T(1e300), left_ = T(1);
    if (layer.hardening.kind == HardeningCurve::elastic) return false;
    if (!point.knows_yield) {
      T p;
      load(memory, Symmetric<T, D>::size, p);
      point.yield = yield_stress(layer.hardening, p);
    }
    limit_ = point.yield.value;
    left_ = point.kept;
    return may_yield(point, hourglass_memory, most);
  }
  /// After that, of half `half` of those that flow together; `point` and both memories follow.
  template <class Flow> void take_flow(Flow& flow, int half, PointResponse<T, D>& point, double* memory, double* hourglass_memory) {
    flow.take(half, point, limit_, left_, memory, hourglass_memory);
    find_plane_stresses(read_again(hourglass_memory));
  }
  /// The last mode of the layer, and with it all its stresses; they are those of the cell, or have a share w in them.
  void finish_only_layer(T& dissipation, double* hourglass_memory) {
    finish(dissipation, hourglass_memory);
    stress_.set(layer_);
  }
  void finish_layer(const T& w, T& dissipation, double* hourglass_memory) {
    finish(dissipation, hourglass_memory);
    stress_.add(w, layer_);
  }
  /// Before the first of several layers.
  void clear() { stress_.clear(); }
  /// As another is before its flow, number by number, as OnePointCell::wait_as().
  void wait_as(const Hourglass& other) {
    repeat<D>([&](auto d) { repeat<D>([&](auto i) { fibres_.along[d][i] = other.fibres_.along[d][i]; }); });
    strain_.set(other.strain_);
    if constexpr (Ring) hoop_ = other.hoop_;
    far_ = other.far_;
    constants_ = other.constants_;
  }
  const HourglassStrain<T, D>& strain() const { return strain_; }

  /// Stored energy per initial volume, J/m3; memory: hourglass_items.
  T energy(const SolidConstants& m, const double* memory) const {
    if (m.law == Law::hyperelastic) return layer_energy(nullptr);
    T sum(0);
    for (int k = 0; k < m.layers; ++k, memory += kHourglassItems<D> * stride_of<T>) sum += T(m.layer[k].weight) * layer_energy(memory);
    return sum;
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
  Vector<T, D> fibre_rate(const Edges<T, D, Ring>& e, const Vector<T, D>* sums, int d, int a) const {
    T gamma(kHourglass<D>[0][a]);
    for (int m = 0; m < D; ++m) gamma -= dot(e.up[m], sums[0]) * corner_weight<T, D>(constants_, a, m);
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

  /// memory: of the layer; null without plasticity.
  T layer_energy(const double* memory) const {
    T sum(0);
    for (int d = 0; d < D; ++d) {
      const Plane<T> elastic = memory ? strain_.plane[d] - load_plane<T, D>(memory, d) : strain_.plane[d];
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

  void find_plane_stresses(const double* memory) {
    repeat<D>([&](auto d) { layer_.plane[d] = moduli_.stress(strain_.plane[d] - load_plane<T, D>(memory, d)); });
  }

  /// Whether a coordinate can be outside its surface, asked of the largest face stress and the largest |p'| at once.
  bool may_yield(const PointResponse<T, D>& point, const double* hourglass_memory, double most) const {
    T q2, rise;
    repeat<D>([&](auto d) {
      const T p = absolute(load_rise<T, D>(hourglass_memory, d)), of_d = face_square(layer_.plane[d]);
      q2 = d == 0 ? of_d : larger(q2, of_d);
      rise = d == 0 ? p : larger(rise, p);
    });
    q2 = T(most) * q2;
    const T n2 = T(1.5 * most) * contract(point.S, point.S), back = point.yield.slope * rise;
    if (!any(may_be_outside(n2, q2, back, point.yield.value * point.yield.value))) return false;
    const T one = T(1) / point.yield.value, n = sqrt(n2) * one, m = T(kFaceStress) * (sqrt(q2) + absolute(back) * n) * one;
    return any(n * n + n * m + m * m > T(1 + 1e-12));
  }

  void finish(T& dissipation, double* memory) {
    if constexpr (D == 3) relax(limit_, left_, layer_.warp, dissipation, memory);
    if constexpr (Ring)
      if (far_) fade(dissipation, memory);
  }

  /// The bound of a folded cell's stresses.
  [[gnu::noinline]] void fade(T& dissipation, double* memory) {
    const T square = strain_.square(), near = loaded(Cell::near), bound = near / larger(square, near) * limit_;
    repeat<D>([&](auto d) {
      Plane<T>& s = layer_.plane[d];
      const T norm = sqrt(face_square(s)), kept = select(square > near, bound / larger(norm, bound), T(1)), gone = T(1) - kept;
      const Plane<T> ep = load_plane<T, D>(memory, d), elastic = strain_.plane[d] - ep;
      const Plane<T> rate{gone * elastic.a, gone * elastic.b, T(0)};
      s.a *= kept, s.b *= kept;
      dissipation += T(1.0 / 3) * work(s, rate);
      store(memory, d * kPlaneItems<D>, ep.a + rate.a);
      store(memory, d * kPlaneItems<D> + 1, ep.b + rate.b);
    });
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

  const PlaneModuli& moduli_;
  const double* constants_;
  std::conditional_t<Ring, HoopStrain<T>, int> hoop_;
  Fibres<T, D> fibres_;
  Strain strain_, stress_, layer_;  ///< layer_: stresses of the layer in hand; those of the last mode over 3
  T limit_, left_;  ///< of the last mode of a layer: the yield stress, and the share that is left
  bool far_;
};

}  // namespace forming_sim
