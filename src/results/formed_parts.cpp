#include "forming_sim/results/formed_parts.h"

#include <algorithm>

#include "forming_sim/files/formed_file.h"
#include "forming_sim/loads/course.h"
#include "forming_sim/scene/yaml.h"

namespace forming_sim {

void FormedParts::on_end(const Simulation& simulation, Code code, const std::string&) {
  if (code != Code::success && code != Code::limit_reached) return;
  const Model& model = simulation.model();
  std::vector<FormedPart> parts;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    FormedPart part;
    part.name = body.name;
    part.material = write_material(scene_.bodies[b].material);
    part.pressure_average = body.pressure_average;
    part.axisymmetric = model.axisymmetric;
    for (int tool : simulation.tools_on(static_cast<int>(b))) part.pressed_by.push_back("tool " + model.tools[tool].name);
    const auto note = [&](const auto& load) {
      const std::string name = name_of(load);
      if (acts(load, simulation.time() - simulation.began(load.since)) && std::find(part.pressed_by.begin(), part.pressed_by.end(), name) == part.pressed_by.end()) part.pressed_by.push_back(name);
    };
    for (const PressureConfig& pressure : scene_.bodies[b].pressures) note(pressure);
    for (const LoadConfig& load : scene_.bodies[b].loads) note(load);
    for (const BoundaryConfig& boundary : scene_.bodies[b].boundaries)
      if (boundary.until.empty()) part.held_sets.push_back(boundary.set);
    part.mesh = body.mesh;
    for (int n = 0; n < body.node_count; ++n) part.mesh.nodes[n] = vec3(simulation.positions()[body.first_node + n]);
    part.memory = simulation.memory_of(body);
    parts.push_back(std::move(part));
  }
  save_formed(path_, parts);
}

}  // namespace forming_sim
