#pragma once
// The packed scalar: several doubles that behave as one number, so that a law is
// written once, for a single point (T = double) and for several elements (T = Pack).
//
// This header is compiled once per instruction set (see CMakeLists.txt); Pack
// lives in a namespace of that set's name, so that no code made for a wider
// processor is ever linked into a narrower path. A Pack is as wide as that set's registers:
// eight doubles with AVX-512, four with AVX2, two with SSE2.
#include <immintrin.h>

#include <cmath>
#include <cstdint>
#include <utility>

#ifndef FORMING_SIM_ISA
#define FORMING_SIM_ISA portable
#endif

namespace forming_sim {

/// What is kept of elements, or of pairs in contact, lies in blocks of so many side by side, whatever the width of a Pack:
/// the widest takes a block at once, others a part of it after the other.
constexpr int kLanes = 8;

// The same words for a plain double, so that templates read alike.
inline bool any(bool mask) { return mask; }
inline double select(bool mask, double a, double b) { return mask ? a : b; }
inline double larger(double a, double b) { return a > b ? a : b; }
inline double smaller(double a, double b) { return a < b ? a : b; }
inline double sqrt(double a) { return std::sqrt(a); }
inline double exp(double a) { return std::exp(a); }
inline double log(double a) { return std::log(a); }
inline double absolute(double a) { return std::fabs(a); }
inline double least(double a) { return a; }  ///< of all lanes
template <class F> double lanewise(F&& f, double a) { return f(a); }
/// Doubles from one number of a point to the next in memory: 1, or a block's lanes.
template <class T> constexpr int stride_of = 1;
/// Registers that hold such numbers.
template <class T> constexpr int registers_of = 16;
inline void load(const double* from, int item, double& to) { to = from[item]; }
inline void store(double* to, int item, double value) { to[item] = value; }

/// The same place, forgotten to have been read: numbers that are asked for again much later are loaded again, instead of
/// being kept in a register that is not free and so written elsewhere.
inline const double* read_again(const double* from) {
  asm("" : "+r"(from));
  return from;
}

namespace FORMING_SIM_ISA {

/// Lanes of a Pack, and Packs of a block.
#if defined(__AVX512DQ__)
constexpr int kWidth = 8;
#elif defined(__AVX2__)
constexpr int kWidth = 4;
#else
constexpr int kWidth = 2;
#endif
constexpr int kPacks = kLanes / kWidth;

typedef double Lanes __attribute__((vector_size(kWidth * sizeof(double))));
typedef std::int64_t Bits __attribute__((vector_size(kWidth * sizeof(double))));
typedef std::uint64_t Whole __attribute__((vector_size(kWidth * sizeof(double))));

/// Of what at(lane) gives.
template <class At, std::size_t... lane> [[gnu::always_inline]] inline Lanes lanes_from(const At& at, std::index_sequence<lane...>) { return Lanes{at(static_cast<int>(lane))...}; }
template <class At> [[gnu::always_inline]] inline Lanes lanes_from(const At& at) { return lanes_from(at, std::make_index_sequence<kWidth>()); }

/// One truth a lane.
#if defined(__AVX512DQ__)
struct Mask {
  __mmask8 v;  ///< a bit a lane
  friend Mask operator&(Mask a, Mask b) { return {static_cast<__mmask8>(a.v & b.v)}; }
  friend Mask operator|(Mask a, Mask b) { return {static_cast<__mmask8>(a.v | b.v)}; }
};
#else
struct Mask {
  Bits v;  ///< all ones where true
  friend Mask operator&(Mask a, Mask b) { return {a.v & b.v}; }
  friend Mask operator|(Mask a, Mask b) { return {a.v | b.v}; }
};
#endif

struct Pack {
  Lanes v;
  Pack() = default;
  Pack(double s) : v(lanes_from([s](int) { return s; })) {}
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
#if defined(__AVX512DQ__)
  friend Mask operator>(Pack a, Pack b) { return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_GT_OQ)}; }
  friend Mask operator<(Pack a, Pack b) { return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_LT_OQ)}; }
  friend Mask operator>=(Pack a, Pack b) { return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_GE_OQ)}; }
#else
  friend Mask operator>(Pack a, Pack b) { return {a.v > b.v}; }
  friend Mask operator<(Pack a, Pack b) { return {a.v < b.v}; }
  friend Mask operator>=(Pack a, Pack b) { return {a.v >= b.v}; }
#endif
};

