#include "forming_sim/loads/fading_forces.h"

#include <algorithm>

namespace forming_sim {

void FadingForces::begin(double start, double duration, std::vector<int> nodes, std::vector<Node> forces) {
  sets_.push_back({start, duration, std::move(nodes), std::move(forces)});
}

void FadingForces::add(double t, NodeField& f) const {
  for (const Set& set : sets_) {
    const double u = std::clamp((t - set.start) / set.duration, 0.0, 1.0);
    const double left = 1 - u * u * u * (10 - u * (15 - 6 * u));
    for (std::size_t i = 0; i < set.nodes.size(); ++i) f[set.nodes[i]] += left * set.forces[i];
  }
}

double FadingForces::end() const {
  double last = 0;
  for (const Set& set : sets_) last = std::max(last, set.start + set.duration);
  return last;
}

void FadingForces::forget(double t) {
  sets_.erase(std::remove_if(sets_.begin(), sets_.end(), [t](const Set& set) { return t >= set.start + set.duration; }), sets_.end());
}

}  // namespace forming_sim
