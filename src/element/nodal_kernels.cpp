// The loops over simplices whose pressures are in their nodes, compiled once per vector width (see
// CMakeLists.txt): the volumes of the nodes, and the forces of their pressures,
//   V_n = sum_s V_s / (d+1),  theta_n = V_n / V_n0 - 1,  p_n = K theta_n, next to nu = 1/2 that of element/even_pressure.h,
//   U = sum_n V_n0/2 p_n theta_n + the guard of each simplex (element/guard.h),
//   f_a = - dU/dx_a = - sum_s p_s dV_s/dx_a,  p_s the mean p_n of the nodes of s, and its guard.
#include "element/bulk_viscosity.h"
#include "forming_sim/element/guard.h"

namespace forming_sim {
namespace FORMING_SIM_ISA {
namespace {

/// Adds to each node of the pack its share, 1/(d+1), of what every simplex around it has.
template <class Cell> void share_out(const CellGroup& g, long pack, const Pack* of_simplex) {
  Pack share[Cell::nodes];
  for (Pack& s : share) s = Pack(0.0);
  for (int s = 0; s < Cell::simplices; ++s) {
    const Pack part = of_simplex[s] * Pack(1.0 / (kD<Cell> + 1));
    for (int a = 0; a <= kD<Cell>; ++a) share[Cell::table[s][a]] += part;
  }
  const int* slots = slots_of<Cell>(g, pack);
  for (int a = 0; a < Cell::nodes; ++a) add_numbers(share[a], slots + a * kLanes, g.sums);
}

template <class Cell> void volumes_of_pack(const CellGroup& g, const NodalView& view, long pack) {
  Vector<Pack, kD<Cell>> x[Cell::nodes];
  gather_ways<Cell>(nodes_of<Cell>(g, pack), view.x, x);
  Pack V[Cell::simplices];
  simplex_volumes<Cell>(nullptr, x, V);
  share_out<Cell>(g, pack, V);
}

/// Of every simplex of the pack the mean of a number per node.
template <class Cell> void means(const CellGroup& g, long pack, const double* numbers, Pack* mean) {
  const int* nodes = nodes_of<Cell>(g, pack);
  Pack of_node[Cell::nodes];
  for (int a = 0; a < Cell::nodes; ++a) of_node[a] = gather_numbers(numbers, nodes + a * kLanes);
  for (int s = 0; s < Cell::simplices; ++s) {
    mean[s] = Pack(0.0);
    for (int a = 0; a <= kD<Cell>; ++a) mean[s] += of_node[Cell::table[s][a]];
    mean[s] = Pack(1.0 / (kD<Cell> + 1)) * mean[s];
  }
}

template <class Cell> void growths_of_pack(const CellGroup& g, const NodalView& view, long pack) {
  Pack growth[Cell::simplices];  // V_s0 theta_s
  means<Cell>(g, pack, view.growth, growth);
  for (int s = 0; s < Cell::simplices; ++s) growth[s] = growth[s] * initial_volume(g, memory_of<Cell>(g, pack, s));
  share_out<Cell>(g, pack, growth);
}

/// p_s of every simplex of the pack, and J = V_s / V_s0.
template <class Cell> void pressures(const CellGroup& g, const NodalView& view, long pack, const Vector<Pack, kD<Cell>>* x, Pack* p, Pack* J) {
  simplex_volumes<Cell>(nullptr, x, J);
  means<Cell>(g, pack, view.pressure, p);
  for (int s = 0; s < Cell::simplices; ++s) {
    J[s] = J[s] / initial_volume(g, memory_of<Cell>(g, pack, s));
    p[s] += Pack(kGuard * g.solid.K) * guard_pressure(J[s]);
  }
}

template <class Cell> [[gnu::flatten]] void forces_of_pack(const CellGroup& g, const NodalView& view, long pack) {
  constexpr int D = kD<Cell>;
  Vector<Pack, D> x[Cell::nodes], f[Cell::nodes];
  gather_ways<Cell>(nodes_of<Cell>(g, pack), view.x, x);
  for (Vector<Pack, D>& on_node : f)
    for (int i = 0; i < D; ++i) on_node[i] = Pack(0.0);
  Pack p[Cell::simplices], J[Cell::simplices];
  pressures<Cell>(g, view, pack, x, p, J);
  if (is_viscous(g)) {
    const Pack q = viscosity_of_pack<Cell>(g, view, pack);
    for (Pack& of_simplex : p) of_simplex += q;
  }
  Mask upright = Pack(1.0) > Pack(0.0);
  Pack hoops(0.0);
  for (int s = 0; s < Cell::simplices; ++s) {
    CellEdges<Cell> e;
    edges_of<Cell>(nullptr, x, s, e.x);
    find_normals(e);
    upright = upright & (J[s] > Pack(0.0));
    const Pack share = Pack(kVolumePart<D, Cell::ring>) * p[s];
    for (int m = 0; m < D; ++m) f[Cell::table[s][m + 1]] -= share * e.normal[m];
    if constexpr (Cell::ring) {  // a third on each corner, since x_3 is their mean radius
      const Pack hoop = e.normal[2][0] * share * Pack(1.0 / 3);
      for (int m = 0; m < D; ++m) f[Cell::table[s][m + 1]][0] -= hoop;
      hoops += hoop;
    }
  }
  balance_apex<Cell>(hoops, f);
  holds(g.upright, pack, all(upright));
  const int* slots = slots_of<Cell>(g, pack);
  for (int a = 0; a < Cell::nodes; ++a) add_vectors(f[a], slots + a * kLanes, g.sums);
}

template <class Cell> void observe_pack(const CellGroup& g, const NodalView& view, long pack, long place, double* stress, double* ratio, double* energy) {
  Vector<Pack, kD<Cell>> x[Cell::nodes];
  gather_ways<Cell>(nodes_of<Cell>(g, pack), view.x, x);
  Pack p[Cell::simplices], J[Cell::simplices], stored(0.0);
  pressures<Cell>(g, view, pack, x, p, J);
  for (int s = 0; s < Cell::simplices; ++s) {
    stored += Pack(kGuard * g.solid.K) * initial_volume(g, memory_of<Cell>(g, pack, s)) * guard_energy(J[s]);
    if (!stress) continue;
    double* to = lanes_of(stress, Cell::simplices * 6, place) + s * 6 * kLanes;
    for (int i = 0; i < 6; ++i) (i < 3 ? p[s] : Pack(0.0)).store(to + i * kLanes);
    J[s].store(lanes_of(ratio, Cell::simplices, place) + s * kLanes);
  }
  add_to_block(energy, place, sum_of_first(stored, lanes_in_use(g, pack)));
}

/// Calls `work` with the cell type of simplices; one-point cells have pressures of their own.
template <class Work> void with_simplices(const CellGroup& g, Work&& work) {
  with_cell(g, [&](auto cell) {
    if constexpr (!decltype(cell)::one_point) work(cell);
  });
}

void volumes(const CellGroup& g, const NodalView& view, int first, int last) {
  with_simplices(g, [&](auto cell) {
    each_pack(first, last, [&](long pack) { volumes_of_pack<decltype(cell)>(g, view, pack); });
  });
}
void growths(const CellGroup& g, const NodalView& view, int first, int last) {
  with_simplices(g, [&](auto cell) {
    each_pack(first, last, [&](long pack) { growths_of_pack<decltype(cell)>(g, view, pack); });
  });
}
void forces(const CellGroup& g, const NodalView& view, int first, int last) {
  with_simplices(g, [&](auto cell) {
    each_pack(first, last, [&](long pack) { forces_of_pack<decltype(cell)>(g, view, pack); });
  });
}
void observe(const CellGroup& g, const NodalView& view, int first, int last, double* stress, double* ratio, double* energy) {
  with_simplices(g, [&](auto cell) {
    each_pack(first, last, [&](long pack) { observe_pack<decltype(cell)>(g, view, pack, pack - first * kPacks, stress, ratio, energy); });
  });
}

}  // namespace

NodalKernels nodal_kernels() { return {volumes, growths, forces, observe}; }

}  // namespace FORMING_SIM_ISA
}  // namespace forming_sim
