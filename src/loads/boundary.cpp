#include "forming_sim/loads/boundary.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "forming_sim/config/fault.h"

namespace forming_sim {
namespace {

/// Directions closer to dependent than this count as dependent.
constexpr double kParallel = 1e-9;

std::string name_of(const ResolvedBoundary& boundary) {
  return "boundary on set \"" + boundary.config.set + "\" of body \"" + boundary.body + "\"";
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// Unit vectors along which a boundary fixes its nodes.
std::vector<Vec3> directions_of(const ResolvedBoundary& boundary, int dimension) {
  const BoundaryConfig& config = boundary.config;
  if (config.kind == "symmetric") {
    const bool in_space = config.normal.allFinite() && config.normal.norm() > 0;
    if (!in_space || (dimension == 2 && config.normal.z() != 0))
      throw Error(Code::invalid_scene, name_of(boundary) +
                                           ": the normal of its plane of symmetry must be finite and " +
                                           "not zero" + (dimension == 2 ? ", and lie in the x-y plane" : ""));
    return {config.normal.normalized()};
  }
  if (config.kind != "fixed" && config.kind != "velocity")
    throw Error(Code::invalid_scene, name_of(boundary) + ": given the kind \"" + config.kind +
                                         "\"; give fixed, symmetric or velocity");
  std::vector<Vec3> directions;
  if (config.axes.empty())
    for (int k = 0; k < dimension; ++k) directions.push_back(Vec3::Unit(k));
  for (const std::string& axis : config.axes) {
    const int k = axis == "x" ? 0 : axis == "y" ? 1 : axis == "z" ? 2 : 3;
    if (k >= dimension)
      throw Error(Code::invalid_scene, name_of(boundary) + ": given the axis \"" + axis + "\"; give " +
                                           (dimension == 2 ? "x or y in dimension 2" : "x, y or z"));
    directions.push_back(Vec3::Unit(k));
  }
  return directions;
}

}  // namespace

ResolvedBoundary resolve(const BoundaryConfig& config, const std::string& body, const Mesh& mesh,
                         int first_node) {
  ResolvedBoundary resolved{config, body, {}};
  const auto set = mesh.sets.find(config.set);
  if (set == mesh.sets.end() || set->second.empty())
    throw Error(Code::invalid_scene, name_of(resolved) + ": the set " +
                                         (set == mesh.sets.end() ? "does not exist" : "holds no node") +
                                         "; name a set of the body that holds nodes");
  for (int node : set->second) resolved.nodes.push_back(first_node + node);
  return resolved;
}

BoundarySet::BoundarySet(const std::vector<ResolvedBoundary>& boundaries, int dimension) {
  std::map<int, std::vector<int>> members;  // boundaries of each node
  for (size_t b = 0; b < boundaries.size(); ++b) {
    const BoundaryConfig& config = boundaries[b].config;
    try {
      profiles_.push_back(config.kind == "velocity"
                              ? VelocityProfile(config.times, config.velocities, config.profile)
                              : VelocityProfile());
    } catch (const Error& error) {
      throw Error(error.code(), name_of(boundaries[b]) + ": " + error.what());
    }
    for (int node : boundaries[b].nodes) {
      std::vector<int>& mine = members[node];
      if (mine.empty() || mine.back() != static_cast<int>(b)) mine.push_back(static_cast<int>(b));
    }
  }
  std::map<std::vector<int>, int> group_of;
  for (const auto& [node, mine] : members) {
    const auto [place, is_new] = group_of.try_emplace(mine, static_cast<int>(groups_.size()));
    if (is_new) groups_.push_back(merge(mine, boundaries, dimension, node));
    nodes_.push_back(node);
    group_.push_back(place->second);
  }
}

// Gram-Schmidt. A direction d splits into sum_j c_j e_j plus a rest. The rest, if
// there is one, becomes a new e with speed (u_d - sum_j c_j u_j) / |rest|; if
// not, u_d must equal sum_j c_j u_j at all times.
BoundarySet::Group BoundarySet::merge(const std::vector<int>& members,
                                      const std::vector<ResolvedBoundary>& boundaries, int dimension,
                                      int node) const {
  Group group;
  for (int b : members) {
    for (const Vec3& direction : directions_of(boundaries[b], dimension)) {
      Vec3 rest = direction;
      std::vector<Term> terms;
      if (!profiles_[b].times().empty()) terms.push_back({b, direction});
      for (const Direction& fixed : group.directions) {
        const double share = direction.dot(fixed.axis);
        rest -= share * fixed.axis;
        if (std::abs(share) > kParallel)
          for (const Term& term : fixed.terms) terms.push_back({term.profile, -share * term.weight});
      }
      const double length = rest.norm();
      if (length > kParallel) {
        for (Term& term : terms) term.weight /= length;
        group.directions.push_back({rest / length, terms});
        continue;
      }
      // The difference is a cubic between neighbouring knots: four points decide.
      std::set<double> knots;
      double scale = 0;
      for (const Term& term : terms)
        for (double t : profiles_[term.profile].times()) {
          knots.insert(t);
          scale = std::max(scale, profiles_[term.profile].at(t).norm());
        }
      for (auto k = knots.begin(); k != knots.end(); ++k) {
        const double next = std::next(k) == knots.end() ? *k : *std::next(k);
        for (double t : {*k, (2 * *k + next) / 3, (*k + 2 * next) / 3})
          if (std::abs(speed(terms, t)) > 1e-9 * scale) {
            std::string others;
            for (int other : members)
              if (other < b)
                others += (others.empty() ? "" : ", ") + ("\"" + boundaries[other].config.set + "\"");
            throw Error(Code::invalid_scene,
                        name_of(boundaries[b]) + ": node " + std::to_string(node) + " is also in set " +
                            (others.empty() ? "\"" + boundaries[b].config.set + "\"" : others) +
                            ", which prescribes another velocity along the same direction at t = " +
                            short_number(t) + " s; take the node out of one set, or give equal velocities");
          }
      }
    }
  }
  for (const Direction& fixed : group.directions) group.projector -= fixed.axis * fixed.axis.transpose();
  // All directions fixed: nothing is left, not even rounding.
  if (group.directions.size() == 3) group.projector.setZero();
  return group;
}

int BoundarySet::find(int node) const {
  const auto place = std::lower_bound(nodes_.begin(), nodes_.end(), node);
  return place != nodes_.end() && *place == node ? static_cast<int>(place - nodes_.begin()) : -1;
}

double BoundarySet::speed(const std::vector<Term>& terms, double t) const {
  double sum = 0;
  for (const Term& term : terms) sum += term.weight.dot(profiles_[term.profile].at(t));
  return sum;
}

Vec3 BoundarySet::prescribed(const Group& group, double t) const {
  Vec3 u = Vec3::Zero();
  for (const Direction& fixed : group.directions)
    if (!fixed.terms.empty()) u += speed(fixed.terms, t) * fixed.axis;
  return u;
}

Vec3 BoundarySet::prescribed(int k, double t) const { return prescribed(groups_[group_[k]], t); }

double BoundarySet::apply_velocity(double t_mid, NodeField& v) const {
  double fastest = 0;
  std::vector<Vec3> velocities;
  for (const Group& group : groups_) {
    velocities.push_back(prescribed(group, t_mid));
    fastest = std::max(fastest, velocities.back().norm());
  }
  for (size_t k = 0; k < nodes_.size(); ++k) {
    Node& velocity = v[nodes_[k]];
    velocity.head<3>() = projector(static_cast<int>(k)) * vec3(velocity) + velocities[group_[k]];
  }
  return fastest;
}

Vec3 BoundarySet::reaction_impulse(int k, const Vec3& force, double mass, const Vec3& v_before,
                                   const Vec3& v_after, double dt) const {
  const Vec3 impulse = mass * (v_after - v_before) - dt * force;
  return impulse - projector(k) * impulse;
}

double BoundarySet::work(int k, const Vec3& force, double mass, const Vec3& v_before, const Vec3& v_after,
                         double dt) const {
  return 0.5 * reaction_impulse(k, force, mass, v_before, v_after, dt).dot(v_before + v_after);
}

double BoundarySet::work(const NodeField& force, const std::vector<double>& mass, const NodeField& v_before,
                         const NodeField& v_after, double dt) const {
  double sum = 0;
  for (size_t k = 0; k < nodes_.size(); ++k) {
    const int i = nodes_[k];
    if (v_before[i] + v_after[i] == Node::Zero()) continue;  // held at rest
    sum += work(static_cast<int>(k), vec3(force[i]), mass[i], vec3(v_before[i]), vec3(v_after[i]), dt);
  }
  return sum;
}

}  // namespace forming_sim
