#pragma once
// Two numbers that go the same way side by side, as one: where a computation waits for its roots and divisions, what the other
// number asks for is done meanwhile. T is a double or a Pack.
#include "forming_sim/tensor/pack.h"

namespace forming_sim {

template <class Mask> struct TwinMask {
  Mask half[2];
  friend TwinMask operator&(const TwinMask& a, const TwinMask& b) { return {{Mask(a.half[0] & b.half[0]), Mask(a.half[1] & b.half[1])}}; }
  friend TwinMask operator|(const TwinMask& a, const TwinMask& b) { return {{Mask(a.half[0] | b.half[0]), Mask(a.half[1] | b.half[1])}}; }
};

template <class T> struct Twin {
  T half[2];
  Twin() = default;
  Twin(double both) : half{T(both), T(both)} {}
  Twin(const T& first, const T& second) : half{first, second} {}

  friend Twin operator+(const Twin& a, const Twin& b) { return {a.half[0] + b.half[0], a.half[1] + b.half[1]}; }
  friend Twin operator-(const Twin& a, const Twin& b) { return {a.half[0] - b.half[0], a.half[1] - b.half[1]}; }
  friend Twin operator*(const Twin& a, const Twin& b) { return {a.half[0] * b.half[0], a.half[1] * b.half[1]}; }
  friend Twin operator/(const Twin& a, const Twin& b) { return {a.half[0] / b.half[0], a.half[1] / b.half[1]}; }
  friend Twin operator-(const Twin& a) { return {-a.half[0], -a.half[1]}; }
  Twin& operator+=(const Twin& b) { return *this = *this + b; }
  Twin& operator*=(const Twin& b) { return *this = *this * b; }
  friend auto operator>(const Twin& a, const Twin& b) { return TwinMask<decltype(a.half[0] > b.half[0])>{{a.half[0] > b.half[0], a.half[1] > b.half[1]}}; }
  friend auto operator<(const Twin& a, const Twin& b) { return TwinMask<decltype(a.half[0] < b.half[0])>{{a.half[0] < b.half[0], a.half[1] < b.half[1]}}; }
};

template <class Mask> bool any(const TwinMask<Mask>& mask) { return any(mask.half[0]) || any(mask.half[1]); }
template <class Mask, class T> Twin<T> select(const TwinMask<Mask>& mask, const Twin<T>& a, const Twin<T>& b) {
  return {select(mask.half[0], a.half[0], b.half[0]), select(mask.half[1], a.half[1], b.half[1])};
}
template <class T> Twin<T> larger(const Twin<T>& a, const Twin<T>& b) { return {larger(a.half[0], b.half[0]), larger(a.half[1], b.half[1])}; }
template <class T> Twin<T> smaller(const Twin<T>& a, const Twin<T>& b) { return {smaller(a.half[0], b.half[0]), smaller(a.half[1], b.half[1])}; }
template <class T> Twin<T> exp(const Twin<T>& a) { return {exp(a.half[0]), exp(a.half[1])}; }
template <class T> Twin<T> log(const Twin<T>& a) { return {log(a.half[0]), log(a.half[1])}; }
template <class T> Twin<T> sqrt(const Twin<T>& a) { return {sqrt(a.half[0]), sqrt(a.half[1])}; }
template <class T> Twin<T> absolute(const Twin<T>& a) { return {absolute(a.half[0]), absolute(a.half[1])}; }

/// Numbers in memory of which each half has its own.
struct TwinItems {
  const double* half[2];
};
template <class T> void load(const TwinItems& from, int item, Twin<T>& to) {
  load(from.half[0], item, to.half[0]);
  load(from.half[1], item, to.half[1]);
}

/// A half of a number; of one that is no twin itself.
template <class T> T& half_of(T& number, int) { return number; }
template <class T> T& half_of(Twin<T>& number, int i) { return number.half[i]; }

}  // namespace forming_sim
