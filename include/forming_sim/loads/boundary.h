#pragma once
// Nodes that are held or driven: projectors and prescribed velocities.
#include <string>
#include <vector>

#include "forming_sim/loads/config.h"
#include "forming_sim/loads/rigid_velocity.h"
#include "forming_sim/mesh/measure.h"
#include "forming_sim/mesh/mesh.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// A boundary with its nodes in the joined numbering.
struct ResolvedBoundary {
  BoundaryConfig config;
  std::string body;  ///< for messages
  std::vector<int> nodes;
  std::vector<Vec3> places = {};  ///< of the nodes at the start; asked for where the set turns
  CourseClock clock = {};
  std::string path = "boundaries";  ///< of the field, for messages
};

/// Looks up the set of a boundary in its body's mesh.
/// Throws Error(invalid_scene) naming a set that is missing or empty.
ResolvedBoundary resolve(const BoundaryConfig& config, const std::string& body, const Mesh& mesh,
                         int first_node);

/// A boundary that holds one direction and nothing else, from the start to the end, counts as a plane of symmetry across that direction; of an axisymmetric body along the axis alone.
std::vector<SymmetryPlane> symmetry_planes(const std::vector<BoundaryConfig>& boundaries, bool axisymmetric);

/// All held or driven nodes of a model. A node may be in several boundaries:
/// their directions are orthonormalised into one space of fixed directions.
class BoundarySet {
 public:
  BoundarySet() = default;
  /// Throws Error(invalid_scene) for an axis, kind or normal that means nothing,
  /// and SceneError where two boundaries prescribe different velocities of one node along
  /// one direction, naming node, body and both sets.
  BoundarySet(const std::vector<ResolvedBoundary>& boundaries, int dimension);

  /// Constrained nodes, increasing.
  const std::vector<int>& nodes() const { return nodes_; }
  /// P of nodes()[k]: identity minus its fixed directions, symmetric, P P = P.
  /// The inverse mass that contact sees is P / m.
  const Mat3& projector(int k) const { return groups_[group_[k]].projector; }
  /// A boundary prescribes a motion of nodes()[k]; else it stands along its fixed directions.
  bool drives(int k) const { return groups_[group_[k]].driven; }

  /// u of nodes()[k], which is at x at the time t: the prescribed velocity of the step to t + dt,
  /// zero along free directions.
  Vec3 prescribed(int k, double t, double dt, const Vec3& x) const;

  /// What the boundaries prescribe in the step from t to t + dt; it holds until the next is asked for.
  struct Prescription {
    std::vector<RigidVelocity::Step> motions;  ///< of each boundary
    std::vector<Vec3> u;  ///< of each group that does not turn
  };
  const Prescription& prescription(double t, double dt);
  /// v <- P v + u of those of the nodes [first, last) that are held or driven.
  void apply_velocity(const Prescription& step, const NodeField& x, long first, long last, NodeField& v) const;
  /// Of all nodes.
  void apply_velocity(double t, double dt, const NodeField& x, NodeField& v);

  /// What the prescription pushed on nodes()[k] in a step, N s:
  /// R = (I - P) [m (v_after - v_before) - dt f], f all other forces, before projection.
  /// Its work is R . (v_before + v_after) / 2: with it and dt f . (v_before + v_after) / 2
  /// for the other forces, the change of m v^2 / 2 is met exactly.
  Node reaction_impulse(int k, const Node& force, double mass, const Node& v_before, const Node& v_after, double dt) const {
    const Node impulse = mass * (v_after - v_before) - dt * force;
    const Eigen::Matrix4d& fixed = groups_[group_[k]].fixed;
    return impulse[0] * fixed.col(0) + impulse[1] * fixed.col(1) + impulse[2] * fixed.col(2);
  }

 private:
  /// u along one fixed direction: sum of weight . motion.
  struct Term {
    int motion;
    Vec3 weight;
  };
  struct Direction {
    Vec3 axis;
    std::vector<Term> terms;
  };
  /// A direction that the others have fixed already: what its boundary prescribes beyond them, which must be nothing.
  struct Beyond {
    int boundary;
    std::vector<Term> terms;
  };
  /// Nodes that are in the same boundaries share one group.
  struct Group {
    Mat3 projector = Mat3::Identity();
    Eigen::Matrix4d fixed = Eigen::Matrix4d::Zero();  ///< I - P of nodal records
    std::vector<Direction> directions;
    std::vector<Beyond> beyond;
    bool turns = false;  ///< u differs from node to node
    bool driven = false; ///< u may be other than 0
    bool whole = false;  ///< no direction is free: v = u
  };
  Group merge(const std::vector<int>& members, const std::vector<ResolvedBoundary>& boundaries, int dimension) const;
  /// Throws where the boundaries of a group prescribe different velocities of a node.
  void check(const Group& group, const std::vector<int>& members, const std::vector<ResolvedBoundary>& boundaries, int node, const Vec3& place) const;
  Vec3 prescribed(const Group& group, const std::vector<RigidVelocity::Step>& motions, const Vec3& x) const;
  void find_motions(double t, double dt, std::vector<RigidVelocity::Step>& motions) const;

  Prescription step_;
  std::vector<RigidVelocity> motions_;  ///< one per boundary; at rest where it holds
  std::vector<Group> groups_;
  std::vector<int> nodes_, group_;  ///< group_[k] of nodes_[k]
};

}  // namespace forming_sim
