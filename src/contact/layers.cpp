#include "forming_sim/contact/layers.h"

#include <algorithm>
#include <mutex>

#include "forming_sim/contact/closest.h"
#include "forming_sim/contact/law.h"

namespace forming_sim {
namespace {

double closing_speed(const ContactPair& pair, const Workspace& work) {
  double vn = 0;
  for (int k = 0; k < pair.nodes; ++k) vn += pair.weight[k] * dot3(pair.normal, work.v[pair.node[k]]);
  return std::max(0.0, -vn);
}

/// A vertex (or, + kEdge, an edge) and the surface that it meets.
struct Meeting {
  std::int64_t feature;
  int surface;
  bool operator<(const Meeting& o) const { return feature != o.feature ? feature < o.feature : surface < o.surface; }
};
constexpr std::int64_t kEdge = std::int64_t{1} << 32;

// The meetings that a pair is: of its first feature with the surface of the
// second and, between two vertices or two edges, the reverse. Returns their number.
template <class PairOrRecord> int meetings(const PairOrRecord& pair, Meeting (&all)[2]) {
  const bool edges = pair.key.kind() == PairKey::edge_edge;
  const std::int64_t tag = edges ? kEdge : 0;
  all[0] = {tag + static_cast<std::int64_t>(pair.key.group & 0xffffffffu), pair.surface};
  all[1] = {tag + static_cast<std::int64_t>(pair.key.feature & 0xffffffffu), pair.own};
  return edges || pair.key.kind() == PairKey::vertex_vertex ? 2 : 1;
}

/// The records whose pairs are gone, by their meetings; each may be taken once.
class Left {
 public:
  Left(const std::vector<PairRecord>& before, const std::vector<ContactPair>& pairs) {
    size_t p = 0;
    for (const PairRecord& record : before) {
      while (p < pairs.size() && pairs[p].key < record.key) ++p;
      if (p < pairs.size() && pairs[p].key == record.key) continue;
      Meeting all[2];
      const int count = meetings(record, all);
      for (int k = 0; k < count; ++k) entries_.push_back({all[k], static_cast<int>(records_.size())});
      records_.push_back(&record);
    }
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.meeting < b.meeting || (!(b.meeting < a.meeting) && a.record < b.record); });
  }

  /// Gives the pair the layer of the one from which it is thickest, if there is any.
  void inherit(ContactPair& pair) {
    Meeting all[2];
    const int count = meetings(pair, all);
    const PairRecord** taken = nullptr;
    for (int k = 0; k < count; ++k) {
      auto e = std::lower_bound(entries_.begin(), entries_.end(), all[k], [](const Entry& a, const Meeting& m) { return a.meeting < m; });
      for (; e != entries_.end() && !(all[k] < e->meeting); ++e) {
        const PairRecord*& parent = records_[e->record];
        if (!parent) continue;
        const double layer = std::min(parent->layer, pair.gap * std::max(1.0, parent->layer / parent->gap));
        if (layer <= pair.layer) continue;
        pair.layer = layer;
        taken = &parent;
      }
    }
    if (taken) *taken = nullptr;
  }

 private:
  struct Entry {
    Meeting meeting;
    int record;
  };
  std::vector<const PairRecord*> records_;
  std::vector<Entry> entries_;
};

}  // namespace

void assign_layers(const std::vector<PairRecord>& before, const std::vector<PairRecord>& tried, const Workspace& work, double dt, double last_dt, double full, double ceiling, Team& team,
                   std::vector<ContactPair>& pairs, std::vector<Rub>& rubs) {
  const double lasts = tried.empty() ? std::min(dt, last_dt) : dt;  // of a force from which the sweeps start
  std::mutex one;
  std::vector<long> born;  // inside their layer
  const auto rising = [](const PairRecord& r, const PairKey& key) { return r.key < key; };
  team.share(static_cast<long>(pairs.size()), kPairsOfAThread, [&](long first, long last) {
    const std::vector<PairRecord>& last_try = tried.empty() ? before : tried;
    auto r = std::lower_bound(before.begin(), before.end(), pairs[first].key, rising);
    auto t = std::lower_bound(last_try.begin(), last_try.end(), pairs[first].key, rising);
    std::vector<long> inside;
    for (long i = first; i < last; ++i) {
      ContactPair& pair = pairs[i];
      while (r != before.end() && r->key < pair.key) ++r;
      while (t != last_try.end() && t->key < pair.key) ++t;
      pair.impulse = 0;
      if (t != last_try.end() && t->key == pair.key && pair.w > 0) {
        pair.impulse = lasts * t->force;
        if (pair.rub >= 0) rubs[pair.rub].slip = lasts * Node(t->drag[0], t->drag[1], t->drag[2], 0);
      }
      if (r != before.end() && r->key == pair.key) {
        pair.layer = pair.base < full ? std::min(r->layer, pair.base) : r->layer;
      } else if (pair.gap >= pair.base) {
        const double raised = std::min(ceiling, 0.1 * closing_speed(pair, work) * dt);
        pair.layer = std::max(pair.base, std::min(pair.gap, raised));
      } else {
        pair.layer = pair.gap;
        inside.push_back(i);
      }
    }
    const std::lock_guard<std::mutex> lock(one);
    born.insert(born.end(), inside.begin(), inside.end());
  });
  if (born.empty()) return;
  std::sort(born.begin(), born.end());
  Left left(before, pairs);
  for (long i : born) left.inherit(pairs[i]);
}

PairRecord record_of(const ContactPair& pair, const std::vector<Rub>& rubs, double dt) {
  const Node drag = pair.rub >= 0 ? Node(rubs[pair.rub].slip / dt) : Node(Node::Zero());
  return {pair.key, pair.own, pair.surface, pair.layer, pair.end_gap, pair.impulse / dt, {drag[0], drag[1], drag[2]}};
}

void relax_layer(double dt, double growth, const std::vector<Rub>& rubs, ContactPair& pair, RelaxedPotential& potential, std::vector<PairRecord>& after) {
  const double old = pair.layer, before = mild_potential(pair.end_gap, old, pair.stiffness);
  pair.layer = old < pair.base ? std::min(pair.base, old + growth) : std::max(pair.base, old - growth);
  potential.before += before;
  potential.after += pair.layer == old ? before : mild_potential(pair.end_gap, pair.layer, pair.stiffness);
  if (pair.end_gap < std::max(pair.layer, pair.base)) after.push_back(record_of(pair, rubs, dt));
}

}  // namespace forming_sim
