// What the elements of a part remember, for the run that goes on from it (element/formed.h).
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

#include "element/group.h"
#include "forming_sim/config/fault.h"
#include "forming_sim/element/edge_points.h"
#include "forming_sim/element/formed.h"

namespace forming_sim {

namespace {

/// [cell of the body][number] of what a group keeps as [block][number][lane].
std::vector<double> by_cells(const LargeArray<Lane>& lanes, const std::vector<int>& order) {
  if (lanes.empty()) return {};
  const std::size_t cells = order.size(), numbers = lanes.size() / ((cells + kLanes - 1) / kLanes);
  std::vector<double> values(cells * numbers);
  for (std::size_t cell = 0; cell < cells; ++cell)
    for (std::size_t k = 0; k < numbers; ++k) values[order[cell] * numbers + k] = lanes[cell / kLanes * numbers + k][cell % kLanes];
  return values;
}

/// The other way; the last block is filled up with copies of the last cell.
void put_by_cells(const std::vector<double>& values, const std::vector<int>& order, LargeArray<Lane>& lanes) {
  if (lanes.empty()) return;
  const std::size_t cells = order.size(), blocks = (cells + kLanes - 1) / kLanes, numbers = lanes.size() / blocks;
  for (std::size_t at = 0; at < blocks * kLanes; ++at)
    for (std::size_t k = 0; k < numbers; ++k) lanes[at / kLanes * numbers + k][at % kLanes] = values[order[std::min(at, cells - 1)] * numbers + k];
}

void require_same(int then, int now, const BodyModel& body) {
  if (then != now) throw Error(Code::mesh_error, "the formed part that body " + body.name + " goes on from was kept by another version: it has " + std::to_string(then) + " numbers where " + std::to_string(now) + " are remembered now; form it anew");
}

/// G^11, G^22, G^33, G^12 (G^23, G^31) as a matrix, and back.
Eigen::Matrix3d matrix_of(const double* G, int dimension) {
  Eigen::Matrix3d m;
  const double yz = dimension == 3 ? G[4] : 0, zx = dimension == 3 ? G[5] : 0;
  m << G[0], G[3], zx, G[3], G[1], yz, zx, yz, G[2];
  return m;
}
void put_matrix(const Eigen::Matrix3d& m, int dimension, double* G) {
  for (int i = 0; i < 3; ++i) G[i] = m(i, i);
  G[3] = m(0, 1);
  if (dimension == 3) G[4] = m(1, 2), G[5] = m(2, 0);
}

}  // namespace

Eigen::Matrix3d Elements::point_edges(const Group& g, int point, const NodeField& x) const {
  const int weights = edge_weights(dimension_, axisymmetric_), block = point / kLanes, l = point % kLanes;
  Eigen::Matrix3d y = Eigen::Matrix3d::Zero();
  if (!axisymmetric_ && dimension_ == 2) y(2, 2) = 1;
  for (int row = g.row_storage[block]; row < g.row_storage[block + 1]; ++row) {
    const Node& at = x[g.node_storage[static_cast<std::size_t>(row) * kLanes + l]];
    const auto weight = [&](int m) { return g.constants_storage[static_cast<std::size_t>(row) * weights + m][l]; };
    for (int m = 0; m < dimension_; ++m)
      for (int i = 0; i < dimension_; ++i) y(i, m) += weight(m) * at[i];
    if (axisymmetric_) y(2, 2) += weight(dimension_) * at[0];
  }
  return y;
}

FormedMemory Elements::memory_of(const BodyModel& body, const NodeField& x) const {
  FormedMemory memory;
  auto group = groups_.begin();
  for (const Cells& cells : body.mesh.cells) {
    memory.cells.emplace_back();
    if (cells.count() == 0) continue;
    while (group->body != body.name || group->at_edges) ++group;
    const Group& g = *group++;
    FormedCells& of = memory.cells.back();
    of.points = g.cell_simplices;
    of.items = g.items;
    of.hourglass_items = g.hourglass_items;
    of.memory = by_cells(g.memory_storage, g.order);
    of.hourglass = by_cells(g.hourglass_storage, g.order);
    of.ratio = by_cells(g.weight_ratio, g.order);
  }
  observe_pressure({x.data()->data(), nullptr, nullptr, pressure_.data(), 0, 0});
  for (const Group& g : groups_) {
    if (!g.at_edges || g.body != body.name) continue;
    for (int n = body.first_node; n < body.first_node + body.node_count; ++n) memory.nodal_ratio.push_back(1 + growth_[n]);
    FormedEdges& of = memory.edges;
    of.items = g.items;
    of.volume_ratio = point_ratios(g, x);
    for (int point = 0; point < g.cells; ++point) {
      of.ends.push_back({g.edge_ends[point][0] - body.first_node, g.edge_ends[point][1] - body.first_node});
      of.edges.push_back(point_edges(g, point, x));
      for (int i = 0; i < g.items; ++i) of.memory.push_back(g.memory_storage[static_cast<std::size_t>(point / kLanes) * g.items + i][point % kLanes]);
    }
  }
  return memory;
}

void Elements::take_up(const BodyModel& body, const FormedMemory& memory, const NodeField& x) {
  auto group = groups_.begin();
  for (std::size_t k = 0; k < body.mesh.cells.size(); ++k) {
    if (body.mesh.cells[k].count() == 0) continue;
    while (group->body != body.name || group->at_edges) ++group;
    Group& g = *group++;
    const FormedCells& of = memory.cells[k];
    require_same(of.points, g.cell_simplices, body);
    require_same(of.items, g.items, body);
    require_same(of.hourglass_items, g.hourglass_items, body);
    put_by_cells(of.memory, g.order, g.memory_storage);
    put_by_cells(of.hourglass, g.order, g.hourglass_storage);
    const LargeArray<Lane> first = g.weight_ratio;
    put_by_cells(of.ratio, g.order, g.weight_ratio);
    g.set_changed_weights(first);
  }
  for (Group& g : groups_)
    if (g.at_edges && g.body == body.name) {
      take_up_nodes(body, memory.nodal_ratio, x);
      take_up_points(body, memory.edges, x, g);
    }
}

// A node at a cut has lost simplices whose volumes made up for those of the others: that its pressure stays, its V0 is what goes with it now.
void Elements::take_up_nodes(const BodyModel& body, const std::vector<double>& ratio, const NodeField& x) {
  observe_pressure({x.data()->data(), nullptr, nullptr, pressure_.data(), 0, 0});
  for (int k = 0; k < body.node_count; ++k) {
    const int n = body.first_node + k;
    if (nodal_volume0_[n] > 0) nodal_volume0_[n] *= (1 + growth_[n]) / ratio[k];
  }
}

// The mean of the simplices around an edge is another where some of them are cut away: the elastic strain that the point had stays,
// J^(-2/3) B with B = x_m x_k G^mk, and so do the places of fibres. Rubber has none to keep: its stress is that of its shape.
void Elements::take_up_points(const BodyModel& body, const FormedEdges& formed, const NodeField& x, Group& g) {
  require_same(formed.items, g.items, body);
  if (g.solid.law == Law::hyperelastic) return;
  std::map<std::array<int, 2>, std::size_t> at;
  for (std::size_t e = 0; e < formed.ends.size(); ++e) at[formed.ends[e]] = e;
  const std::vector<double> ratio = point_ratios(g, x);
  const int layers = g.solid.layers, of_layer = dimension_ == 2 ? kLayerItems<2> : kLayerItems<3>;
  for (int point = 0; point < g.blocks * kLanes; ++point) {
    const int own = std::min(point, g.cells - 1);
    const std::size_t e = at.at({g.edge_ends[own][0] - body.first_node, g.edge_ends[own][1] - body.first_node});
    const Eigen::Matrix3d A = point_edges(g, own, x).inverse() * formed.edges[e];
    const double scale = std::pow(ratio[own] / formed.volume_ratio[e], 2. / 3);
    std::vector<double> memory(formed.memory.begin() + static_cast<std::ptrdiff_t>(e) * g.items, formed.memory.begin() + static_cast<std::ptrdiff_t>(e + 1) * g.items);
    for (int k = 0; k < layers; ++k) put_matrix(scale * A * matrix_of(&memory[k * of_layer], dimension_) * A.transpose(), dimension_, &memory[k * of_layer]);
    if (g.solid.law == Law::hill)
      for (int fibre = 0; fibre < 2; ++fibre) {
        double* d = &memory[layers * of_layer + fibre * dimension_];
        const Eigen::VectorXd moved = A.topLeftCorner(dimension_, dimension_) * Eigen::Map<const Eigen::VectorXd>(d, dimension_);
        std::copy(moved.data(), moved.data() + dimension_, d);
      }
    for (int i = 0; i + 1 < g.items; ++i) g.memory_storage[static_cast<std::size_t>(point / kLanes) * g.items + i][point % kLanes] = memory[i];  // V0, the last, is its own
  }
}

}  // namespace forming_sim
