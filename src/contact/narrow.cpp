#include "forming_sim/contact/narrow.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "forming_sim/contact/closest.h"

namespace forming_sim {
namespace {

// Slope up to which facets count as level, when it is asked whether a feature
// is the nearest of its surface. Between vertices of one surface a hollow of the
// layer's own depth counts as level too: a pressed layer is that wavy, and pairs
// that came and went with the waves would lose their potential each time.
constexpr double kWedge = 1e-3;

class Phase {
 public:
  Phase(const Features& f, const Workspace& work, double layer, bool all, Narrow& result)
      : f_(f), work_(work), layer_(layer), all_(all), out_(result) {}

  // Returns the distance of the nearest facet.
  double group(const NearList& list, int index, double reach) {
    const NearList::VertexGroup& g = list.groups[index];
    const Node& p = work_.x[g.node];
    const double reach2 = reach * reach;
    hits_.clear();
    double least = -1;
    for (int i = g.first; i < g.last; ++i) {
      const NearList::FacetEntry& e = list.facets[i];
      const Closest c = f_.dimension == 2 ? closest_on_segment_facet(p, work_.x[e.node[0]], work_.x[e.node[1]])
                                          : closest_on_triangle(p, work_.x[e.node[0]], work_.x[e.node[1]], work_.x[e.node[2]]);
      if (least < 0 || c.squared < least) least = c.squared;
      if (c.squared > reach2) continue;
      hits_.push_back({c, i, feature_of(c, e.facet), false});
      out_.close.push_back({i, index, std::sqrt(c.squared)});
    }
    if (!hits_.empty()) choose(list, g);
    return std::sqrt(least);
  }

  double edges(const NearList& list, int index, double reach) {
    const NearList::EdgePair& e = list.edges[index];
    const Node &a0 = work_.x[e.node[0]], &a1 = work_.x[e.node[1]], &b0 = work_.x[e.node[2]], &b1 = work_.x[e.node[3]];
    const ClosestEdges c = closest_on_edges(a0, a1, b0, b1);
    const double distance = std::sqrt(c.squared);
    if (distance > reach) return distance;
    out_.close.push_back({index, -1, distance});
    if (!c.crossing || !(distance > 0)) return distance;
    ContactPair pair;
    pair.key = PairKey::make(PairKey::edge_edge, e.first, 0, e.second);
    pair.own = f_.edges[e.first].surface;
    pair.surface = f_.edges[e.second].surface;
    pair.nodes = 4;
    const double weight[4] = {1 - c.s, c.s, c.t - 1, -c.t};
    for (int k = 0; k < 4; ++k) {
      pair.node[k] = e.node[k];
      pair.weight[k] = weight[k];
    }
    pair.gap = distance;
    pair.normal = c.apart / distance;
    const bool nearest = outside(a0, a1, e.opposite, -pair.normal) && outside(b0, b1, e.opposite + 2, pair.normal);
    pair.base = nearest ? layer_ : layer_ / 2;
    offer(pair);
    return distance;
  }

 private:
  struct Hit {
    Closest closest;
    int entry;
    std::uint64_t feature;
    bool taken;
  };

  std::uint64_t feature_of(const Closest& c, int facet) const {
    int id = facet;
    if (c.feature == Closest::edge) id = f_.facet_edges[facet][c.which];
    if (c.feature == Closest::corner) id = f_.facets[facet][c.which];
    return static_cast<std::uint64_t>(c.feature) << 32 | static_cast<std::uint32_t>(id);
  }

  // Keeps the features where the distance is a local minimum, each once; the
  // nearest of all in any case.
  void choose(const NearList& list, const NearList::VertexGroup& g) {
    size_t nearest = 0;
    bool nearest_held = false;
    for (size_t i = 0; i < hits_.size(); ++i)
      if (hits_[i].closest.squared < hits_[nearest].closest.squared) nearest = i;
    const double near2 = hits_[nearest].closest.squared * (1 + 1e-9);
    for (size_t i = 0; i < hits_.size(); ++i) {
      if (hits_[i].taken) continue;
      int count = 0;
      for (size_t j = i; j < hits_.size(); ++j)
        if (hits_[j].feature == hits_[i].feature) {
          hits_[j].taken = true;
          ++count;
        }
      const int id = static_cast<int>(hits_[i].feature & 0xffffffffu);
      const Closest::Feature type = hits_[i].closest.feature;
      const int all = type == Closest::face ? 1 : type == Closest::edge ? f_.edges[id].facets : f_.facets_at_vertex[id];
      if (count < all) continue;
      add(list, g, hits_[i]);
      nearest_held = nearest_held || hits_[i].closest.squared <= near2;
    }
    if (!nearest_held) add(list, g, hits_[nearest]);
  }

