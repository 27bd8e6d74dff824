#pragma once
// The law of material/von_mises.h at several points, a layer at a time, in passes: each goes through all points before
// the next begins. A point's roots and divisions wait for each other, but not for those of the next point, and a
// processor looks ahead some hundred operations: so a pass is short, what is needed once only is asked for
// again, and what goes from pass to pass is little, since a store of a Pack costs as much as two products.
#include "forming_sim/material/edge_pull.h"
#include "forming_sim/material/von_mises.h"

namespace forming_sim {

/// A layer of N points.
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

  /// After the trials are found: the corrections and the p of those that yield, and whether any does. memory(i): of this
  /// layer of point i; J: of each; dissipated(i, what): called for each point where any flows, J/m3.
  template <class Memory, class Dissipated>
  [[gnu::always_inline]] bool correct_all(const HardeningCurve& hardening, const T* J, const Memory& memory, const Dissipated& dissipated) {
    constexpr int plastic_strain = Symmetric<T, D>::size;
    const auto none = [&] {
      for (bool& each : flows) each = false;
      return false;
    };
    if (hardening.kind == HardeningCurve::elastic) return none();
    bool may = false;
    for (int i = 0; i < N; ++i) may = may || any(may_yield(hardening, trial[i]));
    if (!may) return none();
    YieldStress<T> yield[N];
    Flow<T> flow[N];
    bool any_flows = false;
    for (int i = 0; i < N; ++i) {
      T p;
      load(memory(i), plastic_strain, p);
      yield[i] = yield_stress(hardening, p);
      flows[i] = any(yields(trial[i], yield[i]));
      if (flows[i]) {
        flow[i] = find_flow(trial[i], yield[i]);
        any_flows = true;
      }
    }
    for (int i = 0; i < N; ++i) {
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

/// f(i) of each of N points: in the plane a turn of its own, so that what little such points have can live in registers.
template <int D, int N, class F> [[gnu::always_inline]] inline void each_point(F&& f) {
  if constexpr (D == 2) repeat<N>(f);
  else
    for (int i = 0; i < N; ++i) f(i);
}

/// A step of N points of a body with one layer. `at` knows them, and is asked of point i:
///   at.edges(i, e)                  its edges, more than once
///   at.ratio(i, e)                  J, once
///   at.memory(i)                    where its memory starts
///   at.dissipate(i, what)           takes the plastic work of the step, J/m3, where any of them flows
///   at.respond(i, e, pull, forces)  takes what its stress beside the pressure does (material/edge_pull.h) into `forces`; e has normals.
template <int N, class T, int D, bool Ring, class At, class Forces> [[gnu::always_inline]] inline void one_layer_of_points(const SolidConstants& m, At& at, Forces& forces) {
  constexpr bool by_ways = D == 3;
  LayerOfPoints<T, D, N> layer;
  T J[N];
  Vector<T, D> y[by_ways ? N : 1][D];
#pragma GCC unroll 1
  for (int i = 0; i < N; ++i) {
    Edges<T, D, Ring> e;
    at.edges(i, e);
    J[i] = at.ratio(i, e);
    const Symmetric<T, D> G = load_memory<T, D>(at.memory(i));
    Vector<T, D>* way = y[by_ways ? i : 0];
    raise(G, e, way);
    find_trial(push(G, e, way), stress_factor(m, J[i]), layer.trial[i]);
  }
  layer.correct_all(m.layer[0].hardening, J, [&](int i) { return at.memory(i); }, [&](int i, const T& what) { at.dissipate(i, what); });
  each_point<D, N>([&](auto i) __attribute__((always_inline)) {
    Edges<T, D, Ring> e;
    at.edges(i, e);
    find_normals(e);
    if constexpr (by_ways) at.respond(i, e, layer.pull_of_ways(i, e, y[i]), forces);
    else at.respond(i, e, layer.template pull<Ring>(i), forces);
    if (layer.flows[i]) keep_flow(at.memory(i), layer.u[i], metric_from_normals(e));
  });
}

/// Likewise with several, in the plane: what is found of a point stays.
template <int N, class T, bool Ring, class At, class Forces> [[gnu::always_inline]] inline void layers_in_the_plane(const SolidConstants& m, At& at, Forces& forces) {
  LayerOfPoints<T, 2, N> layer;
  T J[N], factor[N];
  Edges<T, 2, Ring> e[N];
  Metric<T, 2> metric[N];
  StressPull<T, 2, Ring> pull[N];
  each_point<2, N>([&](auto i) __attribute__((always_inline)) {
    at.edges(i, e[i]);
    J[i] = at.ratio(i, e[i]);
    factor[i] = stress_factor(m, J[i]);
    find_normals(e[i]);
    metric[i] = metric_from_normals(e[i]);
    pull[i].clear();
  });
  for (int k = 0; k < m.layers; ++k) {
    const auto memory = [&](int i) { return at.memory(i) + k * kLayerItems<2> * lanes_of<T>; };
    const T w(m.layer[k].weight);
#pragma GCC unroll 1
    for (int i = 0; i < N; ++i) find_trial(push(load_memory<T, 2>(memory(i)), e[i]), factor[i], layer.trial[i]);
    layer.correct_all(m.layer[k].hardening, J, memory, [&](int i, const T& what) { at.dissipate(i, w * what); });
    each_point<2, N>([&](auto i) __attribute__((always_inline)) {
      layer.add_to(pull[i], i, w);
      if (layer.flows[i]) keep_flow(memory(i), layer.u[i], metric[i]);
    });
  }
  each_point<2, N>([&](auto i) __attribute__((always_inline)) { at.respond(i, e[i], pull[i], forces); });
}

/// In space the edges of a point are found again for each layer: kept, they and their normals would fill a cache.
template <int N, class T, class At, class Forces> [[gnu::always_inline]] inline void layers_in_space(const SolidConstants& m, At& at, Forces& forces) {
  LayerOfPoints<T, 3, N> layer;
  T J[N], factor[N];
  Metric<T, 3> metric[N];
  StressPull<T, 3, false> sum[N];
  bool knows_metrics = false;
  for (int k = 0; k < m.layers; ++k) {
    const auto memory = [&](int i) { return at.memory(i) + k * kLayerItems<3> * lanes_of<T>; };
    const T w(m.layer[k].weight);
    for (int i = 0; i < N; ++i) {
      Edges<T, 3> e;
      at.edges(i, e);
      if (k == 0) {
        J[i] = at.ratio(i, e);
        factor[i] = stress_factor(m, J[i]);
        sum[i].clear();
      }
      find_trial(push(load_memory<T, 3>(memory(i)), e), factor[i], layer.trial[i]);
    }
    const bool flows = layer.correct_all(m.layer[k].hardening, J, memory, [&](int i, const T& what) { at.dissipate(i, w * what); });
    if (flows && !knows_metrics) {
      for (int i = 0; i < N; ++i) {
        Edges<T, 3> e;
        at.edges(i, e);
        find_normals(e);
        metric[i] = metric_from_normals(e);
      }
      knows_metrics = true;
    }
    for (int i = 0; i < N; ++i) {
      if (layer.flows[i]) keep_flow(memory(i), layer.u[i], metric[i]);
      StressPull<T, 3, false> pull = sum[i];
      layer.add_to(pull, i, w);
      if (k + 1 < m.layers) {
        sum[i] = pull;
        continue;
      }
      Edges<T, 3> e;
      at.edges(i, e);
      find_normals(e);
      at.respond(i, e, pull, forces);
    }
  }
}

template <int N, class T, int D, bool Ring, class At, class Forces> [[gnu::always_inline]] inline void layers_of_points(const SolidConstants& m, At& at, Forces& forces) {
  if constexpr (D == 2) layers_in_the_plane<N, T, Ring>(m, at, forces);
  else layers_in_space<N, T>(m, at, forces);
}

/// A step of N points of a body of either.
template <int N, class T, int D, bool Ring, class At, class Forces> [[gnu::always_inline]] inline void von_mises_points(const SolidConstants& m, At& at, Forces& forces) {
  if (m.layers == 1) one_layer_of_points<N, T, D, Ring>(m, at, forces);
  else layers_of_points<N, T, D, Ring>(m, at, forces);
}

}  // namespace forming_sim
