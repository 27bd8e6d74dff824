// Shows a result file on the topics of a run:
//   forming_replay RESULT.h5 [_duration:=SECONDS] [_loop:=true] [_topics:=NAMESPACE]
#include <cstdio>

#include <ros/ros.h>

#include "forming_sim/mesh/url.h"
#include "forming_sim/ros/parameter.h"
#include "forming_sim/ros/replay.h"
#include "forming_sim/ros/signals.h"

int main(int argc, char** argv) {
  if (!forming_sim::init_node(argc, argv, "forming_replay")) return 64;
  forming_sim::catch_stop_signals();
  const std::string given = argc == 2 ? argv[1] : "";
  const bool help = given == "--help" || given == "-h";
  if (argc != 2 || help) {
    std::fprintf(help ? stdout : stderr, "usage: forming_replay RESULT.h5 [_duration:=SECONDS] [_loop:=true] [_topics:=NAMESPACE]\n");
    return help ? 0 : 64;
  }
  forming_sim::ReplayOptions options;
  try {
    options.file = forming_sim::resolve_url(given, "");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "forming_replay: %s; give the result.h5 of a run\n", error.what());
    return 1;
  }
  if (!forming_sim::wait_for_master("forming_replay")) return 1;
  try {
    ros::NodeHandle node("~");
    forming_sim::read_parameter(node, "duration", "a number, in s", options.duration_s);
    forming_sim::read_parameter(node, "loop", "true or false", options.loop);
    if (!(options.duration_s > 0 && options.duration_s <= 1e6))
      forming_sim::refuse_parameter(node, "duration", std::to_string(options.duration_s), "give the wall time of one pass, above 0 and at most 1e6 s");
    forming_sim::read_parameter(node, "topics", "the name under which the topics of a server stand", options.topics);
    forming_sim::warn_of_unknown_parameters(node, {"duration", "loop", "topics"});
    const ros::NodeHandle place = options.topics.empty() ? node : ros::NodeHandle(options.topics);
    if (forming_sim::are_published(place))
      forming_sim::refuse_parameter(node, "topics", place.getNamespace(), "a node publishes there already, a server or another replay: give another name, as in topics:=replay (of one that was killed `rosnode cleanup` forgets the topics)");
    ros::AsyncSpinner spinner(1);
    spinner.start();
    forming_sim::RunPublisher publisher(place, forming_sim::PublishOptions::read(node));
    forming_sim::replay(publisher, options);
    // The last frame stays on the latched topics until the node is stopped.
    while (ros::ok() && !forming_sim::stop_requested()) ros::WallDuration(0.05).sleep();
    ros::shutdown();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "forming_replay: %s\n", error.what());
    return 1;
  }
  return 0;
}
