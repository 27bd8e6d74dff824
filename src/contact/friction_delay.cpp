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
  sum_impulses(work, pairs, sum_);
  not_given_.assign(work.body_entries, 0.0);
  for (const ContactPair& pair : pairs) {
    if (pair.rub < 0 || !(pair.impulse > 0)) continue;
    const Rub& rub = rubs[pair.rub];
    const double left = pair.impulse - (rub.own * pair.impulse + rub.before);
    work.each_of_bodies(pair, [&](int i, double b) { not_given_[i] += std::abs(b) * left; });
  }
  for (int i = 0; i < work.body_entries; ++i) {
    const int n = work.vertex[i];
    if (sum_[i] == 0 || waves.of_node(n).time == 0) continue;
    const double T_N = kMemoryShare * waves.of_node(n).time, a = work.kick / (T_N + work.kick);
    double& delayed = delayed_[n];
    delayed = std::max(0.0, delayed + not_given_[i] / T_N + (1 - waves.phi(n)) * a * (sum_[i] / work.kick - delayed));
  }
}

}  // namespace forming_sim
