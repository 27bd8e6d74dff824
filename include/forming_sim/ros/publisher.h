#pragma once
// The topics of a run: deformed_mesh, plastic_strain with its topology, contact,
// tool_forces/<name>, status; and the frames of the tools, <frame>/<name>, on /tf. Used by the server and by the replay of a result.
#include <chrono>
#include <functional>
#include <mutex>
#include <vector>

#include <geometry_msgs/TransformStamped.h>
#include <ros/ros.h>
#include <std_msgs/Header.h>
#include <tf2_ros/transform_broadcaster.h>

#include "forming_sim/RunStatus.h"
#include "forming_sim/ros/markers.h"
#include "forming_sim/ros/run_view.h"

namespace forming_sim {

struct PublishOptions {
  double rate = 10;       ///< Hz of wall clock, at most
  MarkerOptions markers;
  /// Parameters publish_rate, triangle_budget, colour_by, colour_max, frame.
  /// Throws Error(invalid_scene) naming a parameter out of range.
  static PublishOptions read(const ros::NodeHandle& node);
  static const std::vector<std::string>& parameters();
};

class RunPublisher {
 public:
  RunPublisher(const ros::NodeHandle& node, const PublishOptions& options);

  /// A new run: sends the topology and announces the topics of the tools.
  void start(const RunShape& shape);
  /// The namespace of the topics.
  std::string place() const { return node_.getNamespace(); }
  /// True once the time to publish again has come; costs a look at the clock.
  bool is_due() const { return std::chrono::steady_clock::now() >= next_; }
  /// Does anybody look at the fields of contact?
  bool wants_contact() const;
  /// Is the sheet coloured by this field?
  bool colours_by(const char* field) const { return options_.markers.colour_by == field; }
  /// Sends what somebody listens to; `always`: also to the latched topics that
  /// nobody listens to yet.
  /// Messages are built only here; nothing waits for a subscriber.
  /// status: its stamp is that of all of them, so that what belongs together can be found.
  void publish(const RunFrame& frame, const RunStatus& status, bool always);
  /// Sends a status alone (latched).
  void publish(const RunStatus& status);
  /// With the time now and the frame of the runs.
  std_msgs::Header header() const;

 private:
  void publish_strain(const RunFrame& frame, const std_msgs::Header& header, bool always);
  void publish_contact(const RunFrame& frame, const std_msgs::Header& header, bool always);
  void publish_poses(const RunFrame& frame, const std_msgs::Header& header);
  void publish_forces(const RunFrame& frame, const std_msgs::Header& header, bool always);
  /// /tf is not latched: where the tools stand is told again while no frame comes, or who listens late would not know.
  void repeat_poses();
  static constexpr double kPosesAgain = 1;  ///< Hz

  ros::NodeHandle node_;
  PublishOptions options_;
  ros::Publisher mesh_, strain_, topology_, contact_, status_;
  std::vector<std::string> tools_;  ///< as in topics and frames
  std::vector<ros::Publisher> forces_;
  tf2_ros::TransformBroadcaster poses_;
  std::mutex poses_mutex_;  ///< of the two below: frames and the timer are of different threads
  std::vector<geometry_msgs::TransformStamped> last_poses_;
  std::chrono::steady_clock::time_point poses_sent_{};
  ros::WallTimer again_;
  RunMarkers markers_;
  std::vector<int> surface_nodes_;
  std::chrono::steady_clock::time_point next_{};
};

}  // namespace forming_sim
