#pragma once
// The stable time step of a cell, dt = 2/omega.
//
// omega^2 <= max over simplices (deviatoric part) + omega_vol^2 (pressure part):
// * Deviatoric, one linear simplex with equal nodal masses rho V0/(d+1) and
//   S = sum_a g_a g_a^T (g_a the shape gradients): the largest eigenvalue of the
//   stiffness 2 mu dev(eps) is, exactly,
//     (d+1)/rho mu max( 2 (I1/3 + sqrt(I1^2/9 - I2/3)), s1 + s2 ),
//   I1, I2 the invariants and s1 >= s2 >= s3 the eigenvalues of S; in plane strain
//   I1 = s1 + s2, I2 = s1 s2. In 3D s1 + s2 = I1 - s3 with s3 bounded from below by
//   the iteration s3 <- 4 I3/(I1 - s3)^2. Rings: element/ring_step.h. Large elastic strain enters by the
//   tangent of the law (point_tangent in material/law.h).
// * Pressure: one mode per cell, K/V0 grad V grad V^T, whose eigenvalue with the
//   cell's nodal masses is  omega_vol^2 = K/V0 sum_a |dV/dx_a|^2 / m_a.
//   With a share theta of the element's own pressure, and with a guard (element/guard.h), the two add up. With p per element it is the element's own; with p per node the element's
//   own bounds it (the squares of means do not exceed the means of squares), with what its guard adds (element/guard.h).
// * Crossed triangles whose law sees drawn strains (element/crossed.h): the larger of the deviatoric parts of the triangles and of those that
//   the law sees, and what the middle node has more than in the former. With dF = sum_s V_s dF_s/V, dF_s = dF + q (x) a_s + z (x) g_s,
//     sum_s V_s |dF~_s|^2 = V |dF|^2 + sum_s V_s |lambda q (x) a_s + lambda (1 - beta_s) z (x) g_s|^2,
//   q of the corners, z of the middle: at most sum_s V_s |dF_s|^2 unless S = sum_s V_s (lambda^2 (1 - beta_s)^2 - 1) g_s g_s^T is positive
//   somewhere. It is not in the shape that the weights are for, and is where a long cell has become short and has still those of a long one. There z has, more than without them,
//     mu (tr S + max eigenvalue of S/3) (1/m_z + sum_b w_b^2/m_b),   |dev sym z (x) g|^2 = (|z|^2 |g|^2 + (z.g)^2/3)/2.
// * Where the law is at the edges (element/edge_points.h), the deviatoric part of a simplex is the mean over
//   its edges of theirs: K = sum_e K_e, K_e <= omega_e^2 M_e, M_e = sum_s M_s/k over the simplices around e.
//   omega_e^2 = mu/rho max(...) with S = sum_a g_a g_a^T V_e rho/m_ea; of a ring with M of element/ring_step.h.
// Bulk viscosity eta = rho l (b1 c + b2^2 l |D|) adds the damping
//   C = eta/V sum_a |dV/dx_a|^2 / m_a;  what the step becomes: element/step_bounds.h.
#include "forming_sim/element/cell_group.h"
#include "forming_sim/element/guard.h"
#include "forming_sim/element/ring_step.h"
#include "forming_sim/material/law.h"

