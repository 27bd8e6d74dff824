#include "forming_sim/loads/motion.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>

#include "forming_sim/config/fault.h"
#include "forming_sim/config/words.h"
#include "forming_sim/loads/rotation.h"

namespace forming_sim {
namespace {

[[noreturn]] void refuse(const std::string& field, const std::string& given, const std::string& remedy) {
  throw Error(Code::invalid_scene, "motion." + field + ": given " + given + "; " + remedy);
}

/// One value per knot; nothing given means zero at every knot.
std::vector<Vec3> knots(const std::vector<Vec3>& values, size_t count, const char* field, double scale) {
  if (values.empty()) return std::vector<Vec3>(count, Vec3::Zero());
  if (values.size() != count)
    refuse(field, std::to_string(values.size()) + " values for " + std::to_string(count) + " times",
           "give one value per time, or none");
  std::vector<Vec3> scaled;
  for (const Vec3& value : values) scaled.push_back(scale * value);
  return scaled;
}

void stay_in_plane(const std::vector<Vec3>& values, bool about_z, const char* field) {
  for (size_t k = 0; k < values.size(); ++k) {
    const bool out = about_z ? values[k].x() != 0 || values[k].y() != 0 : values[k].z() != 0;
    if (out)
      refuse(std::string(field) + "[" + std::to_string(k) + "]", "a motion out of the x-y plane",
             about_z ? "in dimension 2 give [0, 0, value]" : "in dimension 2 give [x, y, 0]");
  }
}

/// All vectors along one line through zero.
bool one_axis(const std::vector<Vec3>& values) {
  Vec3 longest = Vec3::Zero();
  for (const Vec3& value : values)
    if (value.norm() > longest.norm()) longest = value;
  return std::all_of(values.begin(), values.end(), [&](const Vec3& value) {
    return value.cross(longest).norm() <= 1e-14 * longest.squaredNorm();
  });
}

/// One step of R' = spin x R by the fourth-order Magnus series at two Gauss points:
/// W = h/2 (w1 + w2) - sqrt(3)/12 h^2 w1 x w2, R <- exp(W) R.
Mat3 magnus_step(const Curve& spin, double from, double to, const Mat3& rotation) {
  const double h = to - from, reach = std::sqrt(3.0) / 6 * h, middle = 0.5 * (from + to);
  const Vec3 w1 = spin.at(middle - reach), w2 = spin.at(middle + reach);
  return rotation_matrix(0.5 * h * (w1 + w2) - std::sqrt(3.0) / 12 * h * h * w1.cross(w2)) * rotation;
}

Curve shaped(const std::string& profile, bool trajectory, const std::vector<double>& times,
             const std::vector<Vec3>& values) try {
  if (profile == "linear") return Curve::linear(times, values);
  if (profile == "smooth") return trajectory ? Curve::quintic(times, values) : Curve::cubic(times, values);
  if (profile == "spline" && trajectory) return Curve::spline(times, values);
  refuse("profile", "\"" + profile + "\"",
         trajectory ? "a trajectory is smooth, linear or spline" : "a velocity is smooth or linear");
} catch (const Error& error) {
  const std::string what = error.what();
  throw Error(error.code(), what.rfind("motion.", 0) == 0 ? what : "motion." + what);
}

}  // namespace

RigidMotion::RigidMotion(const MotionConfig& config, int dimension) {
  const bool trajectory = config.by_places();
  if (!trajectory && config.kind != "velocity" && !config.by_force())
    refuse("kind", "\"" + config.kind + "\"", "give trajectory, velocity or force");
  const size_t count = config.times.size();
  if (count == 0) refuse("times", "none", "give the times of the knots, or leave the motion out");
  const char* names[] = {trajectory ? "positions" : "velocities",
                         trajectory ? "rotations_deg" : "spins_deg_s"};
  const std::vector<Vec3> shifts =
      knots(trajectory ? config.positions : config.velocities, count, names[0], 1);
  const std::vector<Vec3> turns =
      knots(trajectory ? config.rotations_deg : config.spins_deg_s, count, names[1], kRadiansPerDegree);
  if (dimension == 2) {
    stay_in_plane(shifts, false, names[0]);
    stay_in_plane(turns, true, names[1]);
    stay_in_plane({config.centre}, false, "centre");
  }

  path_ = shaped(config.profile, trajectory, config.times, shifts);
  Curve turning = shaped(config.profile, trajectory, config.times, turns);
  if (trajectory) {
    rotation_vector_ = turning;
    return;
  }
  path_ = path_.integral(0);
  if (one_axis(turns)) {
    rotation_vector_ = turning.integral(0);
    return;
  }

  // Spins of changing axis: orientations at fine steps, from t = 0 on.
  spin_ = turning;
  Turns reached;
  reached.times.push_back(0);
  for (size_t k = 0; k < count; ++k) {
    const double from = reached.times.back(), to = config.times[k];
    if (to <= from) continue;
    double fastest = 0;
    for (const Vec3& turn : turns) fastest = std::max(fastest, turn.norm());
    constexpr double kMostSteps = 1e6;
    const double steps = std::max(64.0, std::ceil(fastest * (to - from) / kRadiansPerDegree)), all = reached.times.size() + steps;
    if (!(all <= kMostSteps))
      refuse("spins_deg_s", "spins about a changing axis by " + number_text(all) + " degrees until " + number_text(to) + " s",
             "orientations are found at most a degree apart, " + number_text(kMostSteps) + " of them at most: give times that end with the stages, smaller spins, or spins about one axis");
    for (int j = 1; j <= steps; ++j) reached.times.push_back(from + (to - from) * j / steps);
  }
  reached.rotations.push_back(Mat3::Identity());
  for (size_t k = 1; k < reached.times.size(); ++k)
    reached.rotations.push_back(
        magnus_step(spin_, reached.times[k - 1], reached.times[k], reached.rotations.back()));
  turns_ = std::make_shared<const Turns>(std::move(reached));
}

Mat3 RigidMotion::turned(double t) const {
  const auto after = std::upper_bound(turns_->times.begin(), turns_->times.end(), t);
  const size_t k = std::max<std::ptrdiff_t>(0, after - turns_->times.begin() - 1);
  return magnus_step(spin_, turns_->times[k], t, turns_->rotations[k]);
}

RigidMotion RigidMotion::beginning(double t) const {
  RigidMotion later = *this;
  later.began_ = t;
  return later;
}

Pose RigidMotion::at(double time) const {
  const double t = time - began_;
  Pose pose;
  pose.translation = path_.at(t);
  pose.velocity = path_.slope(t);
  if (turns_) {
    pose.rotation = turned(t);
    pose.spin = spin_.at(t);
    return pose;
  }
  const Vec3 vector = rotation_vector_.at(t);
  pose.rotation = rotation_matrix(vector) * base_;
  pose.spin = spin_of(vector, rotation_vector_.slope(t));
  return pose;
}

RigidMotion withdraw(const Pose& from, const Vec3& displacement, double start, double duration) {
  if (!(duration > 0) || !std::isfinite(duration))
    throw Error(Code::invalid_scene, "withdraw: given a duration of " + std::to_string(duration) +
                                         " s; tools need a time above 0 to move away");
  RigidMotion motion;
  motion.path_ =
      Curve::quintic({start, start + duration}, {from.translation, from.translation + displacement});
  motion.base_ = from.rotation;
  return motion;
}

RigidMotion stay(const Pose& at) {
  RigidMotion motion;
  motion.path_ = Curve::linear({0}, {at.translation});
  motion.base_ = at.rotation;
  return motion;
}

Pose turned_about(const Vec3& axle, double angle, double rate, Pose pose) {
  pose.spin += rate * (pose.rotation * axle);
  pose.rotation = pose.rotation * rotation_matrix(angle * axle);
  return pose;
}

ToolPose tool_pose(const ToolModel& tool, const Pose& pose) {
  const Vec3 centre = tool.motion ? tool.motion->centre : Vec3(Vec3::Zero());
  const Vec3 arm = pose.rotation * (tool.position - centre);
  ToolPose frame;
  frame.position = centre + pose.translation + arm;
  frame.rotation = pose.rotation * rotation_matrix(kRadiansPerDegree * tool.rotation_deg);
  frame.velocity = pose.velocity + pose.spin.cross(arm);
  frame.travel = pose.velocity;
  frame.spin = pose.spin;
  return frame;
}

double reach_from_axle(const ToolModel& tool) {
  const ToolPose start = tool_pose(tool, Pose());
  const Vec3 axle = tool.motion->axle.stableNormalized();
  double farthest = 0;
  for (const Vec3& node : tool.mesh.nodes) farthest = std::max(farthest, axle.cross(start.position + start.rotation * node - tool.motion->centre).norm());
  return farthest;
}

}  // namespace forming_sim
