#pragma once
// The law of material/von_mises.h at several points, a layer at a time, in passes: each goes through all points before
// the next begins. A point's roots and divisions wait for each other, but not for those of the next point, and a
// processor looks ahead some hundred operations: so a pass is short, what is needed once only is asked for
// again, and what goes from pass to pass is little, since a store of a Pack costs as much as two products.
#include "forming_sim/material/edge_pull.h"
#include "forming_sim/material/von_mises.h"

namespace forming_sim {

/// A layer of up to N points.
template <class T, int D, int N> struct LayerOfPoints {
  Trial<T, D> trial[N];
  bool flows[N];  ///< which points have a lane that yields
  T u[N];         ///< 1 - a of those

  /// What the single layer of a body pulls in the plane.
  template <bool Ring> StressPull<T, D, Ring> pull(int i) const { return pull_of<D, Ring>(trial[i].deviator, trial[i].factor); }
  /// In space. y: y^m.
  WayPull<T> pull_of_ways(int i, const Edges<T, 3>& e, const Vector<T, 3>* y) const {
    const T share = T(kVolumePart<3, false>) * trial[i].factor;
    return {y, share * e.det, -(share * trial[i].s)};
  }
  /// Adds what one of several layers pulls, w its weight.
  template <bool Ring> void add_to(StressPull<T, D, Ring>& sum, int i, const T& w) const {
    const T share = w * T(kVolumePart<D, Ring>) * trial[i].factor;
    repeat<Symmetric<T, D>::size>([&](auto c) { sum.share[c] += share * trial[i].deviator[c]; });
  }

  /// After the trials of n points are found: the corrections and the p of those that yield, and whether any does. memory(i): of
  /// this layer of point i; J: of each; dissipated(i, what): called for each point where any flows, J/m3.
  template <class Memory, class Dissipated>
  [[gnu::always_inline]] bool correct_all(int n, const HardeningCurve& hardening, const T* J, const Memory& memory, const Dissipated& dissipated) {
    constexpr int plastic_strain = Symmetric<T, D>::size;
    const auto none = [&] {
      for (bool& each : flows) each = false;
      return false;
    };
    if (hardening.kind == HardeningCurve::elastic) return none();
    bool may = false;
    for (int i = 0; i < n; ++i) may = may || any(may_yield(hardening, trial[i]));
    if (!may) return none();
    YieldStress<T> yield[N];
    Flow<T> flow[N];
    bool any_flows = false;
    for (int i = 0; i < n; ++i) {
      T p;
      load(memory(i), plastic_strain, p);
      yield[i] = yield_stress(hardening, p);
      flows[i] = any(yields(trial[i], yield[i]));
      if (flows[i]) {
        flow[i] = find_flow(trial[i], yield[i]);
        any_flows = true;
      }
    }
    for (int i = 0; i < n; ++i) {
      if (!flows[i]) continue;
      T p;
      load(memory(i), plastic_strain, p);
      const Correction<T> c = correct(hardening, trial[i], flow[i], J[i], p, yield[i]);
      store(memory(i), plastic_strain, c.p);
      u[i] = c.u;
      dissipated(i, c.dissipation);
    }
    return any_flows;
  }
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
  LayerOfPoints<T, D, N * M> layer;
  T J[N * M];
  Vector<T, D> y[by_ways ? N * M : 1][D];
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
      find_trial(push(G, e, by_ways ? y[by_ways ? i : 0] : way), stress_factor(m, J[i]), layer.trial[i]);
    });
  }
  layer.correct_all(count * N, m.layer[0].hardening, J, [&](int i) { return bundles[i / N].memory(i % N); },
                    [&](int i, const T& what) { bundles[i / N].dissipate(i % N, what); });
  for (int b = 0; b < count; ++b) {
    Bundle& at = bundles[b];
    auto&& sum = at.start_forces();
    each_point<D, N>([&](auto s) __attribute__((always_inline)) {
      const int i = b * N + s;
      Edges<T, D, Ring> e;
      at.edges(s, e);
      find_normals(e);
      if constexpr (by_ways) at.respond(s, e, layer.pull_of_ways(i, e, y[i]), sum);
      else at.respond(s, e, layer.template pull<Ring>(i), sum);
      if (layer.flows[i]) keep_flow(at.memory(s), layer.u[i], metric_from_normals(e));
    });
    at.close(sum);
  }
}

