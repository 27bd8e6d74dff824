#include "forming_sim/ros/server.h"

#include <malloc.h>

#include <cstdlib>

#include "forming_sim/ResultCode.h"
#include "forming_sim/parallel/interrupt.h"
#include "forming_sim/parallel/team.h"
#include "forming_sim/ros/convert.h"
#include "forming_sim/ros/observer.h"
#include "forming_sim/ros/parameter.h"
#include "forming_sim/ros/prepare.h"
#include "forming_sim/ros/summary.h"
#include "forming_sim/results/estimate.h"
#include "forming_sim/results/run_scene.h"

namespace forming_sim {
namespace {

using namespace std::chrono_literals;
constexpr auto kSettled = 100ms, kLook = 2ms;  // messages that belong together have come, on all topics; how often one looks

std::string default_output_root() {
  const char* home = std::getenv("HOME");
  return std::string(home ? home : ".") + "/forming_sim_runs";
}

SimulateFormingResult result_of(Code code, const std::string& message) {
  SimulateFormingResult result;
  result.code = static_cast<int>(code);
  result.message = message;
  return result;
}

SimulateFormingResult rejection(const std::vector<Fault>& faults) {
  Code code = faults.front().code;
  for (const Fault& fault : faults) if (fault.code != code) code = Code::invalid_scene;
  std::string text = faults.size() == 1 ? "the goal has a fault:" : "the goal has " + std::to_string(faults.size()) + " faults:";
  for (const Fault& fault : faults) text += "\n  " + fault.sentence();
  SimulateFormingResult result = result_of(code, text);
  result.faults = fault_messages(faults);
  return result;
}

/// The name of the node that sent a goal: clients of actionlib begin the goal's id with it, and end it with a count and a time. Empty: of another.
std::string sender_of(const std::string& goal_id) {
  const std::size_t time = goal_id.rfind('-'), count = time == 0 || time == std::string::npos ? time : goal_id.rfind('-', time - 1);
  return count == std::string::npos || goal_id[0] != '/' ? "" : goal_id.substr(0, count);
}

/// What a large scene took is the system's again when its run, or what was asked of it, has ended.
struct GivesBack {
  ~GivesBack() { malloc_trim(0); }
};

CostEstimate estimate_message(const Estimate& estimate) {
  CostEstimate message;
  message.nodes = estimate.nodes;
  message.elements = estimate.elements;
  message.time_step_s = estimate.time_step_s;
  message.steps = estimate.steps;
  message.wall_time_s = estimate.wall_time_s;
  message.memory_bytes = estimate.memory_bytes;
  return message;
}

}  // namespace

FormingServer::FormingServer(const ros::NodeHandle& node)
    : node_(node),
      publisher_(node, PublishOptions::read(node)),
      server_(
          node_, "simulate_forming", [this](Goal goal) { on_goal(goal); }, [this](Goal goal) { on_cancel(goal); }, false) {
  read_parameter(node_, "threads", "a whole number", threads_);
  if (threads_ < 0 || threads_ > kMostThreads)
    refuse_parameter(node_, "threads", std::to_string(threads_), "give 1 to " + std::to_string(kMostThreads) + " threads, or 0 for one a processor");
  read_parameter(node_, "output_root", "a directory", output_root_);
  if (output_root_.empty()) output_root_ = default_output_root();
  if (const std::string why = fault_of_root(output_root_); !why.empty())
    ROS_WARN("parameter %s: given %s; %s: goals without an output_directory will be rejected", node_.resolveName("output_root").c_str(), output_root_.c_str(), why.c_str());
  // In threads of their own: a service that meshes a large part holds up no cancel.
  ros::NodeHandle services(node_);
  services.setCallbackQueue(&service_queue_);
  validate_ = services.advertiseService("validate_scene", &FormingServer::on_validate, this);
  estimate_ = services.advertiseService("estimate_run", &FormingServer::on_estimate, this);
  service_threads_.start();
  warn_of_unknown_parameters(node_, {"threads", "output_root"});
  RunStatus idle = before_a_run();
  idle.message = "no run so far";
  publisher_.publish(idle);
  worker_ = std::thread([this] { work(); });
  server_.start();
  results_ = node_.advertise<SimulateFormingActionResult>(
      "simulate_forming/result", 1, [this](const ros::SingleSubscriberPublisher& listener) { note_listener(listener.getSubscriberName(), 1); },
      [this](const ros::SingleSubscriberPublisher& listener) { note_listener(listener.getSubscriberName(), -1); });
  goals_ = node_.subscribe<SimulateFormingActionGoal>("simulate_forming/goal", 1, boost::function<void(const SimulateFormingActionGoalConstPtr&)>([](const SimulateFormingActionGoalConstPtr&) {}));
}

FormingServer::~FormingServer() { stop(); }

void FormingServer::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
    cancel_ = true;
  }
  changed_.notify_all();
  if (worker_.joinable()) worker_.join();
}

