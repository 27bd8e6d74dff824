#include "forming_sim/contact/friction_delay.h"

#include <algorithm>
#include <cmath>

#include "forming_sim/contact/impulse.h"

namespace forming_sim {

void FrictionDelay::recall(const Workspace& work, const LargeArray<ContactPair>& pairs, std::vector<Rub>& rubs) {
  if (delayed_.empty()) return;
  sum_impulses(work, pairs, sum_);
  for (const ContactPair& pair : pairs) {
    if (pair.rub < 0 || rubs[pair.rub].lasting == 0) continue;
    double share = 0, weights = 0;  // of the pair's impulse, 1/s
    bool pressed = false;
    work.each_of_bodies(pair, [&](int i, double signed_b) {
      const double b = std::abs(signed_b);
      weights += b;
      if (sum_[i] == 0) return;
      pressed = true;
      share += b * delayed_[work.vertex[i]] / sum_[i];
    });
    if (!pressed) continue;
    Rub& rub = rubs[pair.rub];
    const double kept = rub.lasting * rub.memory / (rub.memory + work.kick);
    rub.own = 1 - kept;
    rub.before = kept * work.kick * pair.impulse * share / weights;
  }
}

void FrictionDelay::follow(const Workspace& work, const LargeArray<ContactPair>& pairs, const std::vector<Rub>& rubs, std::size_t nodes, const ShearWaves& waves) {
  delayed_.resize(nodes, 0.0);
  sum_.assign(work.body_entries, 0.0);  // kick N - given
  for (const ContactPair& pair : pairs) {
    if (pair.rub < 0 || !(pair.impulse > 0)) continue;
    const Rub& rub = rubs[pair.rub];
    const double left = pair.impulse - (rub.own * pair.impulse + rub.before);
    work.each_of_bodies(pair, [&](int i, double b) { sum_[i] += std::abs(b) * left; });
  }
  for (int i = 0; i < work.body_entries; ++i) {
    if (sum_[i] == 0) continue;
    double& delayed = delayed_[work.vertex[i]];
    delayed = std::max(0.0, delayed + sum_[i] / (kMemoryShare * waves.of_node(work.vertex[i]).time));
  }
}

}  // namespace forming_sim
