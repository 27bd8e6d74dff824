#include "forming_sim/contact/constants.h"

#include <algorithm>
#include <cmath>

#include "forming_sim/contact/closest.h"
#include "forming_sim/contact/impulse.h"

namespace forming_sim {

PairShares<double> PairConstants::shares_of(const Link& link) const {
  PairShares<double> sum;
  for (int k = 0; k < link.nodes; ++k) {
    const Share& share = work.share[link.node[k]];
    sum.add(k, link.weight[k], share.inverse_mass, share.area, share.of_body, share.held);
  }
  return sum;
}

double PairConstants::held_w(const ContactPair& pair) const {
  double w = 0;
  for (int k = 0; k < pair.nodes; ++k) {
    const double b2m = pair.weight[k] * pair.weight[k] * work.share[pair.node[k]].inverse_mass;
    const Mat3* projector = work.projector[pair.node[k]];
    w += projector ? b2m * dot3(pair.normal, project(*projector, pair.normal)) : b2m;
  }
  return w;
}

// phi of the pair: the mean of its nodes of bodies by their weights.
void PairConstants::let_waves_leave(const ContactPair& pair, Rub& rub) const {
  double phi = 0, sum = 0;
  work.each_of_bodies(pair, [&](int i, double b) {
    phi += std::abs(b) * work.steady[i][3];
    sum += std::abs(b);
  });
  if (phi == 0) return;
  const double area = pair.stiffness / (modulus * layer);
  rub.lasting = phi / sum;
  const WaveBody& body = waves->of_pair(pair.own, pair.surface);
  rub.beta = part_that_leaves(rub.friction) * body.impedance * rub.lasting * area * work.kick;
  rub.memory = kMemoryShare * body.time;
  rub.steady = relative(pair, work.steady);
}

void PairConstants::set(ContactPair& pair, std::vector<Rub>& rubs) const {
  const PairShares<double> sum = shares_of(pair);
  take(sum.w, sum.mean_area(), sum.movers, sum.held, pair);
  finish(pair, rubs);
}

}  // namespace forming_sim
