#pragma once
// The yield surface that the mean stress of a one-point cell and its variation across the cell
// share.
//
// With S the mean deviator, s the stress at the faces of one coordinate (hourglass.h), m = h dev s
// and H = d sigma_s/dp, p' the variation of the plastic strain, a cell can bear what satisfies
//
//   Q_n + mu <= 1,   mu = Q_m/2 + sqrt(Q_m^2/4 + Q_nm^2),
//   (Q_n, Q_m, Q_nm) = 3/2 (S:S, m:m, S:m) / sigma_s^2,   m = h (dev s - H p'/sigma_s S).
//
// or of an anisotropic material A in place of 1 between them (element/anisotropic_flow.h), S : A S the square of its norm over 3/2.
// This is the surface of Ivanov (1967) for plates and shells. In one direction it is
// |m| <= 1 - n^2, what a rectangle of yield stress bears about any neutral axis, and
// h = 2/3 makes it so; where the whole cell flows one way, s is that of the hardening
// alone.
//
// Flow is normal to it in (S, s/3), the stresses that work on the mean and on ep. On the surface a
// flow with multiplier L takes d p = 2 L/sigma_s, such that sigma_s dp is what it dissipates, and
// d p' = S : d ep / sigma_s.
#include "forming_sim/element/hourglass_strain.h"
#include "forming_sim/material/hardening.h"

