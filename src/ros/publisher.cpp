#include "forming_sim/ros/publisher.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <geometry_msgs/WrenchStamped.h>

#include "forming_sim/ContactFields.h"
#include "forming_sim/PlasticStrain.h"
#include "forming_sim/PlasticStrainTopology.h"
#include "forming_sim/config/words.h"
#include "forming_sim/ros/parameter.h"
#include "forming_sim/scene/topic_name.h"
#include "geometry.h"

namespace forming_sim {

const std::vector<std::string>& PublishOptions::parameters() {
  static const std::vector<std::string> names{"publish_rate", "triangle_budget", "colour_by", "colour_max", "frame"};
  return names;
}

PublishOptions PublishOptions::read(const ros::NodeHandle& node) {
  PublishOptions options;
  read_parameter(node, "publish_rate", "a number, in Hz", options.rate);
  read_parameter(node, "triangle_budget", "a whole number", options.markers.triangle_budget);
  read_parameter(node, "colour_by", "one of " + one_of(MarkerOptions::colours()), options.markers.colour_by);
  read_parameter(node, "colour_max", "a number", options.markers.colour_max);
  read_parameter(node, "frame", "the name of a frame", options.markers.frame);
  const auto refuse = [&](const std::string& name, const std::string& given, const std::string& remedy) { refuse_parameter(node, name, given, remedy); };
  if (const std::string& frame = options.markers.frame; frame.empty() || frame.front() == '/' || frame.back() == '/' || frame.find_first_of(" \t\n") != std::string::npos)
    refuse("frame", '"' + frame + '"', "give the name of a frame, without a slash at either end and without spaces");
  if (!(options.rate > 0 && options.rate <= 1000)) {
    refuse("publish_rate", std::to_string(options.rate), "give a rate above 0 and at most 1000, in Hz");
  }
  if (options.markers.triangle_budget < 100) {
    refuse("triangle_budget", std::to_string(options.markers.triangle_budget), "give at least 100 triangles");
  }
  if (!(options.markers.colour_max >= 0 && std::isfinite(options.markers.colour_max))) {
    refuse("colour_max", std::to_string(options.markers.colour_max),
           "give the value at the upper end of the scale, or 0 for the largest of the run so far");
  }
  const std::vector<std::string>& words = MarkerOptions::colours();
  if (std::find(words.begin(), words.end(), options.markers.colour_by) == words.end()) {
    refuse("colour_by", options.markers.colour_by, "give one of " + one_of(words));
  }
  return options;
}

RunPublisher::RunPublisher(const ros::NodeHandle& node, const PublishOptions& options)
    : node_(node), options_(options) {
  mesh_ = node_.advertise<visualization_msgs::MarkerArray>("deformed_mesh", 2, true);
  strain_ = node_.advertise<PlasticStrain>("plastic_strain", 2, true);
  topology_ = node_.advertise<PlasticStrainTopology>("plastic_strain_topology", 1, true);
  contact_ = node_.advertise<ContactFields>("contact", 2, true);
  status_ = node_.advertise<RunStatus>("status", 2, true);
  again_ = node_.createWallTimer(ros::WallDuration(1 / kPosesAgain), [this](const ros::WallTimerEvent&) { repeat_poses(); });
}

void RunPublisher::start(const RunShape& shape) {
  RunMarkers markers(shape, options_.markers);
  markers.follow(markers_);
  markers_ = std::move(markers);
  next_ = {};
  surface_nodes_.clear();
  for (const Facet& facet : shape.surface) surface_nodes_.insert(surface_nodes_.end(), facet.nodes.begin(), facet.nodes.begin() + shape.dimension);
  std::sort(surface_nodes_.begin(), surface_nodes_.end());
  surface_nodes_.erase(std::unique(surface_nodes_.begin(), surface_nodes_.end()), surface_nodes_.end());
  // A tool of the last run keeps its topic, and with it those who listen.
  std::vector<ros::Publisher> forces;
  tools_.clear();
  for (const ToolModel& tool : shape.tools) {
    tools_.push_back(topic_name(tool.name));
    forces.push_back(node_.advertise<geometry_msgs::WrenchStamped>("tool_forces/" + tools_.back(), 10, true));
  }
  forces_ = std::move(forces);
  PlasticStrainTopology topology;
  topology.header = header();
  topology.scene = shape.scene;
  topology.dimension = shape.dimension;
  for (const Node& x : shape.initial_positions) topology.nodes.push_back(point_message(vec3(x)));
  for (const auto& element : shape.elements) {
    topology.elements.insert(topology.elements.end(), element.begin(), element.begin() + shape.dimension + 1);
  }
  topology.bodies = shape.bodies;
  topology.first_element.assign(shape.first_element.begin(), shape.first_element.end());
  topology_.publish(topology);
  ContactFields none;  // that of the last run is latched, and would be taken for this one's
  none.header = topology.header;
  contact_.publish(none);
}

void RunPublisher::publish(const RunFrame& frame, const RunStatus& status, bool always) {
  next_ = std::chrono::steady_clock::now() +
          std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(1 / options_.rate));
  const std_msgs::Header& header = status.header;
  if (frame.is_finite()) {
    if (always || mesh_.getNumSubscribers() > 0) mesh_.publish(markers_.at(frame, header.stamp));
    publish_strain(frame, header, always);
    publish_contact(frame, header, always);
  }
  publish_poses(frame, header);
  publish_forces(frame, header, always);
  publish(status);
}

