#include "forming_sim/ros/observer.h"

#include <algorithm>

#include "forming_sim/simulation/simulation.h"

namespace forming_sim {
namespace {

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

RosObserver::RosObserver(RunPublisher& publisher, std::string scene, Feedback feedback)
    : publisher_(publisher), scene_(std::move(scene)), feedback_(std::move(feedback)) {}

void RosObserver::begin(const Simulation& simulation) {
  clock_.start(simulation.progress(), now_s());
  sheets_ = Thickness(simulation.model());
  if (publisher_.colours_by("limit_ratio")) limits_ = FormingLimits(simulation.model());
  publisher_.start(shape_of(simulation, scene_));
  begun_ = true;
}

void RosObserver::on_start(const Simulation& simulation) {
  begin(simulation);
  tell(simulation, true, Code::none, "running");
}

void RosObserver::on_step(const Simulation& simulation) {
  if (publisher_.is_due()) tell(simulation, false, Code::none, "running");
}

void RosObserver::on_stage_end(const Simulation& simulation, int) {
  tell(simulation, true, Code::none, "running");
}

void RosObserver::on_end(const Simulation& simulation, Code code, const std::string& message) {
  if (!begun_) begin(simulation);  // an observer before this one could not
  tell(simulation, true, code, message);
}

void RosObserver::tell(const Simulation& simulation, bool always, Code code, const std::string& message) {
  RunFrame frame = frame_of(simulation, always || publisher_.wants_contact());
  double thinnest = -1;
  if (sheets_.any()) {
    const std::vector<double> thickness = sheets_.at(simulation.positions());
    thinnest = smallest(thickness, sheets_.top()).value_or(-1);
    if (publisher_.colours_by("thinning")) frame.thinning = sheets_.thinning(thickness);
  }
  if (publisher_.colours_by("damage")) frame.damage = simulation.damage();
  if (publisher_.colours_by("limit_ratio")) frame.limit_ratio = limits_.at(simulation.positions()).ratio;
  RunStatus status = status_of(simulation, frame, scene_, clock_.left(simulation.progress(), now_s()), thinnest);
  status.header = publisher_.header();
  status.running = code == Code::none;
  status.code = static_cast<int>(code);
  status.message = message;
  feedback_(status);
  publisher_.publish(frame, status, always);
}

}  // namespace forming_sim