namespace forming_sim {

/// How a yield surface measures deviators, 3/2 S : A S = q^2: von Mises', A = 1.
struct Isotropic {
  static constexpr bool is_one = true;
  static constexpr double most = 1;  ///< largest S : A S over S : S
};

/// s at the faces over the m of the yield surface.
constexpr double kFaceStress = 2.0 / 3;

/// The mean of a layer while its cell flows.
template <class T, int D> struct MeanFlow {
  Symmetric<T, D> S;  ///< Pa
  T modulus;          ///< of S: twice that of shear, Pa
  T sigma, slope;     ///< sigma_s and H, Pa
  T p;                ///< d p of this step

  void harden(const T& dp) {
    p += dp;
    sigma += slope * dp;
  }
};

/// What the surface knows of S and s: S:S, S : dev s and dev s : dev s.
template <class T> struct Products {
  T SS, Ss, ss;
};

/// What one coordinate's surface finds. Its gradients lie between S and dev s:
/// d(Q_n + mu)/dS = along_S S + across dev s, d(Q_n + mu)/ds = across S + along_s dev s, 1/Pa.
template <class T> struct Normal {
  T root;  ///< sqrt(Q_n + mu), at least 1
  T along_S, across, along_s;
  T varied;  ///< d(Q_n + mu)/ds : S
  T rises;   ///< p' per L
  T Sm;      ///< S : m/h
  T turn;    ///< the change of it up to which it may change its sign: kSmoothTurn
};

/// dev s as what works on strains of the plane: dev s : dev r = work(s, deviatoric(r)).
template <class T> Plane<T> deviatoric(const Plane<T>& s) {
  const T third(1.0 / 3), mean = third * (s.a + s.b);
  return {s.a - mean, s.b - mean, T(2) * s.shear};
}

/// The plane in which s lies, of the unit vectors t_1 and t_2 (in 2D t_2 = e_3): where a body has turned, they have
/// turned with it.
template <class T, int D> struct PlaneOf {
  Vector<T, D> t, v;  ///< t_1, and in 3D t_2

  /// Of coordinate d. turned: the fibres that take z, turned with the cell.
  template <class Items> void set(const Fibres<T, D>& turned, const Items& constants, int d) {
    T slope;
    const int i = D == 2 ? d : (d + 1) % 3;
    load(constants, OnePoint<D>::slopes + i, slope);
    const T one = T(1) / slope;
    t = one * turned.along[i];
    if constexpr (D == 3) {
      const Skew<T> skew(constants, d);  // t_2 = (u_j - cos u_i)/sin
      v = skew.second * one * turned.along[(d + 2) % 3] - skew.cotangent * t;
    }
  }
  /// dev s: t_1 and t_2 with the tractions w = s t_1 and z = s t_2.
  Symmetric<T, D> deviator(const Plane<T>& s) const {
    const T mean = T(1.0 / 3) * (s.a + s.b);
    if constexpr (D == 2) {
      return {{s.a * t[0] * t[0] - mean, s.a * t[1] * t[1] - mean, s.b - mean, s.a * t[0] * t[1]}};
    } else {
      const Vector<T, 3> w = s.a * t + s.shear * v, z = s.shear * t + s.b * v;
      return {{t[0] * w[0] + v[0] * z[0] - mean, t[1] * w[1] + v[1] * z[1] - mean, t[2] * w[2] + v[2] * z[2] - mean,
               t[0] * w[1] + v[0] * z[1], t[1] * w[2] + v[1] * z[2], t[2] * w[0] + v[2] * z[0]}};
    }
  }
  /// Components of a tensor in the plane, the shear twice.
  Plane<T> part(const Symmetric<T, D>& a) const {
    if constexpr (D == 2) {
      return {a[0] * t[0] * t[0] + a[1] * t[1] * t[1] + T(2) * a[3] * t[0] * t[1], a[2], T(0)};
    } else {
      const Vector<T, 3> at = a * t;
      return {dot(t, at), dot(v, a * v), T(2) * dot(v, at)};
    }
  }
};

template <class T, int D> Products<T> products(const Symmetric<T, D>& S, const Plane<T>& s, const PlaneOf<T, D>& at, const Isotropic&) {
  return {contract(S, S), work(s, at.part(S)), work(s, deviatoric(s))};
}

/// Q_n, Q_m and Q_nm; over: 1/sigma_s; back: H p'/sigma_s. m/h = dev s - back S.
template <class T> struct Quadratic {
  T scale, Sm, n, m, nm;
  Quadratic(const Products<T>& q, const T& over, const T& back) {
    constexpr double h = kFaceStress;
    scale = T(1.5) * over * over;
    Sm = q.Ss - back * q.SS;
    n = scale * q.SS;
    m = T(h * h) * scale * (q.ss - back * (q.Ss + Sm));
    nm = T(h) * scale * Sm;
  }
  T under_root() const { return T(0.25) * m * m + nm * nm; }
};

/// Where Q_n + mu > limit, without a root.
template <class T> auto is_outside(const Quadratic<T>& Q, double limit) {
  const T left = T(limit) - Q.n - T(0.5) * Q.m;
  return (left < T(0)) | (Q.under_root() > left * left);
}

/// n_x^2 - n_x n_y + n_y^2 + 3 t^2 of a plane stress: the square of its Mises norm.
template <class T> T face_square(const Plane<T>& s) { return s.a * (s.a - s.b) + s.b * s.b + T(3) * s.shear * s.shear; }

/// Where s can be outside, without directions: Q_n + mu <= Q_n + n m + m^2 with n^2 = Q_n and m <= h (s + H |p'| n/sigma_s), s the norm of
/// the face stress over sigma_s, and m^2 <= 2 h^2 (s^2 + (H p'/sigma_s)^2) since n <= 1 once the law has answered. Asked times sigma_s^4,
/// without roots and divisions. n2: 3/2 S:S; q2: face_square; back: H p'; sigma2: sigma_s^2.
template <class T> auto may_be_outside(const T& n2, const T& q2, const T& back, const T& sigma2) {
  const T m2 = T(2 * kFaceStress * kFaceStress) * (q2 + back * back), left = larger(T(1 + 1e-12) * sigma2 - n2 - m2, T(0));
  return n2 * m2 > left * left;
}

/// The change of Q_nm in a step, over Q_m, up to which it may change its sign. The surface turns there over some Q_m, and is an edge where Q_m is 0.
constexpr double kSmoothTurn = 0.01;

template <class T> [[gnu::always_inline]] inline Normal<T> normal(const Products<T>& q, const T& over, const T& back) {
  constexpr double h = kFaceStress;
  const Quadratic<T> Q(q, over, back);
  const T mu_root = larger(sqrt(Q.under_root()), T(1e-30));
  Normal<T> r;
  r.root = sqrt(larger(Q.n + T(0.5) * Q.m + mu_root, T(1)));
  const T one = T(1) / (mu_root * r.root), safe = one * r.root;
  const T by_S = T(h) * Q.scale * Q.nm * safe, by_m = T(h * h) * Q.scale * (T(1) + T(0.5) * Q.m * safe);  // of d mu/dm, by S and by m/h
  r.along_s = by_m;
  r.across = by_S - back * by_m;
  r.along_S = T(2) * Q.scale - back * (by_S + r.across);
  r.varied = r.along_s * q.Ss + r.across * q.SS;
  r.rises = T(3) * r.varied * over * (one * mu_root);
  r.Sm = Q.Sm;
  r.turn = T(kSmoothTurn) * Q.m / (T(h) * Q.scale);
  return r;
}

/// Roots of Q_n + mu from which Newton's step lands near the surface. From farther out it would turn s round.
constexpr double kNearSurface = 1.5;

/// What share of its way to the surface a coordinate goes where `outside` of them are outside. They go one after the other, and each draws the others
/// along: two or three that go all the way drive vibrations on, step by step (steady_flow_test). With 3/4 or 1/2 of it the rest is left to the next steps,
/// little where steps are small; what is far outside goes all of it, since there the step is large, and what it leaves would be.
template <class T> T part_of_way(const T& outside, const T& root) {
  return T(1) - T(0.25) * (outside - T(1)) * larger(T(1) - T(1 / (kNearSurface - 1)) * (root - T(1)), T(0));
}

/// 1 in place of none: cells of a pack that have no stress at all go along with those that flow, and perfect metal does not harden there; the step they would take is 0.
template <class T> T some_resistance(const T& resistance) { return select(absolute(resistance) > T(1e-300), resistance, T(1)); }

/// L of a Newton's step on root = sqrt(Q_n + mu), which is of first degree in the stresses: far outside it is the radial return. elastic: by what the stresses along the flow fall
/// per L; hardening adds to it.
template <class T> T step_to_surface(const Normal<T>& n, const T& elastic, const T& slope, const T& over, const T& share, const T& outside) {
  const T resistance = elastic + slope * over * over * (T(4) * n.root * n.root * n.root + T(3) * n.varied * n.varied);
  return share * part_of_way(outside, n.root) * T(2) * n.root * (n.root - T(1)) / some_resistance(resistance);
}

/// Where one coordinate is farther outside than that, S and s go back along themselves first, as they would by the radial return.
template <class T, int D>
[[gnu::noinline]] inline void return_to_near(MeanFlow<T, D>& mean, const Plane<T>& strain, const T& share, const T& root, Plane<T>& ep) {
  const T kept = select(share * root > T(kNearSurface), T(kNearSurface) / root, T(1)), gone = T(1) - kept;
  const Plane<T> elastic = strain - ep;
  ep = {ep.a + gone * elastic.a, ep.b + gone * elastic.b, ep.shear + gone * elastic.shear};
  mean.harden(gone * sqrt(T(1.5) * contract(mean.S, mean.S)) / (T(1.5) * mean.modulus));
  repeat<Symmetric<T, D>::size>([&](auto i) { mean.S[i] *= kept; });
}

/// One coordinate flows where share is 1, of the `outside` that do: mean, ep and p' (rise) follow; what the variation dissipates per initial volume.
/// Where the whole cell flows one way it goes no further than to where m comes to lie across S: there the surface has an edge, or turns within less
/// than the step, and beyond it the normal leads back. Where m is more than that it is smooth, and S, however small, is no reason to stop.
template <class T, int D>
[[gnu::always_inline]] inline T flow_to_surface(MeanFlow<T, D>& mean, const PlaneModuli& moduli, const Plane<T>& strain, const T& share, const T& outside, Plane<T>& ep, T& rise,
                                                const PlaneOf<T, D>& at, const Isotropic&, const Symmetric<T, D>&) {
  Plane<T> s, dev_s, part;
  Products<T> q;
  T over, back;
  const Plane<T> before = ep;
  const auto find_stresses = [&] {
    s = moduli.stress(strain - ep), dev_s = deviatoric(s), part = at.part(mean.S);
    q = {contract(mean.S, mean.S), work(s, part), work(s, dev_s)};
    over = T(1) / mean.sigma, back = mean.slope * rise * over;
  };
  find_stresses();
  Normal<T> n = normal(q, over, back);
  if (any(share * n.root > T(kNearSurface))) {
    return_to_near<T, D>(mean, strain, share, n.root, ep);
    find_stresses();
    n = normal(q, over, back);
  }
  const Plane<T> direction{n.across * part.a + n.along_s * dev_s.a, n.across * part.b + n.along_s * dev_s.b, n.across * part.shear + n.along_s * dev_s.shear};
  const Plane<T> softer = moduli.stress(direction);
  const T squared = n.along_S * (n.along_S * q.SS + T(2) * n.across * q.Ss) + n.across * n.across * q.ss;
  T L = step_to_surface(n, mean.modulus * squared + T(3) * work(softer, direction), mean.slope, over, share, outside);
  const T of_S = mean.modulus * n.along_S, of_s = mean.modulus * n.across;  // S becomes (1 - L of_S) S - L of_s dev s
  const T kept = T(1) - L * of_S, lost = L * of_s, three = T(3) * L;
  const T after = kept * (q.Ss - three * work(softer, part)) - lost * (q.ss - three * work(softer, dev_s)) -
                  (back + mean.slope * over * L * n.rises) * (kept * (kept * q.SS - T(2) * lost * q.Ss) + lost * lost * q.ss);
  const auto turned = (n.Sm * after < T(0)) & (absolute(n.Sm - after) > n.turn);
  if (any(turned)) L *= select(turned, n.Sm / select(turned, n.Sm - after, T(1)), T(1));
  const Plane<T> rate{T(3) * L * direction.a, T(3) * L * direction.b, T(3) * L * direction.shear};
  const Symmetric<T, D> deviator = at.deviator(s);
  repeat<Symmetric<T, D>::size>([&](auto i) { mean.S[i] = (T(1) - L * of_S) * mean.S[i] - L * of_s * deviator[i]; });
  ep = {ep.a + rate.a, ep.b + rate.b, ep.shear + rate.shear};
  rise += L * n.rises;
  mean.harden(T(2) * L * over * n.root);
  return T(1.0 / 3) * work(moduli.stress(strain - ep), ep - before);
}

/// The mean alone: back to Q_n = 1, along S.
template <class T, int D> [[gnu::always_inline]] inline void flow_of_mean(MeanFlow<T, D>& mean, const Isotropic&, const Symmetric<T, D>&) {
  const T q2 = T(1.5) * contract(mean.S, mean.S);
  if (!any(q2 > mean.sigma * mean.sigma)) return;
  const T q = sqrt(q2), stiff = T(1.5) * mean.modulus;
  const T dp = larger(q - mean.sigma, T(0)) / (stiff + mean.slope), kept = T(1) - stiff * dp / larger(q, mean.sigma);
  repeat<Symmetric<T, D>::size>([&](auto i) { mean.S[i] *= kept; });
  mean.harden(dp);
}

}  // namespace forming_sim
