#include "forming_sim/loads/fading_forces.h"

#include <algorithm>

namespace forming_sim {

void FadingForces::begin(double start, double duration, double may_do, std::vector<int> nodes, std::vector<Node> forces) {
  sets_.push_back({start, duration, may_do, std::move(nodes), std::move(forces)});
}

double FadingForces::Set::left(double t) const {
  const double u = std::clamp((t - start) / duration, 0.0, 1.0);
  return 1 - u * u * u * (10 - u * (15 - 6 * u));
}

void FadingForces::add(double t, NodeField& f) const {
  for (const Set& set : sets_) {
    const double left = set.left(t);
    for (std::size_t i = 0; i < set.nodes.size(); ++i) f[set.nodes[i]] += left * set.forces[i];
  }
}

bool FadingForces::work(double t, double kick, const NodeField& v_before, const NodeField& v) {
  const auto before = sets_.size();
  const auto spent = [&](Set& set) {
    double done = 0;
    for (std::size_t i = 0; i < set.nodes.size(); ++i) done += set.forces[i].dot(v_before[set.nodes[i]] + v[set.nodes[i]]);
    set.may_do -= 0.5 * kick * set.left(t) * done;
    return set.may_do < 0;
  };
  sets_.erase(std::remove_if(sets_.begin(), sets_.end(), spent), sets_.end());
  return sets_.size() < before;
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
