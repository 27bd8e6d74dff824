#pragma once
// The law of mild contact and its end-of-step form, for one pair.
//
//   f(h)   = c (1/h - 1/h0)              for h < h0, else 0
//   phi(h) = c (h/h0 - 1 - ln(h/h0))     f = -dphi/dh
//
// With E the modulus of the layer and A the area a node stands for,
// c = E A h0, so that the pressure is E (h0/h - 1).
#include <cmath>

#include "forming_sim/tensor/pack.h"

namespace forming_sim {

/// Force of a pair, N.
inline double mild_force(double h, double h0, double c) { return h < h0 ? c * (1 / h - 1 / h0) : 0; }

/// Potential of a pair, J. Depends on h/h0 only.
inline double mild_potential(double h, double h0, double c) {
  if (h >= h0) return 0;
  const double below = (h - h0) / h0;
  return c * (below - std::log1p(below));
}

/// The gap h > 0 at the end of a step with h = g + dt w p, p = dt f(h): the
/// positive root of h^2 - (g - a/h0) h - a = 0, a = c w dt^2. g is the gap
/// without the pair's own impulse, of any sign; w the inverse mass that the
/// pair feels. Only for g < h0 and w > 0. T: double, or a Pack of pairs.
template <class T> T end_gap(const T& g, const T& h0, const T& c, const T& w, double dt) {
  const T a = c * w * T(dt * dt), b = g - a / h0;
  const T root = sqrt(b * b + T(4.0) * a);
  return select(b >= T(0.0), T(0.5) * (b + root), T(2.0) * a / (root - b));
}

/// The impulse that goes with the end gap, N s; 0 where g >= h0. Written as
/// dt f(h), which stays exact where h is close to g.
template <class T> T end_impulse(const T& g, const T& h0, const T& c, const T& w, double dt, T& h) {
  h = select(g >= h0, g, end_gap(g, h0, c, w, dt));
  return select(h < h0, c * T(dt) * (h0 - h) / (h * h0), T(0.0));
}

}  // namespace forming_sim
