#include "forming_sim/contact/narrow.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "forming_sim/contact/closest.h"
#include "forming_sim/contact/closest_pack.h"
#include "forming_sim/contact/impulse.h"
#include "forming_sim/contact/levers.h"

namespace forming_sim {

struct NarrowRoom {
  struct Candidate {
    int group, entry;
  };
  struct Hit {
    Closest closest;
    double distance = 0;
    int entry = -1;
    long candidate = -1;
    std::uint64_t feature = 0;
    bool taken = false;
    Hit() {}  // without it all is set to zero before
  };
  std::vector<Candidate> candidates;  ///< listed pairs that are awake, group by group
  std::vector<FacePack> faces;        ///< the same in lanes
  std::vector<Hit> hits;              ///< of a group
  LargeArray<ContactPair> corners;    ///< pairs of two vertices
};

namespace {

NarrowRoom& room_of(Narrow& narrow) {
  if (!narrow.room) narrow.room = std::make_shared<NarrowRoom>();
  return *narrow.room;
}

// Slope up to which facets count as level, when it is asked whether a feature
// is the nearest of its surface. Between vertices of one surface a hollow of the
// layer's own depth counts as level too: a pressed layer is that wavy, and pairs
// that came and went with the waves would lose their potential each time.
constexpr double kWedge = 1e-3;
constexpr double kAside = 1e-3;  ///< of h0: so far from its layer a pair ends at least that is set aside

bool rising(const ContactPair& a, const ContactPair& b) { return a.key < b.key; }

/// Outside of all layers.
bool is_clear(const Range& range, double distance) { return distance > range.thickest * (1 + 1e-12); }
bool all_stand(const Workspace& work, const int* nodes, int count) {
  return std::all_of(nodes, nodes + count, [&](int i) { return work.stands[i] != 0; });
}

const ClosestKernels& widest_kernels() {
  static const ClosestKernels& kernels = closest_kernels_of(choose_isa());
  return kernels;
}

constexpr int kFacetsAtOnce = 64;  ///< whose closest points are found together, or a few more
constexpr int kEdgesAtOnce = 64;

class Phase {
 public:
  Phase(const PairConstants& constants, const Layers* layers, bool all, const Range& range, Narrow& result)
      : constants_(constants), layers_(layers), f_(constants.features), work_(constants.work), layer_(constants.layer), all_(all), range_(range), awake_((range.travel + range.reach) * (1 + 1e-12)), out_(result), room_(room_of(result)), finished_(result.pairs.size()) {}

  /// Looks at the facets that are awake of the groups first ... last - 1; of those out of reach it sets when they need be looked
  /// at again: the others will be awake in the next step too, and what is not written costs less.
  void vertices(NearList& list, long first, long last) {
    for (long i = first; i < last; ++i) {
      NearList::VertexGroup& g = list.groups[i];
      if (g.wake > awake_ || (is_clear(range_, g.rest) && stands(list, g))) continue;
      if (candidates_.size() >= kFacetsAtOnce) meet_facets(list);
      for (int e = g.first; e < g.last; ++e)
        if (list.facets[e].wake <= awake_) candidates_.push_back({static_cast<int>(i), e});
    }
    meet_facets(list);
    finish_vertex();
  }

  /// Likewise at pairs of edges that are watched.
  void edges(NearList& list, long first, long last) {
    int awake[kEdgesAtOnce], count = 0;
    for (long i = first; i < last; ++i) {
      awake[count] = static_cast<int>(i);
      const NearList::EdgePair& e = list.watched[i];
      count += e.wake <= awake_ && !(is_clear(range_, e.rest) && stands(e));
      if (count == kEdgesAtOnce) meet_edges(list, awake, count), count = 0;
    }
    meet_edges(list, awake, count);
  }

  /// Before the next vertex, or at the end of all: in their order, complete.
  void finish_vertex() {
    LargeArray<ContactPair>& all = out_.pairs;
    const auto first = all.begin() + static_cast<long>(finished_);
    if (!std::is_sorted(first, all.end(), rising)) std::sort(first, all.end(), rising);
    finish();
  }
  /// After all vertices, before the edges: pairs of two vertices, found from either side.
  void finish_corners(LargeArray<ContactPair>& corners) {
    put_in_order(corners);
    out_.pairs.insert(out_.pairs.end(), corners.begin(), corners.end());
    finish();
  }
  void finish_planes() {
    for (ContactPair& pair : out_.pairs) take(pair);
    finish();
  }
  void finish() {
    for (; finished_ < out_.pairs.size(); ++finished_) {
      ContactPair& pair = out_.pairs[finished_];
      constants_.finish(pair, out_.rubs);
      if (!(pair.w > 0)) out_.unmovable.push_back(static_cast<long>(finished_));
      if (layers_ && layers_->give(pair, out_.rubs, place_)) out_.born.push_back(static_cast<long>(finished_));
    }
  }

