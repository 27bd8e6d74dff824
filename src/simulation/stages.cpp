#include "simulation/stages.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "forming_sim/simulation/release.h"
#include "forming_sim/simulation/stage_times.h"

namespace forming_sim {

StageRunner::StageRunner(const std::vector<StageConfig>& stages, const Model& model) : stages_(stages), model_(&model) {
  for (const ToolModel& tool : model.tools) {
    const bool by_force = tool.motion && tool.motion->by_force();
    courses_.push_back(tool.motion ? RigidMotion(*tool.motion, model.dimension) : RigidMotion());
    motions_.push_back(tool.motion ? stay(courses_.back().at(0)) : RigidMotion());
    stop_force_.push_back(0);
    drives_.push_back(by_force ? std::optional<ForceDrive>(*tool.motion) : std::nullopt);
    axles_.push_back(tool.turns_freely() ? std::optional<AxleDrive>(*tool.motion) : std::nullopt);
  }
  state_.assign(model.tools.size(), waiting);
  present_.assign(model.tools.size(), 1);
  stops_.assign(model.tools.size(), std::numeric_limits<double>::quiet_NaN());
  known_.resize(motions_.size());
  starts_.push_back(0);
  if (!finished()) begin(0);
}

bool StageRunner::leaves(const StageConfig& stage, int tool) const { return takes_away(stage, model_->tools[tool].name); }

double StageRunner::began(const std::string& since) const {
  const std::size_t stage = first_stage(since, stages_);
  return stage < starts_.size() ? starts_[stage] : std::numeric_limits<double>::infinity();
}

void StageRunner::begin_motion(int tool, double t) {
  motions_[tool] = courses_[tool].beginning(t);
  state_[tool] = begun;
  if (drives_[tool]) drives_[tool]->begin(t);
  if (axles_[tool]) axles_[tool]->begin(t);
  stop_force_[tool] = model_->tools[tool].motion->stop_force;
}

void StageRunner::begin(double t) {
  known_.assign(motions_.size(), {});
  for (std::size_t k = 0; k < motions_.size(); ++k) {
    if (present_[k] && model_->tools[k].motion && first_stage(model_->tools[k].motion->since, stages_) == index_) begin_motion(static_cast<int>(k), t);
    if (!present_[k] || !leaves(stages_[index_], static_cast<int>(k))) continue;
    const Vec3& displacement = stages_[index_].displacement;
    Pose from = motions_[k].at(t);
    if (const ForceDrive* by = drive(static_cast<int>(k))) from = by->placed(from, by->gone(), by->speed());
    if (state_[k] == begun) state_[k] = withdrawn;
    stop_force_[k] = 0;
    present_[k] = !displacement.isZero();
    motions_[k] = present_[k] ? withdraw(from, displacement, t, stages_[index_].duration) : stay(from);
  }
}

void StageRunner::advance(double t) {
  left_ = present_;
  for (std::size_t k = 0; k < motions_.size(); ++k)
    if (leaves(stages_[index_], static_cast<int>(k))) present_[k] = 0;
  ++index_;
  starts_.push_back(t);
  if (!finished()) begin(t);
  for (std::size_t k = 0; k < present_.size(); ++k) left_[k] = left_[k] && !present_[k];
}

double StageRunner::remaining(double t) const {
  return finished() ? 0 : std::max(0.0, starts_.back() + longest_time(stages_[index_]) - t);
}

double StageRunner::progress(double t) const {
  double done = 0, total = 0;
  for (std::size_t k = 0; k < stages_.size(); ++k) {
    const double length = longest_time(stages_[k]);
    total += length;
    if (static_cast<int>(k) < index_) done += length;
    else if (static_cast<int>(k) == index_) done += std::min(length, t - starts_.back());
  }
  return total > 0 ? done / total : 1;
}

Pose StageRunner::pushed(int tool, double t, double way, double speed, double angle, double spin) const {
  Pose pose = motions_[tool].at(t);
  if (const ForceDrive* by = drive(tool)) pose = by->placed(pose, way, speed);
  if (!axle(tool)) return pose;
  const Vec3& a = axle(tool)->axle();
  return turned_about(a, angle, spin - pose.spin.dot(pose.rotation * a), pose);
}

// The twist about the axle a of R(t)^T R(t + dt), in the tool's own frame: of its quaternion (w, q) the angle 2 atan2(q.a, w).
double StageRunner::told_turn(int tool, double t, double dt) const {
  const Eigen::Quaterniond turn(Mat3(told(tool, t).rotation.transpose() * told(tool, t + dt).rotation));
  const double sign = turn.w() < 0 ? -1 : 1;
  return 2 * std::atan2(sign * turn.vec().dot(axles_[tool]->axle()), sign * turn.w());
}

Pose StageRunner::course(int tool, double t) const {
  const ForceDrive* along = drive(tool);
  const AxleDrive* about = axle(tool);
  return pushed(tool, t, along ? along->gone() : 0, along ? along->speed() : 0, about ? about->angle() : 0, about ? about->speed() : 0);
}

ToolPose StageRunner::pushed_by_none(int tool, double t, double kick, double dt) const {
  const ForceDrive* along = drive(tool);
  const AxleDrive* about = axle(tool);
  if (!along && !about) return pose(tool, t + dt);
  const double speed = along ? along->free_speed(t, kick) : 0, spin = about ? about->free_speed(t, kick) : 0;
  return tool_pose(model_->tools[tool], pushed(tool, t + dt, along ? along->gone() + dt * speed : 0, speed, about ? about->angle() + dt * spin - told_turn(tool, t, dt) : 0, spin));
}

StageRunner::Line StageRunner::axle_now(int tool, double t) const {
  const Pose at = course(tool, t);
  return {model_->tools[tool].motion->centre + at.translation, at.rotation * axles_[tool]->axle()};
}

ToolPose StageRunner::pose(int tool, double t) const {
  if (drive(tool) || axle(tool)) return tool_pose(model_->tools[tool], course(tool, t));
  std::array<KnownPose, 2>& known = known_[tool];
  for (const KnownPose& k : known)
    if (k.time == t) return k.pose;
  known[1] = known[0];
  known[0] = {t, tool_pose(model_->tools[tool], course(tool, t))};
  return known[0].pose;
}

void StageRunner::stop(int tool, double t) {
  motions_[tool] = stay(motions_[tool].at(t));
  stop_force_[tool] = 0;
  stops_[tool] = t;
  known_[tool] = {};
}

bool StageRunner::stopped(int tool) const { return !std::isnan(stops_[tool]); }

bool StageRunner::stopped(const std::string& tool) const {
  if (tool.empty()) return false;
  for (std::size_t k = 0; k < stops_.size(); ++k)
    if (model_->tools[k].name == tool) return stopped(static_cast<int>(k));
  return false;
}

void StageRunner::replay(const std::vector<double>& starts, const std::vector<double>& stops) {
  const auto stop_until = [&](double t) {
    for (std::size_t k = 0; k < stops.size(); ++k)
      if (stops[k] <= t && std::isnan(stops_[k])) stop(static_cast<int>(k), stops[k]);
  };
  for (std::size_t k = 1; k < starts.size(); ++k) {
    stop_until(starts[k]);  // before what the next stage does to the tool
    advance(starts[k]);
  }
  stop_until(std::numeric_limits<double>::infinity());
}

}  // namespace forming_sim
