#pragma once
// How fast flow raises the yield stress: sigma_s(p) R(r), r = d p/dt the rate of the equivalent plastic strain.
//
//   cowper_symonds  R = 1 + (r/r0)^(1/P)
//   johnson_cook    R = 1 + C ln(r/r0) above r0, else 1
//   power           R = (r/r0)^m above r0, else 1
//
// A step of length dt takes r = dp/dt with the dp that it finds itself (backward Euler, material/rate_flow.h): what is stressed
// beyond sigma_s(p) flows on until that is gone, at any length of the step.
#include "forming_sim/tensor/pack.h"

namespace forming_sim {

/// Plain numbers, as a HardeningCurve is.
struct RateLaw {
  enum Kind { none, cowper_symonds, johnson_cook, power } kind = none;
  double log_reference = 0;  ///< ln r0, r0 in 1/s
  double sensitivity = 0;    ///< 1/P; C; m
  double log_step = 0;       ///< ln dt, dt in s, of the step that is taken
};

/// R, and its derivative with ln r.
template <class T> struct RateFactor {
  T value, slope;
};

/// ln of a number that may be 0, which counts as 1e-300.
template <class T> T log_of_share(const T& a) { return log(larger(a, T(1e-300))); }

/// After the plastic strain e^w in the step.
template <class T> RateFactor<T> rate_factor(const RateLaw& law, const T& w) {
  const T beyond = w - T(law.log_step + law.log_reference);  // ln r/r0
  const T c(law.sensitivity), above = larger(beyond, T(0));
  switch (law.kind) {
    case RateLaw::cowper_symonds: {
      const T power = exp(c * beyond);
      return {T(1) + power, c * power};
    }
    case RateLaw::johnson_cook: return {T(1) + c * above, select(beyond > T(0), c, T(0))};
    case RateLaw::power: {
      const T power = exp(c * above);
      return {power, select(beyond > T(0), c * power, T(0))};
    }
    case RateLaw::none: break;
  }
  return {T(1), T(0)};
}

/// The w at which R is R; of R = 1 one at which nothing is raised.
template <class T> T log_strain_of(const RateLaw& law, const T& R) {
  const T over(1 / law.sensitivity), start(law.log_step + law.log_reference);
  if (law.kind == RateLaw::cowper_symonds) return start + over * log_of_share(R - T(1));
  if (law.kind == RateLaw::johnson_cook) return start + over * (R - T(1));
  return start + over * log(R);
}

}  // namespace forming_sim
