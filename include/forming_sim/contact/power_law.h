#pragma once
// Mild contact as printed, with any exponent n = 1, 2, 3:
//
//   f(h)   = c (1/h^n - 1/h0^n)                       for h < h0, else 0
//   phi(h) = int_h^h0 f = c (h/h0 - 1 - ln(h/h0))     n = 1
//          = c [(h^(1-n) - h0^(1-n))/(n-1) - (h0-h)/h0^n]   n > 1
//   k(h)   = -df/dh = n c / h^(n+1)
//
// The layer has the stiffness E A / h0 at h0, whatever n, with c = E A h0^n / n.
#include <cmath>

namespace forming_sim {

struct PowerLaw {
  int n = 1;
  double h0 = 0;  ///< m

  /// c with which the layer has, at h0, the stiffness of one of n = 1 with c = `linear` (E A h0), N m^n.
  double coefficient(double linear) const { return linear * std::pow(h0, n - 1) / n; }
  /// N
  double force(double h, double c) const { return h < h0 ? c * (std::pow(h, -n) - std::pow(h0, -n)) : 0; }
  /// J
  double potential(double h, double c) const {
    if (h >= h0) return 0;
    const double y = h / h0;
    // c/h0^(n-1) times a function of y
    const double unit = n == 1 ? y - 1 - std::log(y) : (std::pow(y, 1 - n) - 1) / (n - 1) - (1 - y);
    return c * std::pow(h0, 1 - n) * unit;
  }
  /// N/m
  double stiffness(double h, double c) const { return h < h0 ? n * c * std::pow(h, -n - 1) : 0; }
};

}  // namespace forming_sim
