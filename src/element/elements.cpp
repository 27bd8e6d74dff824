#include "forming_sim/element/elements.h"

#include <Eigen/LU>
#include <algorithm>
#include <sstream>

#include "forming_sim/config/fault.h"
#include "forming_sim/material/law.h"

namespace forming_sim {

struct Elements::Group : CellGroup {
  std::vector<int> node_storage;
  std::vector<double> plastic, viscous, lowest;
  enum Rest : char { changed, kept, passed_over };  ///< a block's memory by the last evaluation, or none was needed
  std::vector<Rest> rest;  ///< per block; empty where all are evaluated
  CurveTables curves;
  std::vector<Lane> memory_storage;
  int first_element = 0;
  long first_record = 0;
  std::string body;
};

namespace {

/// The classical pressure is a memory of each simplex, which no node has.
PressureMode mode_of(const BodyModel& body, CellKind kind) {
  if (body.pressure_average == "element") return PressureMode::element;
  if (body.pressure_average == "node") return PressureMode::node;
  if (kind != CellKind::triangle && kind != CellKind::tetrahedron) return PressureMode::cell;
  return body.material.law == "classical" ? PressureMode::element : PressureMode::node;
}

/// Cells with a node of their own (the centre of a crossed quadrilateral, centre
/// and faces of 24 tetrahedra) leave that node to the deviator alone when the
/// pressure is one per cell: in a strong impact it yields and the simplices around
/// it collapse. A small share theta of each simplex' own pressure holds them,
///   U = V0 [(1-theta) K/2 (J_cell - 1)^2 + theta K/2 (J - 1)^2].
/// .02 is enough (the Taylor bar collapses with none and runs with .01) and costs
/// .1 to .7 % of the bending moment at 4 cells through the thickness. On 2 triangles
/// or 6 tetrahedra it would lock (face radius of the Taylor bar 6.86 instead of
/// 7.35 mm at 4 cells a radius), and they have no such node.
double element_share_of(CellKind kind) {
  return kind == CellKind::hex24 || kind == CellKind::crossed ? 0.02 : 0;
}

/// A simplex whose nodes stand at x: its edges as columns (2D: the third is the unit vector e_3,
/// of a ring the hoop r e_3), and its volume.
struct SimplexShape {
  Eigen::Matrix3d edges = Eigen::Matrix3d::Identity();
  double volume = 0;
  SimplexShape(const NodeField& x, const std::array<int, 4>& corner, int dimension, bool ring) {
    for (int m = 0; m < dimension; ++m) edges.col(m) = vec3(x[corner[m + 1]] - x[corner[0]]);
    if (ring) edges(2, 2) = (x[corner[0]][0] + x[corner[1]][0] + x[corner[2]][0]) / 3;
    volume = edges.determinant() / (dimension == 3 ? 6 : ring ? 2 / kTwoPi : 2);
  }
};

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

}  // namespace

Elements::~Elements() = default;

Elements::Elements(const std::vector<BodyModel>& bodies, int dimension, const NodeField& x,
                   const ElementOptions& options, int threads, const char* kernels)
    : kernels_(choose_kernels(kernels)), dimension_(dimension), axisymmetric_(options.axisymmetric), team_(std::make_unique<Team>(threads)) {
  const int nodes = static_cast<int>(x.size()), D = dimension_;
  if (axisymmetric_) check_axis(x);
  mass_.assign(nodes, 0.0);
  nodal_volume0_.assign(nodes, 0.0);
  nodal_bulk_.assign(nodes, 0.0);
  inertia_.assign(axisymmetric_ ? nodes : 0, 0.0);
  long records = 0;
  for (const BodyModel& body : bodies) {
    int element = body.first_element;
    for (const Cells& cells : body.mesh.cells) {
      if (cells.count() == 0) continue;
      const CellShape& shape = shape_of(cells.kind);
      Group g;
      g.kind = static_cast<int>(cells.kind);
      g.dimension = D;
      g.ring = axisymmetric_;
      g.cell_nodes = shape.nodes;
      g.cell_simplices = shape.simplices;
      g.cells = cells.count();
      g.blocks = (g.cells + kLanes - 1) / kLanes;
      g.pressure = mode_of(body, cells.kind);
      g.element_share = element_share_of(cells.kind);
      any_nodal_ |= g.pressure == PressureMode::node;
      g.solid = solid_constants(body.material, g.curves);
      g.items = D == 2 ? memory_items<2>(g.solid) : memory_items<3>(g.solid);
      g.density = body.material.density * options.mass_scaling;
      g.linear_viscosity = options.linear_viscosity;
      g.quadratic_viscosity = options.quadratic_viscosity;
      const bool viscous = g.linear_viscosity > 0 || g.quadratic_viscosity > 0;
      may_sleep_ = may_sleep_ && g.pressure != PressureMode::node && g.solid.law != Law::classical && !viscous;
      g.first_element = element;
      g.first_record = records;
      g.body = body.name;
      g.plastic.assign(g.blocks, 0.0);
      g.viscous.assign(g.blocks, 0.0);
      g.lowest.assign(g.blocks, 1.0);
      g.node_storage.resize(static_cast<std::size_t>(g.blocks) * shape.nodes * kLanes);
      g.memory_storage.resize(static_cast<std::size_t>(g.blocks) * shape.simplices * g.items);
      for (int b = 0; b < g.blocks; ++b) {
        for (int l = 0; l < kLanes; ++l) {
          const int cell = std::min(b * kLanes + l, g.cells - 1);
          const int* of_cell = cells.nodes.data() + static_cast<std::size_t>(cell) * shape.nodes;
          for (int a = 0; a < shape.nodes; ++a)
            g.node_storage[(static_cast<std::size_t>(b) * shape.nodes + a) * kLanes + l] = of_cell[a] + body.first_node;
          for (int s = 0; s < shape.simplices; ++s) {
            std::array<int, 4> corner{-1, -1, -1, -1};
            for (int a = 0; a <= D; ++a) corner[a] = of_cell[shape.simplex[s][a]] + body.first_node;
            const SimplexShape initial(x, corner, D, axisymmetric_);
            const double V0 = initial.volume;
            if (!(V0 > 0)) {
              std::ostringstream what;
              what << "element " << element << " of body " << body.name << " has volume " << V0
                   << " at the start; every simplex needs a positive volume";
              throw Error(Code::mesh_error, what.str());
            }
            const Eigen::Matrix3d up = initial.edges.inverse();  // rows: X^m
            const Eigen::Matrix3d G = up * up.transpose();
            Lane* memory = g.memory_storage.data() + (static_cast<std::size_t>(b) * shape.simplices + s) * g.items;
            const auto start = [&](int item, double value) { memory[item][l] = value; };
            if (D == 2) start_memory<2>(g.solid, {{G(0, 0), G(1, 1), G(2, 2), G(0, 1)}}, start);
            else start_memory<3>(g.solid, {{G(0, 0), G(1, 1), G(2, 2), G(0, 1), G(1, 2), G(2, 0)}}, start);
            memory[g.items - 1][l] = V0;
            if (b * kLanes + l != cell) continue;
            simplices_.push_back(corner);
            ++element;
            for (int a = 0; a <= D; ++a) {
              mass_[corner[a]] += g.density * V0 * mass_share(x, corner, a, D, axisymmetric_);
              nodal_volume0_[corner[a]] += V0 / (D + 1);
              nodal_bulk_[corner[a]] = g.solid.K;
              if (axisymmetric_) inertia_[corner[a]] = g.density;
            }
          }
        }
      }
      records += static_cast<long>(g.blocks) * shape.nodes * kLanes;
      groups_.push_back(std::move(g));
    }
  }
  for (std::size_t n = 0; n < inertia_.size(); ++n) inertia_[n] *= nodal_volume0_[n] / mass_[n];
  record_size_ = D == 2 ? kRecord<2> : kRecord<3>;
  record_storage_.resize(static_cast<std::size_t>(records) * record_size_ / kLanes);
  records_ = record_storage_.empty() ? nullptr : record_storage_.data()->value;
  pressure_.assign(any_nodal_ ? nodes : 0, 0.0);

  // simplices_ was filled block by block, lane by lane: that is cell by cell.
  std::vector<int> count(nodes + 1, 0);
  auto each_record = [&](auto&& visit) {
    for (const Group& g : groups_)
      for (int cell = 0; cell < g.cells; ++cell)
        for (int a = 0; a < g.cell_nodes; ++a) {
          const long r = (static_cast<long>(cell / kLanes) * g.cell_nodes + a) * kLanes + cell % kLanes;
          visit(g.node_storage[r], g.first_record + r);
        }
  };
  each_record([&](int node, long) { ++count[node + 1]; });
  for (int n = 0; n < nodes; ++n) count[n + 1] += count[n];
  record_start_ = count;
  record_index_.resize(count[nodes]);
  each_record([&](int node, long r) { record_index_[count[node]++] = static_cast<int>(r); });

  for (Group& g : groups_) {
    g.nodes = g.node_storage.data();
    g.memory = reinterpret_cast<double*>(g.memory_storage.data());
    g.records = records_ + g.first_record * record_size_;
    g.plastic_work = g.plastic.data();
    g.viscous_work = g.viscous.data();
    g.lowest_ratio = g.lowest.data();
  }
}

std::vector<GroupPlan> Elements::plan() const {
  std::vector<GroupPlan> groups;
  for (const Group& g : groups_) {
    GroupPlan plan;
    plan.body = g.body;
    plan.kind = static_cast<CellKind>(g.kind);
    plan.pressure = g.pressure;
    plan.layers = g.solid.layers;
    plan.cells = g.cells;
    plan.elements = static_cast<long>(g.cells) * g.cell_simplices;
    plan.memory_bytes = static_cast<double>(g.memory_storage.size() * sizeof(Lane));
    plan.force_bytes = static_cast<double>(g.node_storage.size()) * record_size_ * sizeof(double);
    plan.index_bytes = static_cast<double>(g.node_storage.size()) * 2 * sizeof(int);  // of the cell's nodes, of the node's forces
    groups.push_back(plan);
  }
  return groups;
}

/// A thread gets 512 packs or more: below that, waiting for each other costs more.
long Elements::blocks_of_a_thread(const Group& g) { return 512 / g.cell_simplices; }

/// Calls work(group, first, last) over chunks of blocks, shared by the team.
template <class Work> void Elements::over_blocks(Work&& work) const {
  for (const Group& g : groups_) {
    const int per_chunk = std::max(1, 64 / (g.cell_simplices * kLanes / 8));
    team_->share(g.blocks, blocks_of_a_thread(g), [&](long begin, long end) {
      for (long b = begin; b < end; b += per_chunk) work(g, static_cast<int>(b), static_cast<int>(std::min(end, b + per_chunk)));
    });
  }
}

void Elements::nodal_pressure(const NodalView& view) const {
  over_blocks([&](const Group& g, int first, int last) {
    CellGroup one_wide = g;
    one_wide.records = records_ + g.first_record;
    kernels_.volumes(one_wide, view, first, last);
  });
  team_->share(static_cast<long>(mass_.size()), kNodesOfAThread, [&](long first, long last) {
    for (long n = first; n < last; ++n) {
      double V = 0;
      for (int k = record_start_[n]; k < record_start_[n + 1]; ++k) V += records_[record_index_[k]];
      pressure_[n] = nodal_bulk_[n] * (V / nodal_volume0_[n] - 1);
    }
  });
}

void Elements::forces_of_moved(Group& g, const NodalView& view) {
  g.rest.resize(g.blocks, Group::changed);
  const int nodes = static_cast<int>(g.node_storage.size()) / g.blocks;
  team_->share(g.blocks, blocks_of_a_thread(g), [&](long begin, long end) {
    for (int b = static_cast<int>(begin); b < end; ++b) {
      const int* first = &g.node_storage[static_cast<std::size_t>(b) * nodes];
      if (g.rest[b] != Group::changed && std::none_of(first, first + nodes, [&](int n) { return stillness_.moved(n); })) {
        g.rest[b] = Group::passed_over;
        continue;
      }
      const double before = g.plastic[b];
      kernels_.forces(g, view, b, b + 1);
      g.rest[b] = g.plastic[b] == before ? Group::kept : Group::changed;
    }
  });
}

void Elements::forces(const NodeField& x, const NodeField& v, double last_dt, double dt, NodeField& f) {
  if (axisymmetric_) check_axis(x);
  NodalView view{x.data()->data(), v.data()->data(), nullptr, pressure_.data(), dt, last_dt};
  if (any_nodal_) nodal_pressure(view);
  if (may_sleep_) stillness_.look(x, *team_);
  if (stillness_.any()) {
    for (Group& g : groups_) forces_of_moved(g, view);
  } else {
    for (Group& g : groups_) g.rest.clear();
    over_blocks([&](const Group& g, int first, int last) { kernels_.forces(g, view, first, last); });
  }
  for (const Group& g : groups_)
    for (double ratio : g.lowest)
      if (!(ratio > 0)) report_inversion(x);
  const bool flat = dimension_ == 2;
  team_->share(static_cast<long>(mass_.size()), kNodesOfAThread, [&](long first, long last) {
    for (long n = first; n < last; ++n) {
      Node sum = Node::Zero();
      for (int k = record_start_[n]; k < record_start_[n + 1]; ++k) {
        const double* record = records_ + static_cast<std::size_t>(record_index_[k]) * record_size_;
        if (flat) sum.head<2>() += Eigen::Map<const Eigen::Vector2d>(record);
        else sum += Eigen::Map<const Node>(record);
      }
      f[n] = sum;
    }
  });
}

void Elements::stable_step(const NodeField& x, const NodeField& v, double& dt, int& element) const {
  const NodalView view{x.data()->data(), v.data()->data(), inertia_.data(), nullptr, 0, 0};
  dt = 1e300;
  element = -1;
  for (const Group& g : groups_) {
    std::vector<BlockStep> steps(g.blocks);
    team_->share(g.blocks, blocks_of_a_thread(g), [&](long first, long last) {
      kernels_.time_step(g, view, static_cast<int>(first), static_cast<int>(last), steps.data());
    });
    for (int b = 0; b < g.blocks; ++b)
      if (!(steps[b].dt >= dt)) {
        dt = steps[b].dt;
        element = g.first_element + std::min(b * kLanes + steps[b].lane, g.cells - 1) * g.cell_simplices;
      }
  }
}

long Elements::blocks() const {
  long sum = 0;
  for (const Group& g : groups_) sum += g.blocks;
  return sum;
}

long Elements::blocks_at_rest() const {
  long sum = 0;
  for (const Group& g : groups_) sum += std::count(g.rest.begin(), g.rest.end(), Group::passed_over);
  return sum;
}

double Elements::plastic_work() const {
  double sum = 0;
  for (const Group& g : groups_)
    for (double w : g.plastic) sum += w;
  return sum;
}

double Elements::viscous_work() const {
  double sum = 0;
  for (const Group& g : groups_)
    for (double w : g.viscous) sum += w;
  return sum;
}

std::vector<double> Elements::plastic_strain() const {
  std::vector<double> p(simplices_.size());
  for (const Group& g : groups_)
    for (int cell = 0; cell < g.cells; ++cell)
      for (int s = 0; s < g.cell_simplices; ++s) {
        const Lane* memory = g.memory_storage.data() + (static_cast<std::size_t>(cell / kLanes) * g.cell_simplices + s) * g.items;
        const auto at = [&](int item) { return memory[item][cell % kLanes]; };
        p[g.first_element + cell * g.cell_simplices + s] = dimension_ == 2 ? plastic_strain_of<2>(g.solid, at) : plastic_strain_of<3>(g.solid, at);
      }
  return p;
}

ElementFields Elements::observe(const NodeField& x) const {
  const NodalView view{x.data()->data(), nullptr, nullptr, pressure_.data(), 0, 0};
  if (any_nodal_) nodal_pressure(view);
  ElementFields fields;
  fields.stress.resize(simplices_.size());
  fields.volume_ratio.resize(simplices_.size());
  for (const Group& g : groups_) {
    std::vector<Lane> stress(static_cast<std::size_t>(g.blocks) * g.cell_simplices * 6);
    std::vector<Lane> ratio(static_cast<std::size_t>(g.blocks) * g.cell_simplices);
    std::vector<double> energy(g.blocks);
    team_->share(g.blocks, blocks_of_a_thread(g), [&](long first, long last) {
      kernels_.observe(g, view, static_cast<int>(first), static_cast<int>(last), stress.data()->value, ratio.data()->value, energy.data());
    });
    for (double e : energy) fields.stored_energy += e;
    for (int cell = 0; cell < g.cells; ++cell)
      for (int s = 0; s < g.cell_simplices; ++s) {
        const std::size_t at = static_cast<std::size_t>(cell / kLanes) * g.cell_simplices + s;
        const int l = cell % kLanes, element = g.first_element + cell * g.cell_simplices + s;
        Sym& sigma = fields.stress[element];
        for (int i = 0; i < 6; ++i) sigma[i] = stress[at * 6 + i][l];
        fields.volume_ratio[element] = ratio[at][l];
      }
  }
  if (any_nodal_)  // the volumetric energy of nodal pressures belongs to the nodes
    for (const Group& g : groups_) {
      if (g.pressure != PressureMode::node) continue;
      std::vector<char> mine(mass_.size(), 0);
      for (int node : g.node_storage) mine[node] = 1;
      for (std::size_t n = 0; n < mine.size(); ++n)
        if (mine[n]) fields.stored_energy += 0.5 * nodal_volume0_[n] * pressure_[n] * pressure_[n] / nodal_bulk_[n];
    }
  return fields;
}

Elements::Location Elements::locate(int element) const {
  for (int k = static_cast<int>(groups_.size()) - 1; k >= 0; --k) {
    const Group& g = groups_[k];
    if (element >= g.first_element)
      return {k, (element - g.first_element) / g.cell_simplices, (element - g.first_element) % g.cell_simplices};
  }
  return {0, 0, 0};
}

void Elements::report_inversion(const NodeField& x) const {
  for (std::size_t e = 0; e < simplices_.size(); ++e) {
    const double V = SimplexShape(x, simplices_[e], dimension_, axisymmetric_).volume;
    if (V > 0) continue;
    const Location where = locate(static_cast<int>(e));
    const Group& g = groups_[where.group];
    const double V0 = g.memory_storage[(static_cast<std::size_t>(where.cell / kLanes) * g.cell_simplices + where.simplex + 1) * g.items - 1][where.cell % kLanes];
    std::ostringstream what;
    what << "element " << e << " of body " << g.body << " (nodes";
    for (int a = 0; a <= dimension_; ++a) what << ' ' << simplices_[e][a];
    what << ") turned inside out at (" << vec3(x[simplices_[e][0]]).transpose() << ") m: V/V0 = " << V / V0
         << "; a finer mesh there, larger tool radii or slower tools avoid it";
    throw Error(Code::mesh_error, what.str());
  }
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

void Elements::append_state(std::vector<double>& to) const {
  for (const Group& g : groups_) {
    const double* memory = reinterpret_cast<const double*>(g.memory_storage.data());
    to.insert(to.end(), memory, memory + g.memory_storage.size() * 8);
    to.insert(to.end(), g.plastic.begin(), g.plastic.end());
    to.insert(to.end(), g.viscous.begin(), g.viscous.end());
  }
}

const double* Elements::read_state(const double* from) {
  stillness_.forget();
  for (Group& g : groups_) {
    double* memory = reinterpret_cast<double*>(g.memory_storage.data());
    std::copy(from, from + g.memory_storage.size() * 8, memory);
    from += g.memory_storage.size() * 8;
    std::copy(from, from + g.plastic.size(), g.plastic.begin());
    from += g.plastic.size();
    std::copy(from, from + g.viscous.size(), g.viscous.begin());
    from += g.viscous.size();
  }
  return from;
}

const char* Elements::kernel_name() const { return kernels_.name; }

}  // namespace forming_sim
