// The legend: a bar of colours left of the sheet, in 3D at its near corner, which hides nothing
// of it, what it means, its ends, and where the run stands.
#include <cstdio>

#include "forming_sim/ros/colour.h"
#include "forming_sim/ros/markers.h"
#include "geometry.h"

namespace forming_sim {

using visualization_msgs::Marker;

void RunMarkers::add_legend(const RunFrame& frame, const ros::Time& stamp,
                            visualization_msgs::MarkerArray& array) const {
  constexpr int bar_cubes = 24;
  const double size = box_.sizes().maxCoeff(), height = 0.5 * size, text_height = 0.04 * size;
  const Vec3 up = dimension_ == 2 ? Vec3::UnitY() : Vec3::UnitZ();
  const Vec3 centre = box_.center();
  Vec3 foot = centre - 0.5 * height * up;
  foot.x() = box_.min().x() - 0.3 * size;
  if (dimension_ == 3) foot.y() = box_.min().y();

  Marker bar = marker("legend", 0, Marker::CUBE_LIST, stamp);
  bar.scale.x = bar.scale.y = bar.scale.z = height / bar_cubes;
  for (int i = 0; i < bar_cubes; ++i) {
    bar.points.push_back(point_message(foot + height * (i + 0.5) / bar_cubes * up));
    bar.colors.push_back(scale_colour((i + 0.5) / bar_cubes));
  }
  array.markers.push_back(bar);

  const auto write = [&](int id, const Vec3& place, const std::string& text) {
    Marker m = marker("legend", id, Marker::TEXT_VIEW_FACING, stamp);
    m.pose.position = point_message(place);
    m.scale.z = text_height;
    m.text = text;
    array.markers.push_back(m);
  };
  const double range = options_.colour_max > 0 ? options_.colour_max : range_;
  // One line a marker: rviz spaces the lines of one marker for texts of a metre.
  char text[160];
  const std::string& by = options_.colour_by;
  const std::string title = by == "plastic_strain" ? "plastic strain" : by == "contact_pressure" ? "contact pressure, Pa" : by == "contact_gap" ? "gap, m" : by == "contact_slip" ? "slip, m" : by;
  write(1, foot + (height + 2.6 * text_height) * up, title);
  write(2, foot - 1.0 * text_height * up, "0");
  std::snprintf(text, sizeof text, "%.3g", range);
  write(3, foot + (height + 1.0 * text_height) * up, text);
  write(4, foot - 3.0 * text_height * up, frame.stage);
  std::snprintf(text, sizeof text, "t = %.3f ms", 1e3 * frame.time);
  write(5, foot - 4.4 * text_height * up, text);
  std::snprintf(text, sizeof text, "step %ld", frame.step);
  write(6, foot - 5.8 * text_height * up, text);
}

}  // namespace forming_sim
