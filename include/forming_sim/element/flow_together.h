#pragma once
// Mean and variation of a layer of a one-point cell flow together, where the trial of one of its coordinates lies outside of the yield
// surface of element/hourglass_flow.h: what the law has returned is taken back, the coordinates flow one after the other, and what is
// left outside of the mean's own surface returns along the mean.
//
// One root and one division waits for the other all the way. T may be a Twin of the numbers of two cells (tensor/twin.h), which
// have nothing to do with each other but that they are looked at side by side: halves do not change what the other finds.
#include "forming_sim/element/anisotropic_flow.h"
#include "forming_sim/element/flow_rate.h"
#include "forming_sim/material/von_mises.h"
#include "forming_sim/tensor/twin.h"

namespace forming_sim {

/// Memory of one layer: ep (2D: along E_i and E_3; 3D: two normal strains, shear) and p' of every
/// coordinate, in 3D the plastic part of the last mode.
template <int D> constexpr int kPlaneItems = D == 2 ? 3 : 4;
template <int D> constexpr int kHourglassItems = D * kPlaneItems<D> + (D == 3 ? 3 : 0);

/// ep of coordinate d.
template <class T, int D> Plane<T> load_plane(const double* memory, int d) {
  Plane<T> ep;
  load(memory, d * kPlaneItems<D>, ep.a);
  load(memory, d * kPlaneItems<D> + 1, ep.b);
  if constexpr (D == 3) load(memory, d * kPlaneItems<D> + 2, ep.shear);
  else ep.shear = T(0);
  return ep;
}
template <class T, int D> T load_rise(const double* memory, int d) {
  T rise;
  load(memory, (d + 1) * kPlaneItems<D> - 1, rise);
  return rise;
}

/// The cell's axes E_m turned as its edges are: the orthonormal vectors nearest to the edges' directions, the rotation of their
/// polar decomposition. Not F^-1 S F, in which shear would grow with the ratio of the stretches.
template <class T, int D> struct TurnedAxes {
  Vector<T, D> e[D];

  explicit TurnedAxes(const Vector<T, D>* x) {
    T length[D];
    repeat<D>([&](auto m) { length[m] = sqrt(dot(x[m], x[m])); });
    if constexpr (D == 2) {  // e_1 and e_2 turned back by a quarter lie on either side of it
      const Vector<T, 2> a = {{length[1] * x[0][0] + length[0] * x[1][1], length[1] * x[0][1] - length[0] * x[1][0]}};
      e[0] = T(1) / sqrt(dot(a, a)) * a;
      e[1] = {{-e[0][1], e[0][0]}};
    } else {  // A <- (A + A^-T)/2: what is apart by d is so by d^2/2 then
      Edges<T, D> a;
      T half(0.5);  // 0 where it has come near enough
      const T one = T(1) / (length[0] * length[1] * length[2]);
      repeat<D>([&](auto m) { a.x[m] = one * length[(m + 1) % 3] * length[(m + 2) % 3] * x[m]; });
      for (int k = 0; k < 5 && any(half > T(0)); ++k) {
        find_reciprocal(a);
        T apart(0);
        repeat<D>([&](auto m) {
          const Vector<T, D> d = a.up[m] - a.x[m];
          apart += dot(d, d);
          a.x[m] += half * d;
        });
        half = select(apart > T(1e-16), half, T(0));
      }
      repeat<D>([&](auto m) { repeat<D>([&](auto i) { e[m][i] = a.x[m][i]; }); });
    }
  }
};

/// A: how the yield surface measures.
template <class T, int D, bool Ring, class Metric = Isotropic> class FlowTogether {
  static constexpr int size = Symmetric<T, D>::size;

 public:
  FlowTogether() = default;
  explicit FlowTogether(const Metric& A) : A_(A) {}

  /// A cell, or one of two: its edges with their reciprocal vectors, the strains that vary across it, stress per deviator, V/V0.
  template <class Part>
  void put_cell(int half, const Edges<Part, D, Ring>& e, const HourglassStrain<Part, D>& strain, const Part& factor, const Part& J) {
    repeat<kEdges<D, Ring>>([&](auto m) {
      repeat<D>([&](auto i) {
        half_of(edges_.x[m][i], half) = e.x[m][i];
        half_of(edges_.up[m][i], half) = e.up[m][i];
      });
    });
    repeat<D>([&](auto d) { put_plane(half, strain_[d], strain.plane[d]); });
    half_of(factor_, half) = factor;
    half_of(J_, half) = J;
  }
  /// A layer of it: what its law has answered, and where its memories are.
  template <class Part> void put_layer(int half, const PointResponse<Part, D>& point, const double* memory, const double* hourglass_memory) {
    repeat<D>([&](auto d) {
      put_plane(half, ep_[d], load_plane<Part, D>(hourglass_memory, d));
      half_of(rise_[d], half) = load_rise<Part, D>(hourglass_memory, d);
    });
    const Symmetric<Part, D> G = load_memory<Part, D>(memory);
    repeat<size>([&](auto i) {
      half_of(G_[i], half) = G[i];
      half_of(S_[i], half) = point.S[i];
    });
    half_of(dissipation_, half) = point.dissipation;
    half_of(kept_, half) = point.kept;
    half_of(dp_, half) = point.dp;
    half_of(mean_.sigma, half) = point.yield.value;
    half_of(mean_.slope, half) = point.yield.slope;
  }

  /// Of a Twin whose second half nobody has put: it goes as the first does. What it would have held otherwise decides what is looked at, and so on the last digits of the first.
  void repeat_first() {
    const auto both = [](T& number) { half_of(number, 1) = half_of(number, 0); };
    repeat<kEdges<D, Ring>>([&](auto m) { repeat<D>([&](auto i) { both(edges_.x[m][i]), both(edges_.up[m][i]); }); });
    repeat<D>([&](auto d) {
      for (Plane<T>* plane : {&strain_[d], &ep_[d]}) both(plane->a), both(plane->b), both(plane->shear);
      both(rise_[d]);
    });
    repeat<size>([&](auto i) { both(G_[i]), both(S_[i]); });
    for (T* number : {&factor_, &J_, &dissipation_, &kept_, &dp_, &mean_.sigma, &mean_.slope}) both(*number);
  }

  /// Of a layer whose law does not return along S: the stress before it did.
  void put_trial(const Symmetric<T, D>& S) {
    repeat<size>([&](auto i) { trial_[i] = S[i]; });
  }

  /// Once all cells are put, for all layers. constants: of the cell, or TwinItems.
  template <class Items> void find_planes(const Items& constants) {
    const TurnedAxes<T, D> axes(edges_.x);
    const Fibres<T, D> turned(constants, axes.e);
    repeat<D>([&](auto d) { at_[d].set(turned, constants, d); });
  }

  /// hardening: of the layer.
  [[gnu::noinline, gnu::flatten]] void flow(const SolidConstants& m, const HardeningCurve& hardening, const PlaneModuli& moduli) {
    repeat<size>([&](auto i) { mean_.S[i] = S_[i]; });
    mean_.modulus = T(2) * factor_;
    mean_.p = T(0);
    const T over = T(1) / mean_.sigma, SS = products(S_, Plane<T>{T(0), T(0), T(0)}, at_[0], A_).SS, sigma2 = mean_.sigma * mean_.sigma;
    T share[D];  // 1 where the coordinate's variation takes part, else 0
    flowed_ = T(0);
    repeat<D>([&](auto d) {
      share[d] = T(0);
      const Plane<T> s = moduli.stress(strain_[d] - ep_[d]);
      if (!any(may_be_outside(T(1.5) * SS, T(A_.most) * face_square(s), mean_.slope * rise_[d], sigma2))) return;
      const Products<T> q = products(S_, s, at_[d], A_);
      share[d] = select(is_outside(Quadratic<T>(q, over, mean_.slope * rise_[d] * over), 1 + 1e-12), T(1), T(0));
      flowed_ = larger(flowed_, share[d]);
    });
    if (!any(flowed_ > T(0))) return;
    take_back(SS);
    const T varied = hardening.rate.kind == RateLaw::none ? flow_from_trial(moduli, share) : flow_at_rate(hardening.rate, moduli, share);
    take_mean_flow(m);
    dissipation_ += varied;
    if constexpr (D == 3) kept_ = smaller(kept_ * mean_.sigma / larger(mean_.sigma + T(3) * T(moduli.mu) * mean_.p, T(0.5) * mean_.sigma), T(1));
  }

  /// What has become of a half: its answer, of the last mode the yield stress and the share that is left, and, where any of it has flowed, its memories.
  template <class Part> void take(int half, PointResponse<Part, D>& point, Part& limit, Part& left, double* memory, double* hourglass_memory) {
    repeat<size>([&](auto i) { point.S[i] = half_of(mean_.S[i], half); });
    point.dissipation = half_of(dissipation_, half);
    limit = half_of(mean_.sigma, half);
    left = half_of(kept_, half);
    if (!any(half_of(flowed_, half) > Part(0))) return;
    repeat<D>([&](auto d) {
      store(hourglass_memory, d * kPlaneItems<D>, half_of(ep_[d].a, half));
      store(hourglass_memory, d * kPlaneItems<D> + 1, half_of(ep_[d].b, half));
      if constexpr (D == 3) store(hourglass_memory, d * kPlaneItems<D> + 2, half_of(ep_[d].shear, half));
      store(hourglass_memory, (d + 1) * kPlaneItems<D> - 1, half_of(rise_[d], half));
    });
    repeat<size>([&](auto i) { store(memory, i, half_of(G_[i], half)); });
    Part p;
    load(memory, size, p);
    store(memory, size, p + half_of(mean_.p, half));
  }

 private:
  template <class Part> static void put_plane(int half, Plane<T>& to, const Plane<Part>& from) {
    half_of(to.a, half) = from.a;
    half_of(to.b, half) = from.b;
    half_of(to.shear, half) = from.shear;
  }

  /// What the law has returned is taken back. SS: S : A S as it has answered.
  [[gnu::always_inline]] void take_back(const T& SS) {
    if constexpr (Metric::is_one) {
      const T returned = flowed_ * (T(1) / kept_ - T(1)), softer = T(1) / mean_.modulus;
      repeat<size>([&](auto i) { mean_.S[i] *= T(1) + returned; });
      mean_.harden(-(T(2.0 / 3) * softer * returned * sqrt(T(1.5) * SS)));
    } else {
      repeat<size>([&](auto i) { mean_.S[i] += flowed_ * (trial_[i] - S_[i]); });
      mean_.harden(-(flowed_ * dp_));
    }
  }
  /// From there on: the coordinates flow whose share is 1, and what is left returns along the mean. What the variation dissipates.
  [[gnu::always_inline]] T flow_from_trial(const PlaneModuli& moduli, const T* share) {
    T varied(0), outside(0);
    repeat<D>([&](auto d) { outside += share[d]; });
    repeat<D>([&](auto d) {
      if (any(share[d] > T(0))) varied += flow_to_surface<T, D>(mean_, moduli, strain_[d], share[d], outside, ep_[d], rise_[d], at_[d], A_, S_);
    });
    flow_of_mean(mean_, A_, S_);
    return varied;
  }

  /// Likewise where the rate raises the yield stress.
  [[gnu::noinline]] T flow_at_rate(const RateLaw& law, const PlaneModuli& moduli, const T* share) {
    const T by_law = select(dp_ > T(0), rate_factor(law, log_of_share(dp_)).value, T(1));
    const MeanFlow<T, D> trial = mean_;
    const T sigma = trial.sigma / by_law, slope = trial.slope / by_law, over = T(1) / sigma;  // without its rate
    T most(1);
    Plane<T> ep[D];
    T rise[D];
    repeat<D>([&](auto d) {
      ep[d] = ep_[d];
      rise[d] = rise_[d];
      const Quadratic<T> Q(products(trial.S, moduli.stress(strain_[d] - ep[d]), at_[d], A_), over, slope * rise[d] * over);
      most = larger(most, sqrt(Q.n + T(0.5) * Q.m + sqrt(Q.under_root())));
    });
    RateOfFlow<T> rate(law, most, sigma / (T(1.5) * trial.modulus));
    for (int flows = 1;; ++flows) {
      mean_.sigma = select(flowed_ > T(0), sigma * rate.R(), trial.sigma);
      mean_.slope = select(flowed_ > T(0), slope * rate.R(), trial.slope);
      const T varied = flow_from_trial(moduli, share);
      if (flows == rate.kFlows) return varied;
      rate.follow(dp_ + mean_.p);
      repeat<D>([&](auto d) {
        ep_[d] = ep[d];
        rise_[d] = rise[d];
      });
      mean_ = trial;
    }
  }

  /// G^mk = x^m . B x^k.
  void pull(const Symmetric<T, D>& B) {
    const Vector<T, D>* up = edges_.up;
    Vector<T, D> Bx[D];
    repeat<D>([&](auto m) { Bx[m] = B * up[m]; });
    repeat<D>([&](auto m) { G_[m] = dot(up[m], Bx[m]); });
    G_[3] = dot(up[0], Bx[1]);
    if constexpr (D == 2) {
      G_[2] = Ring ? B[2] * up[2][0] * up[2][0] : B[2];
    } else {
      G_[4] = dot(up[1], Bx[2]);
      G_[5] = dot(up[2], Bx[0]);
    }
  }

  /// The mean, S after the law's step, has flowed to S'. The classical law's memory is that, its plastic strain (S - S')/(2 factor).
  /// In B = s I + d it is d <- d' = S'/factor, and s such that det B = s^3 - s d:d/2 + det d stays; what B stores falls by
  /// 3/2 factor J (s - s'), of which the stress that is left does all but what is of second order in the change, (d - d'):(d - d')/(4 s).
  /// With it, too, what the law returned before is dissipated, along S.
  void take_mean_flow(const SolidConstants& m) {
    const Symmetric<T, D>& after = mean_.S;
    const T over = T(1) / factor_, SS = contract(S_, S_), left = contract(after, after), along = contract(after, S_);
    T flowed = T(0.5) * over * (along - left);  // S' : D_p
    if (m.law == Law::classical) {
      repeat<size>([&](auto i) { G_[i] = after[i]; });
    } else {
      const auto det = [](const Symmetric<T, D>& S) { return determinant(S, cofactor(S)); };
      const T s = trace(push(G_, edges_)) * T(1.0 / 3), over2 = over * over;
      const T per = T(1) / (T(3) * s * s - T(0.5) * over2 * left);  // 1/s = 3 s per, to the order that is asked for
      const T fall = over2 * (T(0.5) * s * (SS - left) + over * (det(after) - det(S_))) * per;
      flowed = factor_ * (T(1.5) * fall - T(0.75) * s * per * over2 * (SS - T(2) * along + left));
      Symmetric<T, D> B;
      repeat<size>([&](auto i) { B[i] = i < 3 ? over * after[i] + (s - fall) : over * after[i]; });
      pull(B);
    }
    T share;  // of what the law returned
    if constexpr (Metric::is_one) {
      share = along / larger(SS, T(1e-30) * T(m.mu * m.mu));
    } else {
      Symmetric<T, D> returned;
      repeat<size>([&](auto i) { returned[i] = trial_[i] - S_[i]; });
      const T own = contract(S_, returned);
      share = select(own > T(0), contract(after, returned) / select(own > T(0), own, T(1)), T(1));
    }
    dissipation_ = dissipation_ * share + J_ * flowed;
  }

  Edges<T, D, Ring> edges_;
  Plane<T> strain_[D], ep_[D];
  PlaneOf<T, D> at_[D];
  T rise_[D];
  Symmetric<T, D> G_, S_;  ///< of the memory; as the law has answered
  MeanFlow<T, D> mean_;
  T dissipation_, kept_, factor_, J_;
  T flowed_;  ///< 1 where a coordinate flows, else 0
  Symmetric<T, D> trial_;  ///< as put_trial() was told
  T dp_;                   ///< plastic strain that the law has taken
  [[no_unique_address]] Metric A_;
};

}  // namespace forming_sim
