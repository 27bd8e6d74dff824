#pragma once
// Isotropic hardening curves sigma_s(p), p the equivalent plastic strain.
#include "forming_sim/tensor/pack.h"

namespace forming_sim {

/// A hardening curve as plain numbers, so that kernels of every vector width share it.
struct HardeningCurve {
  enum Kind { elastic, perfect, linear, voce, swift, table } kind = elastic;
  double lowest = 0;  ///< no sigma_s(p) lies below: what is not stressed that far does not yield, whatever its p
  double a = 0, b = 0, c = 0, d = 0;  ///< perfect: a; linear: a + d p; voce: a - b exp(-c p) + d p; swift: a (b + p)^c
  const double* strain = nullptr;   ///< table
  const double* stress = nullptr;
  int points = 0;
};

/// sigma_s at p, and its first and second derivative with p.
template <class T> struct YieldStress {
  T value, slope, bend;
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
    case HardeningCurve::perfect: return {T(h.a), T(0), T(0)};
    case HardeningCurve::linear: return {T(h.a) + T(h.d) * p, T(h.d), T(0)};
    case HardeningCurve::voce: {
      const T fall = T(h.b) * exp(T(-h.c) * p);
      return {T(h.a) - fall + T(h.d) * p, T(h.c) * fall + T(h.d), T(-h.c * h.c) * fall};
    }
    case HardeningCurve::swift: {
      const T sigma = T(h.a) * lanewise([&](double q) { return std::pow(h.b + q, h.c); }, p);
      const T over = T(1) / (T(h.b) + p), slope = T(h.c) * sigma * over;
      return {sigma, slope, T(h.c - 1) * slope * over};
    }
    case HardeningCurve::table:
      return {lanewise([&](double q) { return table_value(h, q, false); }, p),
              lanewise([&](double q) { return table_value(h, q, true); }, p), T(0)};
    case HardeningCurve::elastic: break;
  }
  return {T(1e300), T(0), T(0)};
}

/// (1 - e^-s)/s for |s| <= kShortWay, by its Taylor polynomial, to 1.4e-15.
constexpr double kShortWay = 1.0 / 256;
template <class T> T mean_decay(const T& s) {
  const T s2 = s * s;
  return (T(1) - T(1.0 / 2) * s) + s2 * ((T(1.0 / 6) - T(1.0 / 24) * s) + s2 * T(1.0 / 120));
}

/// sigma_s at p + dp, given what it is at p: after the short way of one step the exponential of
/// Voce's curve is known without another one.
template <class T> YieldStress<T> yield_stress_beyond(const HardeningCurve& h, const T& p, const YieldStress<T>& at, const T& dp) {
  if (h.kind == HardeningCurve::voce) {
    const T s = T(h.c) * dp;
    if (!any(absolute(s) > T(kShortWay))) {
      const T lost = (at.slope - T(h.d)) * dp * mean_decay(s);  // fall(p) - fall(p + dp), fall = b exp(-c p)
      const T slope = at.slope - T(h.c) * lost;
      return {at.value + lost + T(h.d) * dp, slope, T(-h.c) * (slope - T(h.d))};
    }
  }
  return yield_stress(h, p + dp);
}

}  // namespace forming_sim
