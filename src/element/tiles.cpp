// Which cells add up their forces together: element/cell_group.h.
#include <algorithm>

#include "element/group.h"

namespace forming_sim {

/// Of 512 times eight simplices at most, whose nodes a core's cache holds, or of an eighth of a small
/// group, so that there is something to share among threads, but not of much less than 64 times eight. An even number, so that two threads have as many.
int tiles_of(int blocks, int simplices_of_a_cell) {
  const auto of_eights = [&](int eights) { return std::max(1, eights / simplices_of_a_cell); };
  const int most = std::clamp((blocks + 7) / 8, of_eights(64), of_eights(512)), tiles = (blocks + most - 1) / most;
  return tiles > 1 ? tiles + tiles % 2 : tiles;
}

void Elements::lay_tiles(int nodes) {
  std::vector<int> count(nodes + 1, 0), slot(nodes), seen(nodes, -1);
  std::vector<int> node_of_slot;  // -1: of the copies of a last cell
  int tile_number = 0;
  const auto lay = [&](Group& g) {
    g.first_slot = static_cast<long>(node_of_slot.size());
    g.slot_storage.resize(g.node_storage.size());
    for (int t = 0; t < g.tiles; ++t, ++tile_number) {
      g.tile_start.push_back(static_cast<long>(node_of_slot.size()) - g.first_slot);
      std::vector<long> copies;
      for (long at = g.first_node(g.first_block(t)); at < g.first_node(g.last_block(t)); ++at) {
        if (g.copied(at)) {
          copies.push_back(at);
          continue;
        }
        const int node = g.node_storage[at];
        if (seen[node] != tile_number) {
          seen[node] = tile_number;
          slot[node] = static_cast<int>(node_of_slot.size() - g.first_slot);
          node_of_slot.push_back(node);
          ++count[node + 1];
        }
        g.slot_storage[at] = slot[node] * record_size_;
      }
      for (long at : copies) g.slot_storage[at] = static_cast<int>(node_of_slot.size() - g.first_slot) * record_size_;
      node_of_slot.push_back(-1);
    }
    g.tile_start.push_back(static_cast<long>(node_of_slot.size()) - g.first_slot);
  };
  for (Group& g : groups_)
    if (g.nodal()) lay(g);
  nodal_slots_.assign(count.begin() + 1, count.end());
  for (Group& g : groups_)
    if (!g.nodal()) lay(g);
  for (int n = 0; n < nodes; ++n) count[n + 1] += count[n];
  slot_start_ = count;
  for (int n = 0; n < nodes; ++n) nodal_slots_[n] += slot_start_[n];
  slot_index_.assign(count[nodes] + kSlotsFetched, 0);
  for (std::size_t s = 0; s < node_of_slot.size(); ++s)
    if (node_of_slot[s] >= 0) slot_index_[count[node_of_slot[s]]++] = static_cast<int>(s);
  std::vector<long> place(nodes, 0);
  for (int n = 0; n < nodes; ++n)
    if (slot_start_[n] < slot_start_[n + 1]) place[n] = slot_index_[slot_start_[n]];
  long eights = 0;
  for (const Group& g : groups_) eights += g.blocks * eights_of_a_block(g);
  node_team_ = std::make_unique<NodeTeam>(*team_, place, eights >= 2 * kEightsOfAThread);
  slot_storage_.resize((node_of_slot.size() * record_size_ + kLanes - 1) / kLanes);
  slots_ = slot_storage_.empty() ? nullptr : slot_storage_.data()->value;
}

}  // namespace forming_sim
