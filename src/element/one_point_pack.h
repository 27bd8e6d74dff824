#pragma once
// The forces of a pack of one-point cells (element/one_point.h). For files that are compiled once per vector width only.
//
// On the way in the nodes are gathered in pairs, and only the edges and the sums of the modes remain of them; on the way out
// each node's force is made when it is added up. With p I + S = sigma and r_alpha = dU/d(sum_alpha) of the hourglass energy,
// sum_alpha = sum_a h_alpha,a x_a, the force on edge m is
//   M . x^m,  M = sum_alpha r_alpha (x) sum_alpha - V sigma,
// and that on corner a sum_m w_ma M . x^m - sum_alpha h_alpha,a r_alpha.
#include "element/bulk_viscosity.h"
#include "element/classical_pack.h"
#include "element/corner_pack.h"
#include "forming_sim/element/one_point_law.h"

namespace forming_sim {
namespace FORMING_SIM_ISA {

/// Edges of one-point cells and the sums of their corners.
template <class Cell> void gather_one_point(const int* nodes, const double* field, const double* constants, Vector<Pack, kD<Cell>> (&edge)[kE<Cell>], CornerSums<Pack, kD<Cell>>& sums) {
  constexpr int D = kD<Cell>, half = Cell::nodes / 2;
  if constexpr (Cell::ring) edge[2] = {{Pack(0.0), Pack(0.0)}};
  repeat<half>([&](auto a) {
    const Vector<Pack, D> low = gather_vectors<D>(nodes + a * kLanes, field), high = gather_vectors<D>(nodes + (a + half) * kLanes, field);
    sums.template add<a>(low, high);
    if constexpr (Cell::ring) edge[2][0] += weight(constants, OnePoint<D, true>::hoop + a) * low[0] + weight(constants, OnePoint<D, true>::hoop + a + half) * high[0];
  });
  sums.find_edges(constants, edge);
}

/// The constants of the next block, which there is where kOnePointBlocksAhead are, if they are others: cells of a file have each their own.
template <class Cell> void fetch_constants(const CellGroup& g, long pack) {
  const long block = block_of(pack);
  if (g.constant_set[block + 1] == g.constant_set[block]) return;
  using Items = OnePoint<kD<Cell>, Cell::ring>;
  const double* constants = constants_of<Cell>(g, pack + kPacks);
  fetch_ahead(constants, 0, Items::inertia);  // those behind are for the time step, but for one
  fetch_ahead(constants + Items::near * kLanes, 0, 1);
}

/// What varies across the cells of a pack whose nodes are gathered.
template <class Cell> class Variation {
 public:
  Variation(const CellGroup& g, const double* constants, const CellEdges<Cell>& e, const Vector<Pack, kD<Cell>>* x) : moduli_(g.solid), hourglass(moduli_, constants) {
    sums.add_all(x);
    hourglass.find_strains(e, sums.mode, x);
  }
  Variation(const Variation&) = delete;

 private:
  PlaneModuli moduli_;

 public:
  CornerSums<Pack, kD<Cell>> sums;
  Hourglass<Pack, kD<Cell>, Cell::ring> hourglass;
};

/// Blocks ahead whose memory is fetched.
constexpr int kOnePointBlocksAhead = 2;

/// A pack in a step. It opens with its nodes gathered and closes with its forces handed out.
template <class Cell> class OnePointPack : public OnePointCell<Pack, kD<Cell>, Cell::ring> {
  static constexpr int D = kD<Cell>;
  using Base = OnePointCell<Pack, D, Cell::ring>;

 public:
  Pack V0, p;  ///< p: the pressure
  using Base::e, Base::sums, Base::J, Base::constants, Base::memory, Base::hourglass, Base::point;

  OnePointPack(const CellGroup& g, const PlaneModuli& moduli, const NodalView& view, long pack)
      : Base(moduli, constants_of<Cell>(g, pack), memory_of<Cell>(g, pack, 0), hourglass_of<Cell>(g, pack)), g_(g), view_(view), pack_(pack) {}

  void wait_as(const OnePointPack& other) {
    Base::wait_as(other);
    V0 = other.V0, p = other.p;
    pack_ = other.pack_;
  }

  void open(bool fetches) {
    if (fetches) fetch();
    gather_one_point<Cell>(nodes(), view_.x, constants, e.x, sums);
    find_reciprocal(e);
    V0 = initial_volume(g_, memory), J = e.volume / V0;
    p = Pack(g_.solid.K) * (J - Pack(1.0));
    holds(g_.upright, pack_, all(J > Pack(0.0)));
    if (first_lane(pack_) == 0) g_.pressed[block_of(pack_)] = false;
    if constexpr (Cell::ring) gather<Cell>(nodes(), view_.x, Base::x);
  }

  void close() {
    if (is_viscous(g_)) p += viscosity_of_pack<Cell>(g_, view_, pack_);
    g_.plastic_work[block_of(pack_)] += sum_of_first(point.dissipation * V0, lanes_in_use(g_, pack_));

    Vector<Pack, D> r[OnePoint<D>::modes], M[D], force[D];
    hourglass.gradient(V0, r);
    for (int c = 0; c < 3; ++c) point.S[c] += p;  // sigma = p I + S (3.4)
    repeat<D>([&](auto i) {
      repeat<D>([&](auto j) { M[i][j] = r[0][i] * sums.mode[0][j] - e.volume * point.S[kFull[i][j]]; });
      repeat<OnePoint<D>::modes - 1>([&](auto k) { M[i] += r[k + 1][i] * sums.mode[k + 1]; });
    });
    repeat<D>([&](auto m) { repeat<D>([&](auto i) { force[m][i] = dot(M[i], e.up[m]); }); });
    Pack hoop;  // of a ring, through the weights of x_3
    if constexpr (Cell::ring) hoop = e.volume * e.up[2][0] * point.S[2];

    const CornerForces<Pack, D> corners(constants, force, r);
    const int* slots = slots_of<Cell>(g_, pack_);
    repeat<Cell::nodes / 2>([&](auto a) {
      constexpr int opposite = a + Cell::nodes / 2;
      Vector<Pack, D> low, high;
      corners.template at<a>(low, high);
      if constexpr (Cell::ring) {
        low[0] -= weight(constants, OnePoint<D, true>::hoop + a) * hoop + hourglass.hoop_force(V0, a);
        high[0] -= weight(constants, OnePoint<D, true>::hoop + opposite) * hoop + hourglass.hoop_force(V0, opposite);
      }
      add_vectors(low, slots + a * kLanes, g_.sums);
      add_vectors(high, slots + opposite * kLanes, g_.sums);
    });
    if (hourglass.far()) guard_corners<Cell>(g_, view_, pack_);
  }

 private:
  const int* nodes() const { return nodes_of<Cell>(g_, pack_); }
  void fetch() const {
    fetch_memory(g_, memory, kOnePointBlocksAhead);
    fetch_constants<Cell>(g_, pack_);
    fetch_ahead(Base::hourglass_memory, kOnePointBlocksAhead * g_.hourglass_items * static_cast<long>(sizeof(Lane)), g_.hourglass_items);
  }

  const CellGroup& g_;
  const NodalView& view_;
  long pack_;
};

/// Packs whose cells ask to flow, until there are two.
template <class Cell> class WaitingPacks {
 public:
  WaitingPacks(const CellGroup& g, const PlaneModuli& moduli, const NodalView& view) : g_(g), moduli_(moduli), packs_{{g, moduli, view, 0}, {g, moduli, view, 0}} {}

  void add(const OnePointPack<Cell>& pack) {
    put_one_layer(flow_, count_, pack);
    packs_[count_++].wait_as(pack);
    if (count_ == 2) flow();
  }
  /// An odd one flows beside itself.
  void end() {
    if (count_ == 0) return;
    flow_.repeat_first();
    flow();
  }

 private:
  [[gnu::noinline, gnu::flatten]] void flow() {
    flow_.find_planes(TwinItems{{packs_[0].constants, packs_[count_ - 1].constants}});
    flow_.flow(g_.solid, g_.solid.layer[0].hardening, moduli_);
    for (int b = 0; b < count_; ++b) {
      take_one_layer(flow_, b, packs_[b]);
      finish_one_layer(packs_[b]);
      packs_[b].close();
    }
    count_ = 0;
  }

  const CellGroup& g_;
  const PlaneModuli& moduli_;
  OnePointPack<Cell> packs_[2];
  FlowTogether<Twin<Pack>, kD<Cell>, Cell::ring> flow_;
  int count_ = 0;
};

template <class Cell, Made made> [[gnu::flatten]] void forces_of_one_point_pack(const CellGroup& g, const PlaneModuli& moduli, const NodalView& view, const PacksNow& now, WaitingPacks<Cell>& waiting) {
  OnePointPack<Cell> at(g, moduli, view, now.pack);
  at.open(now.goes_on(kOnePointBlocksAhead));
  if constexpr (made == Made::one_layer) {
    if (try_one_layer(g.solid, at)) return waiting.add(at);
    finish_one_layer(at);
  } else if constexpr (made == Made::layers) {
    step_of_layers(g.solid, moduli, at);
  } else if (g.solid.law == Law::hill) {
    step_of_hill(g.solid, moduli, at);
  } else if (g.solid.law == Law::hyperelastic) {
    at.find_strains();
    at.hourglass.set_elastic();
    at.answer(hyperelastic_step(g.solid, at.e, at.J, at.memory));
  } else {
    Vector<Pack, kD<Cell>> w[kE<Cell>];
    at.p = classical_step_of_edges<Cell>(g, view, now.pack, w);
    at.factor = Pack(g.solid.mu);
    at.answer(classical_step(g.solid, at.e, w, at.J, at.memory, Keep::yes));
    at.find_strains();
    if (at.hourglass.try_layer(g.solid.layer[0], at.point, at.memory, at.hourglass_memory)) flow_alone(g.solid, moduli, at);
    finish_one_layer(at);
  }
  at.close();
}

}  // namespace FORMING_SIM_ISA
}  // namespace forming_sim