void FormingServer::note_listener(const std::string& node, int more) {
  const std::lock_guard<std::mutex> lock(listeners_mutex_);
  if ((listeners_[node] += more) == 0) listeners_.erase(node);
}

bool FormingServer::listens(const std::string& node) const {
  const std::lock_guard<std::mutex> lock(listeners_mutex_);
  return listeners_.count(node) > 0;
}

// Answers that come at once are lost, and their clients wait for ever: actionlib's client in C++ takes itself for connected
// as soon as it has opened its way to the results, which may be before this node knows of it; the one in Python drops what
// comes before its send_goal has returned.
void FormingServer::wait_for_client(const Goal& goal, Clock::time_point received) const {
  const std::string sender = sender_of(goal.getGoalID().id);
  while (ros::ok()) {
    const auto age = Clock::now() - received;
    const bool heard = sender.empty() ? results_.getNumSubscribers() >= goals_.getNumPublishers() : listens(sender);
    if (age >= kSettled && (heard || age >= 2s)) return;
    std::this_thread::sleep_for(kLook);
  }
}

void FormingServer::on_goal(Goal goal) {
  const auto received = Clock::now();
  // The cancel of the run before it, sent before it, may come a little later: by another topic.
  for (; ros::ok() && Clock::now() - received < kSettled; std::this_thread::sleep_for(kLook)) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!waiting_ && !(current_ && !cancel_) && !stopping_) {
      // Its cancel may have come already, in another thread: then on_cancel did not know the goal yet.
      const int status = goal.getGoalStatus().status;
      const bool cancelled = status == actionlib_msgs::GoalStatus::RECALLING || status == actionlib_msgs::GoalStatus::PREEMPTING;
      waiting_ = std::make_unique<Waiting>(Waiting{goal, received, cancelled});
      changed_.notify_all();
      return;
    }
  }
  const bool stops = [&] {
    const std::lock_guard<std::mutex> lock(mutex_);
    return stopping_ || !ros::ok();
  }();
  const auto result = result_of(Code::busy, stops ? "the server is being shut down; send the goal when it runs again"
                                                  : "another run is under way; send the goal again when it has ended, or cancel it");
  wait_for_client(goal, received);
  goal.setRejected(result, result.message);
}

void FormingServer::on_cancel(Goal goal) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (waiting_ && waiting_->goal == goal) waiting_->cancelled = true;
  if (current_ && *current_ == goal) cancel_ = true;
}

void FormingServer::work() {
  for (;;) {
    const GivesBack memory;
    std::unique_ptr<Waiting> next;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait(lock, [this] { return stopping_ || waiting_; });
      if (!waiting_) return;
      next = std::move(waiting_);
      current_ = std::make_unique<Goal>(next->goal);
      cancel_ = next->cancelled || stopping_;
    }
    serve(next->goal, next->received);
  }
}

void FormingServer::serve(Goal goal, Clock::time_point received) {
  Answer answer;
  answer.scene = goal.getGoal()->scene.name;
  SimulateFormingResult& result = answer.result;
  tell(answer.scene, Code::none, "the scene is being checked and meshed");
  try {
    run(goal, answer);
  } catch (const Error& error) {
    result.code = static_cast<int>(error.code());
    result.message = error.what();
  } catch (const std::exception& error) {
    result.code = ResultCode::INTERNAL_ERROR;
    result.message = std::string("the run ended with an unexpected error: ") + error.what();
  }
  if (result.code == ResultCode::NONE) {
    result.code = ResultCode::INTERNAL_ERROR;
    result.message = "the run ended without an outcome: " + result.message;
  }
  if (!answer.begun) tell(answer.scene, static_cast<Code>(result.code), result.message);
  wait_for_client(goal, received);
  {
    // From here a new goal is welcome: its client may have waited for this result only.
    const std::lock_guard<std::mutex> lock(mutex_);
    current_.reset();
  }
  finish(goal, answer);
}

void FormingServer::tell(const std::string& scene, Code code, const std::string& message) {
  RunStatus status = before_a_run();
  status.scene = scene;
  status.running = code == Code::none;
  status.stage = "preparing";
  status.code = static_cast<int>(code);
  status.message = message;
  publisher_.publish(status);
}

