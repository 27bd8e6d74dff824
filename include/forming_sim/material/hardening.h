#pragma once
// Isotropic hardening curves sigma_s(p), p the equivalent plastic strain.
#include "forming_sim/tensor/pack.h"

namespace forming_sim {

/// A hardening curve as plain numbers, so that kernels of every vector width share it.
struct HardeningCurve {
  enum Kind { elastic, perfect, linear, voce, swift, table } kind = elastic;
  double a = 0, b = 0, c = 0, d = 0;  ///< perfect: a; linear: a + d p; voce: a - b exp(-c p) + d p; swift: a (b + p)^c
  const double* strain = nullptr;   ///< table
  const double* stress = nullptr;
  int points = 0;
};

/// sigma_s and d sigma_s / d p at p.
template <class T> struct YieldStress {
  T value, slope;
};

inline double table_value(const HardeningCurve& h, double p, bool slope) {
  if (p >= h.strain[h.points - 1]) return slope ? 0 : h.stress[h.points - 1];
  int i = 0;
  while (i + 2 < h.points && p >= h.strain[i + 1]) ++i;
  const double rise = (h.stress[i + 1] - h.stress[i]) / (h.strain[i + 1] - h.strain[i]);
  return slope ? rise : h.stress[i] + rise * (p - h.strain[i]);
}

template <class T> YieldStress<T> yield_stress(const HardeningCurve& h, const T& p) {
  switch (h.kind) {
    case HardeningCurve::perfect: return {T(h.a), T(0)};
    case HardeningCurve::linear: return {T(h.a) + T(h.d) * p, T(h.d)};
    case HardeningCurve::voce: {
      const T fall = T(h.b) * exp(T(-h.c) * p);
      return {T(h.a) - fall + T(h.d) * p, T(h.c) * fall + T(h.d)};
    }
    case HardeningCurve::swift: {
      const T sigma = T(h.a) * lanewise([&](double q) { return std::pow(h.b + q, h.c); }, p);
      return {sigma, T(h.c) * sigma / (T(h.b) + p)};
    }
    case HardeningCurve::table:
      return {lanewise([&](double q) { return table_value(h, q, false); }, p),
              lanewise([&](double q) { return table_value(h, q, true); }, p)};
    case HardeningCurve::elastic: break;
  }
  return {T(1e300), T(0)};
}

}  // namespace forming_sim
