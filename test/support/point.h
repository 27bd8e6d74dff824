#pragma once
// Constants of laws for tests at a single point.
#include <Eigen/LU>

#include "forming_sim/material/material_point.h"

namespace forming_sim {

inline SolidConstants solid_of(double E, double nu, HardeningCurve curve = {}) {
  SolidConstants s;
  s.K = E / (3 * (1 - 2 * nu));
  s.mu = E / (2 * (1 + nu));
  s.layer[0].hardening = curve;
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

/// |sigma - (1/J) dW/dF . F^T| / |sigma| of the first step to F, by central differences.
inline double distance_from_gradient(const SolidConstants& solid, const Mat3& F) {
  MaterialPoint point(solid);
  const double J = F.determinant(), h = 1e-6;
  Mat3 P;  // first Piola-Kirchhoff stress dW/dF
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      Mat3 plus = F, minus = F;
      plus(i, j) += h;
      minus(i, j) -= h;
      P(i, j) = (point.step(plus, false).energy - point.step(minus, false).energy) / (2 * h);
    }
  const Mat3 found = point.step(F, false).stress;
  return (P * F.transpose() / J - found).norm() / found.norm();
}

}  // namespace forming_sim
