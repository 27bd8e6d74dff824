#pragma once
// Several numbers that behave as one: a law written for a number runs for N points
// at once, and while one of them waits for a root or a division there is
// the others' work to do.
#include "forming_sim/tensor/pack.h"
#include "forming_sim/tensor/repeat.h"

namespace forming_sim {

template <class T, int N> struct Several {
  T part[N];
  Several() = default;
  Several(double s) {
    repeat<N>([&](auto i) { part[i] = T(s); });
  }
  /// part i: f(i).
  template <class F> static Several of(F&& f) {
    Several r;
    repeat<N>([&](auto i) { r.part[i] = f(i); });
    return r;
  }

  friend Several operator+(const Several& a, const Several& b) { return of([&](auto i) { return a.part[i] + b.part[i]; }); }
  friend Several operator-(const Several& a, const Several& b) { return of([&](auto i) { return a.part[i] - b.part[i]; }); }
  friend Several operator*(const Several& a, const Several& b) { return of([&](auto i) { return a.part[i] * b.part[i]; }); }
  friend Several operator/(const Several& a, const Several& b) { return of([&](auto i) { return a.part[i] / b.part[i]; }); }
  friend Several operator-(const Several& a) { return of([&](auto i) { return -a.part[i]; }); }
  Several& operator+=(const Several& b) { return *this = *this + b; }
  Several& operator-=(const Several& b) { return *this = *this - b; }
  Several& operator*=(const Several& b) { return *this = *this * b; }

  /// A truth of each.
  struct Truth {
    decltype(T() > T()) part[N];
  };
  friend Truth operator>(const Several& a, const Several& b) {
    Truth t;
    repeat<N>([&](auto i) { t.part[i] = a.part[i] > b.part[i]; });
    return t;
  }
  friend Truth operator<(const Several& a, const Several& b) { return b > a; }
  friend bool any(const Truth& t) {
    bool one = false;
    repeat<N>([&](auto i) { one |= any(t.part[i]); });
    return one;
  }
  friend Several select(const Truth& t, const Several& a, const Several& b) { return of([&](auto i) { return select(t.part[i], a.part[i], b.part[i]); }); }

  friend Several larger(const Several& a, const Several& b) { return of([&](auto i) { return larger(a.part[i], b.part[i]); }); }
  friend Several smaller(const Several& a, const Several& b) { return of([&](auto i) { return smaller(a.part[i], b.part[i]); }); }
  friend Several absolute(const Several& a) { return of([&](auto i) { return absolute(a.part[i]); }); }
  friend Several sqrt(const Several& a) { return of([&](auto i) { return sqrt(a.part[i]); }); }
  friend Several exp(const Several& a) { return of([&](auto i) { return exp(a.part[i]); }); }
  template <class F> friend Several lanewise(F&& f, const Several& a) { return of([&](auto i) { return lanewise(f, a.part[i]); }); }
};

/// What a number T consists of: points_in<T> numbers PartOf<T>, each of a point of its own.
template <class T> constexpr int points_in = 1;
template <class T, int N> constexpr int points_in<Several<T, N>> = N;
template <class T> struct PartOfType { using type = T; };
template <class T, int N> struct PartOfType<Several<T, N>> { using type = T; };
template <class T> using PartOf = typename PartOfType<T>::type;

template <class T> T& part_of(T& a, int) { return a; }
template <class T> const T& part_of(const T& a, int) { return a; }
template <class T, int N> T& part_of(Several<T, N>& a, int point) { return a.part[point]; }
template <class T, int N> const T& part_of(const Several<T, N>& a, int point) { return a.part[point]; }

}  // namespace forming_sim
