#pragma once
// What element/hourglass_flow.h does, of a material that measures stresses by another norm than von Mises': A(S) is A S, a tensor
// for which 3/2 S : A S is the square of it (HillMetric of material/hill.h).
//
// The trial state does not go back along itself: its flow is normal to the surface where it ends. That is not known yet,
// but near where the law of the mean alone has ended, and there the direction is taken.
#include "forming_sim/element/hourglass_flow.h"

namespace forming_sim {

/// One coordinate's S and s as the surface sees them.
template <class T, int D> struct Measured {
  Symmetric<T, D> A_S, A_s;  ///< A S, A dev s
  Plane<T> part, dev_s;      ///< their parts in the plane, shears twice
  Products<T> q;

  template <class Metric> Measured(const Symmetric<T, D>& S, const Plane<T>& s, const PlaneOf<T, D>& at, const Metric& A)
      : A_S(A(S)), A_s(A(at.deviator(s))), part(at.part(A_S)), dev_s(at.part(A_s)), q{contract(S, A_S), work(s, part), work(s, dev_s)} {}

  /// d(Q_n + mu)/dS and d(Q_n + mu)/ds.
  Symmetric<T, D> by_S(const Normal<T>& n) const {
    Symmetric<T, D> g;
    repeat<Symmetric<T, D>::size>([&](auto i) { g[i] = n.along_S * A_S[i] + n.across * A_s[i]; });
    return g;
  }
  Plane<T> by_s(const Normal<T>& n) const {
    return {n.across * part.a + n.along_s * dev_s.a, n.across * part.b + n.along_s * dev_s.b, n.across * part.shear + n.along_s * dev_s.shear};
  }
};

template <class T, int D, class Metric> Products<T> products(const Symmetric<T, D>& S, const Plane<T>& s, const PlaneOf<T, D>& at, const Metric& A) {
  return Measured<T, D>(S, s, at, A).q;
}

/// end: S as the law of the mean alone has left it.
template <class T, int D, class Metric>
[[gnu::always_inline]] inline T flow_to_surface(MeanFlow<T, D>& mean, const PlaneModuli& moduli, const Plane<T>& strain, const T& share, const T& outside, Plane<T>& ep, T& rise,
                                                const PlaneOf<T, D>& at, const Metric& A, const Symmetric<T, D>& end) {
  const Plane<T> before = ep;
  {
    const Normal<T> far = normal(products(mean.S, moduli.stress(strain - ep), at, A), T(1) / mean.sigma, mean.slope * rise / mean.sigma);
    if (any(share * far.root > T(kNearSurface))) return_to_near<T, D>(mean, strain, share, far.root, ep);
  }
  const Plane<T> s = moduli.stress(strain - ep);
  const T over = T(1) / mean.sigma, back = mean.slope * rise * over;
  const Measured<T, D> here(mean.S, s, at, A), there(end, s, at, A);
  const Normal<T> n = normal(here.q, over, back), to = normal(there.q, over, back);
  const Symmetric<T, D> by_S = there.by_S(to);
  const Plane<T> by_s = there.by_s(to), softer = moduli.stress(by_s);
  T L = step_to_surface(n, mean.modulus * contract(here.by_S(n), by_S) + T(3) * work(softer, here.by_s(n)), mean.slope, over, share, outside);  // along the flow of the end
  // S : m/h of the end, which s follows: it changes its sign where S will, not where its trial does
  const T falls = T(3) * work(softer, there.part) + mean.slope * over * to.rises * there.q.SS;  // per L
  const auto turned = (to.Sm * (to.Sm - L * falls) < T(0)) & (absolute(L * falls) > to.turn);
  if (any(turned)) L = select(turned, to.Sm / select(turned, falls, T(1)), L);
  repeat<Symmetric<T, D>::size>([&](auto i) { mean.S[i] -= L * mean.modulus * by_S[i]; });
  ep = {ep.a + T(3) * L * by_s.a, ep.b + T(3) * L * by_s.b, ep.shear + T(3) * L * by_s.shear};
  rise += L * to.rises;
  mean.harden(T(2) * L * over * to.root);
  return T(1.0 / 3) * work(moduli.stress(strain - ep), ep - before);
}

/// The mean alone: back to Q_n = 1, along A S of the end: where no coordinate has flown on the way, it ends as the law alone has.
template <class T, int D, class Metric> [[gnu::always_inline]] inline void flow_of_mean(MeanFlow<T, D>& mean, const Metric& A, const Symmetric<T, D>& end) {
  const Symmetric<T, D> along = A(end);
  const T per = T(1.5) * mean.modulus / larger(sqrt(T(1.5) * contract(end, along)), T(1e-30) * mean.modulus);  // of S per d p
  for (int round = 0; round < 3; ++round) {
    const Symmetric<T, D> A_S = A(mean.S);
    const T q2 = T(1.5) * contract(mean.S, A_S);
    if (round == 0 && !any(q2 > mean.sigma * mean.sigma)) return;
    const T q = larger(sqrt(q2), mean.sigma), falls = per * T(1.5) * contract(A_S, along) / q;
    const T dp = select(falls > T(0), (q - mean.sigma) / (falls + mean.slope), T(0)), less = per * dp;
    repeat<Symmetric<T, D>::size>([&](auto i) { mean.S[i] -= less * along[i]; });
    mean.harden(dp);
  }
}

}  // namespace forming_sim