RunStatus FormingServer::before_a_run() const {
  RunStatus status;
  status.header = publisher_.header();
  status.eta_s = -1;
  status.min_thickness_m = -1;
  status.min_gap_over_layer = 1;
  return status;
}

void FormingServer::run(Goal& goal, Answer& answer) {
  SimulateFormingResult& result = answer.result;
  const auto request = goal.getGoal();
  const int threads = choose_threads(request->threads, threads_);
  std::string resume;
  Scene scene;
  std::unique_ptr<Simulation> simulation;
  {
    const Interruptible while_wanted(cancel_);
    Prepared prepared = prepare(request->scene, request->scene_text, threads);
    resume = check_resume(request->resume, prepared);
    answer.scene = prepared.scene.name;
    if (!prepared.faults.empty()) {
      result = rejection(prepared.faults);
      return;
    }
    scene = std::move(prepared.scene);
    simulation = std::move(prepared.simulation);
  }
  std::string directory;
  try {
    if (cancel_) {
      result = result_of(Code::cancelled, "cancelled before the first step");
      return;
    }
    directory = make_output_directory(request->output_directory, output_root_, scene.name);
  } catch (const Error& error) {
    const bool chosen = request->output_directory.empty();
    result = rejection({{error.code(), chosen ? "output_root" : "output_directory", '"' + (chosen ? output_root_ : request->output_directory) + '"',
                       std::string(error.what()) + "; give a directory that the server may write to"}});
    return;
  }

  goal.setAccepted("running; files go to " + directory);
  answer.accepted = true;
  ROS_INFO("%s: running with %d threads, files in %s", scene.name.c_str(), threads, directory.c_str());

  RosObserver observer(publisher_, scene.name, [&goal](const RunStatus& status) {
    SimulateFormingFeedback feedback;
    feedback.status = status;
    goal.publishFeedback(feedback);
  });
  const Outcome outcome = run_scene(scene, directory, threads, resume, cancel_, {&observer}, std::move(simulation));

  result = result_of(outcome.code, outcome.message);
  result.directory = directory;
  answer.begun = observer.begun();
  if (!answer.begun) return;  // what is in the directory is of other runs
  result.files = run_files(directory, scene.output.formed);
  try {
    result.summary = read_summary(directory);
  } catch (const Error& error) {
    if (outcome.code == Code::success) result = result_of(error.code(), error.what());
  }
}

void FormingServer::finish(Goal& goal, const Answer& answer) {
  const SimulateFormingResult& result = answer.result;
  const auto level = [&] {
    if (result.code == ResultCode::SUCCESS || result.code == ResultCode::CANCELLED) return ros::console::levels::Info;
    return answer.accepted ? ros::console::levels::Error : ros::console::levels::Warn;
  }();
  ROS_LOG(level, ROSCONSOLE_DEFAULT_NAME, "%s: %s", answer.scene.c_str(), result.message.c_str());
  if (result.code == ResultCode::CANCELLED) {
    goal.setCanceled(result, result.message);
  } else if (!answer.accepted) {
    goal.setRejected(result, result.message);
  } else if (result.code == ResultCode::SUCCESS) {
    goal.setSucceeded(result, result.message);
  } else {
    goal.setAborted(result, result.message);
  }
}

bool FormingServer::on_validate(ValidateScene::Request& request, ValidateScene::Response& response) {
  const GivesBack memory;
  const Prepared prepared = prepare(request.scene, request.scene_text, 1);
  response.valid = prepared.faults.empty();
  response.faults = fault_messages(prepared.faults);
  response.notes = prepared.notes;
  return true;
}

bool FormingServer::on_estimate(EstimateRun::Request& request, EstimateRun::Response& response) {
  const GivesBack memory;
  const int threads = choose_threads(request.threads, threads_);
  Prepared prepared = prepare(request.scene, request.scene_text, threads);
  if (prepared.faults.empty()) {
    try {
      const Estimate estimate = estimate_run(*prepared.simulation);
      response.estimate = estimate_message(estimate);
      if (!estimate.broken.empty()) prepared.notes.push_back("the run breaks in its first steps: " + estimate.broken);
    } catch (const std::exception& error) {
      prepared.faults.push_back({Code::internal_error, "scene", error.what(), "please report this as a defect"});
    }
  }
  response.valid = prepared.faults.empty();
  response.faults = fault_messages(prepared.faults);
  response.notes = prepared.notes;
  return true;
}

}  // namespace forming_sim