#if defined(__AVX512DQ__)
inline bool any(Mask m) { return m.v != 0; }
inline bool all(Mask m) { return m.v == 0xff; }
inline Pack select(Mask m, Pack a, Pack b) { return Pack(_mm512_mask_blend_pd(m.v, b.v, a.v)); }
inline Pack larger(Pack a, Pack b) { return Pack(_mm512_maskz_max_pd(0xff, a.v, b.v)); }
inline Pack smaller(Pack a, Pack b) { return Pack(_mm512_maskz_min_pd(0xff, a.v, b.v)); }
inline Pack sqrt(Pack a) { return Pack(_mm512_maskz_sqrt_pd(0xff, a.v)); }
#elif defined(__AVX2__)
inline bool any(Mask m) { return _mm256_movemask_pd((__m256d)m.v) != 0; }
inline bool all(Mask m) { return _mm256_movemask_pd((__m256d)m.v) == 0xf; }
inline Pack select(Mask m, Pack a, Pack b) { return Pack(_mm256_blendv_pd(b.v, a.v, (__m256d)m.v)); }
inline Pack larger(Pack a, Pack b) { return Pack(_mm256_max_pd(a.v, b.v)); }
inline Pack smaller(Pack a, Pack b) { return Pack(_mm256_min_pd(a.v, b.v)); }
inline Pack sqrt(Pack a) { return Pack(_mm256_sqrt_pd(a.v)); }
#else
inline bool any(Mask m) { return _mm_movemask_pd((__m128d)m.v) != 0; }
inline bool all(Mask m) { return _mm_movemask_pd((__m128d)m.v) == 0x3; }
inline Pack select(Mask m, Pack a, Pack b) { return Pack((Lanes)((m.v & (Bits)a.v) | (~m.v & (Bits)b.v))); }
inline Pack larger(Pack a, Pack b) { return Pack(_mm_max_pd(a.v, b.v)); }
inline Pack smaller(Pack a, Pack b) { return Pack(_mm_min_pd(a.v, b.v)); }
inline Pack sqrt(Pack a) { return Pack(_mm_sqrt_pd(a.v)); }
#endif
inline void load(const double* from, int item, Pack& to) { to = Pack::load(from + item * kLanes); }
inline void store(double* to, int item, Pack value) { value.store(to + item * kLanes); }
inline Pack absolute(Pack a) { return Pack((Lanes)((Bits)a.v & INT64_MAX)); }  // without the bit of the sign
/// All lanes joined, in pairs of pairs.
template <class Join> inline double joined(Pack a, const Join& join) {
  double part[kWidth];
  for (int l = 0; l < kWidth; ++l) part[l] = a[l];
  for (int n = kWidth / 2; n > 0; n /= 2)
    for (int l = 0; l < n; ++l) part[l] = join(part[2 * l], part[2 * l + 1]);
  return part[0];
}
inline double least(Pack a) {
  return joined(a, [](double b, double c) { return b < c ? b : c; });
}
inline double sum(Pack a) {
  return joined(a, [](double b, double c) { return b + c; });
}
/// Of the first lanes; those behind them count for nothing.
inline double sum_of_first(Pack a, int lanes) {
  for (int l = lanes; l < kWidth; ++l) a.v[l] = 0;
  return sum(a);
}

/// Numbers anywhere in memory.
inline Pack gather_numbers(const double* from, const int* index) {
  return Pack(lanes_from([&](int l) { return from[index[l]]; }));
}
/// Adds to numbers anywhere in memory; lanes may have one in common.
inline void add_numbers(Pack a, const int* index, double* to) {
  for (int l = 0; l < kWidth; ++l) to[index[l]] += a[l];
}

/// Four doubles anywhere in memory: a nodal record; and two.
typedef double Quad __attribute__((vector_size(32), aligned(8)));
typedef double Pair __attribute__((vector_size(16), aligned(8)));

