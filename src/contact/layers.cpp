#include "forming_sim/contact/layers.h"

#include <algorithm>

#include "forming_sim/contact/closest.h"
#include "forming_sim/contact/impulse.h"
#include "forming_sim/contact/law.h"

namespace forming_sim {
namespace {

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
  all[0] = {tag + pair.key.first(), pair.surface};
  all[1] = {tag + pair.key.second(), pair.own};
  return edges || pair.key.kind() == PairKey::vertex_vertex ? 2 : 1;
}

/// The records whose pairs are gone, by their meetings; each may be taken once.
class Left {
 public:
  Left(const LargeArray<PairRecord>& before, const LargeArray<ContactPair>& pairs) {
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

/// The record of a key: whether there is one, and its place. Before the first call the place is -1; keys rise from call to call.
inline bool find(const LargeArray<PairRecord>& records, const PairKey& key, long& place) {
  const long count = static_cast<long>(records.size());
  if (place < 0) place = std::lower_bound(records.begin(), records.end(), key, [](const PairRecord& r, const PairKey& k) { return r.key < k; }) - records.begin();
  while (place < count && records[place].key < key) ++place;
  return place < count && records[place].key == key;
}

}  // namespace

bool Layers::give(ContactPair& pair, std::vector<Rub>& rubs, Place& place) const {
  const bool known = find(before_.pairs, pair.key, place.before);
  const bool pressed = tried_ ? find(last_try_.pairs, pair.key, place.last_try) : known;
  const double base = pair.base(full_);
  pair.impulse = 0;
  if (pressed && pair.w > 0) {
    const long last = tried_ ? place.last_try : place.before;
    pair.impulse = lasts_ * last_try_.pairs[last].force;
    if (pair.rub >= 0 && !last_try_.drags.empty()) {
      const double(&drag)[3] = last_try_.drags[last].force;
      rubs[pair.rub].slip = lasts_ * node(drag[0], drag[1], drag[2]);
    }
  }
  if (known && before_.pairs[place.before].inside(base)) {
    const double layer = before_.pairs[place.before].layer;
    pair.layer = pair.askew ? std::min(layer, base) : layer;
    return false;
  }
  if (pair.gap < base) {
    pair.layer = pair.gap;
    return true;
  }
  const double closing = std::max(0.0, -dot3(pair.normal, relative(pair, work_.v)));
  pair.layer = std::max(base, std::min(pair.gap, raised(closing)));
  return false;
}

void Layers::hand_over(const std::vector<long>& born, LargeArray<ContactPair>& pairs) const {
  if (born.empty()) return;
  Left left(before_.pairs, pairs);
  for (long i : born) left.inherit(pairs[i]);
}

void PairRecords::put(long i, const ContactPair& pair, const std::vector<Rub>& rubs, double dt) {
  pairs[i] = {pair.key, pair.own, pair.surface, pair.layer, pair.end_gap, pair.impulse / dt};
  if (drags.empty()) return;
  const Node drag = pair.rub >= 0 ? Node(rubs[pair.rub].slip / dt) : Node(Node::Zero());
  drags[i] = {{drag[0], drag[1], drag[2]}};
}

void PairRecords::move(long from, long to, long count) {
  const auto within = [&](auto& all) {
    if (!all.empty() && to < from) std::move(all.begin() + from, all.begin() + from + count, all.begin() + to);
  };
  within(pairs);
  within(drags);
}

bool relax_layer(double full, double growth, ContactPair& pair, RelaxedPotential& potential) {
  const double base = pair.base(full), old = pair.layer, before = mild_potential(pair.end_gap, old, pair.stiffness);
  pair.layer = old < base ? std::min(base, old + growth) : std::max(base, old - growth);
  potential.before += before;
  potential.after += pair.layer == old ? before : mild_potential(pair.end_gap, pair.layer, pair.stiffness);
  return pair.end_gap < std::max(pair.layer, base);
}

}  // namespace forming_sim
