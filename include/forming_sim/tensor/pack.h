#pragma once
// The packed scalar: eight doubles that behave as one number, so that a law is
// written once, for a single point (T = double) and for eight elements (T = Pack).
//
// This header is compiled once per instruction set (see CMakeLists.txt); Pack
// lives in a namespace of that set's name, so that no code made for a wider
// processor is ever linked into a narrower path.
#include <cmath>
#include <cstdint>

#ifndef FORMING_SIM_ISA
#define FORMING_SIM_ISA portable
#endif

namespace forming_sim {

constexpr int kLanes = 8;

// The same words for a plain double, so that templates read alike.
inline bool any(bool mask) { return mask; }
inline double select(bool mask, double a, double b) { return mask ? a : b; }
inline double larger(double a, double b) { return a > b ? a : b; }
inline double smaller(double a, double b) { return a < b ? a : b; }
inline double sqrt(double a) { return std::sqrt(a); }
inline double exp(double a) { return std::exp(a); }
inline double absolute(double a) { return std::fabs(a); }
template <class F> double lanewise(F&& f, double a) { return f(a); }

namespace FORMING_SIM_ISA {

typedef double Lanes __attribute__((vector_size(64)));
typedef std::int64_t Bits __attribute__((vector_size(64)));

struct Mask {
  Bits v;  ///< all ones where true
};

struct Pack {
  Lanes v;
  Pack() = default;
  Pack(double s) : v{s, s, s, s, s, s, s, s} {}
  explicit Pack(Lanes lanes) : v(lanes) {}
  static Pack load(const double* p) { return Pack(*reinterpret_cast<const Lanes*>(p)); }
  void store(double* p) const { *reinterpret_cast<Lanes*>(p) = v; }
  double operator[](int lane) const { return v[lane]; }

  friend Pack operator+(Pack a, Pack b) { return Pack(a.v + b.v); }
  friend Pack operator-(Pack a, Pack b) { return Pack(a.v - b.v); }
  friend Pack operator*(Pack a, Pack b) { return Pack(a.v * b.v); }
  friend Pack operator/(Pack a, Pack b) { return Pack(a.v / b.v); }
  friend Pack operator-(Pack a) { return Pack(-a.v); }
  Pack& operator+=(Pack b) { v += b.v; return *this; }
  Pack& operator-=(Pack b) { v -= b.v; return *this; }
  Pack& operator*=(Pack b) { v *= b.v; return *this; }
  friend Mask operator>(Pack a, Pack b) { return {a.v > b.v}; }
  friend Mask operator<(Pack a, Pack b) { return {a.v < b.v}; }
  friend Mask operator>=(Pack a, Pack b) { return {a.v >= b.v}; }
};

inline bool any(Mask m) {
  return (m.v[0] | m.v[1] | m.v[2] | m.v[3] | m.v[4] | m.v[5] | m.v[6] | m.v[7]) != 0;
}
inline Pack select(Mask m, Pack a, Pack b) { return Pack(m.v ? a.v : b.v); }
inline Pack larger(Pack a, Pack b) { return select(a > b, a, b); }
inline Pack smaller(Pack a, Pack b) { return select(a < b, a, b); }
inline Pack absolute(Pack a) { return larger(a, -a); }
inline double sum(Pack a) {
  return ((a[0] + a[1]) + (a[2] + a[3])) + ((a[4] + a[5]) + (a[6] + a[7]));
}
template <class F> Pack lanewise(F&& f, Pack a) {
  Pack r;
  for (int l = 0; l < kLanes; ++l) r.v[l] = f(a.v[l]);
  return r;
}
inline Pack sqrt(Pack a) {
  Pack r;
  for (int l = 0; l < kLanes; ++l) r.v[l] = __builtin_sqrt(a.v[l]);
  return r;
}

/// e^x to 2 units in the last place for |x| < 700, clamped beyond: x = n ln 2 + r,
/// |r| <= ln 2 / 2, e^r by its Taylor polynomial of degree 13.
inline Pack exp(Pack x) {
  const double round_magic = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to an integer
  x = smaller(larger(x, Pack(-700.0)), Pack(700.0));
  const Lanes shifted = x.v * 1.4426950408889634 + round_magic;
  const Pack n(shifted - round_magic);
  const Pack r = (x - n * Pack(6.93145751953125e-1)) - n * Pack(1.42860682030941723212e-6);
  Pack e(1.0 / 6227020800.0);
  const double coefficient[] = {1.0 / 479001600, 1.0 / 39916800, 1.0 / 3628800, 1.0 / 362880, 1.0 / 40320,
                                1.0 / 5040,      1.0 / 720,      1.0 / 120,     1.0 / 24,     1.0 / 6,
                                0.5,             1.0,            1.0};
  for (double c : coefficient) e = e * r + Pack(c);
  return Pack((Lanes)(((Bits)shifted << 52) + (Bits)e.v));  // the low bits of `shifted` hold n
}

}  // namespace FORMING_SIM_ISA

/// J^(-1/3) for J > 0, by Newton's method on y^-3 = J from the tangent at J = 1,
/// which never lies above the root: the iteration rises to it without overshoot.
template <class T> T inverse_cube_root(T J) {
  T y = larger((T(4) - J) * T(1.0 / 3), T(0.3));
  for (int i = 0; i < 60; ++i) {
    const T next = y * (T(4) - J * y * y * y) * T(1.0 / 3);
    const T change = next - y;
    y = next;
    if (!any(absolute(change) > T(1e-15) * absolute(y) + T(1e-300))) break;
    if (i >= 3 && !any(absolute(change) > T(1e-9) * absolute(y))) break;  // the next error is its square
  }
  return y;
}

}  // namespace forming_sim
