#pragma once
// A step of the laws in one-point cells: the law at the centre, the trial of what varies about it, and, where a cell asks for it, both
// flowing together (element/flow_together.h).
#include "forming_sim/element/hourglass.h"

namespace forming_sim {

/// A cell in a step.
template <class T, int D, bool Ring> struct OnePointCell {
  Edges<T, D, Ring> e;  ///< with their reciprocal vectors
  CornerSums<T, D> sums;
  Vector<T, D> x[Ring ? OnePoint<D>::nodes : 1];  ///< of a ring, the corners
  T J, factor;          ///< V/V0; stress per deviator, as the law has it
  const double* constants;
  double *memory, *hourglass_memory;
  PointResponse<T, D> point;  ///< what mean and variation answer
  Hourglass<T, D, Ring> hourglass;

  OnePointCell(const PlaneModuli& moduli, const double* of_cell, double* its_memory, double* its_hourglass)
      : constants(of_cell), memory(its_memory), hourglass_memory(its_hourglass), hourglass(moduli, of_cell) {}

  void find_strains() { hourglass.find_strains(e, sums.mode, x); }

  /// `point` becomes this, number by number: what is copied as a whole has to lie in memory from its beginning on.
  void answer(const PointResponse<T, D>& a) {
    repeat<Symmetric<T, D>::size>([&](auto i) { point.S[i] = a.S[i]; });
    point.dissipation = a.dissipation;
    point.kept = a.kept;
    point.knows_yield = a.knows_yield;
    point.yield.value = a.yield.value;
    point.yield.slope = a.yield.slope;
    point.yield.bend = a.yield.bend;
    point.dp = a.dp;
  }
  /// What the forces ask for, as another cell has it, in the same way.
  void wait_as(const OnePointCell& other) {
    const auto copy = [](auto& to, const auto& from) __attribute__((always_inline)) {
      repeat<static_cast<int>(std::extent_v<std::remove_reference_t<decltype(to)>>)>([&](auto m) { repeat<D>([&](auto i) { to[m][i] = from[m][i]; }); });
    };
    copy(e.up, other.e.up);
    copy(sums.mode, other.sums.mode);
    e.volume = other.e.volume;
    constants = other.constants, memory = other.memory, hourglass_memory = other.hourglass_memory;
    hourglass.wait_as(other.hourglass);
  }
};

/// A cell of a single layer that asks to flow.
template <class Flow, class T, int D, bool Ring> void put_one_layer(Flow& flow, int half, const OnePointCell<T, D, Ring>& cell) {
  flow.put_cell(half, cell.e, cell.hourglass.strain(), cell.factor, cell.J);
  flow.put_layer(half, cell.point, cell.memory, cell.hourglass_memory);
}
template <class Flow, class T, int D, bool Ring> void take_one_layer(Flow& flow, int half, OnePointCell<T, D, Ring>& cell) {
  cell.hourglass.take_flow(flow, half, cell.point, cell.memory, cell.hourglass_memory);
}
template <class T, int D, bool Ring> void flow_alone(const SolidConstants& m, const PlaneModuli& moduli, OnePointCell<T, D, Ring>& cell) {
  FlowTogether<T, D, Ring> flow;
  put_one_layer(flow, 0, cell);
  flow.find_planes(cell.constants);
  flow.flow(m, m.layer[0].hardening, moduli);
  take_one_layer(flow, 0, cell);
}

/// The law of a body of a single layer, and the trial of what varies; whether the cell asks to flow.
template <class T, int D, bool Ring> bool try_one_layer(const SolidConstants& m, OnePointCell<T, D, Ring>& cell) {
  cell.factor = stress_factor(m, cell.J);
  cell.answer(layer_step(m, 0, cell.factor, cell.e, cell.J, cell.memory, Keep::yes));
  cell.find_strains();
  return cell.hourglass.try_layer(m.layer[0], cell.point, cell.memory, cell.hourglass_memory);
}
template <class T, int D, bool Ring> void finish_one_layer(OnePointCell<T, D, Ring>& cell) {
  cell.hourglass.finish_only_layer(cell.point.dissipation, cell.hourglass_memory);
}

/// One step of a body of several, or of anisotropic ones. flow: of its metric, most that of it; answer(k, memory): asks the law of layer k.
template <class T, int D, bool Ring, class Flow, class Answer>
void step_of_layers(const SolidConstants& m, const PlaneModuli& moduli, OnePointCell<T, D, Ring>& cell, Flow& flow, double most, const Answer& answer) {
  constexpr int size = Symmetric<T, D>::size;
  Symmetric<T, D> S;
  T dissipation(0);
  repeat<size>([&](auto i) { S[i] = T(0); });
  cell.hourglass.clear();
  cell.factor = stress_factor(m, cell.J);
  cell.find_strains();
  bool is_put = false;
  double *memory = cell.memory, *hourglass_memory = cell.hourglass_memory;
  for (int k = 0; k < m.layers; ++k) {
    answer(k, memory);
    if (cell.hourglass.try_layer(m.layer[k], cell.point, memory, hourglass_memory, most)) {
      if (!is_put) {
        flow.put_cell(0, cell.e, cell.hourglass.strain(), cell.factor, cell.J);
        flow.find_planes(cell.constants);
        is_put = true;
      }
      flow.put_layer(0, cell.point, memory, hourglass_memory);
      flow.flow(m, m.layer[k].hardening, moduli);
      cell.hourglass.take_flow(flow, 0, cell.point, memory, hourglass_memory);
    }
    const T w(m.layer[k].weight);
    cell.hourglass.finish_layer(w, cell.point.dissipation, hourglass_memory);
    repeat<size>([&](auto i) { S[i] += w * cell.point.S[i]; });
    dissipation += w * cell.point.dissipation;
    memory += kLayerItems<D> * stride_of<T>;
    hourglass_memory += kHourglassItems<D> * stride_of<T>;
  }
  repeat<size>([&](auto i) { cell.point.S[i] = S[i]; });
  cell.point.dissipation = dissipation;
}
template <class T, int D, bool Ring> void step_of_layers(const SolidConstants& m, const PlaneModuli& moduli, OnePointCell<T, D, Ring>& cell) {
  FlowTogether<T, D, Ring> flow;
  step_of_layers(m, moduli, cell, flow, Isotropic::most, [&](int k, double* memory) { cell.answer(layer_step(m, k, cell.factor, cell.e, cell.J, memory, Keep::yes)); });
}
/// Of Law::hill.
template <class T, int D, bool Ring> void step_of_hill(const SolidConstants& m, const PlaneModuli& moduli, OnePointCell<T, D, Ring>& cell) {
  const double* axes = axes_of<T, D>(m, cell.memory);
  const HillMetric<T, D> metric(m, cell.e, axes);
  FlowTogether<T, D, Ring, HillMetric<T, D>> flow(metric);
  const HillPoint<T, D, Ring> point = hill_point(m, cell.e, cell.J, cell.memory);
  step_of_layers(m, moduli, cell, flow, metric.most, [&](int k, double*) {
    HillResponse<T, D> r;
    hill_layer_step<1>(m, k, 1, &point, Keep::yes, &r);
    cell.answer(r);
    flow.put_trial(r.flowed ? r.trial : r.S);
  });
}

}  // namespace forming_sim
