#pragma once
// The law of material/von_mises.h at several points, a layer at a time, in passes: each goes through all points before
// the next begins. A point's roots and divisions wait for each other, but not for those of the next point, and a
// processor looks ahead some hundred operations: so a pass is short, what is needed once only is asked for
// again, and what goes from pass to pass is little, since a store of a Pack costs as much as two products.
#include "forming_sim/material/von_mises.h"

namespace forming_sim {

/// A layer of N points.
template <class T, int D, int N> struct LayerOfPoints {
  Trial<T, D> trial[N];
  T u[N];  ///< 1 - a of each

  /// S of a point, as if the body were made of this layer.
  Symmetric<T, D> stress(int i) const {
    Symmetric<T, D> S;
    repeat<Symmetric<T, D>::size>([&](auto c) { S[c] = trial[i].factor * trial[i].deviator[c]; });
    return S;
  }

  /// After the trials are found: the corrections and the p of those that yield, and whether any does. memory(i): of this
  /// layer of point i; J: of each; dissipated(i, what): called for each point where any flows, J/m3.
  template <class Memory, class Dissipated>
  [[gnu::always_inline]] bool correct_all(const HardeningCurve& hardening, const T* J, const Memory& memory, const Dissipated& dissipated) {
    constexpr int plastic_strain = Symmetric<T, D>::size;
    const auto none = [&] {
      for (T& each : u) each = T(0);
      return false;
    };
    if (hardening.kind == HardeningCurve::elastic) return none();
    bool may = false;
    for (int i = 0; i < N; ++i) may = may || any(may_yield(hardening, trial[i]));
    if (!may) return none();
    YieldStress<T> yield[N];
    Flow<T> flow[N];
    bool flows = false;
    for (int i = 0; i < N; ++i) {
      T p;
      load(memory(i), plastic_strain, p);
      yield[i] = yield_stress(hardening, p);
      flows |= any(yields(trial[i], yield[i]));
    }
    if (!flows) return none();
    for (int i = 0; i < N; ++i) flow[i] = find_flow(trial[i], yield[i]);
    for (int i = 0; i < N; ++i) {
      T p;
      load(memory(i), plastic_strain, p);
      const Correction<T> c = correct(hardening, trial[i], flow[i], J[i], p, yield[i]);
      store(memory(i), plastic_strain, c.p);
      u[i] = c.u;
      dissipated(i, c.dissipation);
    }
    return true;
  }
};

/// f(i) of each of N points: in the plane a turn of its own, so that what little such points have can live in registers.
template <int D, int N, class F> [[gnu::always_inline]] inline void each_point(F&& f) {
  if constexpr (D == 2) repeat<N>(f);
  else
    for (int i = 0; i < N; ++i) f(i);
}

/// A step of N points of a body with one layer. `at` knows them, and is asked of point i:
///   at.edges(i, e)               its edges, twice
///   at.ratio(i, e)               J, once
///   at.memory(i)                 where its memory starts
///   at.dissipate(i, what)        takes the plastic work of the step, J/m3, where any of them flows
///   at.respond(i, e, S, forces)  takes its stress beside the pressure into `forces`; e has areas.
template <int N, class T, int D, bool Ring, class At, class Forces> [[gnu::always_inline]] inline void one_layer_of_points(const SolidConstants& m, At& at, Forces& forces) {
  LayerOfPoints<T, D, N> layer;
  T J[N];
#pragma GCC unroll 1
  for (int i = 0; i < N; ++i) {
    Edges<T, D, Ring> e;
    at.edges(i, e);
    J[i] = at.ratio(i, e);
    find_trial(push(load_memory<T, D>(at.memory(i)), e), stress_factor(m, J[i]), layer.trial[i]);
  }
  const bool flows = layer.correct_all(m.layer[0].hardening, J, [&](int i) { return at.memory(i); }, [&](int i, const T& what) { at.dissipate(i, what); });
  each_point<D, N>([&](auto i) __attribute__((always_inline)) {
    Edges<T, D, Ring> e;
    at.edges(i, e);
    find_areas(e);
    at.respond(i, e, layer.stress(i), forces);
    if (flows) keep_flow(at.memory(i), layer.u[i], metric_of_areas(e));
  });
}

/// Likewise with several.
template <int N, class T, int D, bool Ring, class At, class Forces> [[gnu::always_inline]] inline void layers_of_points(const SolidConstants& m, At& at, Forces& forces) {
  constexpr int size = Symmetric<T, D>::size;
  LayerOfPoints<T, D, N> layer;
  Edges<T, D, Ring> e[N];
  T J[N], factor[N];
  Metric<T, D> metric[N];
  Symmetric<T, D> S[N];
  each_point<D, N>([&](auto i) __attribute__((always_inline)) {
    at.edges(i, e[i]);
    J[i] = at.ratio(i, e[i]);
    factor[i] = stress_factor(m, J[i]);
    find_areas(e[i]);
    metric[i] = metric_of_areas(e[i]);
    repeat<size>([&](auto c) { S[i][c] = T(0); });
  });
  for (int k = 0; k < m.layers; ++k) {
    const auto memory = [&](int i) { return at.memory(i) + k * kLayerItems<D> * lanes_of<T>; };
    const T w(m.layer[k].weight);
#pragma GCC unroll 1
    for (int i = 0; i < N; ++i) find_trial(push(load_memory<T, D>(memory(i)), e[i]), factor[i], layer.trial[i]);
    const bool flows = layer.correct_all(m.layer[k].hardening, J, memory, [&](int i, const T& what) { at.dissipate(i, w * what); });
    each_point<D, N>([&](auto i) __attribute__((always_inline)) {
      const Symmetric<T, D> of_layer = layer.stress(i);
      repeat<size>([&](auto c) { S[i][c] += w * of_layer[c]; });
      if (flows) keep_flow(memory(i), layer.u[i], metric[i]);
    });
  }
  each_point<D, N>([&](auto i) __attribute__((always_inline)) { at.respond(i, e[i], S[i], forces); });
}

/// A step of N points of a body of either.
template <int N, class T, int D, bool Ring, class At, class Forces> [[gnu::always_inline]] inline void von_mises_points(const SolidConstants& m, At& at, Forces& forces) {
  if (m.layers == 1) one_layer_of_points<N, T, D, Ring>(m, at, forces);
  else layers_of_points<N, T, D, Ring>(m, at, forces);
}

}  // namespace forming_sim
