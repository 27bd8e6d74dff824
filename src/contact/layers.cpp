#include "forming_sim/contact/layers.h"

#include <algorithm>

#include "forming_sim/contact/closest.h"
#include "forming_sim/contact/law.h"

namespace forming_sim {
namespace {

double closing_speed(const ContactPair& pair, const Workspace& work) {
  double vn = 0;
  for (int k = 0; k < pair.nodes; ++k) vn += pair.weight[k] * dot3(pair.normal, work.v[pair.node[k]]);
  return std::max(0.0, -vn);
}

}  // namespace

void assign_layers(const std::vector<LayerRecord>& before, const Workspace& work, double dt, double full, double ceiling,
                   std::vector<ContactPair>& pairs) {
  size_t r = 0;
  for (size_t first = 0; first < pairs.size();) {
    size_t last = first;
    while (last < pairs.size() && pairs[last].key.group == pairs[first].key.group) ++last;
    while (r < before.size() && before[r].key.group < pairs[first].key.group) ++r;
    size_t r_last = r;
    while (r_last < before.size() && before[r_last].key.group == pairs[first].key.group) ++r_last;

    const auto lives = [&](const LayerRecord& record) {
      for (size_t i = first; i < last; ++i)
        if (pairs[i].key == record.key) return true;
      return false;
    };
    for (size_t i = first; i < last; ++i) {
      ContactPair& pair = pairs[i];
      const LayerRecord* known = nullptr;
      for (size_t k = r; k < r_last; ++k)
        if (before[k].key == pair.key) known = &before[k];
      if (known) {
        pair.layer = pair.base < full ? std::min(known->layer, pair.base) : known->layer;
      } else if (pair.gap >= pair.base) {
        const double raised = std::min(ceiling, 0.1 * closing_speed(pair, work) * dt);
        pair.layer = std::max(pair.base, std::min(pair.gap, raised));
      } else {
        pair.layer = pair.gap;
        for (size_t k = r; k < r_last; ++k) {
          const LayerRecord& parent = before[k];
          if (parent.surface != pair.surface || lives(parent)) continue;
          const double same_potential = pair.gap * std::max(1.0, parent.layer / parent.gap);
          pair.layer = std::max(pair.layer, std::min(parent.layer, same_potential));
        }
      }
    }
    first = last;
    r = r_last;
  }
}

RelaxedPotential relax_layers(double growth, std::vector<ContactPair>& pairs, std::vector<LayerRecord>& after) {
  after.clear();
  RelaxedPotential potential;
  for (ContactPair& pair : pairs) {
    const double old = pair.layer, before = mild_potential(pair.end_gap, old, pair.stiffness);
    pair.layer = old < pair.base ? std::min(pair.base, old + growth) : std::max(pair.base, old - growth);
    potential.before += before;
    potential.after += pair.layer == old ? before : mild_potential(pair.end_gap, pair.layer, pair.stiffness);
    if (pair.end_gap < std::max(pair.layer, pair.base)) after.push_back({pair.key, pair.surface, pair.layer, pair.end_gap});
  }
  return potential;
}

}  // namespace forming_sim
