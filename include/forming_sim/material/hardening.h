#pragma once
// Isotropic hardening curves sigma_s(p), p the equivalent plastic strain.
#include "forming_sim/material/rate.h"

namespace forming_sim {

/// A hardening curve as plain numbers, so that kernels of every vector width share it.
struct HardeningCurve {
  enum Kind { elastic, perfect, linear, voce, swift, table } kind = elastic;
  double lowest = 0;  ///< no sigma_s(p) lies below: what is not stressed that far does not yield, whatever its p
  double a = 0, b = 0, c = 0, d = 0;  ///< perfect: a; linear: a + d p; voce: a - b exp(-c p) + d p; swift: a (b + p)^c
  const double* strain = nullptr;   ///< table
  const double* stress = nullptr;
  int points = 0;
  RateLaw rate;                     ///< what raises it while it flows
};

/// sigma_s at p, and its first and second derivative with p.
template <class T> struct YieldStress {
  T value, slope, bend;
};

/// Relative distance of q from sigma_s below which a point is on the yield surface: what stands still there keeps its memory.
constexpr double kOnTheSurface = 1e-13;

/// That of a table: on the last line that starts at or below p, from the one on which the least p of the lanes lies.
template <class T> YieldStress<T> table_stress(const HardeningCurve& h, const T& p) {
  const auto rise = [&](int i) { return i + 1 < h.points ? (h.stress[i + 1] - h.stress[i]) / (h.strain[i + 1] - h.strain[i]) : 0; };
  const double first = least(p);
  int i = 0;
  for (int beyond = h.points; beyond - i > 1;) {
    const int middle = (i + beyond) / 2;
    (h.strain[middle] <= first ? i : beyond) = middle;
  }
  T strain(h.strain[i]), stress(h.stress[i]), slope(rise(i));
  for (++i; i < h.points; ++i) {
    const auto there = p >= T(h.strain[i]);
    if (!any(there)) break;
    strain = select(there, T(h.strain[i]), strain);
    stress = select(there, T(h.stress[i]), stress);
    slope = select(there, T(rise(i)), slope);
  }
  return {stress + slope * (p - strain), slope, T(0)};
}

/// That of Swift's curve, sigma its value at p.
template <class T> YieldStress<T> swift_stress(const HardeningCurve& h, const T& sigma, const T& p) {
  const T over = T(1) / (T(h.b) + p), slope = T(h.c) * sigma * over;
  return {sigma, slope, T(h.c - 1) * slope * over};
}

template <class T> YieldStress<T> yield_stress(const HardeningCurve& h, const T& p) {
  switch (h.kind) {
    case HardeningCurve::perfect: return {T(h.a), T(0), T(0)};
    case HardeningCurve::linear: return {T(h.a) + T(h.d) * p, T(h.d), T(0)};
    case HardeningCurve::voce: {
      const T fall = T(h.b) * exp(T(-h.c) * p);
      return {T(h.a) - fall + T(h.d) * p, T(h.c) * fall + T(h.d), T(-h.c * h.c) * fall};
    }
    case HardeningCurve::swift: return swift_stress(h, T(h.a) * exp(T(h.c) * log(T(h.b) + p)), p);
    case HardeningCurve::table: return table_stress(h, p);
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
/// (1 + z)^c - 1 for |z| <= kShortShare and c from 0 to 1, by its binomial series, to 1e-16.
constexpr double kShortShare = 1.0 / 64;
template <class T> T power_beyond_one(double c, const T& z) {
  const T z2 = z * z, z4 = z2 * z2;
  double k[8] = {1};  // of z^(n+1)/c
  for (int n = 1; n < 8; ++n) k[n] = k[n - 1] * (c - n) * (1.0 / (n + 1));
  const auto pair = [&](int n) { return T(k[n]) + T(k[n + 1]) * z; };
  return T(c) * z * ((pair(0) + z2 * pair(2)) + z4 * (pair(4) + z2 * pair(6)));
}

/// sigma_s at p + dp, given what it is at p: after the short way of one step the exponential of
/// Voce's curve and the power of Swift's are known without another one.
template <class T> YieldStress<T> yield_stress_beyond(const HardeningCurve& h, const T& p, const YieldStress<T>& at, const T& dp) {
  if (h.kind == HardeningCurve::voce) {
    const T s = T(h.c) * dp;
    if (!any(absolute(s) > T(kShortWay))) {
      const T lost = (at.slope - T(h.d)) * dp * mean_decay(s);  // fall(p) - fall(p + dp), fall = b exp(-c p)
      const T slope = at.slope - T(h.c) * lost;
      return {at.value + lost + T(h.d) * dp, slope, T(-h.c) * (slope - T(h.d))};
    }
  }
  if (h.kind == HardeningCurve::swift) {
    const T z = dp / (T(h.b) + p);
    if (!any(absolute(z) > T(kShortShare))) return swift_stress(h, at.value + at.value * power_beyond_one(h.c, z), p + dp);
  }
  return yield_stress(h, p + dp);
}

}  // namespace forming_sim
