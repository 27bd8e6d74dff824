#include "forming_sim/contact/sticking.h"

#include <algorithm>
#include <cmath>

#include "forming_sim/contact/levers.h"

namespace forming_sim {

Sticking::Sticking(const Features& features) {
  any_ = std::any_of(features.relations.begin(), features.relations.end(), [](const Features::Relation& relation) { return relation.sticks_by >= 0; });
}

void Sticking::leave_to_one_side(const Features& features, const Workspace& work, double layer, LargeArray<ContactPair>& pairs, std::vector<Rub>& rubs) {
  const auto by = [&](const ContactPair& pair) { return features.relation(pair.own, pair.surface).sticks_by; };
  sticks_.assign(work.x.size(), 0);
  for (const ContactPair& pair : pairs)
    if (pair.rub >= 0 && pair.key.kind() == PairKey::vertex_facet && pair.own == by(pair) && pair.gap < layer) sticks_[pair.node[0]] = 1;
  for (ContactPair& pair : pairs) {
    const int one = by(pair);
    if (one < 0 || pair.rub < 0) continue;
    if (Node& start = rubs[pair.rub].slip; pair.held && !start.isZero(0)) start = moving_part(work, pair, start);
    if (pair.key.kind() == PairKey::vertex_vertex || (pair.key.kind() == PairKey::vertex_facet && pair.own == one)) continue;
    int first = 1, end = pair.nodes;  // of the nodes of the surface that sticks
    if (pair.key.kind() == PairKey::edge_edge) {
      const int other = pair.own == one ? 2 : 0;
      if (std::max(std::abs(pair.weight[other]), std::abs(pair.weight[other + 1])) < 1 - kAtEnd) continue;
      first = 2 - other, end = first + 2;
    }
    if (std::any_of(pair.node + first, pair.node + end, [&](int n) { return sticks_[n] != 0; })) pair.rub = -1;
  }
}

}  // namespace forming_sim
