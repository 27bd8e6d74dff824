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
  if (config.kind != "fixed" && !config.is_driven())
    throw Error(Code::invalid_scene, name_of(boundary) + ": given the kind \"" + config.kind +
                                         "\"; give fixed, symmetric, velocity or trajectory");
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
  for (int node : set->second) {
    resolved.nodes.push_back(first_node + node);
    resolved.places.push_back(mesh.nodes[node]);
  }
  return resolved;
}

std::vector<SymmetryPlane> symmetry_planes(const std::vector<BoundaryConfig>& boundaries, bool axisymmetric) {
  std::vector<SymmetryPlane> planes;
  for (const BoundaryConfig& boundary : boundaries) {
    Vec3 normal;
    if (boundary.kind == "symmetric") normal = boundary.normal;
    else if (boundary.kind == "fixed" && boundary.axes.size() == 1) normal = Vec3::Unit(boundary.axes[0][0] - 'x');
    else continue;
    if (boundary.since.empty() && boundary.until.empty() && !(axisymmetric && normal.x() != 0)) planes.push_back({boundary.set, normal});
  }
  return planes;
}

BoundarySet::BoundarySet(const std::vector<ResolvedBoundary>& boundaries, int dimension) {
  std::map<int, std::vector<int>> members;  // boundaries of each node
  std::map<int, Vec3> places;               // of nodes that turn
  for (size_t b = 0; b < boundaries.size(); ++b) {
    const BoundaryConfig& config = boundaries[b].config;
    try {
      motions_.push_back(config.is_driven() ? RigidVelocity(config, boundaries[b].clock) : RigidVelocity());
    } catch (const Error& error) {
      const std::string what = error.what(), of_tools = "motion.";  // of RigidMotion, which knows the motions of tools
      throw Error(error.code(), name_of(boundaries[b]) + ": " + (what.rfind(of_tools, 0) == 0 ? what.substr(of_tools.size()) : what));
    }
    for (size_t i = 0; i < boundaries[b].nodes.size(); ++i) {
      const int node = boundaries[b].nodes[i];
      std::vector<int>& mine = members[node];
      if (mine.empty() || mine.back() != static_cast<int>(b)) mine.push_back(static_cast<int>(b));
      if (motions_[b].turns()) places[node] = boundaries[b].places.at(i);
    }
  }
  std::map<std::vector<int>, int> group_of;
  for (const auto& [node, mine] : members) {
    const auto [place, is_new] = group_of.try_emplace(mine, static_cast<int>(groups_.size()));
    if (is_new) groups_.push_back(merge(mine, boundaries, dimension));
    const Group& group = groups_[place->second];
    if (is_new || group.turns) check(group, mine, boundaries, node, group.turns ? places.at(node) : Vec3(Vec3::Zero()));
    nodes_.push_back(node);
    group_.push_back(place->second);
  }
}

// Gram-Schmidt. A direction d splits into sum_j c_j e_j plus a rest. The rest, if
// there is one, becomes a new e with speed (u_d - sum_j c_j u_j) / |rest|; if
// not, u_d must equal sum_j c_j u_j at all times. Boundaries that say the same motion count as one.
BoundarySet::Group BoundarySet::merge(const std::vector<int>& members,
                                      const std::vector<ResolvedBoundary>& boundaries, int dimension) const {
  Group group;
  for (int b : members) {
    if (motions_[b].turns()) group.turns = true;
    if (motions_[b].moves()) group.driven = true;
    int motion = b;
    for (int other : members)
      if (other < motion && boundaries[other].config.is_driven() && same_motion(boundaries[other].config, boundaries[b].config)) motion = other;
    for (const Vec3& direction : directions_of(boundaries[b], dimension)) {
      Vec3 rest = direction;
      std::vector<Term> terms;
      const auto add = [&](int of, const Vec3& weight) {
        for (Term& term : terms)
          if (term.motion == of) {
            term.weight += weight;
            return;
          }
        terms.push_back({of, weight});
      };
      if (motions_[motion].moves()) add(motion, direction);
      for (const Direction& fixed : group.directions) {
        const double share = direction.dot(fixed.axis);
        rest -= share * fixed.axis;
        if (std::abs(share) > kParallel)
          for (const Term& term : fixed.terms) add(term.motion, -share * term.weight);
      }
      const double length = rest.norm();
      if (length > kParallel) {
        for (Term& term : terms) term.weight /= length;
        group.directions.push_back({rest / length, terms});
      } else {
        group.beyond.push_back({b, terms});
      }
    }
  }
  for (const Direction& fixed : group.directions) group.projector -= fixed.axis * fixed.axis.transpose();
  // All directions fixed: nothing is left, not even rounding.
  group.whole = static_cast<int>(group.directions.size()) == dimension;
  if (group.directions.size() == 3) group.projector.setZero();
  group.fixed.topLeftCorner<3, 3>() = Mat3::Identity() - group.projector;
  return group;
}

