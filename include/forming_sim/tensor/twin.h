#pragma once
// Two numbers that behave as one: a law written for a number runs for two points
// at once, and while one of them waits for a root or a division there is
// the other one's work to do.
#include "forming_sim/tensor/pack.h"

namespace forming_sim {

template <class T> struct Twin {
  T part[2];
  Twin() = default;
  Twin(double s) : part{T(s), T(s)} {}
  Twin(const T& first, const T& second) : part{first, second} {}

  friend Twin operator+(const Twin& a, const Twin& b) { return {a.part[0] + b.part[0], a.part[1] + b.part[1]}; }
  friend Twin operator-(const Twin& a, const Twin& b) { return {a.part[0] - b.part[0], a.part[1] - b.part[1]}; }
  friend Twin operator*(const Twin& a, const Twin& b) { return {a.part[0] * b.part[0], a.part[1] * b.part[1]}; }
  friend Twin operator/(const Twin& a, const Twin& b) { return {a.part[0] / b.part[0], a.part[1] / b.part[1]}; }
  friend Twin operator-(const Twin& a) { return {-a.part[0], -a.part[1]}; }
  Twin& operator+=(const Twin& b) { return *this = *this + b; }
  Twin& operator-=(const Twin& b) { return *this = *this - b; }
  Twin& operator*=(const Twin& b) { return *this = *this * b; }

  /// A truth of each.
  struct Truth {
    decltype(T() > T()) part[2];
  };
  friend Truth operator>(const Twin& a, const Twin& b) { return {{a.part[0] > b.part[0], a.part[1] > b.part[1]}}; }
  friend Truth operator<(const Twin& a, const Twin& b) { return {{a.part[0] < b.part[0], a.part[1] < b.part[1]}}; }
  friend bool any(const Truth& t) { return any(t.part[0]) || any(t.part[1]); }
  friend Twin select(const Truth& t, const Twin& a, const Twin& b) { return {select(t.part[0], a.part[0], b.part[0]), select(t.part[1], a.part[1], b.part[1])}; }

  friend Twin larger(const Twin& a, const Twin& b) { return {larger(a.part[0], b.part[0]), larger(a.part[1], b.part[1])}; }
  friend Twin smaller(const Twin& a, const Twin& b) { return {smaller(a.part[0], b.part[0]), smaller(a.part[1], b.part[1])}; }
  friend Twin absolute(const Twin& a) { return {absolute(a.part[0]), absolute(a.part[1])}; }
  friend Twin sqrt(const Twin& a) { return {sqrt(a.part[0]), sqrt(a.part[1])}; }
  friend Twin exp(const Twin& a) { return {exp(a.part[0]), exp(a.part[1])}; }
  template <class F> friend Twin lanewise(F&& f, const Twin& a) { return {lanewise(f, a.part[0]), lanewise(f, a.part[1])}; }
};

/// What a number T consists of: points_in<T> numbers PartOf<T>, each of a point of its own.
template <class T> constexpr int points_in = 1;
template <class T> constexpr int points_in<Twin<T>> = 2;
template <class T> struct PartOfType { using type = T; };
template <class T> struct PartOfType<Twin<T>> { using type = T; };
template <class T> using PartOf = typename PartOfType<T>::type;

template <class T> T& part_of(T& a, int) { return a; }
template <class T> const T& part_of(const T& a, int) { return a; }
template <class T> T& part_of(Twin<T>& a, int point) { return a.part[point]; }
template <class T> const T& part_of(const Twin<T>& a, int point) { return a.part[point]; }

}  // namespace forming_sim
