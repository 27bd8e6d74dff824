#include "forming_sim/contact/constants.h"

#include <algorithm>

#include "forming_sim/contact/closest.h"
#include "forming_sim/contact/impulse.h"

namespace forming_sim {

void PairConstants::set(ContactPair& pair, std::vector<Rub>& rubs) const {
  double area = 0, any = 0, w = 0;
  int deformable = 0, movers = 0;
  bool held = false;
  for (int k = 0; k < pair.nodes; ++k) {
    const int n = pair.node[k];
    if (n >= work.body_entries) continue;
    const Share& share = work.share[n];
    area += share.area;
    ++deformable;
    if (!(share.inverse_mass > 0)) continue;
    movers |= 1 << k;
    const double b2m = pair.weight[k] * pair.weight[k] * share.inverse_mass;
    any += b2m;
    w += share.projector ? b2m * dot3(pair.normal, project(*share.projector, pair.normal)) : b2m;
    held = held || share.projector;
  }
  pair.w = w;
  pair.movers = static_cast<std::uint8_t>(movers);
  pair.held = held;
  pair.stiffness = deformable > 0 ? modulus * layer * area / deformable : 0;
  // Held against the normal up to rounding is held.
  if (pair.w <= 1e-12 * any) pair.w = pair.stiffness = 0;
  pair.tool = std::max(-1, std::max(pair.own, pair.surface) - features.bodies);
  const double friction = features.relation(pair.own, pair.surface).friction;
  pair.rub = -1;
  if (!(friction > 0)) return;
  pair.rub = static_cast<int>(rubs.size());
  rubs.push_back({Node::Zero(), friction, any});
}

}  // namespace forming_sim