/// Likewise with several, in the plane: what is found of a point stays.
template <int N, int M, class T, bool Ring, class Bundle> [[gnu::always_inline]] inline void layers_in_the_plane(const SolidConstants& m, Bundle* bundles, int count) {
  LayerOfPoints<T, 2, N * M> layer;
  T J[N * M], factor[N * M];
  Edges<T, 2, Ring> e[N * M];
  Metric<T, 2> metric[N * M];
  StressPull<T, 2, Ring> pull[N * M];
  for (int b = 0; b < count; ++b) {
    Bundle& at = bundles[b];
    at.open();
    each_point<2, N>([&](auto s) __attribute__((always_inline)) {
      const int i = b * N + s;
      at.edges(s, e[i]);
      J[i] = at.ratio(s, e[i]);
      factor[i] = stress_factor(m, J[i]);
      find_normals(e[i]);
      metric[i] = metric_from_normals(e[i]);
      pull[i].clear();
    });
  }
  const int n = count * N;
  for (int k = 0; k < m.layers; ++k) {
    const auto memory = [&](int i) { return bundles[i / N].memory(i % N) + k * kLayerItems<2> * lanes_of<T>; };
    const T w(m.layer[k].weight);
#pragma GCC unroll 1
    for (int i = 0; i < n; ++i) find_trial(push(load_memory<T, 2>(memory(i)), e[i]), factor[i], layer.trial[i]);
    layer.correct_all(n, m.layer[k].hardening, J, memory, [&](int i, const T& what) { bundles[i / N].dissipate(i % N, w * what); });
#pragma GCC unroll 1
    for (int i = 0; i < n; ++i) {
      layer.add_to(pull[i], i, w);
      if (layer.flows[i]) keep_flow(memory(i), layer.u[i], metric[i]);
    }
  }
  for (int b = 0; b < count; ++b) {
    auto&& sum = bundles[b].start_forces();
    each_point<2, N>([&](auto s) __attribute__((always_inline)) { bundles[b].respond(s, e[b * N + s], pull[b * N + s], sum); });
    bundles[b].close(sum);
  }
}

/// In space the edges of a point are found again for each layer: kept, they and their normals would fill a cache.
template <int N, int M, class T, class Bundle> [[gnu::always_inline]] inline void layers_in_space(const SolidConstants& m, Bundle* bundles, int count) {
  LayerOfPoints<T, 3, N * M> layer;
  T J[N * M], factor[N * M];
  Metric<T, 3> metric[N * M];
  StressPull<T, 3, false> pull[N * M];
  const int n = count * N;
  const auto edges = [&](int i, Edges<T, 3>& e) { bundles[i / N].edges(i % N, e); };
  for (int b = 0; b < count; ++b) bundles[b].open();
  bool knows_metrics = false;
  for (int k = 0; k < m.layers; ++k) {
    const auto memory = [&](int i) { return bundles[i / N].memory(i % N) + k * kLayerItems<3> * lanes_of<T>; };
    const T w(m.layer[k].weight);
    for (int i = 0; i < n; ++i) {
      Edges<T, 3> e;
      edges(i, e);
      if (k == 0) {
        J[i] = bundles[i / N].ratio(i % N, e);
        factor[i] = stress_factor(m, J[i]);
        pull[i].clear();
      }
      find_trial(push(load_memory<T, 3>(memory(i)), e), factor[i], layer.trial[i]);
    }
    const bool flows = layer.correct_all(n, m.layer[k].hardening, J, memory, [&](int i, const T& what) { bundles[i / N].dissipate(i % N, w * what); });
    if (flows && !knows_metrics) {
      for (int i = 0; i < n; ++i) {
        Edges<T, 3> e;
        edges(i, e);
        find_normals(e);
        metric[i] = metric_from_normals(e);
      }
      knows_metrics = true;
    }
    for (int i = 0; i < n; ++i) {
      if (layer.flows[i]) keep_flow(memory(i), layer.u[i], metric[i]);
      layer.add_to(pull[i], i, w);
    }
  }
  for (int b = 0; b < count; ++b) {
    auto&& sum = bundles[b].start_forces();
    for (int s = 0; s < N; ++s) {
      Edges<T, 3> e;
      bundles[b].edges(s, e);
      find_normals(e);
      bundles[b].respond(s, e, pull[b * N + s], sum);
    }
    bundles[b].close(sum);
  }
}

template <int N, int M, class T, int D, bool Ring, class Bundle> [[gnu::always_inline]] inline void layers_of_points(const SolidConstants& m, Bundle* bundles, int count) {
  if constexpr (D == 2) layers_in_the_plane<N, M, T, Ring>(m, bundles, count);
  else layers_in_space<N, M, T>(m, bundles, count);
}

/// A step of the points of a body of either.
template <int N, int M, class T, int D, bool Ring, class Bundle> [[gnu::always_inline]] inline void von_mises_points(const SolidConstants& m, Bundle* bundles, int count) {
  if (m.layers == 1) one_layer_of_points<N, M, T, D, Ring>(m, bundles, count);
  else layers_of_points<N, M, T, D, Ring>(m, bundles, count);
}

}  // namespace forming_sim
