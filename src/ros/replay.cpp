#include "forming_sim/ros/replay.h"

#include <algorithm>
#include <limits>
#include <memory>

#include "forming_sim/ros/signals.h"
#include "forming_sim/ros/status.h"
#include "forming_sim/results/result_reader.h"
#include "forming_sim/results/thickness.h"

namespace forming_sim {
namespace {

RunShape shape_of(const ResultHeader& header) {
  RunShape shape;
  shape.scene = header.scene_name;
  shape.dimension = header.dimension;
  shape.initial_positions = header.initial_positions;
  shape.elements = header.elements;
  shape.surface = header.surface;
  shape.bodies = header.bodies;
  for (std::size_t body = 0; body < header.bodies.size(); ++body) {
    const auto first = std::find(header.element_body.begin(), header.element_body.end(), static_cast<int>(body));
    shape.first_element.push_back(static_cast<int>(first - header.element_body.begin()));
  }
  for (const ToolShape& tool : header.tools) {
    ToolModel model;
    model.name = tool.name;
    model.mesh.dimension = header.dimension;
    model.mesh.nodes = tool.points;
    for (const auto& nodes : tool.facets) model.mesh.surface.push_back({nodes, -1});
    model.point = tool.plane_point;
    model.normal = tool.plane_normal;
    shape.tools.push_back(std::move(model));
  }
  return shape;
}

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

RunFrame run_frame(const Frame& stored) {
  RunFrame frame;
  frame.time = stored.time;
  frame.step = stored.step;
  frame.stage = stored.stage;
  frame.positions = stored.positions;
  frame.plastic_strain.assign(stored.plastic_strain.begin(), stored.plastic_strain.end());
  if (!stored.contact_gap.empty()) frame.contact_pressure.assign(stored.contact_pressure.begin(), stored.contact_pressure.end());
  frame.contact_gap.assign(stored.contact_gap.begin(), stored.contact_gap.end());
  frame.contact_slip.assign(stored.contact_slip.begin(), stored.contact_slip.end());
  frame.damage.assign(stored.damage.begin(), stored.damage.end());
  frame.limit_ratio.assign(stored.limit_ratio.begin(), stored.limit_ratio.end());
  frame.thinning.assign(stored.thinning.begin(), stored.thinning.end());
  for (const FrameTool& pose : stored.tools) {
    ToolStatus status;
    for (Vec3* vector : {&status.velocity, &status.peak_force, &status.peak_moment}) vector->setConstant(kUnknown);
    status.radial_force = status.peak_radial_force = kUnknown;
    status.position = pose.position;
    status.rotation = pose.rotation;
    status.force = pose.force;
    status.moment = pose.moment;
    status.present = pose.present;
    frame.tools.push_back(status);
  }
  return frame;
}

/// What a file does not tell is NaN.
RunStatus status_of(const std_msgs::Header& header, const RunShape& shape, const RunFrame& frame, const std::vector<float>& thickness, double progress) {
  RunStatus status;
  status.header = header;
  status.scene = shape.scene;
  status.message = "replay of a result";
  status.stage = frame.stage;
  status.progress = progress;
  status.eta_s = -1;
  status.step = frame.step;
  status.time_s = frame.time;
  EnergyLedger& e = status.energies;
  for (double* value : {&status.dt_s, &status.min_gap_over_layer, &status.contact_layer_m, &e.kinetic, &e.elastic, &e.plastic, &e.contact, &e.friction, &e.damping, &e.work, &e.initial, &e.balance_error}) *value = kUnknown;
  for (std::size_t k = 0; k < shape.tools.size(); ++k) {
    status.tools.push_back(tool_message(shape.tools[k].name, frame.tools[k]));
  }
  for (const double p : frame.plastic_strain) status.max_plastic_strain = std::max(status.max_plastic_strain, p);
  status.min_thickness_m = smallest({thickness.begin(), thickness.end()}).value_or(-1);
  return status;
}

/// Waits until that time; false when the program is to stop.
bool wait_until(const ros::WallTime& time) {
  while (ros::ok() && !stop_requested() && ros::WallTime::now() < time) ros::WallDuration(0.005).sleep();
  return ros::ok() && !stop_requested();
}

/// A run that still writes has gone on since. While it does, or begins anew, its file cannot always be read: then the frames known play again.
void look_again(const std::string& file, std::unique_ptr<ResultReader>& reader) {
  try {
    auto now = std::make_unique<ResultReader>(file);
    if (!now->frames().empty()) reader = std::move(now);
  } catch (const Error&) {
  }
}

}  // namespace

bool are_published(const ros::NodeHandle& place) {
  ros::master::V_TopicInfo topics;
  ros::master::getTopics(topics);
  const std::string status = place.resolveName("status");
  return std::any_of(topics.begin(), topics.end(), [&](const ros::master::TopicInfo& topic) { return topic.name == status; });
}

void replay(RunPublisher& publisher, const ReplayOptions& options) {
  auto reader = std::make_unique<ResultReader>(options.file);
  if (reader->frames().empty()) throw Error(Code::output_error, options.file + " has no frame to show");
  ROS_INFO("replaying %zu frames of %s in %g s%s, on %s", reader->frames().size(), options.file.c_str(), options.duration_s,
           options.loop ? " again and again" : "", publisher.place().c_str());
  do {
    const auto& entries = reader->frames();
    const RunShape shape = shape_of(reader->header());
    const double first = entries.front().time, span = entries.back().time - first;
    publisher.start(shape);
    const ros::WallTime begin = ros::WallTime::now();
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const double progress = span > 0 ? (entries[i].time - first) / span : 1;
      if (!wait_until(begin + ros::WallDuration(progress * options.duration_s))) return;
      if (!publisher.is_due() && i + 1 < entries.size()) continue;
      const Frame stored = reader->frame(i);
      const RunFrame frame = run_frame(stored);
      publisher.publish(frame, status_of(publisher.header(), shape, frame, stored.thickness, progress), true);
    }
    if (options.loop) look_again(options.file, reader);
  } while (options.loop);
}

}  // namespace forming_sim
