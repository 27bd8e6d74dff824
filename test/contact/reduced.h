#pragma once
// A step of mild contact put together from the package's parts, with only those
// pairs that the test leaves in and no continuous check: what each safeguard is
// worth shows when it is missing. Tools stand where they are given, not set back.
#include "contact/give_layers.h"
#include "contact/point_bodies.h"
#include "forming_sim/contact/crossing.h"
#include "forming_sim/contact/layers.h"
#include "forming_sim/contact/narrow.h"
#include "forming_sim/contact/sweeps.h"

namespace contact_test {

class Reduced {
 public:
  /// Takes away from the pairs of a step.
  using Reduce = std::function<void(const Workspace&, LargeArray<ContactPair>&)>;

  Reduced(const World& world, Reduce reduce) : reduce_(std::move(reduce)), layer_(world.config.layer) {
    features_ = build_features(world.setup(), world.x);
  }

  void step(World& world, double dt) {
    world.spring_forces();
    double fastest = 0;
    for (size_t i = 0; i < world.x.size(); ++i) {
      world.v[i] += dt / world.mass[i] * world.force[i];
      fastest = std::max(fastest, world.v[i].norm());
    }
    const std::vector<ToolMotion> motion = world.motion(world.time, world.time + dt);
    double tool_way = 0;
    for (const ToolMotion& m : motion) tool_way = std::max(tool_way, (m.position1 - m.position0).norm());
    const double reach = 2 * layer_ + 4 * fastest * dt + 2 * tool_way;
    const std::vector<bool> present(motion.size(), true), is_plane(motion.size(), false);
    const std::vector<PlanePose> planes(motion.size());
    NearList list = build_list(features_, world.x, {ToolIndex(features_, features_.place, present), motion, present, is_plane, planes}, {}, reach, work_);
    const NodeField start = place(motion, false), end = place(motion, true);
    for (size_t i = 0; i < work_.vertex.size(); ++i) {
      const int v = work_.vertex[i];
      const bool rigid = features_.rigid(v);
      work_.x[i] = rigid ? start[v - features_.body_nodes] : world.x[v];
      work_.v[i] = rigid ? Node((end[v - features_.body_nodes] - work_.x[i]) / dt) : world.v[v];
      work_.share[i].inverse_mass = rigid ? 0 : 1 / world.mass[v];
    }
    narrow_phase({features_, work_, world.modulus, layer_}, nullptr, planes, true, {reach, 0, 0}, team_, list, near_);
    if (reduce_) reduce_(work_, near_.pairs);
    give_layers({records_, {}, work_, dt, dt, layer_, layer_}, near_.pairs, near_.rubs);
    sweeps_.solve(dt, 1e-3 * layer_, 50, work_, ties_, near_.pairs, near_.rubs, none_driven_);
    RelaxedPotential potential;
    records_.resize(static_cast<long>(near_.pairs.size()), !near_.rubs.empty());
    long kept = 0;
    sweeps_.take_back(0, static_cast<long>(near_.pairs.size()), near_.pairs, near_.rubs);
    for (ContactPair& pair : near_.pairs)
      if (relax_layer(layer_, .1 * dt, pair, potential)) records_.put(kept++, pair, near_.rubs, dt);
    records_.resize(kept, !near_.rubs.empty());
    for (int i = 0; i < work_.body_entries; ++i) world.v[work_.vertex[i]] = work_.v[i];
    for (size_t i = 0; i < world.x.size(); ++i) world.x[i] += dt * world.v[i];
    world.time += dt;
    active += static_cast<long>(std::count_if(near_.pairs.begin(), near_.pairs.end(), [](const ContactPair& p) { return p.impulse > 0; }));
    crossings += static_cast<long>(find_crossings(features_, world.x, end, present, is_plane, planes).size());
  }

  long crossings = 0, active = 0;  ///< sums over all steps

 private:
  NodeField place(const std::vector<ToolMotion>& motion, bool at_end) const {
    NodeField places = features_.place;
    for (size_t t = 0; t < motion.size(); ++t)
      for (int v : features_.surfaces[features_.bodies + t].vertices)
        places[v - features_.body_nodes] += node(at_end ? motion[t].position1 : motion[t].position0);
    return places;
  }

  Reduce reduce_;
  double layer_;
  Features features_;
  Workspace work_;
  Narrow near_;
  Team team_{1};
  Sweeps sweeps_{team_};
  std::vector<TiePair> ties_;
  std::vector<DrivenTool> none_driven_;
  PairRecords records_;
};

// ---- reductions

inline void drop(LargeArray<ContactPair>& pairs, const std::function<bool(const ContactPair&)>& which) {
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), which), pairs.end());
}
inline bool is_edge_pair(const ContactPair& pair) { return pair.key.kind() == PairKey::edge_edge; }

inline void without_edges(const Workspace&, LargeArray<ContactPair>& pairs) { drop(pairs, is_edge_pair); }

/// Without pairs of edges at an angle below `least`, rad.
inline Reduced::Reduce without_parallel_edges(double least) {
  return [least](const Workspace& work, LargeArray<ContactPair>& pairs) {
    drop(pairs, [&](const ContactPair& p) {
      if (!is_edge_pair(p)) return false;
      const Node u = work.x[p.node[1]] - work.x[p.node[0]], v = work.x[p.node[3]] - work.x[p.node[2]];
      const double c = u.dot(v) / (u.norm() * v.norm());
      return 1 - c * c < least * least;
    });
  };
}

/// Two pairs of one vertex with facets or vertices, or of one edge.
inline bool same_vertex(const ContactPair& a, const ContactPair& b) { return is_edge_pair(a) == is_edge_pair(b) && a.key.first() == b.key.first(); }

/// Of every vertex its nearest feature alone, as a search for the closest point gives it.
inline void nearest_only(const Workspace&, LargeArray<ContactPair>& pairs) {
  const LargeArray<ContactPair> all = pairs;
  drop(pairs, [&](const ContactPair& p) {
    return std::any_of(all.begin(), all.end(), [&](const ContactPair& o) { return same_vertex(o, p) && (o.gap < p.gap || (o.gap == p.gap && o.key < p.key)); });
  });
}

/// Without pairs whose first feature is a tool's vertex.
inline void without_tool_nodes(const Workspace& work, LargeArray<ContactPair>& pairs) {
  drop(pairs, [&](const ContactPair& p) { return !is_edge_pair(p) && p.node[0] >= work.body_entries; });
}

}  // namespace contact_test