 private:
  using Candidate = NarrowRoom::Candidate;
  using Hit = NarrowRoom::Hit;

  // The closest points of the candidates, in lanes; then group by group what they are.
  void meet_facets(NearList& list) {
    const long count = static_cast<long>(candidates_.size());
    const size_t packs = (count + kLanes - 1) / kLanes;
    if (faces_.size() < packs) faces_.resize(packs);
    for (size_t p = 0; p < packs; ++p) {
      for (int l = 0; l < kLanes; ++l) {
        const Candidate& c = candidates_[std::min<long>(p * kLanes + l, count - 1)];
        faces_[p].point[l] = list.groups[c.group].node;
        faces_[p].corner[l] = list.facets[c.entry].node;
      }
    }
    (f_.dimension == 2 ? kernels_.segments : kernels_.faces)(work_.x.front().data(), &work_.share.front().inverse_mass, faces_.data(), static_cast<long>(packs));
    for (long i = 0; i < count;) {
      const int group = candidates_[i].group;
      NearList::VertexGroup& g = list.groups[group];
      hits_.clear();
      for (; i < count && candidates_[i].group == group; ++i) {
        NearList::FacetEntry& e = list.facets[candidates_[i].entry];
        const double distance = std::sqrt(faces_[i / kLanes].squared[i % kLanes]);
        if (distance > range_.reach) {
          e.wake = range_.travel + distance;
          continue;
        }
        hits_.emplace_back();
        Hit& hit = hits_.back();
        take(faces_[i / kLanes], static_cast<int>(i % kLanes), hit.closest);
        hit.distance = distance;
        hit.entry = candidates_[i].entry;
        hit.candidate = i;
        hit.feature = feature_of(hit.closest, e.facet);
        watch_touch(candidates_[i].entry, group, distance);
      }
      g.rest = 0;
      if (hits_.empty()) {
        g.wake = std::numeric_limits<double>::infinity();
        for (int e = g.first; e < g.last; ++e) g.wake = std::min(g.wake, list.facets[e].wake);
        continue;
      }
      if (stands(list, g)) {
        const double least = std::min_element(hits_.begin(), hits_.end(), [](const Hit& a, const Hit& b) { return a.distance < b.distance; })->distance;
        if (is_clear(range_, least)) {
          g.rest = least;
          continue;  // none of its pairs is one, see add()
        }
      }
      if (g.vertex != vertex_) finish_vertex();
      vertex_ = g.vertex;
      choose(list, g);
    }
    candidates_.clear();
  }

  void take(const FacePack& found, int lane, Closest& c) const {
    const Node apart(found.apart[0][lane], found.apart[1][lane], found.apart[2][lane], 0);
    if (f_.dimension == 2) lie_on_segment(found.beta[lane], apart, c);
    else if (found.inside[lane] != 0) lie_in_face(found.beta[lane], found.gamma[lane], apart, c);
    else lie_on_border(static_cast<int>(found.side[lane]), found.s[lane], apart, c);
  }

  void meet_edges(NearList& list, const int* awake, int count) {
    EdgePack packs[kEdgesAtOnce / kLanes];
    const int filled = (count + kLanes - 1) / kLanes;
    for (int i = 0; i < filled * kLanes; ++i) packs[i / kLanes].node[i % kLanes] = list.watched[awake[std::min(i, count - 1)]].node;
    kernels_.edges(work_.x.front().data(), &work_.share.front().inverse_mass, kWedge, packs, filled);
    for (int i = 0; i < count; ++i) {
      const EdgePack& pack = packs[i / kLanes];
      const int l = i % kLanes;
      const double distance = pack.distance[l];
      NearList::EdgePair& e = list.watched[awake[i]];
      if (distance > range_.reach) e.wake = range_.travel + distance;
      else watch_touch(awake[i], -1, distance);
      e.rest = is_clear(range_, distance) && stands(e) ? distance : 0;
      if (pack.inside[l] != 0 && e.rest == 0) cross(e, pack, l);  // of others vertices see the end that is closest
    }
  }

