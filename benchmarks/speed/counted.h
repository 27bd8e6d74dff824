#pragma once
// A scalar that counts: the law and the geometry of an element, which are written for any scalar,
// run with it to find how many operations they take.
#include <cmath>

namespace forming_sim::bench {

struct Counted {
  double value = 0;
  Counted() = default;
  Counted(double v) : value(v) {}
  static long operations;  ///< additions, multiplications, divisions, roots, minima and maxima, one each

  static Counted result(double v) {
    ++operations;
    return Counted(v);
  }
  friend Counted operator+(Counted a, Counted b) { return result(a.value + b.value); }
  friend Counted operator-(Counted a, Counted b) { return result(a.value - b.value); }
  friend Counted operator*(Counted a, Counted b) { return result(a.value * b.value); }
  friend Counted operator/(Counted a, Counted b) { return result(a.value / b.value); }
  friend Counted operator-(Counted a) { return Counted(-a.value); }
  Counted& operator+=(Counted b) { return *this = *this + b; }
  Counted& operator-=(Counted b) { return *this = *this - b; }
  Counted& operator*=(Counted b) { return *this = *this * b; }
  friend bool operator>(Counted a, Counted b) { return a.value > b.value; }
  friend bool operator<(Counted a, Counted b) { return a.value < b.value; }
  friend bool operator>=(Counted a, Counted b) { return a.value >= b.value; }
};
inline long Counted::operations = 0;

inline Counted select(bool mask, Counted a, Counted b) { return mask ? a : b; }
inline Counted larger(Counted a, Counted b) { return Counted::result(a.value > b.value ? a.value : b.value); }
inline Counted smaller(Counted a, Counted b) { return Counted::result(a.value < b.value ? a.value : b.value); }
inline Counted absolute(Counted a) { return Counted::result(std::fabs(a.value)); }
inline Counted sqrt(Counted a) { return Counted::result(std::sqrt(a.value)); }
inline Counted exp(Counted a) {
  Counted::operations += 31;  // as the packed one: clamp, reduction, 13 terms
  return Counted(std::exp(a.value));
}
inline Counted log(Counted a) {
  Counted::operations += 30;
  return Counted(std::log(a.value));
}
inline double least(Counted a) { return a.value; }
template <class F> Counted lanewise(F&& f, Counted a) { return Counted::result(f(a.value)); }
inline void load(const double* from, int item, Counted& to) { to = Counted(from[item]); }
inline void store(double* to, int item, Counted value) { to[item] = value.value; }

}  // namespace forming_sim::bench
