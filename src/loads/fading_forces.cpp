#include "forming_sim/loads/fading_forces.h"

#include <algorithm>
#include <iterator>

namespace forming_sim {

void FadingForces::begin(double start, double duration, const std::vector<int>& together, double may_do, std::vector<HoldingForce> forces) {
  Group group;
  group.bodies = together;
  group.may_do = may_do;
  std::sort(group.bodies.begin(), group.bodies.end());
  for (auto other = groups_.begin(); other != groups_.end();) {
    std::vector<int> shared, all;
    std::set_intersection(group.bodies.begin(), group.bodies.end(), other->bodies.begin(), other->bodies.end(), std::back_inserter(shared));
    if (shared.empty()) {
      ++other;
      continue;
    }
    std::set_union(group.bodies.begin(), group.bodies.end(), other->bodies.begin(), other->bodies.end(), std::back_inserter(all));
    if (all.size() > together.size()) group.may_do = std::max(group.may_do, other->may_do);
    group.bodies = std::move(all);
    std::move(other->sets.begin(), other->sets.end(), std::back_inserter(group.sets));
    other = groups_.erase(other);
  }
  Set set;
  set.start = start;
  set.duration = duration;
  set.forces = std::move(forces);
  group.sets.push_back(std::move(set));
  groups_.push_back(std::move(group));
}

bool FadingForces::join(const std::vector<int>& together, double may_do, const std::vector<HoldingForce>& forces) {
  for (Group& group : groups_) {
    if (std::none_of(together.begin(), together.end(), [&](int body) { return std::binary_search(group.bodies.begin(), group.bodies.end(), body); })) continue;
    const auto last = std::max_element(group.sets.begin(), group.sets.end(), [](const Set& a, const Set& b) { return a.left < b.left; });
    if (last->left < kLeft) continue;
    std::vector<HoldingForce> whole = forces;
    for (HoldingForce& held : whole) held.force /= last->left;
    begin(last->start, last->duration, together, may_do, std::move(whole));
    return true;
  }
  return false;
}

void FadingForces::add(double t, NodeField& f) {
  for (Group& group : groups_)
    for (Set& set : group.sets) {
      const double u = std::clamp((t - set.start) / set.duration, 0.0, 1.0);
      set.left = 1 - u * u * u * (10 - u * (15 - 6 * u));
      for (const HoldingForce& held : set.forces) f[held.node] += set.left * held.force;
    }
}

bool FadingForces::work(double kick, const NodeField& v_before, const NodeField& v) {
  const auto before = groups_.size();
  const auto spent = [&](Group& group) {
    double of_step = 0;
    for (const Set& set : group.sets) {
      double done = 0;
      for (const HoldingForce& held : set.forces) done += held.force.dot(v_before[held.node] + v[held.node]);
      of_step += 0.5 * kick * set.left * done;
    }
    group.may_do -= of_step;
    return group.may_do < std::max(of_step, 0.0);  // the next step would do too much
  };
  groups_.erase(std::remove_if(groups_.begin(), groups_.end(), spent), groups_.end());
  return groups_.size() < before;
}

void FadingForces::count(int body, double work) {
  for (Group& group : groups_)
    if (std::binary_search(group.bodies.begin(), group.bodies.end(), body)) group.may_do -= work;
}

double FadingForces::end() const {
  double last = 0;
  for (const Group& group : groups_)
    for (const Set& set : group.sets) last = std::max(last, set.start + set.duration);
  return last;
}

void FadingForces::forget(double t) {
  for (Group& group : groups_)
    group.sets.erase(std::remove_if(group.sets.begin(), group.sets.end(), [t](const Set& set) { return t >= set.start + set.duration; }), group.sets.end());
  groups_.erase(std::remove_if(groups_.begin(), groups_.end(), [](const Group& group) { return group.sets.empty(); }), groups_.end());
}

}  // namespace forming_sim