/// Loads the nodal record of each lane, that of lane l at at(l), and hands back their components.
template <class At> [[gnu::always_inline]] inline void gather_records(const At& at, Pack& x, Pack& y, Pack& z, Pack& fourth) {
#if defined(__AVX512DQ__)
  const auto two = [&](int k, int l) -> Lanes {
    const Quad &low = *reinterpret_cast<const Quad*>(at(k)), &high = *reinterpret_cast<const Quad*>(at(l));
    return _mm512_maskz_insertf64x4(0xff, _mm512_castpd256_pd512((__m256d)low), (__m256d)high, 1);
  };
  const Lanes even = two(0, 2), odd = two(1, 3), even_high = two(4, 6), odd_high = two(5, 7);
  const Lanes xz = __builtin_shufflevector(even, odd, 0, 8, 2, 10, 4, 12, 6, 14), yw = __builtin_shufflevector(even, odd, 1, 9, 3, 11, 5, 13, 7, 15);
  const Lanes xz_high = __builtin_shufflevector(even_high, odd_high, 0, 8, 2, 10, 4, 12, 6, 14);
  const Lanes yw_high = __builtin_shufflevector(even_high, odd_high, 1, 9, 3, 11, 5, 13, 7, 15);
  x.v = __builtin_shufflevector(xz, xz_high, 0, 1, 4, 5, 8, 9, 12, 13);
  y.v = __builtin_shufflevector(yw, yw_high, 0, 1, 4, 5, 8, 9, 12, 13);
  z.v = __builtin_shufflevector(xz, xz_high, 2, 3, 6, 7, 10, 11, 14, 15);
  fourth.v = __builtin_shufflevector(yw, yw_high, 2, 3, 6, 7, 10, 11, 14, 15);
#elif defined(__AVX2__)
  const auto pairs = [&](int k, int l, int half) {  // of two records, beside each other
    const Pair &low = *reinterpret_cast<const Pair*>(at(k) + half), &high = *reinterpret_cast<const Pair*>(at(l) + half);
    return Lanes(_mm256_insertf128_pd(_mm256_castpd128_pd256((__m128d)low), (__m128d)high, 1));
  };
  const Lanes even = pairs(0, 2, 0), odd = pairs(1, 3, 0), even_high = pairs(0, 2, 2), odd_high = pairs(1, 3, 2);
  x.v = __builtin_shufflevector(even, odd, 0, 4, 2, 6);
  y.v = __builtin_shufflevector(even, odd, 1, 5, 3, 7);
  z.v = __builtin_shufflevector(even_high, odd_high, 0, 4, 2, 6);
  fourth.v = __builtin_shufflevector(even_high, odd_high, 1, 5, 3, 7);
#else
  const auto pair = [&](int l, int half) -> Lanes { return *reinterpret_cast<const Pair*>(at(l) + half); };
  const Lanes even = pair(0, 0), odd = pair(1, 0), even_high = pair(0, 2), odd_high = pair(1, 2);
  x.v = __builtin_shufflevector(even, odd, 0, 2);
  y.v = __builtin_shufflevector(even, odd, 1, 3);
  z.v = __builtin_shufflevector(even_high, odd_high, 0, 2);
  fourth.v = __builtin_shufflevector(even_high, odd_high, 1, 3);
#endif
}
/// The first three alone.
template <class At> [[gnu::always_inline]] inline void gather_records(const At& at, Pack& x, Pack& y, Pack& z) {
  Pack unused;
  gather_records(at, x, y, z, unused);
}

