#pragma once
// Watches a run for ROS: topics and feedback, at most publish_rate times a second.
#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "forming_sim/results/forming_limits.h"
#include "forming_sim/results/thickness.h"
#include "forming_sim/ros/publisher.h"
#include "forming_sim/ros/status.h"
#include "forming_sim/simulation/observer.h"

namespace forming_sim {

class RosObserver : public Observer {
 public:
  using Feedback = std::function<void(const RunStatus&)>;
  /// publisher must outlive the observer.
  RosObserver(RunPublisher& publisher, std::string scene, Feedback feedback);

  void on_start(const Simulation& simulation) override;
  void on_step(const Simulation& simulation) override;
  void on_stage_end(const Simulation& simulation, int index) override;
  void on_end(const Simulation& simulation, Code code, const std::string& message) override;
  /// The run has got as far as its files.
  bool begun() const { return begun_; }

 private:
  void begin(const Simulation& simulation);
  void tell(const Simulation& simulation, bool always, Code code, const std::string& message);

  RunPublisher& publisher_;
  std::string scene_;
  Feedback feedback_;
  EtaClock clock_;
  Thickness sheets_;
  FormingLimits limits_;
  bool begun_ = false;
};

}  // namespace forming_sim