namespace forming_sim {

/// S += k a b, symmetric together with its twin b a.
template <class T, int D> void add_product(Symmetric<T, D>& S, const T& k, const Vector<T, D>& a, const Vector<T, D>& b) {
  for (int i = 0; i < D; ++i) S[i] += k * a[i] * b[i];
  S[3] += k * a[0] * b[1];
  if constexpr (D == 3) {
    S[4] += k * a[1] * b[2];
    S[5] += k * a[2] * b[0];
  }
}

/// max(2 (I1/3 + sqrt(I1^2/9 - I2/3)), s1 + s2) and I1 = tr S.
template <class T, int D> T shape_bound(const Symmetric<T, D>& S, T& I1) {
  T I2, shear;
  if constexpr (D == 2) {
    I1 = S[0] + S[1];
    I2 = S[0] * S[1] - S[3] * S[3];
    shear = I1;
  } else {
    const Symmetric<T, 3> cof = cofactor(S);
    I1 = trace(S);
    I2 = trace(cof);
    const T I3 = determinant(S, cof);
    T s3(0.0);
    for (int i = 0; i < 3; ++i) s3 = T(4.0) * I3 / ((I1 - s3) * (I1 - s3));
    shear = I1 - s3;
  }
  const T root = sqrt(larger(I1 * I1 * T(1.0 / 9) - I2 * T(1.0 / 3), T(0.0)));
  return larger(T(2.0) * (I1 * T(1.0 / 3) + root), shear);
}

/// What bounds the step of a cell: the squares of its frequencies, 1/s2, and its damping, 1/s.
template <class T> struct StepRates {
  T omega2, damping;
};

/// The damping by bulk viscosity. sum: sum_a |dV/dx_a|^2 / m_a; rate: |dV/dt|/V.
template <class T, int D> T viscous_damping(const CellGroup& g, const T& sum, const T& V, const T& extent, const T& rate) {
  if (!(g.linear_viscosity > 0 || g.quadratic_viscosity > 0)) return T(0.0);
  const T l = lanewise([](double v) { return D == 2 ? __builtin_sqrt(v) : __builtin_cbrt(v); }, extent);
  const double c = __builtin_sqrt((g.solid.K + 4.0 / 3 * g.solid.mu) / g.density);
  const double b2 = g.quadratic_viscosity;
  const T eta = T(g.density) * l * (T(g.linear_viscosity * c) + T(b2 * b2) * l * rate);
  return eta / V * sum;
}

template <class T, int D, int Nodes, bool Ring> class StepBound {
 public:
  /// inertia: of a ring's cell nodes, radial and axial: equal share of the mass over the
  /// node's own, 0 where it is held; null elsewhere.
  StepBound(const CellGroup& g, const Vector<T, D>* inertia)
      : g_(g), inertia_(inertia), deviatoric_(0.0), element_(0.0), V_(0.0), V0_(0.0), extent_(0.0) {
    for (int i = 0; i < Symmetric<T, D>::size; ++i) more_[i] = T(0.0);
    for (int a = 0; a < Nodes; ++a) {
      mass_[a] = T(0.0);
      for (int i = 0; i < D; ++i) gradient_[a][i] = T(0.0);
    }
  }

  /// at_edges: where the law is at the edges the deviatoric part of omega^2, for which no memory is read; null elsewhere. free: of its guard.
  template <class Corners>
  void add(const Edges<T, D, Ring>& e, const double* memory, const T* at_edges, const T& V0, const T& free, const Corners& corner) {
    const Shapes shapes = shapes_of(e, corner);
    const T J = e.volume / V0;
    const T omega2 = at_edges ? *at_edges : deviatoric(point_tangent(g_.solid, e, J, memory), shapes);
    const T volumetric = T((D + 1) * g_.solid.K / g_.density) * pressure_tangent(g_.solid, J) * shapes.volumetric;
    const T guard = T(g_.guard) * guard_slope(J, free);  // over K
    deviatoric_ = larger(deviatoric_, omega2);
    element_ = larger(element_, omega2 + volumetric * (T(1) + guard));
    own_ = larger(own_, volumetric * (T(g_.element_share) + guard));
    V_ += e.volume;
    V0_ += V0;
    extent_ += extent(e);
    const T share = V0 * T(g_.density / (D + 1));
    for (int a = 0; a <= D; ++a) {
      gradient_[corner[a]] += e.volume * shapes.g[a];
      mass_[corner[a]] += share;
    }
  }

  /// Where the law sees other edges than the volume (element/crossed.h): the deviatoric part of those. middle: lambda (1 - beta_s).
  template <class Corners> void add_law(const Edges<T, D, Ring>& e, const double* memory, const T& V0, const T& middle, const Corners& corner) {
    const T tangent = point_tangent(g_.solid, e, e.volume / V0, memory);
    deviatoric_ = larger(deviatoric_, deviatoric(tangent, shapes_of(e, corner)));
    law_tangent_ = larger(law_tangent_, tangent);
    Vector<T, D> g = e.up[0];
    for (int m = 1; m < D; ++m) g += e.up[m];
    add_product(more_, V0 * (middle * middle - T(1)), g, g);
  }
  /// After the last of them: what the middle node, whose way is z = x_m - sum_b w_b x_b, has more. w: of the other nodes.
  void add_middle(const T* w) {
    static_assert(D == 2);
    T inverse_mass = inverse_mass_of(Nodes - 1);
    for (int b = 0; b < Nodes - 1; ++b) inverse_mass += w[b] * w[b] * inverse_mass_of(b);
    const T half = T(0.5) * (more_[0] + more_[1]), apart = T(0.5) * (more_[0] - more_[1]);
    const T largest = half + sqrt(apart * apart + more_[3] * more_[3]);
    middle_ = T(g_.solid.mu) * law_tangent_ * larger(T(2) * half + T(1.0 / 3) * largest, T(0.0)) * inverse_mass;
  }

  /// rate: |dV/dt|/V, for the quadratic viscosity.
  StepRates<T> rates(const T& rate) const {
    T sum(0.0);
    for (int a = 0; a < Nodes; ++a) {
      if constexpr (Ring)
        sum += (inertia_[a][0] * gradient_[a][0] * gradient_[a][0] + inertia_[a][1] * gradient_[a][1] * gradient_[a][1]) / mass_[a];
      else
        sum += dot(gradient_[a], gradient_[a]) / mass_[a];
    }
    const T cell_volumetric = T(g_.solid.K) * pressure_tangent(g_.solid, V_ / V0_) * V0_ / (V_ * V_) * sum;
    const bool per_cell = g_.pressure == PressureMode::cell;
    const T omega2 = per_cell ? deviatoric_ + T(1 - g_.element_share) * cell_volumetric + own_ : element_;
    return {omega2 + middle_, viscous_damping<T, D>(g_, sum, V_, extent_, rate)};
  }

 private:
  /// What the gradients of a simplex make of omega^2.
  struct Shapes {
    Vector<T, D> g[D + 1];  ///< dV/dx_a / V of its corners
    T deviatoric, volumetric;
  };
  template <class Corners> Shapes shapes_of(const Edges<T, D, Ring>& e, const Corners& corner) const {
    Shapes s;
    s.g[0] = T(-1.0) * e.up[0];
    for (int m = 0; m < D; ++m) {
      s.g[m + 1] = e.up[m];
      if (m > 0) s.g[0] += T(-1.0) * e.up[m];
    }
    if constexpr (Ring) {
      RingShapes<T> ring;
      ring.hoop = T(1.0 / 3) * e.up[2][0];
      for (int a = 0; a < 3; ++a) {
        ring.g[a] = s.g[a];
        ring.inertia[a] = inertia_[corner[a]];
        s.g[a][0] += ring.hoop;
      }
      s.deviatoric = ring.deviatoric();
      s.volumetric = ring.volumetric();
    } else {
      s.deviatoric = deviatoric_bound(s.g, s.volumetric);
    }
    return s;
  }
  T deviatoric(const T& tangent, const Shapes& shapes) const { return T((D + 1) / g_.density * g_.solid.mu) * tangent * shapes.deviatoric; }
  T inverse_mass_of(int a) const {
    if constexpr (Ring) return inertia_[a][1] / mass_[a];
    else return T(1) / mass_[a];
  }
  static T deviatoric_bound(const Vector<T, D>* g, T& I1) {
    Symmetric<T, D> S;
    for (int i = 0; i < Symmetric<T, D>::size; ++i) S[i] = T(0.0);
    for (int a = 0; a <= D; ++a) add_product(S, T(1), g[a], g[a]);
    return shape_bound(S, I1);
  }
  const CellGroup& g_;
  const Vector<T, D>* inertia_;
  T deviatoric_, element_, own_{0.0}, V_, V0_, extent_, law_tangent_{0.0}, middle_{0.0};
  Symmetric<T, D> more_;  ///< S of the middle node
  Vector<T, D> gradient_[Nodes];
  T mass_[Nodes];
};

}  // namespace forming_sim
