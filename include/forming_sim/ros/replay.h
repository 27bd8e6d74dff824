#pragma once
// A result file back onto the topics of a run.
#include <string>

#include "forming_sim/ros/publisher.h"

namespace forming_sim {

struct ReplayOptions {
  std::string file;
  double duration_s = 10;  ///< wall time of one pass
  bool loop = false;
  std::string topics;      ///< namespace of the topics; empty: that of the node
};

/// Does a node publish a run's topics there?
bool are_published(const ros::NodeHandle& place);

/// Publishes every frame of the file, spaced as the simulated time is, until the
/// end or a stop signal. Waits only between frames.
/// Throws Error(output_error) for a file that cannot be read or has no frames.
void replay(RunPublisher& publisher, const ReplayOptions& options);

}  // namespace forming_sim
