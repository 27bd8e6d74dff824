#include "forming_sim/contact/narrow.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "forming_sim/contact/closest.h"

namespace forming_sim {
namespace {

// Slope up to which facets count as level, when it is asked whether a feature
// is the nearest of its surface. Between vertices of one surface a hollow of the
// layer's own depth counts as level too: a pressed layer is that wavy, and pairs
// that came and went with the waves would lose their potential each time.
constexpr double kWedge = 1e-3;

bool rising(const ContactPair& a, const ContactPair& b) { return a.key < b.key; }

class Phase {
 public:
  Phase(const PairConstants& constants, bool all, Narrow& result)
      : constants_(constants), f_(constants.features), work_(constants.work), layer_(constants.layer), all_(all), out_(result), finished_(result.pairs.size()) {}

  /// Looks at the facets of the group that are awake; sets when they need be looked at again.
  void group(NearList& list, int index, double reach, double travel, double awake) {
    NearList::VertexGroup& g = list.groups[index];
    const Node& p = work_.x[g.node];
    const double reach2 = reach * reach;
    hits_.clear();
    g.wake = std::numeric_limits<double>::infinity();
    for (int i = g.first; i < g.last; ++i) {
      NearList::FacetEntry& e = list.facets[i];
      if (e.wake <= awake) {
        const Closest c = f_.dimension == 2 ? closest_on_segment_facet(p, work_.x[e.node[0]], work_.x[e.node[1]])
                                            : closest_on_triangle(p, work_.x[e.node[0]], work_.x[e.node[1]], work_.x[e.node[2]]);
        const double distance = std::sqrt(c.squared);
        e.wake = travel + distance;
        if (c.squared <= reach2) {
          hits_.push_back({c, i, feature_of(c, e.facet), false});
          out_.close.emplace_back(i, index, distance);
        }
      }
      g.wake = std::min(g.wake, e.wake);
    }
    if (hits_.empty()) return;
    if (g.vertex != vertex_) finish_vertex();
    vertex_ = g.vertex;
    choose(list, g);
  }

  /// Before the next vertex, or at the end of all: in their order, complete.
  void finish_vertex() {
    std::vector<ContactPair>& all = out_.pairs;
    const auto first = all.begin() + static_cast<long>(finished_);
    if (!std::is_sorted(first, all.end(), rising)) std::sort(first, all.end(), rising);
    finish();
  }
  /// After all vertices, before the edges: pairs of two vertices, found from either side.
  void finish_corners(std::vector<ContactPair>& corners) {
    put_in_order(corners);
    out_.pairs.insert(out_.pairs.end(), corners.begin(), corners.end());
    finish();
  }
  std::vector<ContactPair>& corners() { return corners_; }
  void finish() {
    for (; finished_ < out_.pairs.size(); ++finished_) constants_.set(out_.pairs[finished_], out_.rubs);
  }

