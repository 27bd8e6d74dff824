#include "forming_sim/contact/alike.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "forming_sim/contact/closest.h"

namespace forming_sim {
namespace {

constexpr double kTurned = 1e-4;  ///< 1 - |n.n'|
constexpr double kNearer = 0.01;  ///< of the smaller gap
constexpr double kThinner = 1e-6; ///< of the layer
constexpr double kPressed = 0.5;  ///< of the layer: pairs with less gap hold each its own, that none of them comes to nothing unseen

double weight_of(const ContactPair& pair, int node) {
  for (int k = 0; k < pair.nodes; ++k)
    if (pair.node[k] == node) return std::abs(pair.weight[k]);
  return 0;
}
/// What `a` moves moves `b` as much.
bool moves_alike(const ContactPair& a, const ContactPair& b) {
  for (int k = 0; k < a.nodes; ++k)
    if ((a.movers >> k & 1) && std::abs(std::abs(a.weight[k]) - weight_of(b, a.node[k])) > kAtEnd) return false;
  return true;
}
bool are_alike(const ContactPair& a, const ContactPair& b) {
  return a.w > 0 && b.w > 0 && (a.rub < 0) == (b.rub < 0) && std::min(a.gap, b.gap) > kPressed * a.layer && std::abs(a.gap - b.gap) <= kNearer * std::min(a.gap, b.gap) && std::abs(a.layer - b.layer) <= kThinner * a.layer &&
         std::abs(dot3(a.normal, b.normal)) >= 1 - kTurned && moves_alike(a, b) && moves_alike(b, a);
}

void hand_over(ContactPair& from, ContactPair& to, std::vector<Rub>& rubs) {
  to.stiffness += from.stiffness;
  to.impulse += from.impulse;
  from.stiffness = from.impulse = from.w = 0;
  if (from.rub < 0) return;
  Rub &given = rubs[from.rub], &all = rubs[to.rub];
  all.slip += dot3(from.normal, to.normal) > 0 ? given.slip : Node(-given.slip);
  all.before += given.before;
  all.beta += given.beta;
  given.slip = Node::Zero();
  given.before = given.beta = 0;
}

}  // namespace

AlikePairs::First& AlikePairs::first_of(int vertex, int edge) {
  const std::uint64_t hash = (static_cast<std::uint64_t>(vertex) << 32 | static_cast<std::uint32_t>(edge)) * 0x9e3779b97f4a7c15u;
  std::size_t at = static_cast<std::size_t>(hash >> 32) & (table_.size() - 1);
  while (table_[at].pair && (table_[at].vertex != vertex || table_[at].edge != edge)) at = (at + 1) & (table_.size() - 1);
  return table_[at];
}

void AlikePairs::join(const Workspace& work, LargeArray<ContactPair>& pairs, std::vector<Rub>& rubs) {
  const auto edges = std::partition_point(pairs.begin(), pairs.end(), [](const ContactPair& p) { return p.key.kind() != PairKey::edge_edge; });
  const auto ends = [](const ContactPair& pair, int k) { return std::abs(pair.weight[k]) >= 1 - kAtEnd; };
  std::size_t count = 0;
  for (auto pair = edges; pair != pairs.end(); ++pair)
    for (int k = 0; k < 4; ++k) count += ends(*pair, k);
  if (count == 0) return;
  std::size_t size = 16;
  while (size < 2 * count) size *= 2;
  table_.assign(size, First());
  for (auto pair = edges; pair != pairs.end(); ++pair)
    for (int k = 0; k < 4; ++k) {
      if (!ends(*pair, k)) continue;
      const int vertex = work.vertex[pair->node[k]], edge = k < 2 ? pair->key.second() : pair->key.first();
      const PairKey key = PairKey::make(PairKey::vertex_facet, vertex, Closest::edge, edge);
      const auto of_vertex = std::lower_bound(pairs.begin(), edges, key, [](const ContactPair& p, const PairKey& sought) { return p.key < sought; });
      ContactPair* other = of_vertex != edges && of_vertex->key == key ? &*of_vertex : nullptr;
      if (!other) {
        First& first = first_of(vertex, edge);
        if (!first.pair) first = {vertex, edge, &*pair};
        other = first.pair;
      }
      if (other == &*pair || !are_alike(*other, *pair)) continue;
      hand_over(*pair, *other, rubs);
      break;
    }
}

}  // namespace forming_sim
