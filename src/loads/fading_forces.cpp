#include "forming_sim/loads/fading_forces.h"

#include <algorithm>

namespace forming_sim {

void FadingForces::begin(double start, double duration, double may_do, std::vector<HoldingForce> forces) {
  Set set;
  set.start = start;
  set.duration = duration;
  set.may_do = may_do;
  set.forces = std::move(forces);
  sets_.push_back(std::move(set));
}

void FadingForces::add(double t, NodeField& f) {
  for (Set& set : sets_) {
    const double u = std::clamp((t - set.start) / set.duration, 0.0, 1.0);
    set.left = 1 - u * u * u * (10 - u * (15 - 6 * u));
    for (const HoldingForce& held : set.forces) f[held.node] += set.left * held.force;
  }
}

bool FadingForces::work(double kick, const NodeField& v_before, const NodeField& v) {
  const auto before = sets_.size();
  const auto spent = [&](Set& set) {
    double done = 0;
    for (const HoldingForce& held : set.forces) done += held.force.dot(v_before[held.node] + v[held.node]);
    const double of_step = 0.5 * kick * set.left * done;
    set.may_do -= of_step;
    return set.may_do < std::max(of_step, 0.0);  // the next step would do too much
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
