#pragma once
// How rigid tools move.
#include <memory>
#include <vector>

#include "forming_sim/loads/config.h"
#include "forming_sim/loads/curve.h"
#include "forming_sim/loads/tool.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// Where a motion has got to.
struct Pose {
  Vec3 translation = Vec3::Zero();   ///< displacement of the centre from the start, m
  Mat3 rotation = Mat3::Identity();  ///< about the centre, from the initial orientation
  Vec3 velocity = Vec3::Zero();      ///< of the centre, m/s
  Vec3 spin = Vec3::Zero();          ///< angular velocity in the world, rad/s
};

/// A motion as a function of time alone: nothing is accumulated, so a run may
/// ask for any time in any order, halve a step, or resume.
///
/// Trajectories: displacements and rotation vectors are interpolated component
/// by component (smooth: quintic from rest to rest between knots; linear;
/// spline: C2 cubic, at rest at both ends), and the rotation vector is turned
/// into a matrix by exp. About one fixed axis this is the angle over time. Where
/// the axis changes from knot to knot, every knot's orientation is met exactly
/// and the path between is as smooth as the profile says, but it is not the
/// turn about one fixed axis that joins the two orientations; give more knots
/// where the path between matters. Rotation vectors count full turns: from
/// [0, 0, 0] to [0, 0, 720] are two turns.
///
/// Velocities: displacement = exact integral of the velocity from t = 0. Spins
/// about one axis: exact. Spins whose axis changes: fourth-order Magnus steps
/// of at most 1 degree and at least 64 between two knots; the error of the
/// orientation is below 1e-8 rad for each turn.
class RigidMotion {
 public:
  /// Rests.
  RigidMotion() = default;
  /// Of kind force: what is told beside the force. dimension 2 admits x, y and rotation about z only.
  /// Throws Error(invalid_scene) with field, value and remedy.
  RigidMotion(const MotionConfig& config, int dimension);

  /// The same from the time t of the run on.
  RigidMotion beginning(double t) const;
  Pose at(double time) const;

 private:
  friend RigidMotion withdraw(const Pose&, const Vec3&, double, double);
  friend RigidMotion stay(const Pose&);
  /// Orientations reached by spins of changing axis.
  struct Turns {
    std::vector<double> times;
    std::vector<Mat3> rotations;
  };
  Mat3 turned(double t) const;

  Curve path_;
  Curve rotation_vector_;               ///< rad: trajectories, and spins about one axis
  Curve spin_;                          ///< rad/s: spins of changing axis
  std::shared_ptr<const Turns> turns_;  ///< with spin_ only
  double began_ = 0;                    ///< time of the run from which its own counts, s
  Mat3 base_ = Mat3::Identity();        ///< orientation before rotation_vector_ acts
};

/// Moves by `displacement` from where the tool stands, by a quintic that starts
/// and ends at rest; the orientation stays. Whatever velocity `from` had is not
/// carried on: it jumps to 0 at `start`. Throws Error(invalid_scene) unless duration > 0.
RigidMotion withdraw(const Pose& from, const Vec3& displacement, double start, double duration);

/// Rests where a motion has got to.
RigidMotion stay(const Pose& at);

/// A tool's frame in the world: x_world = position + rotation * x_tool.
struct ToolPose {
  Vec3 position = Vec3::Zero();
  Mat3 rotation = Mat3::Identity();
  Vec3 velocity = Vec3::Zero();  ///< of `position`, m/s
  Vec3 travel = Vec3::Zero();    ///< of the centre of rotation: without what it turns by, m/s
  Vec3 spin = Vec3::Zero();      ///< rad/s
};

/// Turned by `angle`, at `rate`, about an axle that the pose takes along; axle: of length 1, in the initial orientation.
Pose turned_about(const Vec3& axle, double angle, double rate, Pose pose);

/// Initial pose (rotation_deg about the origin of the tool's mesh, then
/// position), then the motion about tool.motion->centre, a point of the world at
/// the start; without a motion in the tool the centre is the world's origin.
/// A plane's point and normal are transformed by the same frame.
ToolPose tool_pose(const ToolModel& tool, const Pose& motion);

/// How far the points of a tool that turns freely go from its axle, m.
double reach_from_axle(const ToolModel& tool);

}  // namespace forming_sim