  double edges(const NearList& list, int index, double reach) {
    const NearList::EdgePair& e = list.edges[index];
    const Node &a0 = work_.x[e.node[0]], &a1 = work_.x[e.node[1]], &b0 = work_.x[e.node[2]], &b1 = work_.x[e.node[3]];
    const ClosestEdges c = closest_on_edges(a0, a1, b0, b1);
    const double distance = std::sqrt(c.squared);
    if (distance > reach) return distance;
    out_.close.emplace_back(index, -1, distance);
    if (!c.crossing || !(distance > 0)) return distance;
    const Node normal = c.apart / distance;
    const double base = outside(a0, a1, e.opposite, -normal) && outside(b0, b1, e.opposite + 2, normal) ? layer_ : layer_ / 2;
    if (!offered(base, distance)) return distance;
    ContactPair& pair = out_.pairs.emplace_back(PairKey::make(PairKey::edge_edge, e.first, 0, e.second), e.own, e.surface, distance, base);
    pair.nodes = 4;
    pair.weight[0] = 1 - c.s;
    pair.weight[1] = c.s;
    pair.weight[2] = c.t - 1;
    pair.weight[3] = -c.t;
    for (int k = 0; k < 4; ++k) pair.node[k] = e.node[k];
    pair.normal = normal;
    finish();
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
    int own = f_.vertex_surface[g.vertex], surface = g.surface;
    Link link{{1, 0, 0, 0}, {g.node, -1, -1, -1}, 1};
    const auto with = [&](int corner, double share) {
      link.node[link.nodes] = e.node[corner];
      link.weight[link.nodes++] = -share;
    };
    if (c.feature == Closest::corner) {
      with(c.which, 1);
    } else if (c.feature == Closest::edge) {
      const int i = c.which == 2 ? 0 : c.which, j = c.which == 2 ? 2 : c.which + 1;
      with(i, c.weight[i]);
      with(j, c.weight[j]);
    } else {
      for (int k = 0; k < f_.corners(); ++k) with(k, c.weight[k]);
    }
    int first = g.vertex, second = static_cast<int>(hit.feature & 0xffffffffu);
    const bool corners = c.feature == Closest::corner;
    if (corners && second < first) {  // the same pair is found from both sides
      std::swap(first, second);
      std::swap(link.node[0], link.node[1]);
      std::swap(own, surface);
    }
    Node d = c.apart;
    if (link.node[0] != g.node) d = -d;
    if (corners) d = work_.x[link.node[0]] - work_.x[link.node[1]];  // the same bits from both sides
    const double gap = std::sqrt(dot3(d, d));
    if (!(gap > 0)) return;  // no direction; the start check and the continuous check exclude it
    const Node normal = d / gap;
    double base = layer_;
    // Seen from the vertex, is the other feature's point the nearest too?
    const Node& from = work_.x[g.node];
    const double sense = link.node[0] == g.node ? 1 : -1;
    for (int i = g.near_first; i < g.near_last; ++i) {
      const Node along = work_.x[list.neighbours[i]] - from;
      const double nearer = -sense * dot3(normal, along) - layer_;
      if (nearer > 0 && nearer * nearer > kWedge * kWedge * dot3(along, along)) base = layer_ / 2;
    }
    if (!offered(base, gap)) return;
    (corners ? corners_ : out_.pairs)
        .emplace_back(corners ? PairKey::make(PairKey::vertex_vertex, first, 0, second) : PairKey::make(PairKey::vertex_facet, first, c.feature, second), own,
                      surface, gap, base)
        .lies(link, normal);
  }

  bool offered(double base, double gap) const { return all_ || base == layer_ || gap < base; }

  // Does `away` from the edge ab, across it, point out of the slab of every facet at the edge?
  // `inward`, across the edge too, has the length |r x u| / |u|.
  bool outside(const Node& a, const Node& b, const int* opposite, const Node& away) const {
    for (int k = 0; k < 2; ++k) {
      if (opposite[k] < 0) continue;
      const Node r = work_.x[opposite[k]] - a;
      const double within = dot3(away, r);
      if (!(within > 0)) continue;
      const Node u = b - a, n = cross3(r, u);
      if (within * within * dot3(u, u) > kWedge * kWedge * dot3(n, n)) return false;
    }
    return true;
  }

