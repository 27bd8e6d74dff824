// The node: serves simulate_forming, validate_scene and estimate_run.
#include <cstdio>
#include <string>

#include <ros/ros.h>

#include "forming_sim/ros/server.h"
#include "forming_sim/ros/signals.h"

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i)
    if (const std::string option = argv[i]; option == "--help" || option == "-h") {
      std::printf("usage: forming_server [ROS remappings]\nA ROS node; it needs a master. launch/forming.launch starts it and tells its parameters.\n");
      return 0;
    }
  if (!forming_sim::init_node(argc, argv, "forming_server")) return 64;
  if (argc > 1) {  // what ROS did not take
    std::fprintf(stderr, "forming_server: the argument %s does not exist; see forming_server --help\n", argv[1]);
    return 64;
  }
  forming_sim::catch_stop_signals();
  if (!forming_sim::wait_for_master("forming_server")) return 1;
  try {
    ros::AsyncSpinner spinner(4);
    forming_sim::FormingServer server(ros::NodeHandle("~"));
    forming_sim::catch_shutdown_requests();
    spinner.start();
    ROS_INFO("ready for goals on %s", ros::NodeHandle("~").resolveName("simulate_forming").c_str());
    while (ros::ok() && !forming_sim::stop_requested()) ros::WallDuration(0.02).sleep();
    server.stop();
    ros::shutdown();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "forming_server: %s\n", error.what());
    return 1;
  }
  return 0;
}
