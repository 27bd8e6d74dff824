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
  /// constants: of the cell; x: of its corners; e: its edges.
  Hourglass(const SolidConstants& m, const double* constants, const Edges<T, D, Ring>& e, const Vector<T, D>* x) : moduli_(m), edges_(e), fibres_(constants) {
    Vector<T, D> sum[Cell::modes];
    sum_modes<T, D>(x, sum);
    repeat<Cell::modes>([&](auto k) {
      repeat<D>([&](auto i) {
        T start;
        load(constants, Cell::start + k * D + i, start);
        rise_[k][i] = dot(e.up[i], sum[k]);
        z_[k][i] = rise_[k][i] - start;
      });
    });
    strain_.from(z_, fibres_);
    if constexpr (Ring) hoop_ = HoopStrain<T>(constants, e, x, strain_);
    constants_ = constants;
    repeat<3>([&](auto d) { stress_.warp[d] = T(0); });
  }

  /// Stresses of a body without plasticity.
  void add_elastic() { add(Strain(), T(1)); }

  /// One step of a layer whose law has answered `point` and stored its memory. Where the cell yields by
  /// its variation, mean and variation flow together, and both answers change.
  void add_layer(const SolidConstants& m, const LayerConstants& layer, const T& factor, const T& J, PointResponse<T, D>& point, double* memory,
                 double* hourglass_memory) {
    Strain ep = load_plastic(hourglass_memory);
    if (layer.hardening.kind != HardeningCurve::elastic && flow(m, layer, factor, J, point, memory, ep, hourglass_memory)) store_plastic(ep, hourglass_memory);
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
    Vector<T, D> g[Cell::modes];
    stress_.gradient(fibres_, g);
    Vector<T, D> r[Cell::modes];
    repeat<Cell::modes>([&](auto k) {
      r[k] = (V0 * g[k][0]) * edges_.up[0];  // dU / d(sum_a h_a x_a)
      repeat<D - 1>([&](auto m) { r[k] += (V0 * g[k][m + 1]) * edges_.up[m + 1]; });
      repeat<D>([&](auto m) { on_edges[m] += rise_[k][m] * r[k]; });  // d x^m = -(x^m . d x_k) x^k
    });
    take_modes<T, D>(r, on_corners);
    if constexpr (Ring)
      for (int d = 0; d < 2; ++d) {
        const T force = T(1.0 / 3) * V0 * stress_.plane[d].b;
        for (int a = 0; a < 4; ++a) on_corners[a][0] -= force * hoop_.rate(1 - d, a);
      }
  }

  /// Of a ring: d of the fibre strain e_d, and of the hoop strain that varies with coordinate i, by x_a (r_a).
  Vector<T, D> fibre_rate(int d, int a) const {
    T gamma(kHourglass<D>[0][a]);
    for (int m = 0; m < D; ++m) {
      T w;
      load(constants_, Cell::weights + a * D + m, w);
      gamma -= rise_[0][m] * w;
    }
    Vector<T, D> row = fibres_.along[d][0] * edges_.up[0];
    row += fibres_.along[d][1] * edges_.up[1];
    return (gamma * fibres_.slope[d]) * row;
  }
  T hoop_rate(int i, int a) const { return hoop_.rate(i, a); }

 private:
  using Strain = HourglassStrain<T, D>;

  static Strain load_plastic(const double* memory) {
    Strain ep;
    repeat<D>([&](auto d) {
      load(memory, d * kPlaneItems<D>, ep.plane[d].a);
      load(memory, d * kPlaneItems<D> + 1, ep.plane[d].b);
      if constexpr (D == 3) load(memory, d * kPlaneItems<D> + 2, ep.plane[d].shear);
    });
    if constexpr (D == 3) repeat<3>([&](auto d) { load(memory, 3 * kPlaneItems<D> + d, ep.warp[d]); });
    return ep;
  }
  static void store_plastic(const Strain& ep, double* memory) {
    repeat<D>([&](auto d) {
      store(memory, d * kPlaneItems<D>, ep.plane[d].a);
      store(memory, d * kPlaneItems<D> + 1, ep.plane[d].b);
      if constexpr (D == 3) store(memory, d * kPlaneItems<D> + 2, ep.plane[d].shear);
    });
    if constexpr (D == 3) repeat<3>([&](auto d) { store(memory, 3 * kPlaneItems<D> + d, ep.warp[d]); });
  }

  /// The cell's axes E_m turned as its edges are: the orthonormal vectors nearest to the edges' directions,
  /// A <- (A + A^-T)/2, which ends at the rotation of the polar decomposition. Not F^-1 S F, in which shear
  /// would grow with the ratio of the stretches.
  struct Axes {
    Vector<T, D> e[D];
    explicit Axes(const Edges<T, D, Ring>& edges) {
      Edges<T, D> a;
      for (int m = 0; m < D; ++m) a.x[m] = T(1) / sqrt(dot(edges.x[m], edges.x[m])) * edges.x[m];
      for (int k = 0; k < 5; ++k) {
        find_reciprocal(a);
        for (int m = 0; m < D; ++m)
          for (int i = 0; i < D; ++i) a.x[m][i] = T(0.5) * (a.x[m][i] + a.up[m][i]);
      }
      for (int m = 0; m < D; ++m) e[m] = a.x[m];
    }
  };

  /// A B + B A
  static Symmetric<T, D> twice_symmetric_product(const Symmetric<T, D>& A, const Symmetric<T, D>& B) {
    Symmetric<T, D> r;
    const auto entry = [&](int i, int j) {
      T sum = A[kFull[i][0]] * B[kFull[0][j]] + B[kFull[i][0]] * A[kFull[0][j]];
      for (int k = 1; k < D; ++k) sum += A[kFull[i][k]] * B[kFull[k][j]] + B[kFull[i][k]] * A[kFull[k][j]];
      return sum;
    };
    for (int i = 0; i < D; ++i) r[i] = entry(i, i);
    r[3] = entry(0, 1);
    if constexpr (D == 2) {
      r[2] = T(2) * A[2] * B[2];
    } else {
      r[4] = entry(1, 2);
      r[5] = entry(2, 0);
    }
    return r;
  }

  /// G^mk = x^m . B x^k.
  void pull(const Symmetric<T, D>& B, Symmetric<T, D>& G) const {
    Vector<T, D> Bx[D];
    for (int m = 0; m < D; ++m) Bx[m] = B * edges_.up[m];
    for (int m = 0; m < D; ++m) G[m] = dot(edges_.up[m], Bx[m]);
    G[3] = dot(edges_.up[0], Bx[1]);
    if constexpr (D == 2) {
      G[2] = Ring ? B[2] * edges_.up[2][0] * edges_.up[2][0] : B[2];
    } else {
      G[4] = dot(edges_.up[1], Bx[2]);
      G[5] = dot(edges_.up[2], Bx[0]);
    }
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

  /// All coordinates, one after the other, and the last mode; whether ep changed.
  bool flow(const SolidConstants& m, const LayerConstants& layer, const T& factor, const T& J, PointResponse<T, D>& point, double* memory, Strain& ep,
            double* hourglass_memory) {
    constexpr int size = Symmetric<T, D>::size;
    T p;
    load(memory, size, p);
    const YieldStress<T> yield = yield_stress(layer.hardening, p);
    if (!may_yield(point.S, yield, ep, hourglass_memory)) return relax_all(layer, yield.value, point.kept, ep);
    const Axes axes(edges_);
    const auto plane = [&](int d) { return PlaneOf<T, D>(axes.e, fibres_, d); };
    MeanFlow<T, D> mean{point.S, {}, T(2) * factor, yield.value, yield.slope, T(0)};
    repeat<size>([&](auto i) { mean.strain[i] = T(0); });
    T rise[D], share[D], most(0);  // p'; 1 where the coordinate's variation takes part, else 0
    repeat<D>([&](auto d) {
      load(hourglass_memory, d * kPlaneItems<D> + kPlaneItems<D> - 1, rise[d]);
      const T excess = normal<T, D>(mean, moduli_.stress(strain_.plane[d] - ep.plane[d]), rise[d], plane(d)).excess;
      share[d] = select(excess > T(1e-12), T(1), T(0));
      most = larger(most, share[d]);
    });
    const bool together = any(most > T(0));
    if (together) {
      // From the trial on: what the law has returned is taken back.
      const T returned = most * (T(1) / point.kept - T(1));
      const T dp = sqrt(T(1.5) * contract(mean.S, mean.S)) * returned / (T(1.5) * mean.modulus);
      for (int i = 0; i < size; ++i) mean.flow(i, -(returned / mean.modulus * mean.S[i]));
      mean.harden(-dp);
      repeat<D>([&](auto d) {
        if (!any(share[d] > T(0))) return;
        dissipation_ += T(layer.weight) * flow_to_surface<T, D>(mean, moduli_, strain_.plane[d], share[d], ep.plane[d], rise[d], plane(d));
        store(hourglass_memory, d * kPlaneItems<D> + kPlaneItems<D> - 1, rise[d]);
      });
      flow_of_mean(mean);
      take_mean_flow(m, factor, J, mean.strain, mean.p, point, memory);
    }
    const T left = smaller(point.kept * mean.sigma / larger(mean.sigma + T(3) * T(moduli_.mu) * mean.p, T(0.5) * mean.sigma), T(1));
    return relax_all(layer, mean.sigma, left, ep) || together;
  }

  /// Whether a coordinate can be outside its surface: Q_n + mu <= Q_n + sqrt(Q_n Q_m) + Q_m, without directions; asked
  /// first without roots, by sqrt(Q_n Q_m) <= (Q_n + Q_m)/2.
  bool may_yield(const Symmetric<T, D>& S, const YieldStress<T>& yield, const Strain& ep, const double* hourglass_memory) const {
    const T one = T(1) / yield.value, n2 = T(1.5) * contract(S, S) * one * one;
    T q2[D], back[D], most(0);  // of each coordinate: squared face stress and the shift by p', over sigma_s
    repeat<D>([&](auto d) {
      T rise;
      load(hourglass_memory, d * kPlaneItems<D> + kPlaneItems<D> - 1, rise);
      const Plane<T> s = moduli_.stress(strain_.plane[d] - ep.plane[d]);
      q2[d] = (s.a * s.a + s.b * s.b - s.a * s.b + T(3) * s.shear * s.shear) * one * one;
      back[d] = absolute(yield.slope * rise) * one;
      most = larger(most, q2[d] + back[d] * back[d] * n2);
    });
    if (!any(T(1.5) * (n2 + T(2 * kFaceStress * kFaceStress) * most) > T(1))) return false;
    const T n = sqrt(n2);
    most = T(0);
    repeat<D>([&](auto d) {
      const T m = T(kFaceStress) * (sqrt(q2[d]) + back[d] * n);
      most = larger(most, n2 + n * m + m * m);
    });
    return any(most > T(1 + 1e-12));
  }

  /// The last mode, of hexahedra; whether it flows.
  bool relax_all(const LayerConstants& layer, const T& limit, const T& left, Strain& ep) {
    bool changed = false;
    if constexpr (D == 3) repeat<3>([&](auto d) { changed |= relax(limit, left, T(layer.weight), d, ep); });
    return changed;
  }

  /// The plastic strain of the mean, D, enters the law's memory: B <- B - D B - B D, or the
  /// classical S <- S - 2 mu D; it dissipates S : D.
  void take_mean_flow(const SolidConstants& m, const T& factor, const T& J, const Symmetric<T, D>& flow, const T& dp, PointResponse<T, D>& point, double* memory) {
    constexpr int size = Symmetric<T, D>::size;
    if (m.law == Law::classical) {
      for (int i = 0; i < size; ++i) {
        point.S[i] -= T(2 * m.mu) * flow[i];
        store(memory, i, point.S[i]);
      }
    } else {
      Symmetric<T, D> G = load_memory<T, D>(memory);
      Symmetric<T, D> B = push(G, edges_);
      const Symmetric<T, D> change = twice_symmetric_product(flow, B);
      for (int i = 0; i < size; ++i) B[i] -= change[i];
      pull(B, G);
      for (int i = 0; i < size; ++i) store(memory, i, G[i]);
      B = deviator(B);
      for (int i = 0; i < size; ++i) point.S[i] = factor * B[i];
    }
    point.dissipation += J * contract(point.S, flow);
    T p;
    load(memory, size, p);
    store(memory, size, p + dp);
  }

  /// The last mode: it relaxes as a stress does that is not along the flow, and does not pass the yield stress.
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
    repeat<D>([&](auto d) {
      const Plane<T> s = moduli_.stress(strain_.plane[d] - ep.plane[d]);
      stress_.plane[d].a += weight * s.a;
      stress_.plane[d].b += weight * s.b;
      stress_.plane[d].shear += weight * s.shear;
    });
    if constexpr (D == 3) repeat<3>([&](auto d) { stress_.warp[d] += weight * T(moduli_.E) * (strain_.warp[d] - ep.warp[d]); });
  }

  const PlaneModuli<T> moduli_;
  const Edges<T, D, Ring>& edges_;
  const double* constants_;
  std::conditional_t<Ring, HoopStrain<T>, int> hoop_;
  const Fibres<T, D> fibres_;
  Vector<T, D> rise_[Cell::modes], z_[Cell::modes];
  Strain strain_, stress_;
  T dissipation_{0.0};
};

/// One step of the law at the centre and of the variation about it. memory, hourglass_memory: of
/// the cell, the latter kHourglassItems of each layer; none of a hyperelastic body.
template <class T, int D, bool Ring>
PointResponse<T, D> step_with_hourglass(const SolidConstants& m, const Edges<T, D, Ring>& e, const Vector<T, D>* moved, const T& J, double* memory,
                                        Hourglass<T, D, Ring>& hourglass, double* hourglass_memory) {
  constexpr int size = Symmetric<T, D>::size;
  if (m.law == Law::hyperelastic) {
    hourglass.add_elastic();
    return hyperelastic_step(m, e, J, memory);
  }
  PointResponse<T, D> sum;
  for (int i = 0; i < size; ++i) sum.S[i] = T(0);
  sum.dissipation = T(0);
  const T factor = m.law == Law::classical ? T(m.mu) : stress_factor(m, J);
  for (int k = 0; k < m.layers; ++k) {
    PointResponse<T, D> r = m.law == Law::classical ? classical_step(m, e, moved, J, memory, Keep::yes) : layer_step(m, k, factor, e, J, memory, Keep::yes);
    hourglass.add_layer(m, m.layer[k], factor, J, r, memory, hourglass_memory);
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