  void add(const NearList& list, const NearList::VertexGroup& g, const Hit& hit) {
    const NearList::FacetEntry& e = list.facets[hit.entry];
    const Closest& c = hit.closest;
    ContactPair pair;
    pair.base = layer_;
    pair.own = f_.vertex_surface[g.vertex];
    pair.surface = g.surface;
    pair.node[0] = g.node;
    pair.weight[0] = 1;
    pair.nodes = 1;
    const auto with = [&](int corner, double weight) {
      pair.node[pair.nodes] = e.node[corner];
      pair.weight[pair.nodes++] = -weight;
    };
    if (c.feature == Closest::corner) {
      with(c.which, 1);
    } else if (c.feature == Closest::edge) {
      const int k = c.which, l = (k + 1) % 3;
      with(std::min(k, l), c.weight[std::min(k, l)]);
      with(std::max(k, l), c.weight[std::max(k, l)]);
    } else {
      for (int k = 0; k < f_.corners(); ++k) with(k, c.weight[k]);
    }
    int first = g.vertex, second = static_cast<int>(hit.feature & 0xffffffffu);
    if (c.feature == Closest::corner && second < first) {  // the same pair is found from both sides
      std::swap(first, second);
      std::swap(pair.node[0], pair.node[1]);
      std::swap(pair.own, pair.surface);
    }
    pair.key = PairKey::make(PairKey::vertex_facet, first, c.feature, second);
    Node d = c.apart;
    if (pair.node[0] != g.node) d = -d;
    if (c.feature == Closest::corner) d = work_.x[pair.node[0]] - work_.x[pair.node[1]];  // the same bits from both sides
    pair.gap = std::sqrt(dot3(d, d));
    if (!(pair.gap > 0)) return;  // no direction; the start check and the continuous check exclude it
    pair.normal = d / pair.gap;
    // Seen from the vertex, is the other feature's point the nearest too?
    const Node& from = work_.x[g.node];
    const double sense = pair.node[0] == g.node ? 1 : -1;
    for (int i = g.near_first; i < g.near_last; ++i) {
      const Node along = work_.x[list.neighbours[i]] - from;
      if (-sense * dot3(pair.normal, along) > kWedge * std::sqrt(dot3(along, along)) + layer_) pair.base = layer_ / 2;
    }
    offer(pair);
  }

  void offer(const ContactPair& pair) {
    if (all_ || pair.base == layer_ || pair.gap < pair.base) out_.pairs.push_back(pair);
  }

  // Does `away` from the edge ab point out of the slab of every facet at the edge?
  bool outside(const Node& a, const Node& b, const int* opposite, const Node& away) const {
    const Node u = b - a;
    for (int k = 0; k < 2; ++k) {
      if (opposite[k] < 0) continue;
      const Node r = work_.x[opposite[k]] - a;
      const Node inward = r - dot3(r, u) / dot3(u, u) * u;
      if (dot3(away, inward) > kWedge * std::sqrt(dot3(inward, inward))) return false;
    }
    return true;
  }

  const Features& f_;
  const Workspace& work_;
  double layer_;
  bool all_;
  Narrow& out_;
  std::vector<Hit> hits_;
};

}  // namespace

void put_in_order(std::vector<ContactPair>& pairs) {
  const auto rising = [](const ContactPair& a, const ContactPair& b) { return a.key < b.key; };
  bool done = true;
  for (size_t i = 1; i < pairs.size() && done; ++i) done = rising(pairs[i - 1], pairs[i]);
  if (done) return;
  std::vector<int> order(pairs.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return rising(pairs[a], pairs[b]); });
  std::vector<ContactPair> sorted;
  sorted.reserve(pairs.size());
  for (int i : order)
    if (sorted.empty() || !(sorted.back().key == pairs[i].key)) sorted.push_back(pairs[i]);
  pairs.swap(sorted);
}

void add_plane_pairs(const Features& features, const Workspace& work, const std::vector<PlanePose>& planes, double layer, double reach,
                     const NearList& list, std::vector<ContactPair>& pairs) {
  for (const NearList::PlanePair& p : list.planes) {
    const PlanePose& plane = planes[p.tool];
    const double gap = dot3(work.x[p.node] - plane.point, plane.normal);
    if (gap > reach) continue;
    ContactPair pair;
    pair.key = PairKey::make(PairKey::plane, p.vertex, 0, p.tool);
    pair.own = features.vertex_surface[p.vertex];
    pair.surface = features.bodies + p.tool;
    pair.nodes = 2;
    pair.node[0] = p.node;
    pair.node[1] = p.foot;
    pair.weight[0] = 1;
    pair.weight[1] = -1;
    pair.gap = gap;
    pair.base = layer;
    pair.normal = plane.normal;
    pairs.push_back(pair);
  }
}

void narrow_phase(const Features& features, const Workspace& work, const std::vector<PlanePose>& planes, double layer, bool all, double reach,
                  double travel, NearList& list, Narrow& result) {
  result.pairs.clear();
  result.close.clear();
  Phase phase(features, work, layer, all, result);
  add_plane_pairs(features, work, planes, layer, reach, list, result.pairs);
  // Distances are computed to rounding; the factor keeps the bound on its safe side.
  const double awake = (travel + reach) * (1 + 1e-12);
  for (size_t i = 0; i < list.groups.size(); ++i)
    if (list.groups[i].wake <= awake) list.groups[i].wake = travel + phase.group(list, static_cast<int>(i), reach);
  for (size_t i = 0; i < list.edges.size(); ++i)
    if (list.edges[i].wake <= awake) list.edges[i].wake = travel + phase.edges(list, static_cast<int>(i), reach);
  put_in_order(result.pairs);
}

}  // namespace forming_sim
