#pragma once
// Flow whose rate raises the yield stress (material/rate.h), in a step that is given: how much is found together with its own rate.
//
// In w = ln dp what has to be solved falls and is concave: Newton's iteration comes down on its root from above, however steep
// R rises from where nothing flows. Where a curve levels off fast, as tables may, it is not concave, and a bracket keeps the iteration.
#include "forming_sim/material/hardening.h"

namespace forming_sim {

/// e^w is nothing from here on; a first guess may lie below, where it is the root already.
constexpr double kFarBelow = -700;

/// Newton's iteration on a root of what falls, in w, between what is known to lie below it and above it; halfway between them where it leaves them
/// or gets on too slowly, as about the kink of a table.
template <class T> struct LogSearch {
  T low, high;       ///< of w
  T last = T(1e300); ///< |value| before

  /// From w on, where it is `value` and falls by `falls` per w.
  T next(const T& w, const T& value, const T& falls) {
    low = select(value > T(0), w, low);
    high = select(value < T(0), w, high);
    const T newton = w + value / falls, middle = T(0.5) * (low + high), off = absolute(value);
    const auto slow = (off > T(0.5) * last) & (low > T(kFarBelow));
    last = off;
    return select((newton > high) | (newton < low) | slow, middle, newton);
  }
};

/// Solves q - per dp = sigma_s(p + dp) R(dp/dt) for w = ln dp. start: sigma_s at p; at(dp): at p + dp; most: about what flows without a rate; the search begins there or below.
/// What is not above its start flows by nothing that counts. yield: sigma_s R at the root, and its slope as if R stayed what it is there.
template <class T, class At> T log_of_flow(const RateLaw& law, const T& q, const T& per, const T& most, const YieldStress<T>& start, const At& at, YieldStress<T>& yield) {
  const auto flows = q > start.value * T(1 + 2 * kOnTheSurface);
  LogSearch<T> search{T(kFarBelow), log_of_share(q / per)};
  T w = smaller(log_of_share(most), log_strain_of(law, larger(q / start.value, T(1))));
  for (int i = 0; i < 100; ++i) {
    const T dp = exp(w);
    const YieldStress<T> there = at(dp);
    const RateFactor<T> R = rate_factor(law, w);
    yield = {R.value * there.value, R.value * there.slope, T(0)};
    const T value = q - per * dp - yield.value;
    const auto off = flows & (absolute(value) > T(kOnTheSurface) * q);
    if (!any(off)) break;
    w = select(off, search.next(w, value, (per + yield.slope) * dp + there.value * R.slope), w);
  }
  return w;
}

}  // namespace forming_sim
