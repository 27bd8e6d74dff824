// The points at edges as groups of cells: those with the same number of nodes together.
#include <map>
#include <sstream>

#include "element/group.h"
#include "forming_sim/config/fault.h"
#include "forming_sim/element/edge_points.h"

namespace forming_sim {

void Elements::put_points_at_edges(const BodyModel& body, const NodeField& X) {
  std::vector<std::array<int, 4>> simplices;
  const Group* like = nullptr;
  for (const Group& g : groups_)
    if (g.body == body.name && g.nodal()) {
      simplices.insert(simplices.end(), simplices_.begin() + g.first_element, simplices_.begin() + g.first_element + static_cast<long>(g.cells) * g.parts);
      like = &g;
    }
  if (!like) return;
  const EdgePoints points = find_edge_points(simplices, X, dimension_, axisymmetric_);
  std::map<int, std::vector<int>> of_size;  // points by their number of nodes
  for (int point = 0; point < points.count(); ++point) of_size[points.nodes_of(point)].push_back(point);

  std::vector<int> place(points.count());
  std::vector<Group> groups;
  const int weights = edge_weights(dimension_, axisymmetric_);
  for (const auto& [size, members] : of_size) {
    Group g;
    g.at_edges = true;
    g.dimension = dimension_;
    g.ring = axisymmetric_;
    g.cell_nodes = size;
    g.cell_simplices = 1;
    g.make_blocks(static_cast<int>(members.size()));
    g.pressure = PressureMode::node;
    g.solid = solid_constants(body.material, g.curves);
    g.items = dimension_ == 2 ? memory_items<2>(g.solid) : memory_items<3>(g.solid);
    g.density = like->density;
    g.body = body.name;
    g.node_storage.resize(static_cast<std::size_t>(g.blocks) * size * kLanes);
    g.memory_storage.resize(static_cast<std::size_t>(g.blocks) * g.items);
    g.constants_storage.resize(static_cast<std::size_t>(g.blocks) * size * weights);
    g.node_share_storage.resize(static_cast<std::size_t>(g.blocks) * size);
    g.first_point = points_;
    points_ += g.blocks * kLanes;
    for (int b = 0; b < g.blocks; ++b)
      for (int l = 0; l < kLanes; ++l) {
        const int cell = std::min(b * kLanes + l, g.cells - 1), point = members[cell];
        if (b * kLanes + l == cell) {
          place[point] = g.first_point + cell;
          g.edge_ends.push_back(points.ends[point]);
        }
        g.start(b, l, points.edges(point), points.volume[point]);
        for (int a = 0; a < size; ++a) {
          const std::size_t of_cell = static_cast<std::size_t>(b) * size + a, of_point = static_cast<std::size_t>(points.start[point]) + a;
          g.node_storage[of_cell * kLanes + l] = points.node[of_point];
          g.node_share_storage[of_cell][l] = points.share[of_point];
          for (int m = 0; m < weights; ++m) g.constants_storage[of_cell * weights + m][l] = points.weight[of_point * weights + m];
        }
      }
    groups.push_back(std::move(g));
  }
  auto side = points.of_simplex.begin();
  for (Group& g : groups_)
    if (g.body == body.name && g.nodal()) {
      g.edge_points.resize(static_cast<std::size_t>(g.cells) * g.parts * edges_of_simplex(dimension_));
      for (int& at : g.edge_points) at = place[*side++];
    }
  for (Group& g : groups) groups_.push_back(std::move(g));
}

std::vector<double> Elements::means_over_edges(const Group& g, const std::vector<double>& value, int components, int c) const {
  const int k = edges_of_simplex(dimension_);
  std::vector<double> mean(g.edge_points.size() / k, 0.0);
  for (std::size_t s = 0; s < mean.size(); ++s) {
    for (int i = 0; i < k; ++i) mean[s] += value[static_cast<std::size_t>(g.edge_points[s * k + i]) * components + c];
    mean[s] /= k;
  }
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

void Elements::report_edge_inversion(const NodeField& x) const {
  const NodalView view{x.data()->data(), nullptr, nullptr, nullptr, 0, 0};
  for (const Group& g : groups_) {
    if (!g.at_edges) continue;
    std::vector<Lane> S(static_cast<std::size_t>(g.blocks) * 6), ratio(g.blocks);
    std::vector<double> energy(g.blocks);
    kernels_.edge.observe(g, view, 0, g.blocks, S.data()->value, ratio.data()->value, energy.data());
    for (int cell = 0; cell < g.cells; ++cell) {
      if (!(ratio[cell / kLanes][cell % kLanes] <= 0)) continue;
      const std::array<int, 2> ends = g.edge_ends[cell];
      std::ostringstream what;
      what << "the elements of body " << g.body << " around the edge from node " << ends[0] << " to node " << ends[1] << " at ("
           << vec3(x[ends[0]]).transpose() << ") m are so distorted that their mean turned inside out: V/V0 = " << ratio[cell / kLanes][cell % kLanes]
           << "; a finer mesh there, larger tool radii or slower tools avoid it";
      throw Error(Code::mesh_error, what.str());
    }
  }
}

}  // namespace forming_sim
