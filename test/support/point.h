#pragma once
// A law at a single point, driven through deformation gradients.
#include <Eigen/LU>
#include <cmath>
#include <functional>

#include "forming_sim/material/von_mises.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// One tetrahedron whose initial edges are the unit vectors: x_m = F e_m.
struct MaterialPoint {
  SolidConstants solid;
  Symmetric<double, 3> G{{1, 1, 1, 0, 0, 0}};
  double p = 0, dissipated = 0;

  struct Response {
    Mat3 stress;
    double energy;  ///< per initial volume
  };

  static Edges<double, 3> edges(const Mat3& F) {
    Edges<double, 3> e;
    for (int m = 0; m < 3; ++m)
      for (int i = 0; i < 3; ++i) e.x[m][i] = F(i, m);
    find_reciprocal(e);
    return e;
  }

  /// Cauchy stress at F; `keep` makes the step count.
  Response at(const Mat3& F, bool keep = true) {
    const Edges<double, 3> e = edges(F);
    const double J = F.determinant();
    const Symmetric<double, 3> B = push(G, e);
    double p_new = p;
    const PointResult<double, 3> r = update_point(solid, B, J, p_new);
    if (keep) {
      const Symmetric<double, 3> Gx = metric(e);
      for (int i = 0; i < 6; ++i) G[i] = r.a * G[i] + (1 - r.a) * Gx[i];
      p = p_new;
      dissipated += r.dissipation;
    }
    Response out;
    const double pressure = solid.K * (J - 1);
    out.stress << r.S[0] + pressure, r.S[3], r.S[5], r.S[3], r.S[1] + pressure, r.S[4], r.S[5], r.S[4], r.S[2] + pressure;
    out.energy = 0.5 * solid.K * (J - 1) * (J - 1) + deviatoric_energy(solid, push(G, e), J);
    return out;
  }

  /// Step to axial stretch along x with free sides; returns the axial stress.
  double uniaxial(double stretch, double& lateral) {
    for (int i = 0; i < 50; ++i) {
      const double h = 1e-7;
      auto side = [&](double l) { return at(Vec3(stretch, l, l).asDiagonal().toDenseMatrix(), false).stress(1, 1); };
      const double s = side(lateral), slope = (side(lateral + h) - side(lateral - h)) / (2 * h);
      const double change = -s / slope;
      lateral += change;
      if (std::fabs(change) < 1e-14) break;
    }
    return at(Vec3(stretch, lateral, lateral).asDiagonal().toDenseMatrix()).stress(0, 0);
  }
};

inline SolidConstants solid_of(double E, double nu, HardeningCurve curve = {}) {
  SolidConstants s;
  s.K = E / (3 * (1 - 2 * nu));
  s.mu = E / (2 * (1 + nu));
  s.hardening = curve;
  return s;
}

inline HardeningCurve perfect(double Y) { HardeningCurve h; h.kind = HardeningCurve::perfect; h.a = Y; return h; }
inline HardeningCurve voce(double Y, double saturation, double rate) {
  HardeningCurve h;
  h.kind = HardeningCurve::voce;
  h.a = saturation;
  h.b = saturation - Y;
  h.c = rate;
  return h;
}

}  // namespace forming_sim
