#pragma once
// The service: action simulate_forming, services validate_scene and
// estimate_run, the topics of a run.
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include <actionlib/server/action_server.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include "forming_sim/EstimateRun.h"
#include "forming_sim/SimulateFormingAction.h"
#include "forming_sim/ValidateScene.h"
#include "forming_sim/config/fault.h"
#include "forming_sim/ros/publisher.h"

namespace forming_sim {

/// One run at a time, on a thread of its own: callbacks only hand goals and
/// cancels over. A goal is rejected with all its faults, or as busy, or accepted;
/// one that comes while the run before it is being cancelled waits for that.
/// A cancel counts from the moment the goal came.
class FormingServer {
 public:
  /// node: private to the node; parameters output_root, threads and those of
  /// PublishOptions. Throws Error for a parameter out of range.
  explicit FormingServer(const ros::NodeHandle& node);
  ~FormingServer();

  /// Cancels the run under way, waits until its files are closed and its client
  /// is told, and takes no more goals. Can be called again.
  void stop();

 private:
  using Server = actionlib::ActionServer<SimulateFormingAction>;
  using Goal = Server::GoalHandle;
  using Clock = std::chrono::steady_clock;
  struct Waiting {
    Goal goal;
    Clock::time_point received;
    bool cancelled;
  };

  /// To a goal: how far it came, and the result.
  struct Answer {
    std::string scene;      ///< its name
    bool accepted = false, begun = false;
    SimulateFormingResult result;
  };

  void on_goal(Goal goal);
  void on_cancel(Goal goal);
  bool on_validate(ValidateScene::Request& request, ValidateScene::Response& response);
  bool on_estimate(EstimateRun::Request& request, EstimateRun::Response& response);

  void work();
  void serve(Goal goal, Clock::time_point received);
  /// A status of a goal that does not run: it is prepared (Code::none), or it ended before its first step.
  void tell(const std::string& scene, Code code, const std::string& message);
  RunStatus before_a_run() const;
  /// Prepares and runs what it is the answer to; throws Error, and then holds how far it came.
  void run(Goal& goal, Answer& answer);
  void finish(Goal& goal, const Answer& answer);
  /// Until the client of a goal that came then can take an answer to it.
  void wait_for_client(const Goal& goal, Clock::time_point received) const;
  void note_listener(const std::string& node, int more);
  bool listens(const std::string& node) const;

  ros::NodeHandle node_;
  int threads_ = 0;
  std::string output_root_;
  RunPublisher publisher_;

  std::mutex mutex_;                 ///< of the four below
  std::condition_variable changed_;
  std::unique_ptr<Waiting> waiting_; ///< handed over, not yet taken by the worker
  std::unique_ptr<Goal> current_;    ///< taken by the worker, not yet done; cancel_ is its own
  bool stopping_ = false;

  mutable std::mutex listeners_mutex_;
  std::map<std::string, int> listeners_;  ///< by name of the node: its ways to the results

  std::atomic<bool> cancel_{false};
  Server server_;
  ros::Publisher results_;           ///< the topics of server_, to see who is connected
  ros::Subscriber goals_;
  ros::CallbackQueue service_queue_;
  ros::AsyncSpinner service_threads_{2, &service_queue_};
  ros::ServiceServer validate_, estimate_;
  std::thread worker_;
};

}  // namespace forming_sim
