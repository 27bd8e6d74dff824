#include "forming_sim/ros/run_view.h"

#include <algorithm>
#include <cmath>

#include "forming_sim/results/history.h"
#include "forming_sim/simulation/simulation.h"

namespace forming_sim {

bool RunFrame::is_finite() const {
  return std::all_of(positions.begin(), positions.end(), [](const Node& x) { return x.allFinite(); }) &&
         std::all_of(plastic_strain.begin(), plastic_strain.end(), [](double p) { return std::isfinite(p); });
}

RunShape shape_of(const Simulation& simulation, const std::string& scene) {
  RunShape shape;
  shape.scene = scene;
  shape.dimension = simulation.model().dimension;
  shape.initial_positions = simulation.initial_positions();
  shape.elements = simulation.elements();
  shape.surface = simulation.surface();
  for (const BodyModel& body : simulation.model().bodies) {
    shape.bodies.push_back(body.name);
    shape.first_element.push_back(body.first_element);
  }
  shape.tools = simulation.model().tools;
  return shape;
}

RunFrame frame_of(const Simulation& simulation, bool contact) {
  RunFrame frame;
  frame.time = simulation.time();
  frame.step = simulation.steps();
  frame.stage = stage_name(simulation);
  frame.positions = simulation.positions();
  frame.plastic_strain = simulation.plastic_strain();
  frame.tools = simulation.tools();
  if (contact) {
    frame.contact_gap = simulation.contact_gap();
    frame.contact_slip = simulation.contact_slip();
    if (!frame.contact_gap.empty()) frame.contact_pressure = simulation.contact_pressure();
  }
  return frame;
}

Eigen::AlignedBox3d box_of(const NodeField& positions) {
  Eigen::AlignedBox3d box;
  for (const Node& x : positions) box.extend(vec3(x));
  return positions.empty() ? Eigen::AlignedBox3d(Vec3::Zero(), Vec3::Zero()) : box;
}

}  // namespace forming_sim