  bool stands(const NearList& list, const NearList::VertexGroup& g) const {
    if (work_.stands[g.node] == 0) return false;
    const auto first = list.facets.begin() + g.first, last = list.facets.begin() + g.last;
    return std::all_of(first, last, [&](const NearList::FacetEntry& e) { return all_stand(work_, e.node, f_.corners()); });
  }
  bool stands(const NearList::EdgePair& e) const { return all_stand(work_, e.node, 4); }

  void watch_touch(int entry, int group, double distance) {
    if (0.999 * distance <= range_.closing) out_.close.emplace_back(entry, group, distance);
  }

  void cross(const NearList::EdgePair& e, const EdgePack& pack, int l) {
    const double distance = pack.distance[l];
    const bool askew = pack.outside[l] == 0;
    if (distance > range_.reach || !(distance > 0) || !offered(askew, distance)) return;
    const double s = pack.s[l], t = pack.t[l];
    const Node normal = node(pack.normal[0][l], pack.normal[1][l], pack.normal[2][l]);
    if (lies_over(f_.edges[e.second], t, distance * normal)) return;
    out_.pairs.emplace_back(PairKey::make(PairKey::edge_edge, e.first, 0, e.second), e.own, e.surface, distance, askew, normal);
    ContactPair& pair = out_.pairs.back();
    pair.link({e.node[0], e.node[1], e.node[2], e.node[3]}, 1 - s, s, t - 1, -t);
    const bool first_on_held = leave_to_held(work_, 0, 2, pair), second_on_held = leave_to_held(work_, 2, 4, pair);
    if (set_aside(pair)) {
      out_.pairs.pop_back();
      return;
    }
    if (first_on_held || second_on_held) take(pair);
    else take(pack.shares, l, pair);
    finish();
  }

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
      nearest_held = nearest_held || hits_[i].closest.squared <= near2;
      if (!lies_over_joint(hits_[i])) add(list, g, hits_[i]);
    }
    if (!nearest_held && !lies_over_joint(hits_[nearest])) add(list, g, hits_[nearest]);
  }

  /// The vertex is still on the other side of a joint of two tools, of which this is the edge: the other tool has it.
  bool lies_over_joint(const Hit& hit) const {
    const Closest& c = hit.closest;
    if (f_.joint_vertex.empty() || c.feature == Closest::face) return false;
    const int id = static_cast<int>(hit.feature & 0xffffffffu);
    if (c.feature == Closest::edge) return lies_over(f_.edges[id], c.weight[c.which == 2 ? 2 : c.which + 1], c.apart);
    const int joint = f_.rigid(id) ? f_.joint_vertex[id - f_.body_nodes] : -1;
    return joint >= 0 && f_.joint_parts[joint].is_over(0, c.apart, kWedge);
  }
  /// Of a joint, also where it has opened: a vertex between the two tools has nothing but their edges to stand on.
  bool over_slit(const Hit& hit) const {
    if (f_.joint_vertex.empty() || hit.closest.feature == Closest::face) return false;
    const int id = static_cast<int>(hit.feature & 0xffffffffu);
    if (hit.closest.feature == Closest::edge) return f_.edges[id].first_joint >= 0;
    return f_.rigid(id) && f_.joint_vertex[id - f_.body_nodes] != Features::kNoJoint;
  }
  bool lies_over(const Features::Edge& edge, double s, const Node& apart) const {
    for (int j = 0; j < edge.joints; ++j)
      if (f_.joint_parts[edge.first_joint + j].is_over(s, apart, kWedge)) return true;
    return false;
  }

