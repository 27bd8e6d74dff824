#pragma once
// A run as rviz markers: the sheet coloured by plastic strain, thinning or a field of contact, tools, a legend.
// Namespaces and ids are fixed: sheet 0; tools k, tool_edges k for tool k;
// legend 0 to 6.
#include <optional>
#include <string>
#include <vector>

#include <visualization_msgs/MarkerArray.h>

#include "forming_sim/ros/display_mesh.h"
#include "forming_sim/ros/run_view.h"

namespace forming_sim {

struct MarkerOptions {
  std::string frame = "forming_world";
  int triangle_budget = 20000;  ///< of sheet and tools together
  std::string colour_by = "plastic_strain";  ///< one of colours()
  double colour_max = 0;        ///< value at the upper end of the scale, SI; 0: the largest so far
  static const std::vector<std::string>& colours();
};

class RunMarkers {
 public:
  RunMarkers() = default;
  RunMarkers(const RunShape& shape, const MarkerOptions& options);

  /// Takes over what those of an earlier run may have left in rviz: it is deleted with every message, since a viewer that is busy sees the last one alone.
  void follow(const RunMarkers& earlier);
  /// The markers of one instant. The first call puts DELETEALL before them.
  /// frame.is_finite() must hold: rviz does not check for NaN.
  visualization_msgs::MarkerArray at(const RunFrame& frame, const ros::Time& stamp);

  std::size_t triangle_count() const;

 private:
  visualization_msgs::Marker marker(const std::string& ns, int id, int type, const ros::Time& stamp) const;
  /// The field that colours where it is one of elements; 0 where there is none.
  std::optional<std::vector<double>> of_elements(const RunFrame& frame) const;
  /// The field that colours, per drawn node.
  std::vector<double> values(const RunFrame& frame) const;
  void add_sheet(const RunFrame& frame, const ros::Time& stamp, visualization_msgs::MarkerArray& array) const;
  void add_tools(const RunFrame& frame, const ros::Time& stamp, visualization_msgs::MarkerArray& array) const;
  void add_legend(const RunFrame& frame, const ros::Time& stamp, visualization_msgs::MarkerArray& array) const;

  /// Points of a tool in its own frame, m.
  struct ToolDrawing {
    std::vector<geometry_msgs::Point> triangles, edges;
  };
  ToolDrawing draw(const ToolModel& tool, int budget) const;

  MarkerOptions options_;
  int dimension_ = 3;
  Eigen::AlignedBox3d box_;
  DisplayMesh sheet_;
  std::vector<ToolDrawing> tools_;
  double range_ = 0;
  std::size_t most_tools_ = 0;  ///< of this run and the ones before
  bool started_ = false;
};

}  // namespace forming_sim
