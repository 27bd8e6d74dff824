#include "forming_sim/loads/receding_supports.h"

#include <Eigen/Dense>
#include <algorithm>

namespace forming_sim {

std::vector<Vec3> parts_by_face(const Vec3& F, const std::vector<Vec3>& areas) {
  constexpr double kLevel = 0.866;  // cosine
  std::vector<Vec3> sums;
  for (const Vec3& area : areas) {
    const auto level = [&](const Vec3& sum) { return sum.dot(area) > kLevel * sum.norm() * area.norm(); };
    if (const auto with = std::find_if(sums.begin(), sums.end(), level); with != sums.end())
      *with += area;
    else if (sums.size() < 3)
      sums.push_back(area);
  }
  // Least squares; a face that would have to pull is left out, and the rest is found anew.
  while (!sums.empty()) {
    Eigen::MatrixXd inward(3, sums.size());
    for (std::size_t k = 0; k < sums.size(); ++k) inward.col(k) = -sums[k].normalized();
    const Eigen::VectorXd along = inward.colPivHouseholderQr().solve(F);
    Eigen::Index least, most;
    if (along.minCoeff(&least) <= 0) {
      sums.erase(sums.begin() + least);
      continue;
    }
    along.maxCoeff(&most);
    std::vector<Vec3> parts;
    for (std::size_t k = 0; k < sums.size(); ++k) parts.push_back(along[k] * inward.col(k));
    parts[most] += F - inward * along;
    return parts;
  }
  return {F};
}

double RecedingSupports::squeeze(const std::vector<Held>& held, const Mat3& alone) {
  double all = 0;
  Node together = Node::Zero();
  for (const Held& h : held) {
    if (h.area == 0) continue;
    all += h.by.force.norm();
    together += h.by.force;
  }
  return all > 0 ? 1 - (alone * vec3(together)).norm() / all : 0;
}

void RecedingSupports::begin(const OfBody& body, double squeeze, double dt, const std::vector<double>& mass, const NodeField& x, const std::vector<Held>& held) {
  Set set;
  set.of = body;
  set.added = body.start;
  double pressed = 0, area = 0, stiffness = 0;  // N, m2, N/m
  for (const Held& h : held) {
    if (h.by.force.isZero(0)) continue;
    Support support = support_of(h, x);
    if (h.area > 0) {
      const double k = h.share * mass[h.by.node] * (kStiffness / dt) * (kStiffness / dt);
      support.give = support.force / k;
      stiffness += k;
      pressed += support.force;
      area += h.area;
    }
    set.supports.push_back(support);
  }
  set.depth = area > 0 ? kDepth * squeeze * pressed / area * body.t / body.E + 2 * pressed / stiffness : 0;
  sets_.push_back(std::move(set));
}

RecedingSupports::Support RecedingSupports::support_of(const Held& held, const NodeField& x) {
  Support made;
  made.node = held.by.node;
  made.force = held.by.force.norm();
  made.way = held.by.force / made.force;
  made.start = x[held.by.node].dot(made.way);
  return made;
}

bool RecedingSupports::join(const std::vector<int>& together, const NodeField& x, const std::vector<Held>& held) {
  const auto set = std::find_if(sets_.rbegin(), sets_.rend(), [&](const Set& one) { return std::find(together.begin(), together.end(), one.of.body) != together.end(); });
  if (set == sets_.rend()) return false;
  for (const Held& h : held)
    if (!h.by.force.isZero(0)) set->supports.push_back(support_of(h, x));
  return true;
}

double RecedingSupports::Set::receded(double t) const {
  const double u = std::clamp((t - of.start) / (open() - of.start), 0.0, 1.0);
  return depth * u * u * (3 - 2 * u);
}

double RecedingSupports::bears(const Support& support, double d, const Node& x) {
  if (support.give == 0) return support.force;
  const double s = x.dot(support.way) - support.start;
  return support.force * std::max(1 - (s + d) / support.give, 0.0);
}

void RecedingSupports::add(double t, const NodeField& x, NodeField& f) {
  for (Set& set : sets_) {
    const double from = set.of.start + kNearlyOpen * (set.open() - set.of.start), d = set.receded(t), time = std::max(t - std::max(set.added, from), 0.0);
    for (Support& support : set.supports) {
      support.bore = bears(support, d, x[support.node]);
      support.impulse += time * support.bore;
      f[support.node] += support.bore * support.way;
    }
    set.meant += time;
    set.added = t;
  }
}

std::vector<RecedingSupports::Done> RecedingSupports::work(double kick, const NodeField& v_before, const NodeField& v) const {
  std::vector<Done> all;
  for (const Set& set : sets_) {
    double done = 0;
    for (const Support& support : set.supports) done += support.bore * support.way.dot(v_before[support.node] + v[support.node]);
    all.push_back({set.of.body, 0.5 * kick * done});
  }
  return all;
}

double RecedingSupports::energy(double t, const NodeField& x) const {
  double sum = 0;
  for (const Set& set : sets_)
    for (const Support& support : set.supports) {
      if (support.give == 0) continue;
      const double left = std::max(support.give - (x[support.node].dot(support.way) - support.start + set.receded(t)), 0.0);  // of its way
      sum += support.force * left * left / (2 * support.give);
    }
  return sum;
}

double RecedingSupports::end() const {
  double last = 0;
  for (const Set& set : sets_) last = std::max(last, set.open() + set.of.fade);
  return last;
}

std::vector<RecedingSupports::Receded> RecedingSupports::take(double t) {
  std::vector<Receded> all;
  for (const Set& set : sets_) {
    if (t < set.open()) continue;
    Receded one{set.of, {}};
    for (const Support& support : set.supports) {
      // What a boundary held is as it was; and where no step has come in so short a time they fade from where they were.
      const double bore = support.give > 0 && set.meant > 0 ? support.impulse / set.meant : support.force;
      if (bore > 0) one.forces.push_back({support.node, bore * support.way});
    }
    all.push_back(std::move(one));
  }
  sets_.erase(std::remove_if(sets_.begin(), sets_.end(), [t](const Set& set) { return t >= set.open(); }), sets_.end());
  return all;
}

}  // namespace forming_sim
