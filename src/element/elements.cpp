#include "element/alike.h"
#include "element/group.h"
#include "element/simplex_shape.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <atomic>
#include <sstream>

#include "forming_sim/config/fault.h"
#include "forming_sim/element/crossed.h"
#include "forming_sim/element/guard.h"
#include "forming_sim/element/hourglass.h"
#include "forming_sim/element/nodes.h"
#include "forming_sim/element/one_point.h"
#include "forming_sim/mesh/cell_order.h"
#include "forming_sim/mesh/cell_tables.h"
#include "forming_sim/mesh/measure.h"
#include "forming_sim/material/law.h"
#include "forming_sim/parallel/interrupt.h"
#include "forming_sim/parallel/stage_clock.h"

namespace forming_sim {

namespace {

/// The classical pressure is a memory of each simplex, which no node has.
PressureMode mode_of(const BodyModel& body, CellKind kind) {
  if (is_one_point(kind)) return PressureMode::element;
  if (body.pressure_average == "element") return PressureMode::element;
  if (body.pressure_average == "node") return PressureMode::node;
  if (kind != CellKind::triangle && kind != CellKind::tetrahedron) return PressureMode::cell;
  return body.material.law == "classical" ? PressureMode::element : PressureMode::node;
}

/// Cells with a node of their own (the centre of a crossed quadrilateral, centre
/// and faces of 24, 14 or 8 tetrahedra) leave that node to the deviator alone when the
/// pressure is one per cell: in a strong impact it yields and the simplices around
/// it collapse. They have a guard against that, element/guard.h. The seven nodes that 24 tetrahedra have of
/// their own (a wedge: four, a pyramid: two) would use what it leaves free: the thick sphere is 8 to 20 % too soft with it alone. There a small share theta of each
/// simplex' own pressure holds them too,
///   U = V0 [(1-theta) K/2 (J_cell - 1)^2 + theta K/2 (J - 1)^2].
/// With the guard .02 is enough; without it the Taylor bar collapses with 0 and runs with .01, and cubes that meet a wall at 850 m/s collapse even with .02. It costs
/// .1 to .7 % of the bending moment at 4 cells through the thickness. It is one of what resists shear: where K > 3 mu
/// (nu > .35), theta K = .06 mu. On 2 triangles
/// or 6 tetrahedra it would lock (face radius of the Taylor bar 6.86 instead of
/// 7.35 mm at 4 cells a radius), and they have no such node.
double element_share_of(CellKind kind, const SolidConstants& solid) {
  const bool crossed_alone = kind == CellKind::crossed && solid.law == Law::classical;  // whose pressure is no function of V
  return split_faces_of(kind).count > 0 || crossed_alone ? 0.02 * std::min(1.0, 3 * solid.mu / solid.K) : 0;
}
double guard_of(CellKind kind, PressureMode pressure, const SolidConstants& solid) {
  const bool in_cells = (kind == CellKind::crossed || kind == CellKind::quad2 || kind == CellKind::hex6 || split_faces_of(kind).count > 0) && pressure == PressureMode::cell && solid.law != Law::classical;
  return in_cells || pressure == PressureMode::node ? kGuard : 0;
}

/// Share of corner a in the mass of a simplex: equal shares; of a ring the integral of
/// the corner's shape function, (2 R_a + R_b + R_c) / (4 (R_a + R_b + R_c)). It shows on the
/// axis: in a column that is accelerated along it, two triangles a cell with equal
/// shares leave the axis behind at 3/4 of the right acceleration. In crossed cells the
/// middle nodes hand their inertia to the corners, and at the first moment of a
/// pressure pulse, before they do, equal shares would be the even ones; but once they
/// hang on the corners the integrals are right there too. The displacements of the
/// accelerated column, in error by .0014 on the axis at 8 cells a radius,
/// would be by .0037 with equal shares (nu .34, test/element/ring_mass_test.cpp).
double mass_share(const NodeField& x, const std::array<int, 4>& corner, int a, int dimension, bool ring) {
  if (!ring) return 1.0 / (dimension + 1);
  const double sum = x[corner[0]][0] + x[corner[1]][0] + x[corner[2]][0];
  return (sum + x[corner[a]][0]) / (4 * sum);
}

/// An element with a memory at the start.
struct ElementStart {
  Eigen::Matrix3d edges;
  double volume;
  int nodes;
  int node[8];       ///< joined
  double share[8];   ///< in the mass
  std::vector<double> constants;  ///< of a one-point cell

