#include "forming_sim/ros/signals.h"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <string>

#include <ros/console.h>
#include <ros/exceptions.h>
#include <ros/init.h>
#include <ros/master.h>
#include <ros/time.h>
#include <ros/xmlrpc_manager.h>

namespace forming_sim {
namespace {

constexpr int kMostAsked = 100;
std::atomic<int> stop_flag{0};  ///< how often it was asked, by signals and by a thread of ROS
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" void forming_sim_on_stop(int) {
  if (stop_flag < kMostAsked) ++stop_flag;
}

}  // namespace

bool init_node(int& argc, char** argv, const char* program, unsigned options) {
  try {
    ros::init(argc, argv, program, options | ros::init_options::NoSigintHandler);
    return true;
  } catch (const ros::Exception& error) {
    std::fprintf(stderr, "%s: %s; a word NAME:=VALUE remaps a topic or sets a parameter, as in _threads:=2; files and options are given without \":=\"\n", program, error.what());
    return false;
  }
}

void catch_stop_signals() {
  std::signal(SIGINT, forming_sim_on_stop);
  std::signal(SIGTERM, forming_sim_on_stop);
  if (std::signal(SIGHUP, forming_sim_on_stop) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup asks to be left alone
  std::signal(SIGXFSZ, SIG_IGN);
}

void catch_shutdown_requests() {
  const ros::XMLRPCManagerPtr& server = ros::XMLRPCManager::instance();
  server->unbind("shutdown");
  server->bind("shutdown", [](XmlRpc::XmlRpcValue& given, XmlRpc::XmlRpcValue& answer) {
    if (given.getType() == XmlRpc::XmlRpcValue::TypeArray && given.size() > 1) ROS_WARN("asked to shut down: %s", std::string(given[1]).c_str());
    forming_sim_on_stop(0);
    answer = ros::xmlrpc::responseInt(1, "", 0);
  });
}

bool stop_requested() { return stop_flag != 0; }
int stops_requested() { return stop_flag; }

bool wait_for_master(const char* program, double wait_s) {
  for (double waited = 0; !stop_requested(); waited += 0.1) {
    if (ros::master::check()) return true;
    if (waited == 0) std::fprintf(stderr, "%s: waiting for the ROS master at %s\n", program, ros::master::getURI().c_str());
    if (waited >= wait_s) break;
    ros::WallDuration(0.1).sleep();
  }
  return false;
}

}  // namespace forming_sim
