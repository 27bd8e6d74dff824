#pragma once
// The plan of stages as it runs: which stage, since when, and where the tools
// are told to be.
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "forming_sim/loads/drive.h"
#include "forming_sim/loads/motion.h"
#include "forming_sim/simulation/model.h"
#include "forming_sim/simulation/plan.h"

namespace forming_sim {

class StageRunner {
 public:
  StageRunner(const std::vector<StageConfig>& stages, const Model& model);

  int index() const { return index_; }
  bool finished() const { return index_ >= static_cast<int>(stages_.size()); }
  const StageConfig& stage() const { return stages_[index_]; }
  bool settling() const { return !finished() && stage().kind == "settle"; }
  double start() const { return starts_.back(); }
  /// Longest time the running stage may still take at time t, s.
  double remaining(double t) const;
  /// Ends the running stage and begins the next one at time t.
  void advance(double t);
  /// 0..1 by simulated time; a settle stage counts by its limit.
  double progress(double t) const;

  /// Where a tool stands at time t; what moves as it is pushed, where it has come to.
  ToolPose pose(int tool, double t) const;
  /// Where it stands after a step of dt from t on if nothing presses on it.
  ToolPose pushed_by_none(int tool, double t, double kick, double dt) const;
  /// What drives a tool now; null: no force does.
  const ForceDrive* drive(int tool) const { return state_[tool] == begun && drives_[tool] ? &*drives_[tool] : nullptr; }
  ForceDrive* drive(int tool) { return state_[tool] == begun && drives_[tool] ? &*drives_[tool] : nullptr; }
  /// About what it turns freely now; null: it does not.
  const AxleDrive* axle(int tool) const { return state_[tool] != waiting && axles_[tool] ? &*axles_[tool] : nullptr; }
  AxleDrive* axle(int tool) { return state_[tool] != waiting && axles_[tool] ? &*axles_[tool] : nullptr; }
  /// How far a tool that has an axle has turned about it, rad.
  double turned(int tool) const { return axles_[tool]->gone(); }
  /// A line in space: where the axle of a tool that has one is at time t.
  struct Line {
    Vec3 point, along;
  };
  Line axle_now(int tool, double t) const;
  /// Where a tool is told to be, what pushes it left out.
  Pose told(int tool, double t) const { return motions_[tool].at(t); }
  /// By which what is told turns about the axle of a tool that has one from t to t + dt, rad.
  double told_turn(int tool, double t, double dt) const;
  /// When what has this `since` began; infinity: it has not.
  double began(const std::string& since) const;
  bool present(int tool) const { return present_[tool]; }
  /// Force at which the tool stops, N; 0: none does, or it has stopped or is on its way off.
  double stop_force(int tool) const { return stop_force_[tool]; }
  /// The tool stays for good where it is at time t.
  void stop(int tool, double t);
  /// It has been stopped.
  bool stopped(int tool) const;
  bool stopped(const std::string& tool) const;  ///< by its name; false: none has it
  /// The stage takes this tool away.
  bool leaves(const StageConfig& stage, int tool) const;
  /// 1: tools that were there until the running stage began.
  const std::vector<char>& left() const { return left_; }

  /// Start times of the stages begun so far.
  const std::vector<double>& starts() const { return starts_; }
  /// With them, when tools were stopped; NaN: not.
  const std::vector<double>& stops() const { return stops_; }
  void replay(const std::vector<double>& starts, const std::vector<double>& stops);
  /// What pushes have done to the tools: before replay().
  template <class Archive> void exchange_drives(Archive& a) {
    for (std::optional<ForceDrive>& drive : drives_)
      if (drive) drive->exchange(a);
    for (std::optional<AxleDrive>& axle : axles_)
      if (axle) axle->exchange(a);
  }

 private:
  void begin(double t);
  void begin_motion(int tool, double t);
  /// Where its motion has come to, pushes included.
  Pose course(int tool, double t) const;
  /// What it is told at time t, and pushed along by `way` at `speed`; about its axle turned by `angle` against that, at `spin` in all.
  Pose pushed(int tool, double t, double way, double speed, double angle, double spin) const;

  std::vector<StageConfig> stages_;
  const Model* model_;
  std::vector<RigidMotion> courses_;  ///< as the scene tells them; none: it rests
  std::vector<RigidMotion> motions_;  ///< now: waiting, on its course, stopped, withdrawn
  std::vector<std::optional<ForceDrive>> drives_;  ///< of the tools that a force drives
  std::vector<std::optional<AxleDrive>> axles_;    ///< of those that turn freely
  enum State : char { waiting, begun, withdrawn };  ///< what a force drives it does while begun; what turns freely does so from then on
  std::vector<State> state_;
  std::vector<char> present_, left_;
  std::vector<double> starts_, stops_, stop_force_;
  int index_ = 0;
  struct KnownPose {
    double time = std::numeric_limits<double>::quiet_NaN();
    ToolPose pose;
  };
  mutable std::vector<std::array<KnownPose, 2>> known_;  ///< per tool the last two answers, the later first: the same time is asked for by several
};

}  // namespace forming_sim
