#pragma once
// The laws behind one interface: what an element asks of whichever law its
// material has. A new law is one file and one line in each function here.
#include "forming_sim/material/classical.h"
#include "forming_sim/material/hill.h"
#include "forming_sim/material/hyperelastic.h"
#include "forming_sim/material/von_mises.h"

namespace forming_sim {

/// Numbers of memory of a simplex, V0 (always the last) included.
template <int D> int memory_items(const SolidConstants& m) {
  constexpr int size = Symmetric<double, D>::size;
  if (m.law == Law::classical) return size + 3;  // S, plastic strain, pressure, V0
  return m.layers * kLayerItems<D> + (m.law == Law::hill ? axis_items(D) : 0) + 1;
}
/// Place of the pressure in the memory of the classical method.
template <int D> constexpr int kClassicalPressure = Symmetric<double, D>::size + 1;

/// Calls start(item, value) with the memory of a simplex free of stress, V0 excluded. G: G^X of the start; axes: axes_at_start(), of Law::hill.
template <int D, class Start> void start_memory(const SolidConstants& m, const Symmetric<double, D>& G, const double* axes, Start&& start) {
  constexpr int size = Symmetric<double, D>::size;
  const int of_axes = m.law == Law::hill ? m.layers * kLayerItems<D> : memory_items<D>(m);  // where they begin
  for (int i = 0; i < memory_items<D>(m) - 1; ++i) {
    if (i >= of_axes) {
      start(i, axes[i - of_axes]);
      continue;
    }
    const int within = i % kLayerItems<D>;
    start(i, m.law == Law::classical || within == size ? 0 : G[within]);
  }
}

/// One step of a point: its stress beside the pressure, and what it dissipates.
/// moved: the way of the edges in the last step, for Law::classical; null elsewhere.
template <class T, int D, bool Ring>
PointResponse<T, D> point_step(const SolidConstants& m, const Edges<T, D, Ring>& e, const Vector<T, D>* moved, const T& J, double* memory, Keep keep) {
  if (m.law == Law::hyperelastic) return hyperelastic_step(m, e, J, memory);
  if (m.law == Law::classical) return classical_step(m, e, moved, J, memory, keep);
  if (m.law == Law::hill) return hill_step(m, e, J, memory, keep);
  return von_mises_step(m, e, J, memory, keep);
}

/// Stored energy beside that of the pressure, per initial volume, J/m3. moved: as in classical_energy(), which alone reads it.
template <class T, int D, bool Ring>
T point_energy(const SolidConstants& m, const Edges<T, D, Ring>& e, const T& J, const double* memory, const Vector<T, D>* moved = nullptr) {
  if (m.law == Law::hyperelastic) return hyperelastic_energy(m, e, J, memory);
  if (m.law == Law::classical) return classical_energy(m, e, J, memory, moved);
  return von_mises_energy(m, e, J, memory);
}

/// Bound on the tangent modulus over mu, for the time step (element/time_step.h).
template <class T, int D, bool Ring> T point_tangent(const SolidConstants& m, const Edges<T, D, Ring>& e, const T& J, const double* memory) {
  if (m.law == Law::hyperelastic) return hyperelastic_tangent(m, e, J, memory);
  if (m.law == Law::classical) return J;
  return von_mises_tangent(m, e, J, memory);
}

/// V/V0 dp/d(ln V) over K, likewise: p = K (V/V0 - 1), and the classical pressure follows the rate of the current volume.
template <class T> T pressure_tangent(const SolidConstants& m, const T& J) { return m.law == Law::classical ? J : J * J; }

/// Equivalent plastic strain: the weighted mean of the layers'. at(item): a number of memory.
template <int D, class At> double plastic_strain_of(const SolidConstants& m, At&& at) {
  constexpr int size = Symmetric<double, D>::size;
  if (m.law == Law::classical) return at(size);
  double sum = 0;
  for (int k = 0; k < m.layers; ++k) sum += m.layer[k].weight * at(k * kLayerItems<D> + size);
  return sum;
}

}  // namespace forming_sim