/// Adds the pairs (x, y) to those that start at to[at[lane]]; lanes may have one in common.
inline void add_pairs(Pack x, Pack y, const int* at, double* to) {
  const auto add = [&](int lane, Pair pair) { *reinterpret_cast<Pair*>(to + at[lane]) += pair; };
#if defined(__AVX512DQ__)
  const Lanes pairs[2] = {__builtin_shufflevector(x.v, y.v, 0, 8, 1, 9, 2, 10, 3, 11), __builtin_shufflevector(x.v, y.v, 4, 12, 5, 13, 6, 14, 7, 15)};
  for (int k = 0; k < 2; ++k) {
    add(4 * k, __builtin_shufflevector(pairs[k], pairs[k], 0, 1));
    add(4 * k + 1, __builtin_shufflevector(pairs[k], pairs[k], 2, 3));
    add(4 * k + 2, __builtin_shufflevector(pairs[k], pairs[k], 4, 5));
    add(4 * k + 3, __builtin_shufflevector(pairs[k], pairs[k], 6, 7));
  }
#elif defined(__AVX2__)
  const Lanes even = __builtin_shufflevector(x.v, y.v, 0, 4, 2, 6), odd = __builtin_shufflevector(x.v, y.v, 1, 5, 3, 7);
  add(0, __builtin_shufflevector(even, even, 0, 1));
  add(1, __builtin_shufflevector(odd, odd, 0, 1));
  add(2, __builtin_shufflevector(even, even, 2, 3));
  add(3, __builtin_shufflevector(odd, odd, 2, 3));
#else
  add(0, __builtin_shufflevector(x.v, y.v, 0, 2));
  add(1, __builtin_shufflevector(x.v, y.v, 1, 3));
#endif
}
/// The vectors (x, y, z) as records of four doubles, the last of each zero.
inline void to_records(Pack x, Pack y, Pack z, Quad* records) {
  const Lanes zero = Pack(0.0).v;
#if defined(__AVX512DQ__)
  const Lanes xy0 = __builtin_shufflevector(x.v, y.v, 0, 8, 1, 9, 2, 10, 3, 11);
  const Lanes xy1 = __builtin_shufflevector(x.v, y.v, 4, 12, 5, 13, 6, 14, 7, 15);
  const Lanes z0 = __builtin_shufflevector(z.v, zero, 0, 8, 1, 9, 2, 10, 3, 11);
  const Lanes z1 = __builtin_shufflevector(z.v, zero, 4, 12, 5, 13, 6, 14, 7, 15);
  const Lanes two[4] = {__builtin_shufflevector(xy0, z0, 0, 1, 8, 9, 2, 3, 10, 11), __builtin_shufflevector(xy0, z0, 4, 5, 12, 13, 6, 7, 14, 15),
                        __builtin_shufflevector(xy1, z1, 0, 1, 8, 9, 2, 3, 10, 11), __builtin_shufflevector(xy1, z1, 4, 5, 12, 13, 6, 7, 14, 15)};
  for (int k = 0; k < 4; ++k) {
    records[2 * k] = __builtin_shufflevector(two[k], two[k], 0, 1, 2, 3);
    records[2 * k + 1] = __builtin_shufflevector(two[k], two[k], 4, 5, 6, 7);
  }
#elif defined(__AVX2__)
  const Lanes even = __builtin_shufflevector(x.v, y.v, 0, 4, 2, 6), odd = __builtin_shufflevector(x.v, y.v, 1, 5, 3, 7);
  const Lanes even_z = __builtin_shufflevector(z.v, zero, 0, 4, 2, 6), odd_z = __builtin_shufflevector(z.v, zero, 1, 5, 3, 7);
  records[0] = __builtin_shufflevector(even, even_z, 0, 1, 4, 5);
  records[1] = __builtin_shufflevector(odd, odd_z, 0, 1, 4, 5);
  records[2] = __builtin_shufflevector(even, even_z, 2, 3, 6, 7);
  records[3] = __builtin_shufflevector(odd, odd_z, 2, 3, 6, 7);
#else
  for (int l = 0; l < kWidth; ++l) records[l] = Quad{x[l], y[l], z[l], zero[0]};
#endif
}
/// Adds the vectors (x, y, z) to records of four doubles, which start at to[at[lane]], nothing to the last of each; lanes may have one in common.
inline void add_records(Pack x, Pack y, Pack z, const int* at, double* to) {
  Quad records[kWidth];
  to_records(x, y, z, records);
  for (int l = 0; l < kWidth; ++l) *reinterpret_cast<Quad*>(to + at[l]) += records[l];
}

template <class F> Pack lanewise(F&& f, Pack a) {
  return Pack(lanes_from([&](int l) { return f(a[l]); }));
}

/// Of sixteen numbers those that the lowest four bits of each lane count.
struct alignas(64) Sixteen {
  double value[16];
  Pack operator[](Bits j) const {
#if defined(__AVX512DQ__)
    return Pack(_mm512_permutex2var_pd(_mm512_load_pd(value), (__m512i)j, _mm512_load_pd(value + 8)));
#else
    return Pack(lanes_from([&](int l) { return value[j[l] & 15]; }));
#endif
  }
};
/// 2^(j/16)
constexpr Sixteen kPowers{{1, 1.0442737824274138, 1.0905077326652577, 1.1387886347566916, 1.189207115002721, 1.241857812073484, 1.2968395546510096, 1.3542555469368927,
                           1.4142135623730951, 1.4768261459394993, 1.5422108254079407, 1.6104903319492543, 1.681792830507429, 1.7562521603732995, 1.8340080864093424, 1.9152065613971474}};
/// 1/(1 + (j + 1/2)/16), and minus the logarithm of that.
constexpr Sixteen kInverses{{0.9696969696969697, 0.9142857142857143, 0.8648648648648649, 0.8205128205128205, 0.7804878048780488, 0.7441860465116279, 0.7111111111111111, 0.6808510638297872,
                             0.6530612244897959, 0.6274509803921569, 0.6037735849056604, 0.5818181818181818, 0.5614035087719298, 0.5423728813559322, 0.5245901639344263, 0.5079365079365079}};
