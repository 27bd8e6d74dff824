#include "forming_sim/ros/client.h"

#include <actionlib/client/action_client.h>
#include <ros/ros.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "forming_sim/ResultCode.h"
#include "forming_sim/SimulateFormingAction.h"
#include "forming_sim/config/fault.h"
#include "forming_sim/mesh/url.h"
#include "forming_sim/config/words.h"
#include "forming_sim/material/damage.h"
#include "forming_sim/results/command_line.h"
#include "forming_sim/ros/convert.h"
#include "forming_sim/ros/client_progress.h"
#include "forming_sim/ros/signals.h"
#include "forming_sim/scene/yaml.h"

namespace forming_sim {
namespace {

using Client = actionlib::ActionClient<SimulateFormingAction>;

SimulateFormingGoal goal_of(const ClientRequest& request) {
  Scene scene = read_scene_file(local_path(request.scene_file, Code::invalid_scene));
  SimulateFormingGoal goal;
  goal.scene_text = scene.text;
  make_urls_absolute(scene);
  goal.scene = scene_message(scene);
  const auto absolute = [](const std::string& path) {
    return path.empty() ? path : std::filesystem::absolute(local_path(path, Code::invalid_scene)).lexically_normal().string();
  };
  goal.output_directory = absolute(request.output_directory);
  goal.resume = absolute(request.resume);
  goal.threads = request.threads;
  return goal;
}

void print_faults(const SimulateFormingResult& result) {
  for (const SceneFault& fault : result.faults) {
    std::fprintf(stderr, "  %s: given %s; %s\n", fault.field.c_str(), fault.given.c_str(), fault.remedy.c_str());
  }
}

void print_summary(const SimulateFormingResult& result) {
  const RunSummary& s = result.summary;
  const auto row = [](const char* name, double value, double scale, const char* unit) {
    if (std::isfinite(value)) std::printf("  %-26s %.4g %s\n", name, scale * value, unit);
  };
  row("simulated time", s.sim_time_s, 1e3, "ms");
  row("steps", static_cast<double>(s.steps), 1, "");
  row("wall time", s.wall_time_s, 1, "s");
  row("largest plastic strain", s.max_plastic_strain, 1, "");
  row("smallest thickness", s.min_thickness_m, 1e3, "mm");
  row("largest thinning", s.max_thinning, 100, "%");
  for (const BodyDamage& damage : s.damage) {
    row(("damage of " + damage.body).c_str(), damage.max, 1, (std::string(damage_unit(damage.criterion)) == "Pa" ? "Pa, " + damage.criterion : damage.criterion).c_str());
    if (damage.critical > 0) row("of the critical one", damage.max / damage.critical, 100, "%");
  }
  for (const BodyFormingLimit& limit : s.forming_limit) {
    row(("forming limit of " + limit.body).c_str(), limit.max, 100, "% of it at most");
    row("beyond it", limit.beyond, 100, "% of the sheet");
  }
  row("springback", s.springback_deg, 1, "deg");
  row("energy balance error", s.energies.balance_error, 100, "%");
  row("kinetic over internal", s.kinetic_over_internal_forming, 100, "% (the most while forming)");
  row("crossings", static_cast<double>(s.crossings), 1, "");
  for (const ToolState& tool : s.tools) {
    row(("peak force on " + tool.name).c_str(), std::hypot(tool.peak_force.x, tool.peak_force.y, tool.peak_force.z), 1,
        s.dimension == 2 && !s.axisymmetric ? "N per m of width" : "N");
    row((tool.name + " turned").c_str(), tool.turned_deg, 1, "deg about its axle");
    row((tool.name + " stopped at").c_str(), tool.stopped_s, 1e3, "ms");
    if (s.axisymmetric) row(("peak radial force on " + tool.name).c_str(), tool.peak_radial_force, 1, "N");
  }
  for (const std::string& warning : s.warnings) std::printf("note: %s\n", warning.c_str());
  if (!result.files.empty()) std::printf("files in %s:\n", result.directory.c_str());
  for (const std::string& file : result.files) std::printf("  %s\n", file.c_str());
}

// Waits go by the wall clock here: that of ROS stands still where use_sim_time is set and nothing plays.
constexpr double kLook = 0.1;  // s

template <class Come> bool wait_for(Come&& come, double wait_s) {
  for (double waited = 0; waited < wait_s && ros::ok() && !stop_requested() && !come(); waited += kLook) ros::WallDuration(kLook).sleep();
  return come();
}

enum class Followed { to_its_end, until_lost, until_told };  ///< lost: the server has gone, or does not know the goal any more; told: to stop, again

Followed follow(Client& client, Client::GoalHandle& goal, ClientProgress& line) {
  bool cancelled = false;
  int missed = 0, asked = 0;
  double since = 0;  // it was told to stop, s
  for (; goal.getCommState() != actionlib::CommState::DONE; ros::WallDuration(kLook).sleep()) {
    if (!ros::ok()) return Followed::until_lost;
    // Not before a status lists it: actionlib gives a goal up as lost when it is cancelled earlier.
    if (stop_requested() && !cancelled && goal.getCommState() != actionlib::CommState::WAITING_FOR_GOAL_ACK) {
      line.say("cancelling; again to leave the run to itself");
      goal.cancel();
      cancelled = true;
    }
    // One key stroke may come more than once.
    if (stop_requested() && (since += kLook) < 0.5) asked = stops_requested();
    if (since >= 0.5 && stops_requested() > asked) return Followed::until_told;
    missed = client.isServerConnected() ? 0 : missed + 1;
    if (missed > 30) return Followed::until_lost;
  }
  return goal.getTerminalState() != actionlib::TerminalState::LOST ? Followed::to_its_end : Followed::until_lost;
}

}  // namespace

int run_client(const ClientRequest& request) {
  SimulateFormingGoal goal;
  try {
    goal = goal_of(request);
  } catch (const SceneError& error) {
    std::fprintf(stderr, "%s has %zu fault(s):\n", request.scene_file.c_str(), error.faults().size());
    for (const Fault& fault : error.faults()) std::fprintf(stderr, "  %s\n", fault.sentence().c_str());
    return 2;
  }
  const std::string name = ros::NodeHandle(request.server).resolveName("simulate_forming");
  const ros::NodeHandle starts_the_time;  // of ROS: until that begins actionlib's client would wait for ever
  if (!wait_for(ros::Time::isValid, request.wait_s)) {
    std::fprintf(stderr, "forming_client: use_sim_time is set and in %g s nobody has published /clock, without which actions do not answer: `rosparam set use_sim_time false`\n", request.wait_s);
    return 1;
  }
  ClientProgress line(stdout);  // outlives the spinner, whose thread writes to it
  Client client(name);
  ros::AsyncSpinner spinner(1);
  spinner.start();
  if (!wait_for([&] { return client.isServerConnected(); }, request.wait_s)) {
    std::fprintf(stderr, "forming_client: no server on %s after %g s; start one with `roslaunch forming_sim forming.launch`\n",
                 name.c_str(), request.wait_s);
    return 1;
  }
  Client::GoalHandle sent = client.sendGoal(goal, {}, [&line](Client::GoalHandle, const SimulateFormingFeedbackConstPtr& feedback) { line.show(feedback->status); });
  const Followed followed = follow(client, sent, line);
  line.end();
  if (followed == Followed::until_told) {
    std::fprintf(stderr, "forming_client: the server on %s has not answered; it may go on with the run\n", name.c_str());
    return 130;
  }
  if (followed == Followed::until_lost) {
    std::fprintf(stderr, "forming_client: the server on %s has gone, or another has taken its name; what it had written until then can be read\n", name.c_str());
    return 1;
  }
  const SimulateFormingResult result = sent.getResult() ? *sent.getResult() : SimulateFormingResult();
  const actionlib::TerminalState state = sent.getTerminalState();
  if (result.code == ResultCode::SUCCESS && state == actionlib::TerminalState::SUCCEEDED) {
    std::printf("%s\n", result.message.c_str());
    print_summary(result);
    return 0;
  }
  const bool rejected = state == actionlib::TerminalState::REJECTED;
  if (result.faults.empty()) {
    std::fprintf(stderr, "%s: %s\n", state.toString().c_str(), result.message.c_str());
  } else {
    std::fprintf(stderr, "the goal was rejected, %zu fault(s):\n", result.faults.size());
    print_faults(result);
  }
  if (result.summary.steps > 0) print_summary(result);
  if (result.code == ResultCode::CANCELLED && stop_requested()) return 130;
  return rejected ? 2 : 1;
}

const char* const client_usage =
    "usage: forming_client SCENE.yaml [--output DIR] [--resume CHECKPOINT] [--server NAME] [--threads N] [--wait SECONDS]\n"
    "       forming_client --help | --version\n"
    "Sends the scene to a forming_server and follows the run. Exit code 0: it succeeded.\n";

ClientRequest read_arguments(int argc, char** argv) {
  ClientRequest request;
  const std::vector<std::string> words = separated({argv + 1, argv + argc}), known{"--output", "--resume", "--server", "--threads", "--wait"};
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& option = words[i];
    if (option.rfind("-", 0) != 0) {
      if (!request.scene_file.empty()) throw std::invalid_argument("one scene at a time: given " + request.scene_file + " and " + option);
      request.scene_file = option;
      continue;
    }
    if (std::find(known.begin(), known.end(), option) == known.end()) throw std::invalid_argument("the option " + option + " does not exist" + did_you_mean(option, known));
    if (i + 1 >= words.size() || words[i + 1].empty()) throw std::invalid_argument("option " + option + " needs a value");
    const std::string& value = words[++i];
    const auto number = [&] {
      std::size_t used = 0;
      double parsed = -1;
      try {
        parsed = std::stod(value, &used);
      } catch (const std::exception&) {
      }
      if (used != value.size() || !(parsed >= 0 && parsed < 1e6)) throw std::invalid_argument("option " + option + ": given " + value + "; give a number of 0 or more");
      return parsed;
    };
    if (option == "--output") request.output_directory = value;
    else if (option == "--resume") request.resume = value;
    else if (option == "--server") request.server = value;
    else if (option == "--threads") {
      const double threads = number();
      request.threads = static_cast<int>(threads);
      if (request.threads != threads) throw std::invalid_argument("option --threads: given " + value + "; give a whole number");
    }
    else if (option == "--wait") request.wait_s = number();
  }
  if (request.scene_file.empty()) throw std::invalid_argument("no scene given");
  return request;
}

}  // namespace forming_sim
