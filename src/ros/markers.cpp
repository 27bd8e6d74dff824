#include "forming_sim/ros/markers.h"

#include <algorithm>
#include <cmath>

#include "forming_sim/ros/colour.h"
#include "geometry.h"

namespace forming_sim {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

const std::vector<std::string>& MarkerOptions::colours() {
  static const std::vector<std::string> words{"plastic_strain", "contact_pressure", "contact_gap", "contact_slip", "thinning", "damage", "limit_ratio"};
  return words;
}

RunMarkers::RunMarkers(const RunShape& shape, const MarkerOptions& options)
    : options_(options), dimension_(shape.dimension), box_(box_of(shape.initial_positions)) {
  // Tools may take up to a third of the budget, the sheet what they leave.
  std::size_t tool_triangles = 0;
  for (const ToolModel& tool : shape.tools) {
    tools_.push_back(draw(tool, std::max<int>(1, options.triangle_budget / 3 / static_cast<int>(shape.tools.size()))));
    tool_triangles += tools_.back().triangles.size() / 3;
  }
  const int left = std::max(1, options.triangle_budget - static_cast<int>(tool_triangles));
  sheet_ = DisplayMesh(shape.dimension, shape.initial_positions, shape.elements, shape.surface, left);
}

void RunMarkers::follow(const RunMarkers& earlier) { most_tools_ = std::max(earlier.most_tools_, earlier.tools_.size()); }

std::size_t RunMarkers::triangle_count() const {
  std::size_t count = sheet_.triangles().size();
  for (const ToolDrawing& tool : tools_) count += tool.triangles.size() / 3;
  return count;
}

RunMarkers::ToolDrawing RunMarkers::draw(const ToolModel& tool, int budget) const {
  ToolDrawing drawing;
  const double size = box_.sizes().maxCoeff();
  // In dimension 2 a tool is a line with a short band behind it.
  const auto band = [&](const Vec3& a, const Vec3& b) {
    const Vec3 back(0, 0, -0.1 * size);
    for (const Vec3& p : {a, b, Vec3(b + back), a, Vec3(b + back), Vec3(a + back)}) drawing.triangles.push_back(point_message(p));
    for (const Vec3& p : {a, b}) drawing.edges.push_back(point_message(p));
  };
  if (tool.is_plane()) {
    const Vec3 normal = tool.normal;
    const Vec3 u = dimension_ == 2 ? Vec3(-normal.y(), normal.x(), 0) : any_normal_to(normal);
    if (dimension_ == 2) {
      band(tool.point - size * u, tool.point + size * u);
    } else {
      const Vec3 v = normal.cross(u);
      const Vec3 p = tool.point, a = size * (u + v), b = size * (u - v);
      for (const Vec3& corner : {Vec3(p + a), Vec3(p - b), Vec3(p - a), Vec3(p + a), Vec3(p - a), Vec3(p + b)}) {
        drawing.triangles.push_back(point_message(corner));
      }
    }
  } else if (dimension_ == 2) {
    // Lines with more pieces than may be shown are drawn through every n-th point, in chains whose segments follow each other, as those of profiles do.
    const std::size_t pieces = tool.mesh.surface.size(), step = (2 * pieces + budget - 1) / budget;
    for (std::size_t first = 0; first < pieces;) {
      std::size_t last = first;
      while (last + 1 < std::min(pieces, first + step) && tool.mesh.surface[last + 1].nodes[0] == tool.mesh.surface[last].nodes[1]) ++last;
      band(tool.mesh.nodes[tool.mesh.surface[first].nodes[0]], tool.mesh.nodes[tool.mesh.surface[last].nodes[1]]);
      first = last + 1;
    }
  } else {
    NodeField nodes;
    for (const Vec3& x : tool.mesh.nodes) nodes.push_back(node(x));
    const DisplayMesh mesh(3, nodes, {}, tool.mesh.surface, budget);
    for (const auto& t : mesh.triangles()) {
      for (const int n : t) drawing.triangles.push_back(point_message(tool.mesh.nodes[n]));
    }
  }
  return drawing;
}

Marker RunMarkers::marker(const std::string& ns, int id, int type, const ros::Time& stamp) const {
  Marker m;
  m.header.frame_id = options_.frame;
  m.header.stamp = stamp;
  m.ns = ns;
  m.id = id;
  m.type = type;
  m.action = Marker::ADD;
  m.pose.orientation.w = 1;
  m.scale.x = m.scale.y = m.scale.z = 1;
  m.color.r = m.color.g = m.color.b = m.color.a = 1;
  return m;
}

MarkerArray RunMarkers::at(const RunFrame& frame, const ros::Time& stamp) {
  MarkerArray array;
  if (!started_) {
    Marker clear = marker("", 0, Marker::CUBE, stamp);
    clear.action = Marker::DELETEALL;
    array.markers.push_back(clear);
    started_ = true;
  }
  const std::optional<std::vector<double>> field = of_elements(frame);
  for (const double value : field ? *field : values(frame)) range_ = std::max(range_, value);
  add_sheet(frame, stamp, array);
  add_tools(frame, stamp, array);
  add_legend(frame, stamp, array);
  return array;
}

std::optional<std::vector<double>> RunMarkers::of_elements(const RunFrame& frame) const {
  if (options_.colour_by == "plastic_strain") return frame.plastic_strain;
  if (options_.colour_by != "damage") return std::nullopt;
  std::vector<double> damage = frame.damage;
  damage.resize(frame.plastic_strain.size());
  for (double& d : damage)
    if (std::isnan(d)) d = 0;
  return damage;
}

std::vector<double> RunMarkers::values(const RunFrame& frame) const {
  if (const auto field = of_elements(frame)) return sheet_.node_means(*field);
  const std::vector<double>& field = options_.colour_by == "contact_pressure" ? frame.contact_pressure
                                     : options_.colour_by == "contact_gap"    ? frame.contact_gap
                                     : options_.colour_by == "contact_slip"   ? frame.contact_slip
                                     : options_.colour_by == "limit_ratio"    ? frame.limit_ratio
                                                                              : frame.thinning;
  std::vector<double> drawn;
  for (const int n : sheet_.drawn_nodes()) drawn.push_back(field.empty() || std::isnan(field[n]) ? 0 : field[n]);
  return drawn;
}

void RunMarkers::add_sheet(const RunFrame& frame, const ros::Time& stamp, MarkerArray& array) const {
  Marker m = marker("sheet", 0, Marker::TRIANGLE_LIST, stamp);
  const double range = options_.colour_max > 0 ? options_.colour_max : range_;
  std::vector<std_msgs::ColorRGBA> colours;
  for (const double p : values(frame)) colours.push_back(scale_colour(range > 0 ? p / range : 0));
  m.points.reserve(3 * sheet_.triangles().size());
  m.colors.reserve(3 * sheet_.triangles().size());
  for (std::size_t t = 0; t < sheet_.triangles().size(); ++t) {
    for (int c = 0; c < 3; ++c) {
      m.points.push_back(point_message(vec3(frame.positions[sheet_.triangles()[t][c]])));
      m.colors.push_back(colours[sheet_.corners()[t][c]]);
    }
  }
  array.markers.push_back(std::move(m));
}

void RunMarkers::add_tools(const RunFrame& frame, const ros::Time& stamp, MarkerArray& array) const {
  for (std::size_t k = 0; k < tools_.size(); ++k) {
    const ToolStatus& status = frame.tools[k];
    Marker m = marker("tools", static_cast<int>(k), Marker::TRIANGLE_LIST, stamp);
    m.pose = pose_message(status.position, status.rotation);
    m.color.r = 0.62F;
    m.color.g = 0.66F;
    m.color.b = 0.72F;
    m.color.a = 0.35F;
    m.points = tools_[k].triangles;
    if (!status.present) m.action = Marker::DELETE;
    array.markers.push_back(m);
    if (tools_[k].edges.empty()) continue;
    m.ns = "tool_edges";
    m.type = Marker::LINE_LIST;
    m.scale.x = 0.006 * box_.sizes().maxCoeff();
    m.color.a = 1;
    m.points = tools_[k].edges;
    array.markers.push_back(m);
  }
  const auto forget = [&](const char* ns, std::size_t k) {
    Marker m = marker(ns, static_cast<int>(k), Marker::TRIANGLE_LIST, stamp);
    m.action = Marker::DELETE;
    array.markers.push_back(m);
  };
  for (std::size_t k = 0; k < most_tools_; ++k) {
    if (k >= tools_.size()) forget("tools", k);
    if (k >= tools_.size() || tools_[k].edges.empty()) forget("tool_edges", k);
  }
}

}  // namespace forming_sim