  void add(const NearList& list, const NearList::VertexGroup& g, const Hit& hit) {
    const NearList::FacetEntry& e = list.facets[hit.entry];
    const Closest& c = hit.closest;
    int own = f_.vertex_surface[g.vertex], surface = g.surface;
    int first = g.vertex, second = static_cast<int>(hit.feature & 0xffffffffu);
    const bool corners = c.feature == Closest::corner, turned = corners && second < first;
    const int other = e.node[corners ? c.which : 0];
    Node d = c.apart;
    if (corners) d = turned ? work_.x[other] - work_.x[g.node] : work_.x[g.node] - work_.x[other];  // the same bits from both sides
    const double gap = corners ? std::sqrt(dot3(d, d)) : hit.distance;
    if (!(gap > 0)) return;  // no direction; the start check and the continuous check exclude it
    const Node normal = d / gap;
    bool askew = false;
    // Seen from the vertex, is the other feature's point the nearest too?
    const Node& from = work_.x[g.node];
    const double sense = turned ? -1 : 1;
    for (int i = g.near_first; i < g.near_last; ++i) {
      const Node along = work_.x[list.neighbours[i]] - from;
      const double nearer = -sense * dot3(normal, along) - layer_;
      if (nearer > 0 && nearer * nearer > kWedge * kWedge * dot3(along, along)) askew = true;
    }
    if (!offered(askew && !over_slit(hit), gap)) return;
    if (turned) {  // the same pair is found from both sides
      std::swap(first, second);
      std::swap(own, surface);
    }
    LargeArray<ContactPair>& pairs = corners ? corners_ : out_.pairs;
    pairs.emplace_back(corners ? PairKey::make(PairKey::vertex_vertex, first, 0, second) : PairKey::make(PairKey::vertex_facet, first, c.feature, second), own,
                       surface, gap, askew, normal);
    ContactPair& pair = pairs.back();
    if (c.feature == Closest::face) {
      if (f_.dimension == 2) pair.link({g.node, e.node[0], e.node[1]}, 1, -c.weight[0], -c.weight[1]);
      else pair.link({g.node, e.node[0], e.node[1], e.node[2]}, 1, -c.weight[0], -c.weight[1], -c.weight[2]);
    } else if (corners) {
      pair.link({turned ? other : g.node, turned ? g.node : other}, 1, -1);
    } else {
      const int i = c.which == 2 ? 0 : c.which, j = c.which == 2 ? 2 : c.which + 1;
      pair.link({g.node, e.node[i], e.node[j]}, 1, -c.weight[i], -c.weight[j]);
    }
    const bool on_held = leave_to_held(work_, 1, pair.nodes, pair);
    if ((is_clear(range_, gap) && all_stand(work_, pair.node, pair.nodes)) || set_aside(pair)) pairs.pop_back();
    else if (c.feature == Closest::face && !on_held) take(faces_[hit.candidate / kLanes].shares, static_cast<int>(hit.candidate % kLanes), pair);
    else take(pair);
  }

  // What the nodes make of the pair, as lanes have found it, or here.
  void take(const SharesPack& found, int lane, ContactPair& pair) const {
    constants_.take(found.w[lane], found.area[lane], found.movers[lane], found.held[lane], pair);
  }
  void take(ContactPair& pair) const {
    const PairShares<double> sum = constants_.shares_of(pair);
    constants_.take(sum.w, sum.mean_area(), sum.movers, sum.held, pair);
  }

  bool set_aside(const ContactPair& pair) {
    if (all_ || !layers_ || range_.dt == 0 || !is_clear(range_, pair.gap)) return false;
    const double opening = dot3(pair.normal, relative(pair, work_.v)), layer = std::max(layer_, layers_->raised(std::max(0.0, -opening)));
    if (pair.gap <= layer || pair.gap + range_.dt * opening <= layer + kAside * layer_) return false;
    out_.aside.emplace_back(pair, pair.normal, pair.gap, layer);
    return true;
  }

  bool offered(bool askew, double gap) const { return all_ || !askew || gap < layer_ / 2; }

  const PairConstants& constants_;
  const Layers* layers_;
  const Features& f_;
  const Workspace& work_;
  double layer_;
  bool all_;
  const Range range_;
  const double awake_;  ///< entries that wake later sleep; distances are computed to rounding, the factor keeps the bound on its safe side
  Narrow& out_;
  const ClosestKernels& kernels_ = widest_kernels();
  NarrowRoom& room_;
  std::vector<Candidate>& candidates_ = room_.candidates;
  std::vector<FacePack>& faces_ = room_.faces;
  std::vector<Hit>& hits_ = room_.hits;
  LargeArray<ContactPair>& corners_ = room_.corners;
  int vertex_ = -1;                   ///< whose pairs are being found
  size_t finished_;                   ///< so many pairs are in order and complete
  Layers::Place place_;
};

}  // namespace

void Narrow::clear() {
  pairs.clear();
  born.clear();
  unmovable.clear();
  rubs.clear();
  aside.clear();
  close.clear();
  if (room) room->corners.clear();
}

void put_in_order(LargeArray<ContactPair>& pairs) {
  std::sort(pairs.begin(), pairs.end(), rising);
  pairs.erase(std::unique(pairs.begin(), pairs.end(), [](const ContactPair& a, const ContactPair& b) { return a.key == b.key; }), pairs.end());
}

