// The loops over elements, compiled once per vector width (see CMakeLists.txt).
// Only raw arrays and types of this width's namespace are used here, so that no
// inline function of a wider instruction set can leak into the rest of the program.
#include "element/bulk_viscosity.h"
#include "element/classical_pack.h"
#include "element/one_point_pack.h"
#include "forming_sim/element/hourglass.h"
#include "forming_sim/element/one_point_step.h"
#include "forming_sim/element/time_step.h"
#include "forming_sim/material/law.h"
#include "forming_sim/material/von_mises_points.h"

namespace forming_sim {
namespace FORMING_SIM_ISA {
namespace {

/// V and J = V/V0 of every simplex of the pack.
template <class Cell> void find_volumes(const CellGroup& g, long pack, const double* constants, const Vector<Pack, kD<Cell>>* x, Pack* V, Pack* J) {
  for (int s = 0; s < Cell::simplices; ++s) {
    V[s] = volume_of<Cell>(constants, x, s);
    J[s] = V[s] / initial_volume(g, memory_of<Cell>(g, pack, s));
  }
}

/// p of every simplex of the pack: K (V/V0 - 1) of the cell (with a share of the
/// element's own, see elements.cpp) or of the element. That of nodes: nodal_kernels.cpp.
template <class Cell>
void pressures(const CellGroup& g, long pack, const double* constants, const Pack* V, const Pack* J, Pack* p) {
  constexpr int D = kD<Cell>;
  const Pack K(g.solid.K);
  if (g.solid.law == Law::classical) {
    for (int s = 0; s < Cell::simplices; ++s) load(memory_of<Cell>(g, pack, s), kClassicalPressure<D>, p[s]);
    return;
  }
  if (g.pressure == PressureMode::element || Cell::simplices == 1) {
    for (int s = 0; s < Cell::simplices; ++s) p[s] = K * (J[s] - Pack(1.0));
    return;
  }
  Pack sum_V(0.0), sum_V0(0.0);
  for (int s = 0; s < Cell::simplices; ++s) {
    sum_V += V[s];
    sum_V0 += initial_volume(g, memory_of<Cell>(g, pack, s));
  }
  const Pack theta(g.element_share);
  const Pack mean = (Pack(1.0) - theta) * K * (sum_V / sum_V0 - Pack(1.0));
  for (int s = 0; s < Cell::simplices; ++s) p[s] = mean + theta * K * (J[s] - Pack(1.0));
  if (g.guard > 0) {
    Mask far = absolute(J[0] - Pack(1.0)) > free_of_guard<Cell>(constants, 0);
    for (int s = 1; s < Cell::simplices; ++s) far = far | (absolute(J[s] - Pack(1.0)) > free_of_guard<Cell>(constants, s));
    if (any(far))
      for (int s = 0; s < Cell::simplices; ++s) p[s] += Pack(g.guard) * K * guard_pressure(J[s], free_of_guard<Cell>(constants, s));
  }
}

/// Simplices of a cell that go through the law at a time, and packs of cells: some eight points keep a processor busy while each
/// waits for its own roots and divisions. Cells in the plane go alone where registers are few, and crossed ones of several layers: the
/// places of one cell's points are known beforehand.
template <class Cell> constexpr int kPoints = Cell::simplices % 6 == 0 ? 6 : Cell::simplices;
template <class Cell, Made made> constexpr int kTogether = kD<Cell> == 3 || registers_of<Pack> <= 16 || (made == Made::layers && Cell::simplices == 4) ? 1 : 8 / Cell::simplices;

/// Forces of the simplices of a pack, summed by its nodes.
template <class Cell> struct PackForces {
  static constexpr int D = kD<Cell>;
  const double* constants;
  const Vector<Pack, D>* x;
  Vector<Pack, D> on_node[Cell::nodes], on_drawn[kDrawn<Cell>];
  Pack hoops;

  [[gnu::always_inline]] void start(const double* its_constants, const Vector<Pack, D>* its_x) {
    constants = its_constants;
    x = its_x;
    hoops = Pack(0.0);
    repeat<Cell::nodes>([&](auto a) { repeat<D>([&](auto i) { on_node[a][i] = Pack(0.0); }); });
    repeat<kDrawn<Cell>>([&](auto a) { repeat<D>([&](auto i) { on_drawn[a][i] = Pack(0.0); }); });
  }

  /// A third on each corner, since x_3 is their mean radius.
  [[gnu::always_inline]] void add_hoop(int s, const Pack& force) {
    const Pack hoop = force * Pack(1.0 / 3);
    for (int m = 0; m < D; ++m) on_node[Cell::table[s][m + 1]][0] -= hoop;
    hoops += hoop;
  }
  /// Of simplex s, e its edges for the law with their normals: what the law pulls, and p.
  template <class Pull> [[gnu::always_inline]] void add(int s, const CellEdges<Cell>& e, Pull pull, const Pack& p) {
    if constexpr (Cell::drawn) {  // -V~ S . y^m on the edges of the law, -V p x^m on those of the volume
      Vector<Pack, D> force[D];
      CellEdges<Cell> of_volume;
      edges_of<Cell>(constants, x, s, of_volume.x);
      find_normals(of_volume);
      const Pack part = Pack(kVolumePart<D, Cell::ring>) * p;
      for (int m = 0; m < D; ++m) {
        force[m] = pull.on(e, m);
        on_node[Cell::table[s][m + 1]] -= part * of_volume.normal[m];
      }
      add_law_forces<Cell>(constants, force, s, on_drawn);
      if constexpr (Cell::ring) add_hoop(s, pull.on_hoop(e) + of_volume.normal[2][0] * part);
    } else {
      pull.add(p);
      for (int m = 0; m < D; ++m) on_node[Cell::table[s][m + 1]] -= pull.on(e, m);
      if constexpr (Cell::ring) add_hoop(s, pull.on_hoop(e));
    }
  }
};

/// Simplices whose memory is fetched ahead, and blocks in which that lies.
constexpr int kSimplicesAhead = 16;
template <class Cell> constexpr int kBlocksAhead = (kSimplicesAhead + Cell::simplices - 1) / Cell::simplices;

/// A pack of cells of simplices in a step: n of its simplices from `first` on are a bundle of material/von_mises_points.h.
template <class Cell, int n> struct PackInStep : PackOfGroup {
  static constexpr int D = kD<Cell>, simplices = Cell::simplices;
  const double* constants;
  Vector<Pack, D> x[Cell::nodes], drawn[kDrawn<Cell>];
  Pack J[simplices], p[simplices];  ///< of each simplex: of its volume
  Pack dissipated;  ///< J
  Mask upright;
  int first = 0;
  struct Nothing {};
  std::conditional_t<n == simplices, Nothing, PackForces<Cell>> sums;  ///< of a pack that is several bundles

  const int* nodes() const { return nodes_of<Cell>(g(), pack); }

  [[gnu::always_inline]] void open() {
    if (first > 0) return;
    Pack V[simplices];
    gather(V);
    pressures<Cell>(g(), pack, constants, V, J, p);
    if (is_viscous(g())) add_viscosity();
  }
  [[gnu::always_inline]] void gather(Pack* V) {
    constants = constants_of<Cell>(g(), pack);
    gather_ways<Cell>(nodes(), view->x, x);
    find_volumes<Cell>(g(), pack, constants, x, V, J);
    if constexpr (Cell::drawn) draw<Cell>(constants, x, drawn);
    upright = J[0] > Pack(0.0);
    dissipated = Pack(0.0);
  }
  void add_viscosity() {
    const Pack q = viscosity_of_pack<Cell>(g(), *view, pack);
    for (int s = 0; s < simplices; ++s) p[s] += q;
  }

  /// Simplex of point i; without a sum where they are all of the cell's, so that the compiler knows it.
  [[gnu::always_inline]] int simplex(int i) const { return n == simplices ? i : first + i; }
  [[gnu::always_inline]] double* memory(int i) const { return memory_of<Cell>(g(), pack, simplex(i)); }
  [[gnu::always_inline]] void edges(int i, CellEdges<Cell>& e) const { law_edges<Cell>(constants, x, drawn, simplex(i), e.x); }
  /// J that the law sees.
  [[gnu::always_inline]] Pack ratio(int i, const CellEdges<Cell>& e) {
    if (fetches) fetch_memory(g(), memory(i), kSimplicesAhead);
    const Pack of_law = Cell::drawn ? simplex_volume<Pack, D, Cell::ring>(e.x) / initial_volume(g(), memory(i)) : J[simplex(i)];
    upright = upright & (J[simplex(i)] > Pack(0.0)) & (of_law > Pack(0.0));
    return of_law;
  }
  [[gnu::always_inline]] void dissipate(int i, const Pack& what) { dissipated += what * initial_volume(g(), memory(i)); }
  template <class Pull> [[gnu::always_inline]] void respond(int i, const CellEdges<Cell>& e, const Pull& pull, PackForces<Cell>& forces) const {
    if (fetches) fetch_initial_volume(g(), memory(i), simplices);  // for the pressures of the next block
    forces.add(simplex(i), e, pull, p[simplex(i)]);
  }
  [[gnu::always_inline]] decltype(auto) start_forces() {
    if constexpr (n == simplices) {
      PackForces<Cell> forces;
      forces.start(constants, x);
      return forces;
    } else {
      if (first == 0) sums.start(constants, x);
      return (sums);
    }
  }
  [[gnu::always_inline]] void close(PackForces<Cell>& forces) const {
    if (first + n < simplices) return;
    if constexpr (Cell::drawn) hand_back<Cell>(constants, forces.on_drawn, forces.on_node);
    balance_apex<Cell>(forces.hoops, forces.on_node);
    g().plastic_work[block_of(pack)] += sum_of_first(dissipated, lanes_in_use(g(), pack));
    holds(g().upright, pack, all(upright));
    const int* slots = slots_of<Cell>(g(), pack);
    for (int a = 0; a < Cell::nodes; ++a) add_vectors(forces.on_node[a], slots + a * kLanes, g().sums);
  }
};

/// Of the laws of material/von_mises.h, and made for any of Law::hill.
template <class Cell, Made made> [[gnu::flatten]] void forces_of_several(const CellGroup& g, const NodalView& view, const PacksNow& now) {
  constexpr int n = kPoints<Cell>, most = kTogether<Cell, made>, D = kD<Cell>;
  PackInStep<Cell, n> packs[most];
  set_packs(g, view, now, kBlocksAhead<Cell>, packs);
  for (int first = 0; first < Cell::simplices; first += n) {
    packs[0].first = first;
    if constexpr (made == Made::one_layer) one_layer_of_points<n, most, Pack, D, Cell::ring>(g.solid, packs, now.count);
    else if constexpr (made == Made::layers) several_layers_of_points<n, most, Pack, D, Cell::ring>(g.solid, packs, now.count);
    else hill_points<n, most, Pack, D, Cell::ring>(g.solid, packs, now.count);
  }
}

/// Of any other, one simplex after the other.
template <class Cell> [[gnu::flatten]] void forces_of_any_law(const CellGroup& g, const NodalView& view, const PacksNow& now) {
  constexpr int D = kD<Cell>;
  const long pack = now.pack;
  PackInStep<Cell, 1> at;
  set_pack(g, view, now, pack, kBlocksAhead<Cell>, at);
  Vector<Pack, D> v[Cell::nodes], drawn_v[kDrawn<Cell>];  // only where the law asks for velocities
  const bool classical = g.solid.law == Law::classical;
  if (classical) {
    Pack V[Cell::simplices];
    at.gather(V);
    gather_ways<Cell>(at.nodes(), view.v, v);
    classical_pressures<Cell>(g, view, pack, at.x, v, at.p, Keep::yes);
    if (is_viscous(g)) at.add_viscosity();
    if constexpr (Cell::drawn) draw<Cell>(at.constants, v, drawn_v);
  } else {
    at.open();
  }
  auto&& forces = at.start_forces();
  for (; at.first < Cell::simplices; ++at.first) {
    CellEdges<Cell> e;
    at.edges(0, e);
    find_reciprocal(e);
    Vector<Pack, D> w[kE<Cell>];
    if (classical) {
      law_edges<Cell>(at.constants, v, drawn_v, at.first, w);
      moved<Cell>(view, w);
    }
    const PointResponse<Pack, D> point = point_step(g.solid, e, classical ? w : nullptr, at.ratio(0, e), at.memory(0), Keep::yes);
    at.dissipate(0, point.dissipation);
    at.respond(0, e, pull_of<D, Cell::ring>(point.S), forces);
  }
  at.close(forces);
}

template <class Cell>
using CellBound = std::conditional_t<!Cell::one_point, StepBound<Pack, kD<Cell>, Cell::nodes, Cell::ring>,
                                     std::conditional_t<Cell::ring, OnePointRingBound<Pack>, OnePointBound<Pack, kD<Cell>>>>;

template <class Cell>
[[gnu::flatten]] void rates_of_pack(const CellGroup& g, const NodalView& view, long pack, BlockRates& out) {
  constexpr int D = kD<Cell>;
  const double* constants = constants_of<Cell>(g, pack);
  const int* nodes = nodes_of<Cell>(g, pack);
  Vector<Pack, D> x[Cell::nodes];
  gather<Cell>(nodes, view.x, x);
  Vector<Pack, D> inertia[Cell::nodes];  // rings only
  if constexpr (Cell::ring)
    for (int a = 0; a < Cell::nodes; ++a) {
      inertia[a][1] = gather_numbers(view.inertia, nodes + a * kLanes);
      inertia[a][0] = select(x[a][0] > Pack(0.0), inertia[a][1], Pack(0.0));  // no radial motion on the axis
    }
  refer_to_apex<Cell>(x);
  Vector<Pack, D> drawn_x[kDrawn<Cell>];
  const bool drawn = Cell::drawn && !g.edge_omega2;
  Pack middle_w[4], lambda(0.0);
  if constexpr (Cell::drawn)
    if (drawn) {
      draw<Cell>(constants, x, drawn_x);
      for (int b = 0; b < 4; ++b) lambda -= weight(constants, kCrossedApex + b);
      for (int b = 0; b < 4; ++b) middle_w[b] = weight(constants, kCrossedApex + b) / larger(lambda, Pack(1e-9));  // with beta = 0 there are none
    }
  CellBound<Cell> bound(g, inertia);
  for (int s = 0; s < Cell::simplices; ++s) {
    CellEdges<Cell> e;
    edges_of<Cell>(constants, x, s, e.x);
    find_reciprocal(e);
    const double* memory = memory_of<Cell>(g, pack, s);
    if constexpr (Cell::one_point) {
      const Variation<Cell> variation(g, constants, e, x);
      if constexpr (Cell::ring) bound.set(e, x, memory, initial_volume(g, memory), constants, variation.sums.mode, variation.hourglass);
      else bound.set(e, memory, initial_volume(g, memory), constants, variation.sums.mode);
      if (variation.hourglass.far()) bound.omega2 += corner_rate<Cell>(g, view, pack, bound.omega2);
    } else {
      Pack at_edges;
      if (g.edge_omega2) at_edges = Pack::load(lanes_of(g.edge_omega2, Cell::simplices, pack) + s * kLanes);
      bound.add(e, memory, g.edge_omega2 ? &at_edges : nullptr, initial_volume(g, memory), free_of_guard<Cell>(constants, s), Cell::table[s]);
      if (drawn) {
        law_edges<Cell>(constants, x, drawn_x, s, e.x);
        find_reciprocal(e);
        bound.add_law(e, memory, initial_volume(g, memory), lambda * (Pack(1.0) - weight(constants, kCrossedFreed + s)), Cell::table[s]);
      }
    }
  }
  if constexpr (Cell::drawn)
    if (drawn) bound.add_middle(middle_w);
  Pack rate(0.0);
  if (g.quadratic_viscosity > 0) {
    Vector<Pack, D> v[Cell::nodes];
    gather_ways<Cell>(nodes, view.v, v);
    Pack V, size;
    volume_and_rate<Cell>(constants, x, v, V, rate, size);
    rate = absolute(rate / V);
  }
  const StepRates<Pack> rates = bound.rates(rate);
  rates.omega2.store(out.omega2.value + first_lane(pack));
  rates.damping.store(out.damping.value + first_lane(pack));
}

/// place: where the outputs of the pack are among theirs.
template <class Cell>
void observe_pack(const CellGroup& g, const NodalView& view, long pack, long place, double* stress, double* ratio,
                  double* energy) {
  constexpr int D = kD<Cell>;
  const double* constants = constants_of<Cell>(g, pack);
  const int* nodes = nodes_of<Cell>(g, pack);
  Vector<Pack, D> x[Cell::nodes];
  gather_ways<Cell>(nodes, view.x, x);
  Pack V[Cell::simplices], J[Cell::simplices], p[Cell::simplices];
  find_volumes<Cell>(g, pack, constants, x, V, J);
  pressures<Cell>(g, pack, constants, V, J, p);
  Vector<Pack, D> drawn_x[kDrawn<Cell>];
  if constexpr (Cell::drawn) draw<Cell>(constants, x, drawn_x);
  Pack stored(0.0), cell_V(0.0), cell_V0(0.0);
  const double own = g.pressure == PressureMode::element ? 1 : g.element_share;
  const bool classical = g.solid.law == Law::classical, ahead = classical && view.v && view.last_dt != 0;
  Vector<Pack, D> v[Cell::nodes], drawn_v[kDrawn<Cell>];  // only from a memory of other positions
  if (ahead) {
    gather_ways<Cell>(nodes, view.v, v);
    classical_pressures<Cell>(g, view, pack, x, v, p, Keep::no);
    if constexpr (Cell::drawn) draw<Cell>(constants, v, drawn_v);
  }
  for (int s = 0; s < Cell::simplices; ++s) {
    CellEdges<Cell> e;
    law_edges<Cell>(constants, x, drawn_x, s, e.x);
    find_reciprocal(e);
    double* memory = memory_of<Cell>(g, pack, s);
    const Pack V0 = initial_volume(g, memory), law_J = Cell::drawn ? e.volume / V0 : J[s];
    Vector<Pack, D> w[kE<Cell>];
    if (ahead) {
      law_edges<Cell>(constants, v, drawn_v, s, w);
      moved<Cell>(view, w);
    }
    stored += V0 * point_energy(g.solid, e, law_J, memory, ahead ? w : nullptr);
    if constexpr (Cell::one_point) {
      stored += V0 * Variation<Cell>(g, constants, e, x).hourglass.energy(g.solid, hourglass_of<Cell>(g, pack));
      stored += Pack(kCornerGuard * g.solid.K) * V0 * CornerGuard<Pack, D, Cell::ring>(constants, x, e.x, e.up).energy();
    }
    if (!classical) stored += Pack(0.5 * g.solid.K * own) * V0 * (J[s] - Pack(1.0)) * (J[s] - Pack(1.0));
    if (g.guard > 0) stored += Pack(g.guard * g.solid.K) * V0 * guard_energy(J[s], free_of_guard<Cell>(constants, s));
    cell_V += V[s];
    cell_V0 += V0;
    if (!stress) continue;
    const Vector<Pack, D>* at_rest = nullptr;
    const PointResponse<Pack, D> point = point_step(g.solid, e, at_rest, law_J, memory, Keep::no);
    double* to = lanes_of(stress, Cell::simplices * 6, place) + s * 6 * kLanes;
    for (int i = 0; i < 6; ++i) {
      Pack component = i < Symmetric<Pack, D>::size ? point.S[i] : Pack(0.0);
      if (i < 3) component += p[s];
      component.store(to + i * kLanes);
    }
    J[s].store(lanes_of(ratio, Cell::simplices, place) + s * kLanes);
  }
  if (classical) {
    stored += energy_of_classical_pressures<Cell>(V, p, g.solid.K, own);
  } else if (g.pressure == PressureMode::cell) {
    const Pack strain = cell_V / cell_V0 - Pack(1.0);
    stored += Pack(0.5 * g.solid.K * (1 - own)) * cell_V0 * strain * strain;
  }
  add_to_block(energy, place, sum_of_first(stored, lanes_in_use(g, pack)));
}

template <class Cell, Made made> void forces_of_packs(const CellGroup& g, const NodalView& view, int first, int last) {
  if constexpr (Cell::one_point) {
    const PlaneModuli moduli(g.solid);
    WaitingPacks<Cell> waiting(g, moduli, view);
    packs_at_a_time(first, last, 1, [&](const PacksNow& now) { forces_of_one_point_pack<Cell, made>(g, moduli, view, now, waiting); });
    waiting.end();
  } else if (made == Made::any && g.solid.law != Law::hill) {
    packs_at_a_time(first, last, 1, [&](const PacksNow& now) { forces_of_any_law<Cell>(g, view, now); });
  } else {
    packs_at_a_time(first, last, kTogether<Cell, made>, [&](const PacksNow& now) { forces_of_several<Cell, made>(g, view, now); });
  }
}
void forces(const CellGroup& g, const NodalView& view, int first, int last) {
  with_cell(g, [&](auto cell) {
    using Cell = decltype(cell);
    if (of_von_mises(g.solid.law) && g.solid.layers == 1) return forces_of_packs<Cell, Made::one_layer>(g, view, first, last);
    if (of_von_mises(g.solid.law)) return forces_of_packs<Cell, Made::layers>(g, view, first, last);
    forces_of_packs<Cell, Made::any>(g, view, first, last);
  });
}
void rates(const CellGroup& g, const NodalView& view, int first, int last, BlockRates* out) {
  with_cell(g, [&](auto cell) {
    each_pack(first, last, [&](long pack) { rates_of_pack<decltype(cell)>(g, view, pack, out[block_of(pack)]); });
  });
}
void observe(const CellGroup& g, const NodalView& view, int first, int last, double* stress, double* ratio,
             double* energy) {
  with_cell(g, [&](auto cell) {
    each_pack(first, last, [&](long pack) { observe_pack<decltype(cell)>(g, view, pack, pack - first * kPacks, stress, ratio, energy); });
  });
}

#define FORMING_SIM_TEXT(word) #word
#define FORMING_SIM_NAME(word) FORMING_SIM_TEXT(word)

}  // namespace

const Kernels& kernels() {
  static const Kernels k{FORMING_SIM_NAME(FORMING_SIM_ISA), forces, rates, observe, nodal_kernels(), edge_kernels()};
  return k;
}

}  // namespace FORMING_SIM_ISA
}  // namespace forming_sim
