#pragma once
// What a one-point cell does with the shapes that its mean deformation does not see.
//
// About the centre the deformation gradient is F (I + Z), Z = sum_alpha F^-1 q_alpha (x) grad h_alpha,
// and Z is the variation of the logarithmic strain across the cell, also where F is a large
// plastic stretch. Its parts that vary linearly with one coordinate are kept normal to that
// coordinate only: in 3D the plane tensor
//
//   e_d = sym(z_i (x) A_j + z_j (x) A_i) in the plane of E_i and E_j,   d, i, j cyclic,
//
// (times xi_d; z and A = `slopes` of one_point.h), in 2D e_i = A_ii z_i along E_i and nothing
// along E_3. The stress that goes with them is plane: it has no component along xi_d. Thus a
// bent cell is neither too stiff in shear, at any ratio of its edges, nor near nu = 1/2, and its
// bending is exact, with E/(1-nu^2) in plane strain (the assumed strain of Belytschko and
// Bindeman, 1991, 1993). The part that varies with two coordinates, xi eta zeta, is uniaxial: e = A_mm z_m
// along each E_m. The energy is quadratic,
//
//   U = V0 [ 1/6 sum_d s_d : (e_d - ep_d) + 1/18 sum_m E (e_m - ep_m)^2 ],
//   s_d = C (e_d - ep_d),  C the moduli of plane stress,
//
// 1/3 and 1/9 the means of xi_d^2 and (xi eta)^2; the nodal forces are its gradient, with that of
// F^-1 in it, so that momenta and rotations are exact.
//
// Plasticity. ep is a memory. With S the law's deviator of the trial and p' the variation
// of the plastic strain, the stress at two points xi_d = +-h is S +- h s_d; each is
// returned to the yield surface as the law does it, by
//   dp+- = (q+- - sigma_s -+ h H p') / (3 mu + H) where it is positive,  H = d sigma_s/dp,
// and the plastic strains there, 3/2 dp (S +- h dev s)/q, change mean and variation; the mean is the
// law's own affair, their variation is that of ep, and p' changes likewise. Where both points flow, s
// follows the tangent of the hardening curve along the flow and relaxes across it, as the
// points of a fine mesh would; where none does, the cell is elastic; across a neutral axis, where
// S = 0, s is bounded, and h = 2/3 makes the moment of the cell that of the rectangle of yield stress.
// What the points dissipate beside the centre is s : d ep V0/3.
#include "forming_sim/element/hourglass_strain.h"
#include "forming_sim/material/law.h"