void BoundarySet::check(const Group& group, const std::vector<int>& members, const std::vector<ResolvedBoundary>& boundaries,
                        int node, const Vec3& place) const {
  const auto refuse = [&](int b, const std::string& when, const char* remedy) {
    std::string others;
    for (int other : members)
      if (other < b) others += (others.empty() ? "" : ", ") + ("\"" + boundaries[other].config.set + "\"");
    throw SceneError({{Code::invalid_scene, boundaries[b].path,
                       "a " + name_of(boundaries[b]) + ", whose node " + std::to_string(node) + " is also in another one, on set " +
                           (others.empty() ? "\"" + boundaries[b].config.set + "\"" : others) + ", which prescribes another velocity along the same direction" + when,
                       remedy}});
  };
  double from = 0;  // when all of them hold
  for (int member : members) from = std::max(from, boundaries[member].clock.of_run(0));
  for (const Beyond& beyond : group.beyond) {
    std::set<double> knots{from};
    for (const Term& term : beyond.terms)
      for (double t : motions_[term.motion].times()) knots.insert(std::max(t, from));
    // The difference is a polynomial of fourth degree at most between neighbouring knots: five points decide.
    std::vector<double> looked_at;
    for (auto k = knots.begin(); k != knots.end(); ++k) {
      const double next = std::next(k) == knots.end() ? *k : *std::next(k);
      for (int part = 0; part < 4; ++part) looked_at.push_back(*k + 0.25 * part * (next - *k));
    }
    double scale = 0;
    for (const Term& term : beyond.terms) {
      const RigidVelocity& motion = motions_[term.motion];
      for (double t : looked_at) {
        scale = std::max(scale, motion.velocity(t).norm());
        // A turn asks for nothing along its axis, and for nothing of a node on its axis.
        const Vec3 w = motion.spin(t), r = place - motion.centre();
        if (w.cross(term.weight).norm() > kParallel * w.norm() && w.cross(r).norm() > kParallel * w.norm() * (place.norm() + motion.centre().norm()))
          refuse(beyond.boundary, " where the set turns", "take the node out of one set, or leave to each the axes that are its own");
      }
    }
    for (double t : looked_at) {
      double speed = 0;
      for (const Term& term : beyond.terms) speed += term.weight.dot(motions_[term.motion].velocity(t));
      if (std::abs(speed) > 1e-9 * scale)
        refuse(beyond.boundary, " at t = " + short_number(t) + " s", "take the node out of one set, give equal velocities, or let the one go (until) before the other takes hold (since)");
    }
  }
}

Vec3 BoundarySet::prescribed(const Group& group, const std::vector<RigidVelocity::Step>& motions, const Vec3& x) const {
  Vec3 u = Vec3::Zero();
  for (const Direction& fixed : group.directions)
    for (const Term& term : fixed.terms) u += term.weight.dot(motions[term.motion].at(x)) * fixed.axis;
  return u;
}

void BoundarySet::find_motions(double t, double dt, std::vector<RigidVelocity::Step>& motions) const {
  motions.clear();  // and filled in the memory that is there
  for (const RigidVelocity& motion : motions_) motions.push_back(motion.step(t, dt));
}

Vec3 BoundarySet::prescribed(int k, double t, double dt, const Vec3& x) const {
  std::vector<RigidVelocity::Step> motions;
  find_motions(t, dt, motions);
  return prescribed(groups_[group_[k]], motions, x);
}

const BoundarySet::Prescription& BoundarySet::prescription(double t, double dt) {
  find_motions(t, dt, step_.motions);
  step_.u.clear();
  for (const Group& group : groups_) step_.u.push_back(group.turns ? Vec3(Vec3::Zero()) : prescribed(group, step_.motions, Vec3::Zero()));
  return step_;
}

void BoundarySet::apply_velocity(const Prescription& step, const NodeField& x, long first, long last, NodeField& v) const {
  for (auto at = std::lower_bound(nodes_.begin(), nodes_.end(), first); at != nodes_.end() && *at < last; ++at) {
    const int g = group_[at - nodes_.begin()];
    const Group& group = groups_[g];
    const Vec3 u = group.turns ? prescribed(group, step.motions, vec3(x[*at])) : step.u[g];
    Node& velocity = v[*at];
    velocity = node(group.whole ? u : Vec3(group.projector * vec3(velocity) + u));
  }
}

void BoundarySet::apply_velocity(double t, double dt, const NodeField& x, NodeField& v) {
  apply_velocity(prescription(t, dt), x, 0, static_cast<long>(v.size()), v);
}

}  // namespace forming_sim