  ElementStart(const NodeField& x, const std::array<int, 4>& corner, int dimension, bool ring) : nodes(dimension + 1) {
    const SimplexShape shape(x, corner, dimension, ring);
    edges = shape.edges;
    volume = shape.volume;
    for (int a = 0; a < nodes; ++a) {
      node[a] = corner[a];
      share[a] = mass_share(x, corner, a, dimension, ring);
    }
  }
  ElementStart(const NodeField& x, const int* cell, int first_node, int dimension, bool ring, const SolidConstants& solid) : nodes(dimension == 2 ? 4 : 8) {
    Vec3 corners[8];
    for (int a = 0; a < nodes; ++a) corners[a] = vec3(x[node[a] = cell[a] + first_node]);
    OnePointStart start = start_one_point(corners, dimension, ring, solid);
    edges = start.edges;
    volume = start.volume;
    std::copy(start.share, start.share + nodes, share);
    constants = std::move(start.constants);
  }
};

}  // namespace

const Kernels& kernels_of(Isa isa) {
  return isa == Isa::avx512 ? avx512::kernels() : isa == Isa::avx2 ? avx2::kernels() : sse2::kernels();
}

Elements::~Elements() = default;

constexpr int kBlocksBetweenChecks = 1024;  ///< of whether anybody still waits for them

Elements::Elements(const std::vector<BodyModel>& bodies, int dimension, const NodeField& x,
                   const ElementOptions& options, int threads, const char* kernels)
    : isa_(choose_isa(kernels)), kernels_(kernels_of(isa_)), dimension_(dimension), axisymmetric_(options.axisymmetric), team_(std::make_unique<Team>(threads)) {
  const int nodes = static_cast<int>(x.size()), D = dimension_;
  if (axisymmetric_) check_axis(x);
  mass_.assign(nodes, 0.0);
  nodal_volume0_.assign(nodes, 0.0);
  nodal_bulk_.assign(nodes, 0.0);
  nodal_rough_bulk_.assign(nodes, 0.0);
  inertia_.assign(axisymmetric_ ? nodes : 0, 0.0);
  std::vector<double> simplex_mass(inertia_.size(), 0.0), even_mass = simplex_mass;
  for (const BodyModel& body : bodies) {
    int first_element = body.first_element;
    for (const Cells& cells : body.mesh.cells) {
      if (cells.count() == 0) continue;
      const CellShape& shape = shape_of(cells.kind);
      Group g;
      g.kind = static_cast<int>(cells.kind);
      g.dimension = D;
      g.ring = axisymmetric_;
      g.cell_nodes = shape.nodes;
      g.parts = shape.simplices;
      g.make_blocks(cells.count(), shape.points);
      g.pressure = mode_of(body, cells.kind);
      any_nodal_ |= g.pressure == PressureMode::node;
      g.solid = solid_constants(body.material, g.curves);
      any_even_ |= g.even();
      g.element_share = element_share_of(cells.kind, g.solid);
      g.guard = guard_of(cells.kind, g.pressure, g.solid);
      const bool at_edges = g.nodal();  // the law; what stays is V0
      g.items = at_edges ? 1 : D == 2 ? memory_items<2>(g.solid) : memory_items<3>(g.solid);
      g.density = body.material.density * options.mass_scaling;
      g.linear_viscosity = options.linear_viscosity;
      g.quadratic_viscosity = options.quadratic_viscosity;
      const bool viscous = g.linear_viscosity > 0 || g.quadratic_viscosity > 0;
      if (viscous) g.viscosity_storage.resize(2 * static_cast<std::size_t>(g.blocks));
      may_sleep_ = may_sleep_ && g.pressure != PressureMode::node && g.solid.law != Law::classical && !viscous;
      g.first_element = first_element;
      first_element += g.cells * shape.simplices;
      simplices_.resize(first_element, {-1, -1, -1, -1});
      // By halves only where much is gained: the nodes keep their order, and a large body is the slower for each that is not its cells'.
      g.order = order_of_cells(body.mesh.nodes, cells.nodes, shape.nodes, g.ends_of_tiles(), 0.5);
      g.cell_of.resize(g.cells);
      for (int cell = 0; cell < g.cells; ++cell) g.cell_of[g.order[cell]] = cell;
      g.body = body.name;
      g.node_storage.resize(static_cast<std::size_t>(g.blocks) * shape.nodes * kLanes);
      g.memory_storage.resize(static_cast<std::size_t>(g.blocks) * shape.points * g.items);
      if (is_one_point(cells.kind)) {
        g.hourglass_items = D == 2 ? hourglass_items<2>(g.solid) : hourglass_items<3>(g.solid);
        g.hourglass_storage.resize(static_cast<std::size_t>(g.blocks) * g.hourglass_items);
      }
      AlikeBlocks alike;
      const bool crossed = cells.kind == CellKind::crossed && !at_edges;
      std::vector<Lane> constants(is_one_point(cells.kind) ? one_point_items(D, g.ring) : crossed ? kCrossedItems : 0);
      for (int b = 0; b < g.blocks; ++b) {
        if (b % kBlocksBetweenChecks == 0) check_interrupt();
        for (int l = 0; l < kLanes; ++l) {
          const int cell = std::min(b * kLanes + l, g.cells - 1);
          const int* of_cell = cells.nodes.data() + static_cast<std::size_t>(g.order[cell]) * shape.nodes;
          for (int a = 0; a < shape.nodes; ++a)
            g.node_storage[(static_cast<std::size_t>(b) * shape.nodes + a) * kLanes + l] = of_cell[a] + body.first_node;
          const bool first = b * kLanes + l == cell;  // not a copy
          for (int s = 0; s < shape.simplices && first; ++s)
            for (int a = 0; a <= D; ++a) simplices_[g.element(cell, s)][a] = of_cell[shape.simplex[s][a]] + body.first_node;
          if (crossed) {
            Vec3 corners[5];
            for (int a = 0; a < 5; ++a) corners[a] = vec3(x[of_cell[a] + body.first_node]);
            const bool by_cell = g.pressure == PressureMode::cell;
            const double ratio = crossed_ratio(corners);
            const auto items = crossed_weights(corners, g.ring, by_cell ? crossed_lambda(g.solid, corners, g.ring) : 1, by_cell, ratio);
            for (int i = 0; i < kCrossedItems; ++i) constants[i][l] = items[i];
            if (by_cell && g.solid.law != Law::classical) {  // whose memory is a stress
              if (first) g.first_corners.push_back({corners[0], corners[1], corners[2], corners[3], corners[4]});
              g.weight_ratio.resize(g.blocks);
              g.weight_ratio[b][l] = ratio;
            }
          }
          for (int s = 0; s < shape.points; ++s) {
            const int element = g.element(cell, s);
            const ElementStart initial = is_one_point(cells.kind) ? ElementStart(x, of_cell, body.first_node, D, axisymmetric_, g.solid)
                                                                  : ElementStart(x, simplices_[element], D, axisymmetric_);
            const double V0 = initial.volume;
            if (!(V0 > 0)) {
              std::ostringstream what;
              what << "element " << element << " of body " << body.name << " has volume " << V0
                   << " at the start; every simplex needs a positive volume";
              throw Error(Code::mesh_error, what.str());
            }
            g.start(b * shape.points + s, l, initial.edges, V0);
            for (std::size_t i = 0; i < initial.constants.size(); ++i) constants[i][l] = initial.constants[i];
            if (!first) continue;
            for (int a = 0; a < initial.nodes; ++a) mass_[initial.node[a]] += g.density * V0 * initial.share[a];
            if (is_one_point(cells.kind)) continue;  // it has no share in nodal pressures, and the bound of its step its own masses
            for (int a = 0; a < initial.nodes; ++a) {
              if (at_edges) {
                nodal_volume0_[initial.node[a]] += V0 / (D + 1);
                nodal_bulk_[initial.node[a]] = g.solid.K;
                nodal_rough_bulk_[initial.node[a]] = rough_bulk(g.solid.K, g.solid.mu);
              }
              if (!axisymmetric_) continue;
              even_mass[initial.node[a]] += g.density * V0 / (D + 1);
              simplex_mass[initial.node[a]] += g.density * V0 * initial.share[a];
            }
          }
        }
        if (!constants.empty()) g.constant_sets.push_back(alike.find(constants, g.constants_storage));
      }
      if (!constants.empty()) g.shared_sets = static_cast<int>(g.constants_storage.size() / constants.size());
      groups_.push_back(std::move(g));
    }
  }
  for (std::size_t n = 0; n < inertia_.size(); ++n)
    if (simplex_mass[n] > 0) inertia_[n] = even_mass[n] / simplex_mass[n];
  for (const BodyModel& body : bodies) put_points_at_edges(body, x);
  record_size_ = D == 2 ? kRecord<2> : kRecord<3>;
  check_interrupt();
  lay_tiles(nodes);
  check_interrupt();
  pressure_.assign(any_nodal_ ? nodes : 0, 0.0);
  growth_ = pressure_;

  for (Group& g : groups_) {
    g.nodes = g.node_storage.data();
    g.memory = reinterpret_cast<double*>(g.memory_storage.data());
    g.rows = g.row_storage.data();
    g.constants = g.constants_storage.empty() ? nullptr : reinterpret_cast<double*>(g.constants_storage.data());
    g.constant_set = g.constant_sets.data();
    g.hourglass = reinterpret_cast<double*>(g.hourglass_storage.data());
    g.node_share = reinterpret_cast<double*>(g.node_share_storage.data());
    g.slots = g.slot_storage.data();
    g.sums = slots_ + g.first_slot * record_size_;
    g.plastic_work = g.plastic.data();
    g.viscous_work = g.viscous.data();
    g.last_viscosity = reinterpret_cast<double*>(g.viscosity_storage.data());
    g.upright = g.upright_storage.get();
    g.pressed = g.pressed_storage.get();
  }
  if (options.shares) keep_shares(x);
  for (const BodyModel& body : bodies) {
    if (!body.formed) continue;
    NodeField standing = x;
    for (int n = 0; n < body.node_count; ++n) standing[body.first_node + n] = node(body.mesh.nodes[n]);
    take_up(body, *body.formed, standing);
  }
}

long Elements::eights_of_a_block(const Group& g) const {
  if (g.at_edges) return std::max(1L, g.first_node(g.blocks) / kLanes / (g.blocks * (dimension_ + 1)));  // a point costs what its nodes do
  if (is_one_point(static_cast<CellKind>(g.kind))) return dimension_ == 2 ? 2 : 4;  // a cell costs what so many simplices do, or more
  return g.cell_simplices;
}
long Elements::blocks_of_a_thread(const Group& g) const { return kEightsOfAThread / eights_of_a_block(g); }
long Elements::tiles_of_a_thread(const Group& g) const { return std::max(1L, blocks_of_a_thread(g) * g.tiles / g.blocks); }

/// Calls work(group, tile) for all tiles of the groups of which that is asked, shared by the team: small groups that lie side by
/// side are shared like a large one. A tile belongs to the thread in whose share its middle lies.
template <class Asked, class Work> void Elements::over_tiles(Asked&& asked, Work&& work) const {
  long eights = 0;
  for (const Group& g : groups_)
    if (asked(g)) eights += g.blocks * eights_of_a_block(g);
  team_->share(eights, kEightsOfAThread, [&](long first, long last) {
    long begin = 0;
    for (const Group& g : groups_) {
      if (!asked(g)) continue;
      const long of_block = eights_of_a_block(g);
      for (long t = 0; t < g.tiles; ++t) {
        const long middle = begin + (g.first_block(t) + g.last_block(t)) * of_block / 2;
        if (first <= middle && middle < last) work(g, t);
      }
      begin += g.blocks * of_block;
    }
  });
}

void Elements::clear_slots(const Group& g, long t, double* sums) const {
  std::fill(sums + g.tile_start[t] * record_size_, sums + g.tile_start[t + 1] * record_size_, 0.0);
}

void Elements::observe_pressure(const NodalView& view) const {
  if (!any_nodal_) return;
  volume_storage_.resize(slot_storage_.size());
  nodal_pressure(view, reinterpret_cast<double*>(volume_storage_.data()));
}

void Elements::nodal_pressure(const NodalView& view, double* slots) const {
  // find(sum, n) of every node that has a pressure, with the sum of what `kernel` finds for it in the groups of which that is asked
  const auto sum_up = [&](auto&& asked, auto kernel, const NodalView& at, auto&& find) {
    over_tiles(asked, [&](const Group& own, long t) {
      CellGroup g = own;
      g.sums = slots + own.first_slot * record_size_;
      clear_slots(own, t, g.sums);
      kernel(g, at, own.first_block(t), own.last_block(t));
    });
    node_team_->share([&](long first, long last) {
      for (long n = first; n < last; ++n) {
        if (!(nodal_volume0_[n] > 0)) continue;
        double sum = 0;
        for (int k = slot_start_[n]; k < nodal_slots_[n]; ++k) sum += slots[static_cast<long>(slot_index_[k]) * record_size_];
        find(sum, n);
      }
    });
  };
  sum_up([](const Group& g) { return g.nodal(); }, kernels_.nodal.volumes, view, [&](double V, long n) {
    growth_[n] = V / nodal_volume0_[n] - 1;
    pressure_[n] = nodal_bulk_[n] * growth_[n];
  });
  if (!any_even_) return;
  NodalView grown = view;
  grown.growth = growth_.data();
  sum_up([](const Group& g) { return g.even(); }, kernels_.nodal.growths, grown, [&](double sum, long n) {
    const double K = nodal_bulk_[n], K_r = nodal_rough_bulk_[n];
    if (K_r < K) pressure_[n] = K_r * growth_[n] + (K - K_r) * sum / nodal_volume0_[n];
  });
}

void Elements::forces_of_tile(const CellGroup& cells, const Group& g, const NodalView& view, long t) const {
  clear_slots(g, t, g.sums);
  const auto forces = g.at_edges ? kernels_.edge.forces : g.nodal() ? kernels_.nodal.forces : kernels_.forces;
  forces(cells, view, g.first_block(t), g.last_block(t));
}

bool Elements::forces_of_moved(Group& g, const NodalView& view) {
  std::atomic<bool> any_rests{false};
  g.rest.resize(g.tiles, Group::changed);
  g.plastic_before.resize(g.blocks);
  team_->share(g.tiles, tiles_of_a_thread(g), [&](long begin, long end) {
    for (long t = begin; t < end; ++t) {
      const int *nodes = g.node_storage.data(), *first = nodes + g.first_node(g.first_block(t)), *last = nodes + g.first_node(g.last_block(t));
      if (std::none_of(first, last, [&](int n) { return stillness_.moved(n); })) {
        any_rests = true;
        if (g.rest[t] != Group::changed) {
          g.rest[t] = Group::passed_over;
          continue;
        }
      }
      const int first_block = g.first_block(t), last_block = g.last_block(t);
      const auto work = g.plastic.begin();
      std::copy(work + first_block, work + last_block, g.plastic_before.begin() + first_block);
      forces_of_tile(g, g, view, t);
      g.rest[t] = std::equal(work + first_block, work + last_block, g.plastic_before.begin() + first_block) ? Group::kept : Group::changed;
    }
  });
  return any_rests;
}

void Elements::find_forces(const NodeField& x, const NodeField& v, double last_dt, double last_kick) {
  if (axisymmetric_) check_axis(x);
  StageClock clock(times_);
  for (Group& g : groups_) set_step(g.solid, last_dt);
  NodalView view{x.data()->data(), v.data()->data(), nullptr, pressure_.data(), last_kick, last_dt};
  if (any_nodal_) nodal_pressure(view, slots_);
  clock.ends(&StepTimes::pressure);
  if (may_sleep_) stillness_.look(x, *node_team_);
  if (stillness_.any()) {
    bool any_rests = false;
    for (Group& g : groups_) any_rests = forces_of_moved(g, view) || any_rests;
    if (!any_rests) stillness_.no_cell_rests();
  } else {
    for (Group& g : groups_) g.rest.clear();
    const auto find = [&](const Group& g, long t) { forces_of_tile(g, g, view, t); };
    if (any_nodal_) over_tiles([](const Group& g) { return g.nodal(); }, find);  // which cost less than the others
    over_tiles([](const Group& g) { return !g.nodal(); }, find);
  }
  for (const Group& g : groups_)
    if (!std::all_of(g.upright, g.upright + g.blocks, [](bool upright) { return upright; })) report_inversion(x);
  clock.ends(&StepTimes::cells);
}

void Elements::forces(const NodeField& x, const NodeField& v, double last_dt, double last_kick, NodeField& f) {
  find_forces(x, v, last_dt, last_kick);
  sum_nodes(*node_team_, nodal_forces(), f);
}

Elements::Location Elements::locate(int element) const {
  for (int k = static_cast<int>(groups_.size()) - 1; k >= 0; --k) {
    const Group& g = groups_[k];
    if (g.parts > 0 && element >= g.first_element)
      return {k, g.cell_of[(element - g.first_element) / g.parts], (element - g.first_element) % g.parts};
  }
  return {0, 0, 0};
}

/// V/V0 of an element whose simplex is number `element`; of crossed triangles the smaller one of the triangle's own and of that which
/// the law sees.
double Elements::volume_ratio(const NodeField& x, int element) const {
  const Location where = locate(element);
  const Group& g = groups_[where.group];
  const int block = where.cell / kLanes, l = where.cell % kLanes, point = where.simplex % g.cell_simplices;
  const double V0 = g.memory_storage[(static_cast<std::size_t>(block) * g.cell_simplices + point + 1) * g.items - 1][l];
  if (!is_one_point(static_cast<CellKind>(g.kind))) {
    const SimplexShape shape(x, simplices_[element], dimension_, axisymmetric_);
    const double own = shape.volume / V0;
    if (g.constants_storage.empty()) return own;
    const auto node = [&](int a) { return vec3(x[g.node(where.cell, a)]); };
    const auto item = [&](int i) { return g.constant(block, i, l); };
    Vec3 way[4];
    for (int b = 0; b < 4; ++b) way[b] = node(b) - node(4);
    const std::array<Vec3, 2> y = crossed_edges(item, way, point);  // the hoop of a ring is its own
    return std::min(own, own * y[0].cross(y[1]).z() / shape.edges.col(0).cross(shape.edges.col(1)).z());
  }
  return with_dimension(dimension_, axisymmetric_, [&](auto d, auto ring) {
    const StandingCell<d> cell(g, x, where.cell);
    Vector<double, d> edge[kEdges<d, ring>];
    find_one_point_edges<d, ring>(cell.constants.data(), cell.x, edge);
    return simplex_volume<double, d, ring>(edge) / V0;
  });
}

void Elements::check_upright(const NodeField& x) const {
  for (std::size_t e = 0; e < simplices_.size(); ++e) {
    const double ratio = volume_ratio(x, static_cast<int>(e));
    if (ratio > 0) continue;
    std::ostringstream what;
    what << "element " << e << " of body " << groups_[locate(static_cast<int>(e)).group].body << " (nodes";
    for (int a = 0; a <= dimension_; ++a) what << ' ' << simplices_[e][a];
    if (std::isfinite(ratio))
      what << ") turned inside out at " << place(vec3(x[simplices_[e][0]])) << ": V/V0 = " << ratio
           << "; a finer mesh there, larger tool radii or slower tools avoid it";
    else
      what << ") has no volume that is a number at " << place(vec3(x[simplices_[e][0]]))
           << ": it was pushed or driven farther in a step than numbers reach; look for a boundary, a pressure, a load, gravity or an initial velocity in other units than m, s, Pa";
    throw Error(Code::mesh_error, what.str());
  }
  report_corner_inversion(x);
  report_edge_inversion(x);
}

void Elements::report_inversion(const NodeField& x) const {
  check_upright(x);
  throw Error(Code::mesh_error, "a nodal position is not a number");
}

void Elements::check_axis(const NodeField& x) const {
  for (std::size_t n = 0; n < x.size(); ++n) {
    if (!(x[n][0] < 0)) continue;
    std::ostringstream what;
    what << "node " << n << " at (" << vec3(x[n]).transpose() << ") m lies beyond the axis of symmetry x = 0";
    what << (simplices_.empty() ? "; an axisymmetric section lies at x >= 0, its axis is the y axis"
                                : ", which it has crossed; a finer mesh there or slower tools avoid it");
    throw Error(Code::mesh_error, what.str());
  }
}

const char* Elements::kernel_name() const { return kernels_.name; }

}  // namespace forming_sim
