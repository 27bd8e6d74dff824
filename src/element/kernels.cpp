// The loops over elements, compiled once per vector width (see CMakeLists.txt).
// Only raw arrays and types of this width's namespace are used here, so that no
// inline function of a wider instruction set can leak into the rest of the program.
#include "forming_sim/element/cell_group.h"
#include "forming_sim/element/cell_types.h"
#include "forming_sim/element/hourglass.h"
#include "forming_sim/element/one_point_step.h"
#include "forming_sim/element/time_step.h"
#include "forming_sim/material/law.h"

namespace forming_sim {
namespace FORMING_SIM_ISA {
namespace {

template <class Cell> constexpr int kD = Cell::dimension;
template <class Cell> constexpr int kE = kEdges<kD<Cell>, Cell::ring>;
template <class Cell> using CellEdges = Edges<Pack, kD<Cell>, Cell::ring>;
template <class Cell> using CellIncrement = Increment<Pack, kD<Cell>, Cell::ring>;

/// Nodal vectors of a block of cells, gathered: one Pack per component.
template <class Cell>
void gather(const int* nodes, const double* field, Vector<Pack, kD<Cell>>* out) {
  for (int a = 0; a < Cell::nodes; ++a) {
    const double* from[kLanes];
    for (int l = 0; l < kLanes; ++l) from[l] = field + 4 * static_cast<long>(nodes[a * kLanes + l]);
    Pack z;
    if constexpr (kD<Cell> == 2) gather_records(from, out[a][0], out[a][1], z);
    else gather_records(from, out[a][0], out[a][1], out[a][2]);
  }
}

/// The node that all simplices of a cell have in common (mesh/cell_tables.h).
template <class Cell> constexpr int kApex = Cell::table[0][0];

/// From where the nodes of a cell of simplices are to the ways from the apex to the others; the apex stays where it
/// is. One-point cells have no apex, and keep all their nodes.
template <class Cell> void refer_to_apex(Vector<Pack, kD<Cell>>* x) {
  if constexpr (!Cell::one_point)
    for (int a = 0; a < Cell::nodes; ++a)
      if (a != kApex<Cell>) x[a] = x[a] - x[kApex<Cell>];
}
template <class Cell> void gather_ways(const int* nodes, const double* field, Vector<Pack, kD<Cell>>* out) {
  gather<Cell>(nodes, field, out);
  refer_to_apex<Cell>(out);
}

/// Constants of a block of one-point cells; null elsewhere.
template <class Cell> const double* constants_of(const CellGroup& g, long block) {
  if constexpr (Cell::one_point) return g.constants + static_cast<long>(g.constant_set[block]) * OnePoint<kD<Cell>, Cell::ring>::items * kLanes;
  else return nullptr;
}
template <class Cell> double* hourglass_of(const CellGroup& g, long block) { return g.hourglass + block * g.hourglass_items * kLanes; }

/// w_ma of a one-point cell.
inline Pack weight(const double* constants, int item) { return Pack::load(constants + item * kLanes); }

/// Edges of simplex s from what gather_ways() gives.
template <class Cell>
void edges_of(const double* constants, const Vector<Pack, kD<Cell>>* x, int s, Vector<Pack, kD<Cell>>* edge) {
  constexpr int D = kD<Cell>;
  if constexpr (Cell::one_point) {  // x_m = sum_a w_ma x_a
    for (int m = 0; m < D; ++m) {
      edge[m] = weight(constants, m) * x[0];
      for (int a = 1; a < Cell::nodes; ++a) edge[m] += weight(constants, a * D + m) * x[a];
    }
    if constexpr (Cell::ring) {  // x_3 = sum_a o_a r_a
      edge[2] = {{Pack(0.0), Pack(0.0)}};
      for (int a = 0; a < Cell::nodes; ++a) edge[2][0] += weight(constants, OnePoint<D, true>::hoop + a) * x[a][0];
    }
  } else {
    for (int m = 0; m < D; ++m)
      for (int i = 0; i < D; ++i) edge[m][i] = x[Cell::table[s][m + 1]][i];
    if constexpr (Cell::ring) edge[2] = {{x[kApex<Cell>][0] + Pack(1.0 / 3) * (edge[0][0] + edge[1][0]), Pack(0.0)}};
  }
}

/// Hands the forces on the edges of a one-point cell to its nodes, through the weights by which they make the edges.
template <class Cell>
void spread(const double* constants, const Vector<Pack, kD<Cell>>* force, Vector<Pack, kD<Cell>>* f) {
  constexpr int D = kD<Cell>;
  for (int a = 0; a < Cell::nodes; ++a)
    for (int m = 0; m < D; ++m) f[a] += weight(constants, a * D + m) * force[m];
}

template <class Cell> void simplex_volumes(const double* constants, const Vector<Pack, kD<Cell>>* x, Pack* V) {
  for (int s = 0; s < Cell::simplices; ++s) {
    Vector<Pack, kD<Cell>> edge[kE<Cell>];
    edges_of<Cell>(constants, x, s, edge);
    V[s] = simplex_volume<Pack, kD<Cell>, Cell::ring>(edge);
  }
}

template <class Cell> double* memory_of(const CellGroup& g, long block, int s) {
  return g.memory + (block * Cell::simplices + s) * g.items * kLanes;
}
inline Pack initial_volume(const CellGroup& g, const double* memory) { return Pack::load(memory + (g.items - 1) * kLanes); }

/// The ways of the edges of simplex s in the last step; in: velocities of the cell's nodes.
template <class Cell>
void moved_edges(const NodalView& view, const double* constants, const Vector<Pack, kD<Cell>>* v, int s, Vector<Pack, kD<Cell>>* w) {
  edges_of<Cell>(constants, v, s, w);
  for (int m = 0; m < kE<Cell>; ++m) w[m] = Pack(view.last_dt) * w[m];
}

/// Incremental pressure (2.11) of the classical method, p + K tr D dt, with the
/// mean rate of the cell or that of the element.
template <class Cell>
void classical_pressures(const CellGroup& g, const NodalView& view, long block, const Vector<Pack, kD<Cell>>* x,
                         const Vector<Pack, kD<Cell>>* v, Pack* p) {
  constexpr int D = kD<Cell>;
  const double* constants = constants_of<Cell>(g, block);
  Pack rate[Cell::simplices], sum_V(0.0), sum_rate(0.0);
  for (int s = 0; s < Cell::simplices; ++s) {
    CellEdges<Cell> e;
    edges_of<Cell>(constants, x, s, e.x);
    find_reciprocal(e);
    Vector<Pack, D> w[kE<Cell>];
    moved_edges<Cell>(view, constants, v, s, w);
    rate[s] = CellIncrement<Cell>(e, w).divergence();
    sum_V += e.volume;
    sum_rate += e.volume * rate[s];
  }
  const Pack mean = sum_rate / sum_V, theta(g.pressure == PressureMode::element ? 1 : g.element_share);
  for (int s = 0; s < Cell::simplices; ++s) {
    double* at = memory_of<Cell>(g, block, s);
    load(at, kClassicalPressure<D>, p[s]);
    p[s] += Pack(g.solid.K) * ((Pack(1.0) - theta) * mean + theta * rate[s]);
    store(at, kClassicalPressure<D>, p[s]);
  }
}

/// J = V/V0 of every simplex of the block.
template <class Cell> void volume_ratios(const CellGroup& g, long block, const Pack* V, Pack* J) {
  for (int s = 0; s < Cell::simplices; ++s) J[s] = V[s] / initial_volume(g, memory_of<Cell>(g, block, s));
}

/// p of every simplex of the block: K (V/V0 - 1) of the cell (with a share of the
/// element's own, see elements.cpp), of the element, or the mean of its nodes' pressures.
template <class Cell>
void pressures(const CellGroup& g, const NodalView& view, long block, const Pack* V, const Pack* J, Pack* p) {
  constexpr int D = kD<Cell>;
  const Pack K(g.solid.K);
  if constexpr (!Cell::one_point)
    if (g.pressure == PressureMode::node) {
      const int* nodes = g.nodes + block * Cell::nodes * kLanes;
      for (int s = 0; s < Cell::simplices; ++s) {
        Pack total(0.0);
        for (int a = 0; a <= D; ++a) total += gather_numbers(view.pressure, nodes + Cell::table[s][a] * kLanes);
        p[s] = total * Pack(1.0 / (D + 1));
      }
      return;
    }
  if (g.solid.law == Law::classical) {
    for (int s = 0; s < Cell::simplices; ++s) load(memory_of<Cell>(g, block, s), kClassicalPressure<D>, p[s]);
    return;
  }
  if (g.pressure == PressureMode::element || Cell::simplices == 1) {
    for (int s = 0; s < Cell::simplices; ++s) p[s] = K * (J[s] - Pack(1.0));
    return;
  }
  Pack sum_V(0.0), sum_V0(0.0);
  for (int s = 0; s < Cell::simplices; ++s) {
    sum_V += V[s];
    sum_V0 += initial_volume(g, memory_of<Cell>(g, block, s));
  }
  const Pack theta(g.element_share);
  const Pack mean = (Pack(1.0) - theta) * K * (sum_V / sum_V0 - Pack(1.0));
  for (int s = 0; s < Cell::simplices; ++s) p[s] = mean + theta * K * (J[s] - Pack(1.0));
}

/// V, dV/dt and extent (tensor.h) of the cell whose nodes stand at x and move with v.
template <class Cell>
void volume_and_rate(const double* constants, const Vector<Pack, kD<Cell>>* x, const Vector<Pack, kD<Cell>>* v, Pack& V, Pack& rate, Pack& size) {
  constexpr int D = kD<Cell>;
  V = rate = size = Pack(0.0);
  for (int s = 0; s < Cell::simplices; ++s) {
    CellEdges<Cell> e;
    edges_of<Cell>(constants, x, s, e.x);
    find_reciprocal(e);
    Vector<Pack, D> w[kE<Cell>];
    edges_of<Cell>(constants, v, s, w);
    V += e.volume;
    size += extent(e);
    rate += e.volume * CellIncrement<Cell>(e, w).divergence();
  }
}

/// Bulk viscosity of the cells of a block: q, which adds to p, and the power that it takes, q D V, with
/// q = rho l (b1 c D + b2^2 l D |D| where D < 0), D = (dV/dt)/V, l = extent^(1/d). Out of line: most scenes have none.
struct Viscosity {
  Pack q, power;
};
template <class Cell> [[gnu::noinline]] Viscosity viscosity_of_block(const CellGroup& g, const NodalView& view, long block) {
  constexpr int D = kD<Cell>;
  const int* nodes = g.nodes + block * Cell::nodes * kLanes;
  Vector<Pack, D> x[Cell::nodes], v[Cell::nodes];
  gather_ways<Cell>(nodes, view.x, x);
  gather_ways<Cell>(nodes, view.v, v);
  Pack V, rate, size;
  volume_and_rate<Cell>(constants_of<Cell>(g, block), x, v, V, rate, size);
  const Pack D_v = rate / V;
  const Pack l = lanewise([](double volume) { return D == 2 ? __builtin_sqrt(volume) : __builtin_cbrt(volume); }, size);
  const Pack c(__builtin_sqrt((g.solid.K + 4.0 / 3 * g.solid.mu) / g.density));
  const Pack b2(g.quadratic_viscosity);
  const Pack q = Pack(g.density) * l * D_v * (Pack(g.linear_viscosity) * c + select(D_v < Pack(0.0), b2 * b2 * l * absolute(D_v), Pack(0.0)));
  return {q, q * D_v * V};
}

/// Where a Pack takes several registers, their operations fill each other's waiting times already.
#if defined(__AVX512F__)
constexpr bool kOneRegister = true;
#else
constexpr bool kOneRegister = false;
#endif

/// Simplices of a cell that go through the law together.
template <class Cell> using Together = std::conditional_t<!kOneRegister || Cell::one_point || Cell::simplices % 2 == 1, Pack, Twin<Pack>>;

inline bool of_von_mises(Law law) { return law == Law::green_elastic || law == Law::paper; }

/// OneLayer: the law is one of material/von_mises.h with a single layer, for which the
/// kernel is made as lean as it can be; all others, and the laws of one-point cells, are told apart at run time.
template <class Cell, bool OneLayer>
[[gnu::flatten]] void forces_of_block(const CellGroup& g, const NodalView& view, long block) {
  constexpr int D = kD<Cell>;
  const double* constants = constants_of<Cell>(g, block);
  const int* nodes = g.nodes + block * Cell::nodes * kLanes;
  Vector<Pack, D> x[Cell::nodes], f[Cell::nodes];
  gather_ways<Cell>(nodes, view.x, x);
  for (int a = 0; a < Cell::nodes; ++a)
    for (int i = 0; i < D; ++i) f[a][i] = Pack(0.0);

  Pack V[Cell::simplices], J[Cell::simplices], p[Cell::simplices];
  simplex_volumes<Cell>(constants, x, V);
  volume_ratios<Cell>(g, block, V, J);
  Vector<Pack, D> v[Cell::nodes];  // only where the law asks for velocities
  const bool classical = !OneLayer && g.solid.law == Law::classical;
  if (classical) gather_ways<Cell>(nodes, view.v, v);
  if (classical) classical_pressures<Cell>(g, view, block, x, v, p);
  else pressures<Cell>(g, view, block, V, J, p);
  const int in_use = block + 1 == g.blocks ? g.cells - static_cast<int>(block) * kLanes : kLanes;
  if (g.linear_viscosity > 0 || g.quadratic_viscosity > 0) {
    const Viscosity viscosity = viscosity_of_block<Cell>(g, view, block);
    for (int s = 0; s < Cell::simplices; ++s) p[s] += viscosity.q;
    g.viscous_work[block] += sum_of_first(viscosity.power, in_use) * view.dt;
  }

  Pack dissipated(0.0), hoops(0.0);
  Mask upright = J[0] > Pack(0.0);
  constexpr int together = points_in<Together<Cell>>;
  for (int first = 0; first < Cell::simplices; first += together) {
    CellEdges<Cell> edges[together];
    double* memory[together];
    Together<Cell> ratio;
    for (int i = 0; i < together; ++i) {
      edges_of<Cell>(constants, x, first + i, edges[i].x);
      if (Cell::one_point || classical) find_reciprocal(edges[i]);
      else find_areas(edges[i]);
      memory[i] = memory_of<Cell>(g, block, first + i);
      part_of(ratio, i) = J[first + i];
      upright = upright & (J[first + i] > Pack(0.0));
    }
    PointResponse<Together<Cell>, D> points;
    if constexpr (OneLayer) points = layer_step(g.solid, 0, stress_factor(g.solid, ratio), edges, ratio, memory, Keep::yes);
    else if (!Cell::one_point && of_von_mises(g.solid.law)) points = von_mises_step(g.solid, edges, ratio, memory, Keep::yes);
    for (int i = 0; i < together; ++i) {
      const int s = first + i;
      const CellEdges<Cell>& e = edges[i];
      const Pack V0 = initial_volume(g, memory[i]);
      PointResponse<Pack, D> point;
      Vector<Pack, D> w[kE<Cell>], force[D];
      if (classical) moved_edges<Cell>(view, constants, v, s, w);
      if constexpr (Cell::one_point) {
        Hourglass<Pack, D, Cell::ring> hourglass(g.solid, constants, e, x);
        point = step_with_hourglass(g.solid, e, classical ? w : nullptr, J[s], memory[i], hourglass, hourglass_of<Cell>(g, block));
        for (int m = 0; m < D; ++m)
          for (int c = 0; c < D; ++c) force[m][c] = Pack(0.0);
        hourglass.add_forces(V0, force, f);
      } else if (OneLayer || of_von_mises(g.solid.law)) {
        point = points.of(i);
      } else {
        point = point_step(g.solid, e, classical ? w : nullptr, J[s], memory[i], Keep::yes);
      }
      dissipated += point.dissipation * V0;
      for (int c = 0; c < 3; ++c) point.S[c] += p[s];  // sigma = p I + S (3.4)
      // The force on edge m is -V sigma . x^m, that of the hoop of a ring -V sigma . x^3.
      if constexpr (Cell::one_point) {
        for (int m = 0; m < D; ++m) force[m] += point.S * (Pack(-1.0) * e.area[m]);
        spread<Cell>(constants, force, f);
        if constexpr (Cell::ring) {  // through the weights of x_3
          const Pack hoop = e.area[2][0] * point.S[2];
          for (int a = 0; a < Cell::nodes; ++a) f[a][0] -= weight(constants, OnePoint<D, true>::hoop + a) * hoop;
        }
      } else {
        for (int m = 0; m < D; ++m) f[Cell::table[s][m + 1]] -= point.S * e.area[m];
        if constexpr (Cell::ring) {  // a third on each corner, since x_3 is their mean radius
          const Pack hoop = e.area[2][0] * point.S[2] * Pack(1.0 / 3);
          for (int m = 0; m < D; ++m) f[Cell::table[s][m + 1]][0] -= hoop;
          hoops += hoop;
        }
      }
    }
  }
  if constexpr (!Cell::one_point) {  // the forces on edges are in balance with those on the apex, where all of them start
    for (int a = 0; a < Cell::nodes; ++a)
      if (a != kApex<Cell>) f[kApex<Cell>] -= f[a];
    if constexpr (Cell::ring) f[kApex<Cell>][0] -= Pack(3.0) * hoops;
  }
  g.plastic_work[block] += sum_of_first(dissipated, in_use);
  g.upright[block] = all(upright);

  const int* slots = g.slots + block * Cell::nodes * kLanes;
  for (int a = 0; a < Cell::nodes; ++a) {
    if constexpr (D == 2) add_pairs(f[a][0], f[a][1], slots + a * kLanes, g.sums);
    else add_quads(f[a][0], f[a][1], f[a][2], slots + a * kLanes, g.sums);
  }
}

template <class Cell> void volumes_of_block(const CellGroup& g, const NodalView& view, long block) {
  constexpr int D = kD<Cell>;
  const double* constants = constants_of<Cell>(g, block);
  const int* nodes = g.nodes + block * Cell::nodes * kLanes;
  Vector<Pack, D> x[Cell::nodes];
  gather_ways<Cell>(nodes, view.x, x);
  Pack share[Cell::nodes];
  for (int a = 0; a < Cell::nodes; ++a) share[a] = Pack(0.0);
  Pack V[Cell::simplices];
  simplex_volumes<Cell>(constants, x, V);
  for (int s = 0; s < Cell::simplices; ++s) {
    const Pack part = V[s] * Pack(1.0 / (D + 1));
    if constexpr (!Cell::one_point)  // which has a pressure of its own
      for (int a = 0; a <= D; ++a) share[Cell::table[s][a]] += part;
  }
  const int* slots = g.slots + block * Cell::nodes * kLanes;
  for (int a = 0; a < Cell::nodes; ++a) add_numbers(share[a], slots + a * kLanes, g.sums);
}

template <class Cell>
using CellBound = std::conditional_t<!Cell::one_point, StepBound<Pack, kD<Cell>, Cell::nodes, Cell::ring>,
                                     std::conditional_t<Cell::ring, OnePointRingBound<Pack>, OnePointBound<Pack, kD<Cell>>>>;

template <class Cell>
[[gnu::flatten]] void rates_of_block(const CellGroup& g, const NodalView& view, long block, BlockRates& out) {
  constexpr int D = kD<Cell>;
  const double* constants = constants_of<Cell>(g, block);
  const int* nodes = g.nodes + block * Cell::nodes * kLanes;
  Vector<Pack, D> x[Cell::nodes];
  gather<Cell>(nodes, view.x, x);
  Vector<Pack, D> inertia[Cell::nodes];  // rings only
  if constexpr (Cell::ring)
    for (int a = 0; a < Cell::nodes; ++a) {
      inertia[a][1] = gather_numbers(view.inertia, nodes + a * kLanes);
      inertia[a][0] = select(x[a][0] > Pack(0.0), inertia[a][1], Pack(0.0));  // no radial motion on the axis
    }
  refer_to_apex<Cell>(x);
  CellBound<Cell> bound(g, inertia);
  for (int s = 0; s < Cell::simplices; ++s) {
    CellEdges<Cell> e;
    edges_of<Cell>(constants, x, s, e.x);
    find_reciprocal(e);
    const double* memory = memory_of<Cell>(g, block, s);
    if constexpr (Cell::one_point && Cell::ring) bound.set(e, x, memory, initial_volume(g, memory), constants, Hourglass<Pack, D, true>(g.solid, constants, e, x));
    else if constexpr (Cell::one_point) bound.set(e, memory, initial_volume(g, memory), constants, Hourglass<Pack, D>(g.solid, constants, e, x));
    else bound.add(e, memory, initial_volume(g, memory), Cell::table[s]);
  }
  Pack rate(0.0);
  if (g.quadratic_viscosity > 0) {
    Vector<Pack, D> v[Cell::nodes];
    gather_ways<Cell>(nodes, view.v, v);
    Pack V, size;
    volume_and_rate<Cell>(constants, x, v, V, rate, size);
    rate = absolute(rate / V);
  }
  const StepRates<Pack> rates = bound.rates(rate);
  rates.omega2.store(out.omega2.value);
  rates.damping.store(out.damping.value);
}

template <class Cell>
void observe_block(const CellGroup& g, const NodalView& view, long block, double* stress, double* ratio,
                   double* energy) {
  constexpr int D = kD<Cell>;
  const double* constants = constants_of<Cell>(g, block);
  const int* nodes = g.nodes + block * Cell::nodes * kLanes;
  Vector<Pack, D> x[Cell::nodes];
  gather_ways<Cell>(nodes, view.x, x);
  Pack V[Cell::simplices], J[Cell::simplices], p[Cell::simplices];
  simplex_volumes<Cell>(constants, x, V);
  volume_ratios<Cell>(g, block, V, J);
  pressures<Cell>(g, view, block, V, J, p);
  Pack stored(0.0), cell_V(0.0), cell_V0(0.0);
  const double own = g.pressure == PressureMode::element ? 1 : g.element_share;
  const bool classical = g.solid.law == Law::classical;
  for (int s = 0; s < Cell::simplices; ++s) {
    CellEdges<Cell> e;
    edges_of<Cell>(constants, x, s, e.x);
    find_reciprocal(e);
    double* memory = memory_of<Cell>(g, block, s);
    const Pack V0 = initial_volume(g, memory);
    stored += V0 * point_energy(g.solid, e, J[s], memory);
    if constexpr (Cell::one_point) stored += V0 * Hourglass<Pack, D, Cell::ring>(g.solid, constants, e, x).energy(g.solid, hourglass_of<Cell>(g, block));
    if (classical) stored += e.volume * p[s] * p[s] * Pack(0.5 / g.solid.K);
    else if (g.pressure != PressureMode::node) stored += Pack(0.5 * g.solid.K * own) * V0 * (J[s] - Pack(1.0)) * (J[s] - Pack(1.0));
    cell_V += e.volume;
    cell_V0 += V0;
    const Vector<Pack, D>* at_rest = nullptr;
    const PointResponse<Pack, D> point = point_step(g.solid, e, at_rest, J[s], memory, Keep::no);
    double* to = stress + (block * Cell::simplices + s) * 6 * kLanes;
    for (int i = 0; i < 6; ++i) {
      Pack component = i < Symmetric<Pack, D>::size ? point.S[i] : Pack(0.0);
      if (i < 3) component += p[s];
      component.store(to + i * kLanes);
    }
    J[s].store(ratio + (block * Cell::simplices + s) * kLanes);
  }
  if (g.pressure == PressureMode::cell && !classical) {
    const Pack strain = cell_V / cell_V0 - Pack(1.0);
    stored += Pack(0.5 * g.solid.K * (1 - own)) * cell_V0 * strain * strain;
  }
  const int in_use = block + 1 == g.blocks ? g.cells - static_cast<int>(block) * kLanes : kLanes;
  energy[block] = 0;
  for (int l = 0; l < in_use; ++l) energy[block] += stored[l];
}

/// Calls `work` with the cell type of the group's kind.
template <class Work> void with_cell(const CellGroup& g, Work&& work) {
  const auto flat = [&](auto cell) {
    if (g.ring) return work(cell_types::Turned<decltype(cell)>());
    work(cell);
  };
  switch (static_cast<CellKind>(g.kind)) {
    case CellKind::triangle: return flat(cell_types::Triangle());
    case CellKind::quad2: return flat(cell_types::Quad2());
    case CellKind::crossed: return flat(cell_types::Crossed());
    case CellKind::tetrahedron: return work(cell_types::Tetrahedron());
    case CellKind::hex6: return work(cell_types::Hex6());
    case CellKind::hex24: return work(cell_types::Hex24());
    case CellKind::quad1: return flat(cell_types::Quad1());
    case CellKind::hex1: return work(cell_types::Hex1());
  }
}

void forces(const CellGroup& g, const NodalView& view, int first, int last) {
  const bool one_layer = of_von_mises(g.solid.law) && g.solid.layers == 1;
  with_cell(g, [&](auto cell) {
    for (int b = first; b < last; ++b) {
      if (one_layer && !decltype(cell)::one_point) forces_of_block<decltype(cell), !decltype(cell)::one_point>(g, view, b);
      else forces_of_block<decltype(cell), false>(g, view, b);
    }
  });
}
void volumes(const CellGroup& g, const NodalView& view, int first, int last) {
  with_cell(g, [&](auto cell) {
    for (int b = first; b < last; ++b) volumes_of_block<decltype(cell)>(g, view, b);
  });
}
void rates(const CellGroup& g, const NodalView& view, int first, int last, BlockRates* out) {
  with_cell(g, [&](auto cell) {
    for (int b = first; b < last; ++b) rates_of_block<decltype(cell)>(g, view, b, out[b]);
  });
}
void observe(const CellGroup& g, const NodalView& view, int first, int last, double* stress, double* ratio,
             double* energy) {
  with_cell(g, [&](auto cell) {
    for (int b = first; b < last; ++b) observe_block<decltype(cell)>(g, view, b, stress, ratio, energy);
  });
}

#define FORMING_SIM_TEXT(word) #word
#define FORMING_SIM_NAME(word) FORMING_SIM_TEXT(word)

}  // namespace

const Kernels& kernels() {
  static const Kernels k{FORMING_SIM_NAME(FORMING_SIM_ISA), forces, volumes, rates, observe};
  return k;
}

}  // namespace FORMING_SIM_ISA
}  // namespace forming_sim
