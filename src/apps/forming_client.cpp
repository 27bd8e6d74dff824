// Sends a YAML scene to a forming_server and follows the run.
#include <cstdio>
#include <string>

#include <ros/ros.h>

#include "forming_sim/results/version.h"
#include "forming_sim/ros/client.h"
#include "forming_sim/ros/signals.h"

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i)
    if (const std::string option = argv[i]; option == "--help" || option == "-h") {
      std::printf("%s", forming_sim::client_usage);
      return 0;
    } else if (option == "--version") {
      std::printf("%s\n", forming_sim::package_version());
      return 0;
    }
  if (!forming_sim::init_node(argc, argv, "forming_client", ros::init_options::AnonymousName)) return 64;
  forming_sim::ClientRequest request;
  try {
    request = forming_sim::read_arguments(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "forming_client: %s\n%s", error.what(), forming_sim::client_usage);
    return 64;
  }
  forming_sim::catch_stop_signals();
  if (!forming_sim::wait_for_master("forming_client", request.wait_s)) {
    std::fprintf(stderr, "forming_client: no ROS master; start one with `roscore`, or a server with `roslaunch forming_sim forming.launch`\n");
    return 1;
  }
  try {
    const ros::NodeHandle node;  // keeps the connection to the master while the client lives
    forming_sim::catch_shutdown_requests();
    return forming_sim::run_client(request);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "forming_client: %s\n", error.what());
    return 1;
  }
}
