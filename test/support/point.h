#pragma once
// Constants of laws for tests at a single point.
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

}  // namespace forming_sim