// Of a point x and its foot f on the plane, which go to x1 and f1: along the normal n1 with which the
// step ends, (x - f) . n1 + (v_x - v_f) . n1 dt = (x1 - f1) . n1 is the gap at the end itself, as f1
// lies on the plane, however far both slide and the plane turns.
void add_plane_pairs(const Features& features, const Workspace& work, const std::vector<PlanePose>& planes, const Range& range,
                     const NearList& list, LargeArray<ContactPair>& pairs) {
  for (const NearList::PlanePair& p : list.planes) {
    const PlanePose& plane = planes[p.tool];
    const double gap = dot3(work.x[p.node] - plane.point, plane.normal) * dot3(plane.normal, plane.end_normal);
    const int nodes[2] = {p.node, p.foot};
    if (gap > range.reach || (is_clear(range, gap) && all_stand(work, nodes, 2))) continue;
    pairs.emplace_back(PairKey::make(PairKey::plane, p.vertex, 0, p.tool), features.vertex_surface[p.vertex], features.bodies + p.tool, gap, false, plane.end_normal);
    pairs.back().link({p.node, p.foot}, 1, -1);
  }
}

namespace {

constexpr long kGroupsOfAThread = 1500, kEdgesOfAThread = 2000;  ///< fewer are not worth another thread

/// Appends what another thread has found.
void join(const Narrow& share, Narrow& result) {
  const int rubs = static_cast<int>(result.rubs.size());
  const long pairs = static_cast<long>(result.pairs.size());
  for (long i : share.born) result.born.push_back(pairs + i);
  for (long i : share.unmovable) result.unmovable.push_back(pairs + i);
  for (const ContactPair& pair : share.pairs) {
    result.pairs.push_back(pair);
    if (pair.rub >= 0) result.pairs.back().rub += rubs;
  }
  result.rubs.insert(result.rubs.end(), share.rubs.begin(), share.rubs.end());
  result.aside.insert(result.aside.end(), share.aside.begin(), share.aside.end());
  result.close.insert(result.close.end(), share.close.begin(), share.close.end());
  room_of(result).corners.insert(room_of(result).corners.end(), share.room->corners.begin(), share.room->corners.end());
}

/// Calls work(into, first, last) for every thread's share of `count` things, then joins what
/// they found in the order of the things. together(i): i belongs to the share of i - 1.
template <class Together, class Work> void share_out(Team& team, long count, long least, Together&& together, Narrow& result, Work&& work) {
  const long shares = std::max(1L, std::min<long>(team.size(), count / least));
  if (shares == 1) return work(result, 0, count);
  if (static_cast<long>(result.shares.size()) < shares - 1) result.shares.resize(shares - 1);
  std::vector<long> start(shares + 1, count);
  for (long s = 0; s < shares; ++s)
    for (start[s] = s * count / shares; start[s] > 0 && start[s] < count && together(start[s]);) ++start[s];
  team.share(shares, 1, [&](long first, long last) {
    for (long s = first; s < last; ++s) {
      if (s > 0) result.shares[s - 1].clear();
      work(s == 0 ? result : result.shares[s - 1], start[s], start[s + 1]);
    }
  });
  for (long s = 0; s + 1 < shares; ++s) join(result.shares[s], result);
}

}  // namespace

void narrow_phase(const PairConstants& constants, const Layers* layers, const std::vector<PlanePose>& planes, bool all, const Range& range, Team& team,
                  NearList& list, Narrow& result) {
  result.clear();
  Phase on_planes(constants, layers, all, range, result);
  add_plane_pairs(constants.features, constants.work, planes, range, list, result.pairs);
  on_planes.finish_planes();
  const auto same_vertex = [&](long i) { return list.groups[i].vertex == list.groups[i - 1].vertex; };
  share_out(team, static_cast<long>(list.groups.size()), kGroupsOfAThread, same_vertex, result, [&](Narrow& into, long first, long last) {
    Phase(constants, layers, all, range, into).vertices(list, first, last);
  });
  Phase(constants, layers, all, range, result).finish_corners(room_of(result).corners);
  list.watch(range.reach, range.travel);
  share_out(team, static_cast<long>(list.watched.size()), kEdgesOfAThread, [](long) { return false; }, result, [&](Narrow& into, long first, long last) {
    Phase(constants, layers, all, range, into).edges(list, first, last);
  });
}

}  // namespace forming_sim
