#pragma once
// The law of material/von_mises.h at several points, a layer at a time, in passes: each goes through all points before
// the next begins. A point's roots and divisions wait for each other, but not for those of the next point, and a
// processor looks ahead some hundred operations: so a pass is short, what is needed once only is asked for
// again, and what goes from pass to pass is little, since a store of a Pack costs as much as two products.
#include "forming_sim/material/edge_pull.h"
#include "forming_sim/material/upright_edges.h"
#include "forming_sim/material/von_mises.h"

namespace forming_sim {

/// A layer of up to N points.
template <class T, int D, int N> struct LayerOfPoints {
  Trial<T> trial[N];
  bool flows[N];  ///< which points have a lane that yields
  T u[N];         ///< 1 - a of those

  /// After the trials of n points are found: the corrections and the p of those that yield. memory(i): of this layer of point i;
  /// factor, J: of each; dissipated(i, what): called for each point where any flows, J/m3.
  template <class Memory, class Dissipated>
  [[gnu::always_inline]] void correct_all(int n, const HardeningCurve& hardening, const T* factor, const T* J, const Memory& memory, const Dissipated& dissipated) {
    constexpr int plastic_strain = Symmetric<T, D>::size;
    for (bool& each : flows) each = false;
    if (hardening.kind == HardeningCurve::elastic) return;
    bool may = false;
    for (int i = 0; i < n; ++i) may = may || any(may_yield(hardening, trial[i], factor[i]));
    if (!may) return;
    YieldStress<T> yield[N];
    Flow<T> flow[N];
    for (int i = 0; i < n; ++i) {
      T p;
      load(memory(i), plastic_strain, p);
      yield[i] = yield_stress(hardening, p);
      flows[i] = any(yields(trial[i], factor[i], yield[i]));
      if (flows[i]) flow[i] = find_flow(trial[i], factor[i], yield[i]);
    }
    for (int i = 0; i < n; ++i) {
      if (!flows[i]) continue;
      T p;
      load(memory(i), plastic_strain, p);
      const Correction<T> c = correct(hardening, factor[i], flow[i], J[i], p, yield[i]);
      store(memory(i), plastic_strain, c.p);
      u[i] = c.u;
      dissipated(i, c.dissipation);
    }
  }
  /// factor of the stress after the correction.
  [[gnu::always_inline]] T kept(int i, const T& factor) const { return flows[i] ? factor * (T(1) - u[i]) : factor; }
};

/// f(s) of each of N points: in the plane a turn of its own, so that what little such points have can live in registers.
template <int D, int N, class F> [[gnu::always_inline]] inline void each_point(F&& f) {
  if constexpr (D == 2) repeat<N>(f);
  else
#pragma GCC unroll 1
    for (int s = 0; s < N; ++s) f(s);
}

/// A step of points that come in bundles of N, `count` of them, at most M. A bundle knows its points s, and is asked for
///   open()                     before all that follows
///   edges(s, e)                the edges, more than once
///   ratio(s, e)                J, once
///   memory(s)                  where the memory starts
///   dissipate(s, what)         to take the plastic work of the step, J/m3, where any of them flows
///   start_forces()             what its points' forces are summed in
///   respond(s, e, pull, sum)   to add what the stress beside the pressure does (material/edge_pull.h); e has normals
///   close(sum)
template <int N, int M, class T, int D, bool Ring, class Bundle> [[gnu::always_inline]] inline void one_layer_of_points(const SolidConstants& m, Bundle* bundles, int count) {
  constexpr bool by_ways = D == 3;
  if constexpr (M == 1) count = 1;  // told to the compiler
  LayerOfPoints<T, D, N * M> layer;
  T J[N * M], factor[N * M];
  Vector<T, D> y[by_ways ? N * M : 1][D];
  Symmetric<T, D> deviator[by_ways ? 1 : N * M];
  for (int b = 0; b < count; ++b) {
    Bundle& at = bundles[b];
    at.open();
    each_point<D, N>([&](auto s) __attribute__((always_inline)) {
      const int i = b * N + s;
      Edges<T, D, Ring> e;
      at.edges(s, e);
      J[i] = at.ratio(s, e);
      const Symmetric<T, D> G = load_memory<T, D>(at.memory(s));
      Vector<T, D> way[D];
      raise(G, e, by_ways ? y[by_ways ? i : 0] : way);
      factor[i] = stress_factor(m, J[i]);
      const Symmetric<T, D> its = find_trial(push(G, e, by_ways ? y[by_ways ? i : 0] : way), layer.trial[i]);
      if constexpr (!by_ways) deviator[i] = its;
    });
  }
  layer.correct_all(count * N, m.layer[0].hardening, factor, J, [&](int i) { return bundles[i / N].memory(i % N); },
                    [&](int i, const T& what) { bundles[i / N].dissipate(i % N, what); });
  for (int b = 0; b < count; ++b) {
    Bundle& at = bundles[b];
    auto&& sum = at.start_forces();
    each_point<D, N>([&](auto s) __attribute__((always_inline)) {
      const int i = b * N + s;
      Edges<T, D, Ring> e;
      at.edges(s, e);
      find_normals(e);
      const T kept = layer.kept(i, factor[i]);
      if constexpr (by_ways) at.respond(s, e, pull_of_ways(e, y[i], kept, kept * layer.trial[i].s), sum);
      else at.respond(s, e, pull_of<D, Ring>(deviator[i], kept), sum);
      if (layer.flows[i]) keep_flow(at.memory(s), layer.u[i], layer.u[i] / (e.det * e.det), metric_of_normals(e));
    });
    at.close(sum);
  }
}

/// f(k) of each layer; L: how many, 0 where only `layers` tells.
template <int L, class F> [[gnu::always_inline]] inline void each_layer(int layers, F&& f) {
  if constexpr (L > 0) repeat<L>(f);
  else
#pragma GCC unroll 1
    for (int k = 0; k < layers; ++k) f(k);
}

/// Likewise with several. What they pull is summed as
///   S x^m = sum_i w_i f_i (B_i - s_i I) x^m = x_k (sum_i w_i f_i G_i^mk) - (sum_i w_i f_i s_i) x^m.
/// The trials of two are found from their B where there are registers for both; for more it pays to make the edges upright first.
template <int L, int N, int M, class T, int D, bool Ring, class Bundle> [[gnu::always_inline]] inline void layers_of_points(const SolidConstants& m, Bundle* bundles, int count) {
  constexpr int size = Symmetric<T, D>::size;
  constexpr long behind = kLayerItems<D> * stride_of<T>;
  if constexpr (M == 1) count = 1;  // told to the compiler
  LayerOfPoints<T, D, N * M> layer[L > 0 ? L : kMaxLayers];
  T J[N * M], factor[N * M];
  for (int b = 0; b < count; ++b) {
    Bundle& at = bundles[b];
    at.open();
    each_point<D, N>([&](auto s) __attribute__((always_inline)) {
      const int i = b * N + s;
      Edges<T, D, Ring> e;
      at.edges(s, e);
      J[i] = at.ratio(s, e);
      factor[i] = stress_factor(m, J[i]);
      UprightEdges<T, D> upright;
      if constexpr (L != 2) {
        find_normals(e);
        upright = find_upright(e);
      }
      each_layer<L>(m.layers, [&](auto k) __attribute__((always_inline)) {
        const Symmetric<T, D> G = load_memory<T, D>(at.memory(s) + k * behind);
        if constexpr (L == 2) find_trial(push(G, e), layer[k].trial[i]);
        else find_trial(G, upright, layer[k].trial[i]);
      });
    });
  }
  each_layer<L>(m.layers, [&](auto k) __attribute__((always_inline)) {
    const T w(m.layer[k].weight);
    layer[k].correct_all(count * N, m.layer[k].hardening, factor, J, [&](int i) { return bundles[i / N].memory(i % N) + k * behind; },
                         [&](int i, const T& what) { bundles[i / N].dissipate(i % N, w * what); });
  });
  for (int b = 0; b < count; ++b) {
    Bundle& at = bundles[b];
    auto&& sum = at.start_forces();
    each_point<D, N>([&](auto s) __attribute__((always_inline)) {
      const int i = b * N + s;
      Edges<T, D, Ring> e;
      at.edges(s, e);
      find_normals(e);
      const Symmetric<T, D> A = metric_of_normals(e);
      const T over = T(1) / (e.det * e.det);
      Symmetric<T, D> ways;  // sum_i w_i f_i G_i
      T mean(0);             // sum_i w_i f_i s_i
      repeat<size>([&](auto c) { ways[c] = T(0); });
      each_layer<L>(m.layers, [&](auto k) __attribute__((always_inline)) {
        double* memory = at.memory(s) + k * behind;
        const T share = T(m.layer[k].weight) * layer[k].kept(i, factor[i]);
        const Symmetric<T, D> G = load_memory<T, D>(memory);
        repeat<size>([&](auto c) { ways[c] += share * G[c]; });
        mean += share * layer[k].trial[i].s;
        if (layer[k].flows[i]) keep_flow(memory, layer[k].u[i], layer[k].u[i] * over, A);
      });
      Vector<T, D> y[D];
      raise(ways, e, y);
      if constexpr (D == 3) {
        at.respond(s, e, pull_of_ways(e, y, T(1), mean), sum);
      } else {
        Symmetric<T, D> S = push(ways, e, y);
        repeat<3>([&](auto c) { S[c] -= mean; });
        at.respond(s, e, pull_of<D, Ring>(S), sum);
      }
    });
    at.close(sum);
  }
}

template <int N, int M, class T, int D, bool Ring, class Bundle> [[gnu::always_inline]] inline void several_layers_of_points(const SolidConstants& m, Bundle* bundles, int count) {
  if constexpr (registers_of<T> > 16)
    if (m.layers == 2) return layers_of_points<2, N, M, T, D, Ring>(m, bundles, count);
  layers_of_points<0, N, M, T, D, Ring>(m, bundles, count);
}

/// A step of the points of a body of either.
template <int N, int M, class T, int D, bool Ring, class Bundle> [[gnu::always_inline]] inline void von_mises_points(const SolidConstants& m, Bundle* bundles, int count) {
  if (m.layers == 1) one_layer_of_points<N, M, T, D, Ring>(m, bundles, count);
  else several_layers_of_points<N, M, T, D, Ring>(m, bundles, count);
}

}  // namespace forming_sim