std_msgs::Header RunPublisher::header() const {
  std_msgs::Header header;
  header.stamp = ros::Time::now();
  header.frame_id = options_.markers.frame;
  return header;
}

void RunPublisher::publish(const RunStatus& status) { status_.publish(status); }

void RunPublisher::publish_strain(const RunFrame& frame, const std_msgs::Header& header, bool always) {
  if (!always && strain_.getNumSubscribers() == 0) return;
  PlasticStrain message;
  message.header = header;
  message.time_s = frame.time;
  message.step = frame.step;
  message.values = frame.plastic_strain;
  strain_.publish(message);
}

bool RunPublisher::wants_contact() const { return contact_.getNumSubscribers() > 0 || options_.markers.colour_by.rfind("contact_", 0) == 0; }

void RunPublisher::publish_contact(const RunFrame& frame, const std_msgs::Header& header, bool always) {
  if ((!always && contact_.getNumSubscribers() == 0) || frame.contact_gap.empty()) return;
  ContactFields message;
  message.header = header;
  message.time_s = frame.time;
  message.step = frame.step;
  message.nodes.assign(surface_nodes_.begin(), surface_nodes_.end());
  for (int n : surface_nodes_) {
    message.pressure.push_back(frame.contact_pressure[n]);
    message.gap.push_back(frame.contact_gap[n]);
    if (!frame.contact_slip.empty()) message.slip.push_back(frame.contact_slip[n]);
  }
  contact_.publish(message);
}

void RunPublisher::publish_poses(const RunFrame& frame, const std_msgs::Header& header) {
  const std::lock_guard<std::mutex> lock(poses_mutex_);
  last_poses_.clear();
  poses_sent_ = std::chrono::steady_clock::now();
  for (std::size_t k = 0; k < tools_.size(); ++k) {
    const ToolStatus& tool = frame.tools[k];
    if (!tool.present || !tool.position.allFinite()) continue;
    const geometry_msgs::Pose pose = pose_message(tool.position, tool.rotation);
    geometry_msgs::TransformStamped message;
    message.header = header;
    message.child_frame_id = options_.markers.frame + "/" + tools_[k];
    message.transform.translation = vector_message(tool.position);
    message.transform.rotation = pose.orientation;
    last_poses_.push_back(message);
  }
  poses_.sendTransform(last_poses_);
}

void RunPublisher::repeat_poses() {
  const std::lock_guard<std::mutex> lock(poses_mutex_);
  if (last_poses_.empty() || std::chrono::steady_clock::now() - poses_sent_ < std::chrono::duration<double>(0.9 / kPosesAgain)) return;
  if (ros::Time::now() == last_poses_.front().header.stamp) return;  // a clock that stands: tf warns of what comes twice. One that goes back begins anew, and so do those who listen
  for (geometry_msgs::TransformStamped& pose : last_poses_) pose.header.stamp = ros::Time::now();
  poses_.sendTransform(last_poses_);
}

void RunPublisher::publish_forces(const RunFrame& frame, const std_msgs::Header& header, bool always) {
  for (std::size_t k = 0; k < forces_.size(); ++k) {
    if (!always && forces_[k].getNumSubscribers() == 0) continue;
    const ToolStatus& tool = frame.tools[k];
    if (!tool.force.allFinite()) continue;
    geometry_msgs::WrenchStamped message;
    message.header = header;
    message.wrench.force = vector_message(tool.force);
    message.wrench.torque = vector_message(Vec3(tool.moment + tool.position.cross(tool.force)));  // about the origin of the frame that it is told in
    forces_[k].publish(message);
  }
}

}  // namespace forming_sim