  const PairConstants& constants_;
  const Features& f_;
  const Workspace& work_;
  double layer_;
  bool all_;
  Narrow& out_;
  std::vector<Hit> hits_;
  std::vector<ContactPair> corners_;  ///< pairs of two vertices
  int vertex_ = -1;                   ///< whose pairs are being found
  size_t finished_;                   ///< so many pairs are in order and complete
};

}  // namespace

void put_in_order(std::vector<ContactPair>& pairs) {
  std::sort(pairs.begin(), pairs.end(), rising);
  pairs.erase(std::unique(pairs.begin(), pairs.end(), [](const ContactPair& a, const ContactPair& b) { return a.key == b.key; }), pairs.end());
}

// Of a point x and its foot f on the plane, which go to x1 and f1: along the normal n1 with which the
// step ends, (x - f) . n1 + (v_x - v_f) . n1 dt = (x1 - f1) . n1 is the gap at the end itself, as f1
// lies on the plane, however far both slide and the plane turns.
void add_plane_pairs(const Features& features, const Workspace& work, const std::vector<PlanePose>& planes, double layer, double reach,
                     const NearList& list, std::vector<ContactPair>& pairs) {
  for (const NearList::PlanePair& p : list.planes) {
    const PlanePose& plane = planes[p.tool];
    const double gap = dot3(work.x[p.node] - plane.point, plane.normal) * dot3(plane.normal, plane.end_normal);
    if (gap > reach) continue;
    pairs.emplace_back(PairKey::make(PairKey::plane, p.vertex, 0, p.tool), features.vertex_surface[p.vertex], features.bodies + p.tool, gap, layer)
        .lies({{1, -1, 0, 0}, {p.node, p.foot, -1, -1}, 2}, plane.end_normal);
  }
}

namespace {

constexpr long kGroupsOfAThread = 500, kEdgesOfAThread = 1000;  ///< fewer are not worth another thread

/// Appends what another thread has found.
void join(const Narrow& share, Narrow& result) {
  const int rubs = static_cast<int>(result.rubs.size());
  for (const ContactPair& pair : share.pairs) {
    result.pairs.push_back(pair);
    if (pair.rub >= 0) result.pairs.back().rub += rubs;
  }
  result.rubs.insert(result.rubs.end(), share.rubs.begin(), share.rubs.end());
  result.close.insert(result.close.end(), share.close.begin(), share.close.end());
}

/// Calls work(share, into, first, last) for every thread's share of `count` things, then joins what
/// they found in the order of the things. together(i): i belongs to the share of i - 1.
template <class Together, class Work> void share_out(Team& team, long count, long least, Together&& together, Narrow& result, Work&& work) {
  const long shares = std::max(1L, std::min<long>(team.size(), count / least));
  if (shares == 1) return work(0, result, 0, count);
  result.shares.resize(shares - 1);
  std::vector<long> start(shares + 1, count);
  for (long s = 0; s < shares; ++s)
    for (start[s] = s * count / shares; start[s] > 0 && start[s] < count && together(start[s]);) ++start[s];
  team.share(shares, 1, [&](long first, long last) {
    for (long s = first; s < last; ++s) {
      if (s > 0) result.shares[s - 1].pairs.clear(), result.shares[s - 1].rubs.clear(), result.shares[s - 1].close.clear();
      work(static_cast<int>(s), s == 0 ? result : result.shares[s - 1], start[s], start[s + 1]);
    }
  });
  for (const Narrow& share : result.shares) join(share, result);
}

}  // namespace

void narrow_phase(const PairConstants& constants, const std::vector<PlanePose>& planes, bool all, double reach, double travel, Team& team,
                  NearList& list, Narrow& result) {
  result.pairs.clear();
  result.rubs.clear();
  result.close.clear();
  add_plane_pairs(constants.features, constants.work, planes, constants.layer, reach, list, result.pairs);
  for (ContactPair& pair : result.pairs) constants.set(pair, result.rubs);
  // Distances are computed to rounding; the factor keeps the bound on its safe side.
  const double awake = (travel + reach) * (1 + 1e-12);
  std::vector<std::vector<ContactPair>> corners(team.size());
  const auto same_vertex = [&](long i) { return list.groups[i].vertex == list.groups[i - 1].vertex; };
  share_out(team, static_cast<long>(list.groups.size()), kGroupsOfAThread, same_vertex, result, [&](int share, Narrow& into, long first, long last) {
    Phase phase(constants, all, into);
    for (long i = first; i < last; ++i)
      if (list.groups[i].wake <= awake) phase.group(list, static_cast<int>(i), reach, travel, awake);
    phase.finish_vertex();
    corners[share].swap(phase.corners());
  });
  for (std::size_t s = 1; s < corners.size(); ++s) corners[0].insert(corners[0].end(), corners[s].begin(), corners[s].end());
  Phase(constants, all, result).finish_corners(corners[0]);
  share_out(team, static_cast<long>(list.edges.size()), kEdgesOfAThread, [](long) { return false; }, result, [&](int, Narrow& into, long first, long last) {
    Phase phase(constants, all, into);
    for (long i = first; i < last; ++i)
      if (list.edge_wake[i] <= awake) list.edge_wake[i] = travel + phase.edges(list, static_cast<int>(i), reach);
  });
}

}  // namespace forming_sim
