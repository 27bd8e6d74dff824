// The loops over the points at edges (element/edge_points.h), compiled once per vector width (see CMakeLists.txt).
#include "element/cell_pack.h"
#include "forming_sim/element/edge_points.h"
#include "forming_sim/element/time_step.h"
#include "forming_sim/material/law.h"
#include "forming_sim/material/von_mises_points.h"

namespace forming_sim {
namespace FORMING_SIM_ISA {
namespace {

/// Where the lanes of a pack are in a row of its block, of arrays with so many items a row; and the rows of its block.
template <class T> T* lanes_of_row(T* array, long items, long row, long pack) { return array + row * items * kLanes + first_lane(pack); }
long first_row(const CellGroup& g, long pack) { return g.rows[block_of(pack)]; }
long last_row(const CellGroup& g, long pack) { return g.rows[block_of(pack) + 1]; }

template <int D, bool Ring> const double* weights_of(const CellGroup& g, long row, long pack) {
  return lanes_of_row(g.constants, edge_weights(D, Ring), row, pack);
}

/// x_m = sum_a w_ma x_a, of a ring x_3 = sum_a o_a r_a.
template <int D, bool Ring> Edges<Pack, D, Ring> edges_of_point(const CellGroup& g, const NodalView& view, long pack) {
  Edges<Pack, D, Ring> e;
  for (Vector<Pack, D>& edge : e.x)
    for (int i = 0; i < D; ++i) edge[i] = Pack(0.0);
  for (long row = first_row(g, pack); row < last_row(g, pack); ++row) {
    const Vector<Pack, D> x = gather_vectors<D>(lanes_of_row(g.nodes, 1, row, pack), view.x);
    const double* w = weights_of<D, Ring>(g, row, pack);
    for (int m = 0; m < D; ++m) e.x[m] += weight(w, m) * x;
    if constexpr (Ring) e.x[2][0] += weight(w, D) * x[0];
  }
  return e;
}

/// f_a = - V_e dw/dx_a: the forces -V S . x^m on the edges and -V S . x^3 on the hoop, through the weights by which the nodes make them.
template <int D, bool Ring, class Pull> void add_forces(const CellGroup& g, long pack, const Edges<Pack, D, Ring>& e, const Pull& pull) {
  Vector<Pack, D> force[D];
  for (int m = 0; m < D; ++m) force[m] = -pull.on(e, m);
  for (long row = first_row(g, pack); row < last_row(g, pack); ++row) {
    const double* w = weights_of<D, Ring>(g, row, pack);
    Vector<Pack, D> f = weight(w, 0) * force[0];
    for (int m = 1; m < D; ++m) f += weight(w, m) * force[m];
    if constexpr (Ring) f[0] -= weight(w, D) * pull.on_hoop(e);
    add_vectors(f, lanes_of_row(g.slots, 1, row, pack), g.sums);
  }
}

double* memory_of_point(const CellGroup& g, long pack) { return lanes_of(g.memory, g.items, pack); }

/// Blocks ahead whose memory is fetched.
constexpr int kBlocksAhead = 8;

/// The points of a pack: a bundle for material/von_mises_points.h.
template <int D, bool Ring> struct PackOfPoints : PackOfGroup {
  Vector<Pack, D> x[kEdges<D, Ring>];
  Pack dissipated;

  void open() {
    if (fetches) fetch();
    const Edges<Pack, D, Ring> e = edges_of_point<D, Ring>(g(), *view, pack);
    for (int m = 0; m < kEdges<D, Ring>; ++m) x[m] = e.x[m];
    dissipated = Pack(0.0);
  }
  void fetch() const {
    fetch_memory(g(), memory(0), kBlocksAhead);
    const long row = first_row(g(), pack), weights = (last_row(g(), pack) - row) * edge_weights(D, Ring);
    fetch_ahead(weights_of<D, Ring>(g(), row, pack), kBlocksAhead * weights * static_cast<long>(sizeof(Lane)), weights);
  }
  double* memory(int) const { return memory_of_point(g(), pack); }
  void edges(int, Edges<Pack, D, Ring>& e) const {
    for (int m = 0; m < kEdges<D, Ring>; ++m) e.x[m] = x[m];
  }
  Pack ratio(int, const Edges<Pack, D, Ring>& e) const {
    const Pack J = simplex_volume<Pack, D, Ring>(e.x) / initial_volume(g(), memory(0));
    holds(g().upright, pack, all(J > Pack(0.0)));
    return J;
  }
  void dissipate(int, const Pack& what) { dissipated += what * initial_volume(g(), memory(0)); }
  const CellGroup& start_forces() const { return g(); }
  template <class Pull> void respond(int, const Edges<Pack, D, Ring>& e, const Pull& pull, const CellGroup& sums) const { add_forces(sums, pack, e, pull); }
  void close(const CellGroup&) const { g().plastic_work[block_of(pack)] += sum_of_first(dissipated, lanes_in_use(g(), pack)); }
};

/// Packs that go through the law together.
constexpr int kTogether = 4;

template <int D, bool Ring> [[gnu::flatten]] void forces_of_packs(const CellGroup& g, const NodalView& view, const PacksNow& now) {
  PackOfPoints<D, Ring> packs[kTogether];
  set_packs(g, view, now, kBlocksAhead, packs);
  von_mises_points<1, kTogether, Pack, D, Ring>(g.solid, packs, now.count);
}

/// Of Law::hill.
template <int D, bool Ring> [[gnu::flatten]] void forces_of_rolled(const CellGroup& g, const NodalView& view, const PacksNow& now) {
  PackOfPoints<D, Ring> packs[kTogether];
  set_packs(g, view, now, kBlocksAhead, packs);
  hill_points<1, kTogether, Pack, D, Ring>(g.solid, packs, now.count);
}

/// Of any other law, but for the classical one.
template <int D, bool Ring> [[gnu::flatten]] void forces_of_any_law(const CellGroup& g, const NodalView& view, const PacksNow& now) {
  PackOfPoints<D, Ring> at;
  set_pack(g, view, now, now.pack, kBlocksAhead, at);
  at.open();
  Edges<Pack, D, Ring> e;
  at.edges(0, e);
  find_reciprocal(e);
  const Vector<Pack, D>* no_ways = nullptr;
  const PointResponse<Pack, D> point = point_step(g.solid, e, no_ways, at.ratio(0, e), at.memory(0), Keep::yes);
  at.dissipate(0, point.dissipation);
  at.respond(0, e, pull_of<D, Ring>(point.S), g);
  at.close(g);
}

template <int D, bool Ring> void observe_pack(const CellGroup& g, const NodalView& view, long pack, long place, double* stress, double* ratio, double* energy) {
  Edges<Pack, D, Ring> e = edges_of_point<D, Ring>(g, view, pack);
  find_reciprocal(e);
  double* memory = memory_of_point(g, pack);
  const Pack V0 = initial_volume(g, memory), J = e.volume / V0;
  add_to_block(energy, place, sum_of_first(V0 * point_energy(g.solid, e, J, memory), lanes_in_use(g, pack)));
  if (!stress) return;
  const Vector<Pack, D>* at_rest = nullptr;
  const Symmetric<Pack, D> S = point_step(g.solid, e, at_rest, J, memory, Keep::no).S;
  for (int i = 0; i < 6; ++i) (i < Symmetric<Pack, D>::size ? S[i] : Pack(0.0)).store(lanes_of(stress, 6, place) + i * kLanes);
  J.store(lanes_of(ratio, 1, place));
}

/// omega_e^2 of element/time_step.h.
template <int D, bool Ring> void rates_of_pack(const CellGroup& g, const NodalView& view, long pack, double* omega2) {
  Edges<Pack, D, Ring> e = edges_of_point<D, Ring>(g, view, pack);
  find_reciprocal(e);
  Symmetric<Pack, D> S;
  Symmetric<Pack, 3> M;  // of a ring
  for (int i = 0; i < Symmetric<Pack, D>::size; ++i) S[i] = Pack(0.0);
  for (int i = 0; i < 6; ++i) M[i] = Pack(0.0);
  for (long row = first_row(g, pack); row < last_row(g, pack); ++row) {
    const int* nodes = lanes_of_row(g.nodes, 1, row, pack);
    const double* w = weights_of<D, Ring>(g, row, pack);
    Vector<Pack, D> gradient = weight(w, 0) * e.up[0];
    for (int m = 1; m < D; ++m) gradient += weight(w, m) * e.up[m];
    const Pack over_mass = Pack(1.0) / Pack::load(lanes_of_row(g.node_share, 1, row, pack));
    if constexpr (Ring) {
      const Pack axial = over_mass * gather_numbers(view.inertia, nodes);
      const Pack radial = select(gather_vectors<D>(nodes, view.x)[0] > Pack(0.0), axial, Pack(0.0));  // no radial motion on the axis
      add_deviatoric(M, radial, axial, gradient[0], gradient[1], weight(w, D) * e.up[2][0]);
    } else {
      add_product(S, over_mass, gradient, gradient);
    }
  }
  Pack largest, trace_S;
  if constexpr (Ring) largest = Pack(2.0) * largest_eigenvalue(M);
  else largest = shape_bound(S, trace_S);
  const double* memory = memory_of_point(g, pack);
  const Pack tangent = point_tangent(g.solid, e, e.volume / initial_volume(g, memory), memory);
  (Pack(g.solid.mu / g.density) * tangent * largest).store(lanes_of(omega2, 1, pack));
}

/// Calls work(D, Ring) of the group, as integral constants.
template <class Work> void with_dimension(const CellGroup& g, Work&& work) {
  using std::integral_constant;
  if (g.dimension == 3) work(integral_constant<int, 3>(), std::false_type());
  else if (g.ring) work(integral_constant<int, 2>(), std::true_type());
  else work(integral_constant<int, 2>(), std::false_type());
}

void forces(const CellGroup& g, const NodalView& view, int first, int last) {
  with_dimension(g, [&](auto D, auto ring) {
    if (of_von_mises(g.solid.law))
      packs_at_a_time(first, last, kTogether, [&](const PacksNow& now) { forces_of_packs<D, ring>(g, view, now); });
    else if (g.solid.law == Law::hill)
      packs_at_a_time(first, last, kTogether, [&](const PacksNow& now) { forces_of_rolled<D, ring>(g, view, now); });
    else
      packs_at_a_time(first, last, 1, [&](const PacksNow& now) { forces_of_any_law<D, ring>(g, view, now); });
  });
}
void observe(const CellGroup& g, const NodalView& view, int first, int last, double* stress, double* ratio, double* energy) {
  with_dimension(g, [&](auto D, auto ring) {
    each_pack(first, last, [&](long pack) { observe_pack<D, ring>(g, view, pack, pack - first * kPacks, stress, ratio, energy); });
  });
}
void rates(const CellGroup& g, const NodalView& view, int first, int last, double* omega2) {
  with_dimension(g, [&](auto D, auto ring) {
    each_pack(first, last, [&](long pack) { rates_of_pack<D, ring>(g, view, pack, omega2); });
  });
}

}  // namespace

EdgeKernels edge_kernels() { return {forces, observe, rates}; }

}  // namespace FORMING_SIM_ISA
}  // namespace forming_sim
