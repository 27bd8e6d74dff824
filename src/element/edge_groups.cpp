// The points at edges as a group of cells.
#include <algorithm>
#include <numeric>
#include <sstream>

#include "element/group.h"
#include "forming_sim/config/fault.h"
#include "forming_sim/element/edge_points.h"
#include "forming_sim/mesh/measure.h"
#include "forming_sim/parallel/interrupt.h"

namespace forming_sim {
namespace {

/// Puts points far from each other into the lanes of a block: those that follow each other have nodes in common, and where a block adds
/// to one place again and again, each sum waits for the last.
void spread(std::vector<int>::iterator begin, std::vector<int>::iterator end) {
  const std::vector<int> points(begin, end);
  const std::size_t blocks = points.size() / kLanes;  // what is over stays last
  for (std::size_t i = 0; i < blocks * kLanes; ++i) begin[static_cast<long>(i)] = points[i % kLanes * blocks + i / kLanes];
}

}  // namespace

void Elements::put_points_at_edges(const BodyModel& body, const NodeField& X) {
  std::vector<std::array<int, 4>> simplices;
  const Group* like = nullptr;
  for (const Group& g : groups_)
    if (g.body == body.name && g.nodal()) {
      for (std::size_t i = 0; i < static_cast<std::size_t>(g.cells) * g.parts; ++i) simplices.push_back(simplices_[g.element(i)]);
      like = &g;
    }
  if (!like) return;
  check_interrupt();
  const EdgePoints points = find_edge_points(simplices, X, dimension_, axisymmetric_);
  check_interrupt();
  const int weights = edge_weights(dimension_, axisymmetric_);
  Group g;
  g.at_edges = true;
  g.dimension = dimension_;
  g.ring = axisymmetric_;
  g.make_blocks(points.count(), 1);
  g.pressure = PressureMode::node;
  g.solid = solid_constants(body.material, g.curves);
  g.items = dimension_ == 2 ? memory_items<2>(g.solid) : memory_items<3>(g.solid);
  g.density = like->density;
  g.body = body.name;
  g.memory_storage.resize(static_cast<std::size_t>(g.blocks) * g.items);
  g.first_point = points_;
  points_ += g.blocks * kLanes;

  // Those of a tile by their number of nodes, so that those of a block have the same.
  std::vector<int> order(points.count());
  std::iota(order.begin(), order.end(), 0);
  auto begin = order.begin();
  for (int behind : g.ends_of_tiles()) {
    const auto end = order.begin() + behind;
    std::stable_sort(begin, end, [&](int a, int b) { return points.nodes_of(a) < points.nodes_of(b); });
    for (auto same = begin; same != end;) {
      const auto next = std::find_if(same, end, [&](int point) { return points.nodes_of(point) > points.nodes_of(*same); });
      spread(same, next);
      same = next;
    }
    begin = end;
  }

  std::vector<int> place(points.count());
  for (int b = 0; b < g.blocks; ++b) {
    const auto point_of = [&](int l) { return order[std::min(b * kLanes + l, g.cells - 1)]; };
    int rows = 0;
    for (int l = 0; l < kLanes; ++l) rows = std::max(rows, points.nodes_of(point_of(l)));
    const std::size_t first_row = g.node_storage.size() / kLanes;
    g.row_storage.push_back(static_cast<int>(first_row));
    g.node_storage.resize((first_row + rows) * kLanes);
    g.node_share_storage.resize(first_row + rows);
    g.constants_storage.resize((first_row + rows) * weights);
    for (int l = 0; l < kLanes; ++l) {
      const int point = point_of(l), cell = b * kLanes + l, nodes = points.nodes_of(point);
      if (cell < g.cells) {
        place[point] = g.first_point + cell;
        g.edge_ends.push_back(points.ends[point]);
      }
      g.start(b, l, points.edges(point), points.volume[point]);
      for (int a = 0; a < rows; ++a) {
        const std::size_t row = first_row + a, of_point = static_cast<std::size_t>(points.start[point]) + std::min(a, nodes - 1);
        g.node_storage[row * kLanes + l] = points.node[of_point];
        g.node_share_storage[row][l] = points.share[of_point];
        for (int m = 0; m < weights; ++m) g.constants_storage[row * weights + m][l] = a < nodes ? points.weight[of_point * weights + m] : 0;
      }
    }
  }
  g.row_storage.push_back(static_cast<int>(g.node_storage.size() / kLanes));
  auto side = points.of_simplex.begin();
  for (Group& own : groups_)
    if (own.body == body.name && own.nodal()) {
      own.edge_points.resize(static_cast<std::size_t>(own.cells) * own.parts * edges_of_simplex(dimension_));
      for (int& at : own.edge_points) at = place[*side++];
    }
  groups_.push_back(std::move(g));
}

std::vector<double> Elements::means_over_edges(const Group& g, const std::vector<double>& value, int components) const {
  const int k = edges_of_simplex(dimension_);
  std::vector<double> mean(g.edge_points.size() / k * components, 0.0);
  for (std::size_t i = 0; i < g.edge_points.size(); ++i)
    for (int c = 0; c < components; ++c) mean[i / k * components + c] += value[static_cast<std::size_t>(g.edge_points[i]) * components + c] / k;
  return mean;
}

std::vector<double> Elements::edge_rates(const NodalView& view) const {
  std::vector<Lane> omega2(points_ / kLanes);
  for (const Group& g : groups_)
    if (g.at_edges)
      team_->share(g.blocks, blocks_of_a_thread(g), [&](long first, long last) {
        kernels_.edge.rates(g, view, static_cast<int>(first), static_cast<int>(last), omega2[g.first_point / kLanes].value);
      });
  return {omega2.data()->value, omega2.data()->value + points_};
}

std::vector<double> Elements::point_ratios(const Group& g, const NodeField& x) const {
  const NodalView view{x.data()->data(), nullptr, nullptr, nullptr, 0, 0};
  std::vector<Lane> S(static_cast<std::size_t>(g.blocks) * 6), ratio(g.blocks);
  std::vector<double> energy(g.blocks);
  kernels_.edge.observe(g, view, 0, g.blocks, S.data()->value, ratio.data()->value, energy.data());
  return {ratio.data()->value, ratio.data()->value + g.cells};
}

void Elements::report_edge_inversion(const NodeField& x) const {
  for (const Group& g : groups_) {
    if (!g.at_edges) continue;
    const std::vector<double> ratio = point_ratios(g, x);
    for (int cell = 0; cell < g.cells; ++cell) {
      if (!(ratio[cell] <= 0)) continue;
      const std::array<int, 2> ends = g.edge_ends[cell];
      std::ostringstream what;
      what << "the elements of body " << g.body << " around the edge from node " << ends[0] << " to node " << ends[1] << " at "
           << place(vec3(x[ends[0]])) << " are so distorted that their mean turned inside out: V/V0 = " << ratio[cell]
           << "; a finer mesh there, larger tool radii or slower tools avoid it";
      throw Error(Code::mesh_error, what.str());
    }
  }
}

}  // namespace forming_sim