namespace forming_sim {

/// Memory of one layer: ep (2D: along E_i and E_3; 3D: two normal strains, shear) and p' of every
/// coordinate, in 3D the plastic part of the last mode.
template <int D> constexpr int kPlaneItems = D == 2 ? 3 : 4;
template <int D> constexpr int kHourglassItems = D * kPlaneItems<D> + (D == 3 ? 3 : 0);
/// Numbers of memory of a cell beside those of its point.
template <int D> int hourglass_items(const SolidConstants& m) { return m.law == Law::hyperelastic ? 0 : m.layers * kHourglassItems<D>; }

/// Half the distance of the points of yield over that of the faces.
constexpr double kYieldPoint = 2.0 / 3;

template <class T, int D> class Hourglass {
  using Cell = OnePoint<D>;

 public:
  /// constants: of the cell; x: of its corners; e: its edges.
  Hourglass(const SolidConstants& m, const double* constants, const Edges<T, D>& e, const Vector<T, D>* x) : moduli_(m), edges_(e) {
    for (int i = 0; i < Cell::pairs; ++i) load(constants, Cell::slopes + i, slopes_[i]);
    Vector<T, D> sum[Cell::modes];
    sum_modes<T, D>(x, sum);
    for (int k = 0; k < Cell::modes; ++k) {
      for (int i = 0; i < D; ++i) {
        T start;
        load(constants, Cell::start + k * D + i, start);
        rise_[k][i] = dot(e.up[i], sum[k]);
        z_[k][i] = rise_[k][i] - start;
      }
    }
    strain_.from(z_, slopes_);
    for (int d = 0; d < 3; ++d) stress_.warp[d] = T(0);
  }

  /// Stresses of a body without plasticity.
  void add_elastic() { add(Strain(), T(1)); }

  /// One step of a layer. S: the law's stress after the step, `kept` times that of the trial; yield: its
  /// yield stress before; memory: kHourglassItems, those of the layer.
  void add_layer(const LayerConstants& layer, const Symmetric<T, D>& S, const T& kept, const YieldStress<T>& yield, double* memory, Keep keep) {
    Strain ep = load_plastic(memory);
    if (layer.hardening.kind != HardeningCurve::elastic) {
      const T back = T(1) / kept;
      const Symmetric<T, D> trial = in_frame(S, back);
      const T Q0 = T(1.5) * contract(S, S) * back * back;
      const T stiffness = T(1) / (T(3 * moduli_.mu) + yield.slope);
      bool changed = false;
      for (int d = 0; d < D; ++d) changed |= flow(d, layer, yield, stiffness, trial, Q0, ep.plane[d], memory, keep);
      if constexpr (D == 3)
        for (int d = 0; d < 3; ++d) changed |= relax(yield.value, kept, T(layer.weight), d, ep);
      if (changed && keep == Keep::yes) store_plastic(ep, memory);
    }
    add(ep, T(layer.weight));
  }

  /// Stored energy per initial volume, J/m3; memory: hourglass_items.
  T energy(const SolidConstants& m, const double* memory) const {
    if (m.law == Law::hyperelastic) return layer_energy(Strain());
    T sum(0);
    for (int k = 0; k < m.layers; ++k, memory += kHourglassItems<D> * lanes_of<T>) sum += T(m.layer[k].weight) * layer_energy(load_plastic(memory));
    return sum;
  }

  const T& z(int mode, int m) const { return z_[mode][m]; }
  const T& dissipation() const { return dissipation_; }  ///< per initial volume, J/m3

  /// Minus the gradient of U: on the edges and, directly, on the corners.
  void add_forces(const T& V0, Vector<T, D>* on_edges, Vector<T, D>* on_corners) const {
    T g[Cell::modes][D];
    stress_.gradient(slopes_, g);
    Vector<T, D> r[Cell::modes];
    for (int k = 0; k < Cell::modes; ++k) {
      r[k] = (V0 * g[k][0]) * edges_.up[0];  // dU / d(sum_a h_a x_a)
      for (int m = 1; m < D; ++m) r[k] += (V0 * g[k][m]) * edges_.up[m];
      for (int m = 0; m < D; ++m) on_edges[m] += rise_[k][m] * r[k];  // d x^m = -(x^m . d x_k) x^k
    }
    take_modes<T, D>(r, on_corners);
  }

 private:
  using Strain = HourglassStrain<T, D>;

  static Strain load_plastic(const double* memory) {
    Strain ep;
    for (int d = 0; d < D; ++d) {
      load(memory, d * kPlaneItems<D>, ep.plane[d].a);
      load(memory, d * kPlaneItems<D> + 1, ep.plane[d].b);
      if constexpr (D == 3) load(memory, d * kPlaneItems<D> + 2, ep.plane[d].shear);
    }
    if constexpr (D == 3)
      for (int d = 0; d < 3; ++d) load(memory, 3 * kPlaneItems<D> + d, ep.warp[d]);
    return ep;
  }
  static void store_plastic(const Strain& ep, double* memory) {
    for (int d = 0; d < D; ++d) {
      store(memory, d * kPlaneItems<D>, ep.plane[d].a);
      store(memory, d * kPlaneItems<D> + 1, ep.plane[d].b);
      if constexpr (D == 3) store(memory, d * kPlaneItems<D> + 2, ep.plane[d].shear);
    }
    if constexpr (D == 3)
      for (int d = 0; d < 3; ++d) store(memory, 3 * kPlaneItems<D> + d, ep.warp[d]);
  }

  /// factor F^-1 S F, symmetric: its components along the material axes.
  Symmetric<T, D> in_frame(const Symmetric<T, D>& S, const T& factor) const {
    Vector<T, D> Sx[D];
    for (int m = 0; m < D; ++m) Sx[m] = factor * (S * edges_.x[m]);
    Symmetric<T, D> r;
    for (int m = 0; m < D; ++m) r[m] = dot(edges_.up[m], Sx[m]);
    const auto shear = [&](int i, int j) { return T(0.5) * (dot(edges_.up[i], Sx[j]) + dot(edges_.up[j], Sx[i])); };
    r[3] = shear(0, 1);
    if constexpr (D == 2) {
      r[2] = factor * S[2];
    } else {
      r[4] = shear(1, 2);
      r[5] = shear(2, 0);
    }
    return r;
  }

  T layer_energy(const Strain& ep) const {
    T sum(0);
    for (int d = 0; d < D; ++d) {
      const Plane<T> elastic = strain_.plane[d] - ep.plane[d];
      sum += T(1.0 / 6) * work(moduli_.stress(elastic), elastic);
    }
    if constexpr (D == 3)
      for (int d = 0; d < 3; ++d) {
        const T elastic = strain_.warp[d] - ep.warp[d];
        sum += T(moduli_.E / 18) * elastic * elastic;
      }
    return sum;
  }

  /// The two points of coordinate d (2D: of the strain along E_d); whether one of them yields. stiffness: 1/(3 mu + H).
  bool flow(int d, const LayerConstants& layer, const YieldStress<T>& yield, const T& stiffness, const Symmetric<T, D>& S, const T& Q0, Plane<T>& ep, double* memory,
            Keep keep) {
    const int i = D == 2 ? d : (d + 1) % 3, j = D == 2 ? 2 : (d + 2) % 3;
    const Plane<T> in_plane{S[i], S[j], D == 2 ? T(0) : S[kPair<3>[i][j]]};
    const Plane<T> s = moduli_.stress(strain_.plane[d] - ep);
    constexpr double h = kYieldPoint;
    T rise;  // p'
    const int rise_at = d * kPlaneItems<D> + kPlaneItems<D> - 1;
    load(memory, rise_at, rise);
    // q^2 = 3/2 (S +- h dev s) : (S +- h dev s)
    const T even = Q0 + T(h * h) * (s.a * s.a + s.b * s.b - s.a * s.b + T(3) * s.shear * s.shear);
    const T odd = T(3 * h) * (in_plane.a * s.a + in_plane.b * s.b + T(2) * in_plane.shear * s.shear);
    const T harder = T(h) * yield.slope * rise;
    const T limit[2] = {yield.value + harder, yield.value - harder};
    const T Q[2] = {even + odd, even - odd};
    if (!any(Q[0] > limit[0] * limit[0]) && !any(Q[1] > limit[1] * limit[1])) return false;
    const T q[2] = {sqrt(larger(Q[0], T(1e-150))), sqrt(larger(Q[1], T(1e-150)))}, over = T(1) / (q[0] * q[1]);
    T dp[2], over_q[2];
    for (int k = 0; k < 2; ++k) {
      dp[k] = larger((q[k] - limit[k]) * stiffness, T(0));
      over_q[k] = dp[k] * q[1 - k] * over;
    }
    const T along = T(0.75 / h) * (over_q[0] - over_q[1]), across = T(0.75) * (over_q[0] + over_q[1]);
    const T mean = T(1.0 / 3) * (s.a + s.b);
    const Plane<T> rate{along * in_plane.a + across * (s.a - mean), along * in_plane.b + across * (s.b - mean),
                        T(2) * (along * in_plane.shear + across * s.shear)};
    ep = {ep.a + rate.a, ep.b + rate.b, ep.shear + rate.shear};
    dissipation_ += T(layer.weight / 3) * work(moduli_.stress(strain_.plane[d] - ep), rate);
    if (keep == Keep::yes) store(memory, rise_at, rise + T(0.5 / h) * (dp[0] - dp[1]));
    return true;
  }

  /// The last mode: it relaxes as the law's stress does and does not pass the yield stress.
  bool relax(const T& limit, const T& kept, const T& weight, int d, Strain& ep) {
    const T elastic = strain_.warp[d] - ep.warp[d], s = T(moduli_.E) * elastic;
    T left = kept;
    if (any(absolute(s) > limit)) left = smaller(left, limit / larger(absolute(s), limit));
    if (!any(left < T(1))) return false;
    const T rate = (T(1) - left) * elastic;
    ep.warp[d] += rate;
    dissipation_ += weight * T(1.0 / 9) * left * s * rate;
    return true;
  }

  void add(const Strain& ep, const T& weight) {
    for (int d = 0; d < D; ++d) {
      const Plane<T> s = moduli_.stress(strain_.plane[d] - ep.plane[d]);
      stress_.plane[d].a += weight * s.a;
      stress_.plane[d].b += weight * s.b;
      stress_.plane[d].shear += weight * s.shear;
    }
    if constexpr (D == 3)
      for (int d = 0; d < 3; ++d) stress_.warp[d] += weight * T(moduli_.E) * (strain_.warp[d] - ep.warp[d]);
  }

  const PlaneModuli<T> moduli_;
  const Edges<T, D>& edges_;
  T slopes_[Cell::pairs];
  T rise_[Cell::modes][D], z_[Cell::modes][D];
  Strain strain_, stress_;
  T dissipation_{0.0};
};

/// One step of the law at the centre and of the variation about it. memory, hourglass_memory: of
/// the cell, the latter kHourglassItems of each layer; none of a hyperelastic body.
template <class T, int D>
PointResponse<T, D> step_with_hourglass(const SolidConstants& m, const Edges<T, D>& e, const Vector<T, D>* moved, const T& J, double* memory,
                                   Hourglass<T, D>& hourglass, double* hourglass_memory, Keep keep) {
  constexpr int size = Symmetric<T, D>::size;
  if (m.law == Law::hyperelastic) {
    hourglass.add_elastic();
    return hyperelastic_step(m, e, J, memory);
  }
  PointResponse<T, D> sum;
  for (int i = 0; i < size; ++i) sum.S[i] = T(0);
  sum.dissipation = T(0);
  const T factor = m.law == Law::classical ? T(0) : stress_factor(m, J);
  for (int k = 0; k < m.layers; ++k) {
    const PointResponse<T, D> r = m.law == Law::classical ? classical_step(m, e, moved, J, memory, keep) : layer_step(m, k, factor, e, J, memory, keep);
    hourglass.add_layer(m.layer[k], r.S, r.kept, r.yield, hourglass_memory, keep);
    const T w(m.layer[k].weight);
    for (int i = 0; i < size; ++i) sum.S[i] += w * r.S[i];
    sum.dissipation += w * r.dissipation;
    memory += kLayerItems<D> * lanes_of<T>;
    hourglass_memory += kHourglassItems<D> * lanes_of<T>;
  }
  sum.dissipation += hourglass.dissipation();
  return sum;
}

}  // namespace forming_sim