constexpr Sixteen kLogarithms{{0.03077165866675366, 0.08961215868968717, 0.14518200984449783, 0.19782574332991992, 0.2478361639045812, 0.2954642128938359, 0.3409265869705932, 0.38441169891033206,
                               0.42608439531090014, 0.46608972992459924, 0.5045560107523953, 0.5415972824327444, 0.5773153650348236, 0.6118015411059929, 0.6451379613735847, 0.6773988235918061}};

/// e^x to 2 units in the last place for |x| < 700, clamped beyond: x = n ln 2 / 16 + r,
/// |r| <= ln 2 / 32, e^r - 1 by its Taylor polynomial of degree 7, in pairs of terms that do not wait for each other.
inline Pack exp(Pack x) {
  const double round_magic = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to an integer
  x = smaller(larger(x, Pack(-700.0)), Pack(700.0));
  const Lanes shifted = x.v * (16 * 1.4426950408889634) + round_magic;
  const Pack n(shifted - round_magic);
  const Pack r = (x - n * Pack(0.04332169875851832)) - n * Pack(2.64782585363080249318e-11);
  const Pack r2 = r * r;
  const Pack beyond_one = r + r2 * ((Pack(0.5) + Pack(1.0 / 6) * r) + r2 * (Pack(1.0 / 24) + Pack(1.0 / 120) * r + r2 * (Pack(1.0 / 720) + Pack(1.0 / 5040) * r)));
  const Bits power = (Bits)shifted;  // the low bits hold n
  const Pack start = kPowers[power];
  return Pack((Lanes)((Bits)(((Whole)power >> 4) << 52) + (Bits)(start + start * beyond_one).v));
}

/// ln x to 2e-16 and to that part of itself, for normal x > 0: x = 2^n m, m = (1 + r)/c_j, c_j of the sixteen that is next to 1/m,
/// |r| <= 1/32, ln (1 + r) by its Taylor polynomial of degree 10, in pairs of terms that do not wait for each other.
inline Pack log(Pack x) {
  const Whole whole = (Whole)x.v;
  const Bits j = (Bits)(whole >> 48);
  const double two_52 = 4503599627370496.0;  // its last bit counts one: the exponent put there is added to it
  const Pack n((Lanes)((whole >> 52) | 0x4330000000000000u) - (two_52 + 1023)), m((Lanes)((whole & 0xfffffffffffffu) | 0x3ff0000000000000u));
  const Pack r = m * kInverses[j] - Pack(1.0), r2 = r * r, r4 = r2 * r2;
  const auto pair = [&](int k) { return Pack(1.0 / k) - Pack(1.0 / (k + 1)) * r; };
  const Pack beyond_r = (pair(3) + r2 * pair(5)) + r4 * (pair(7) + r2 * pair(9));
  return n * Pack(0.6931471805599453) + (kLogarithms[j] + (r + r2 * (r * beyond_r - Pack(0.5))));
}

}  // namespace FORMING_SIM_ISA

template <> constexpr int stride_of<FORMING_SIM_ISA::Pack> = kLanes;
#if defined(__AVX512DQ__)
template <> constexpr int registers_of<FORMING_SIM_ISA::Pack> = 32;
#endif

/// J^(-1/3) for J > 0. For |J - 1| <= 0.2 from its Taylor polynomial y of degree 4 about J = 1, which is
/// right to 5e-5, by J^(-1/3) = y (1 - r)^(-1/3), r = 1 - J y^3, to the third power of r: to
/// round-off. Farther away by Newton's method on y^-3 = J from the tangent at J = 1 or, for large J, from .3 or 1/J,
/// which never lie above the root: the iteration rises to it without overshoot.
template <class T> T inverse_cube_root(const T& J) {
  const T d = J - T(1), d2 = d * d;
  T y = (T(1) - T(1.0 / 3) * d) + d2 * (T(2.0 / 9) - T(14.0 / 81) * d + T(35.0 / 243) * d2);
  const T r = T(1) - (J * y) * (y * y), yr = y * r;
  y += yr * (T(1.0 / 3) + r * (T(2.0 / 9) + T(14.0 / 81) * r));
  if (any(absolute(d) > T(0.2))) {
    y = larger((T(4) - J) * T(1.0 / 3), select(J > T(36.0), T(1) / J, T(0.3)));
    for (int i = 0; i < 64; ++i) {
      const T next = y * (T(4) - J * y * y * y) * T(1.0 / 3);
      const T change = next - y;
      y = next;
      if (!any(absolute(change) > T(1e-15) * y)) break;
    }
  }
  return y;
}

}  // namespace forming_sim
