#include "forming_sim/ros/status.h"

#include <algorithm>
#include <limits>

#include "forming_sim/loads/rotation.h"
#include "forming_sim/simulation/simulation.h"
#include "geometry.h"

namespace forming_sim {

EnergyLedger energy_message(const Energies& energies, double balance_error) {
  EnergyLedger message;
  message.kinetic = energies.kinetic;
  message.elastic = energies.elastic;
  message.plastic = energies.plastic;
  message.contact = energies.contact;
  message.friction = energies.friction;
  message.damping = energies.damping;
  message.work = energies.work;
  message.initial = energies.initial;
  message.balance_error = balance_error;
  return message;
}

ToolState tool_message(const std::string& name, const ToolStatus& status) {
  ToolState message;
  message.name = name;
  message.pose = pose_message(status.position, status.rotation);
  message.velocity = vector_message(status.velocity);
  message.force = vector_message(status.force);
  message.moment = vector_message(status.moment);
  message.peak_force = vector_message(status.peak_force);
  message.peak_moment = vector_message(status.peak_moment);
  message.turned_deg = status.turned / kRadiansPerDegree;
  message.radial_force = status.radial_force;
  message.peak_radial_force = status.peak_radial_force;
  message.present = status.present;
  message.stopped_s = status.stopped.value_or(std::numeric_limits<double>::quiet_NaN());
  return message;
}

RunStatus status_of(const Simulation& simulation, const RunFrame& frame, const std::string& scene, double eta_s,
                    double min_thickness) {
  RunStatus status;
  status.scene = scene;
  status.running = true;
  status.stage = frame.stage;
  status.progress = simulation.progress();
  status.eta_s = eta_s;
  status.step = simulation.steps();
  status.time_s = simulation.time();
  status.dt_s = simulation.dt();
  status.limited_by = simulation.step_limit().reason;
  status.energies = energy_message(simulation.energies(), simulation.balance_error());
  const auto& tools = simulation.model().tools;
  for (std::size_t k = 0; k < tools.size(); ++k) status.tools.push_back(tool_message(tools[k].name, frame.tools[k]));
  for (const double p : frame.plastic_strain) status.max_plastic_strain = std::max(status.max_plastic_strain, p);
  status.min_thickness_m = min_thickness;
  const ContactStatus contact = simulation.contact_status();
  status.min_gap_over_layer = contact.min_gap_over_layer;
  status.contact_layer_m = contact.layer;
  status.crossings = contact.crossings;
  return status;
}

}  // namespace forming_sim
