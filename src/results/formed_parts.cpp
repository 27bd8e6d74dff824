#include "forming_sim/results/formed_parts.h"

#include "forming_sim/files/formed_file.h"
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
    for (const PressureConfig& pressure : scene_.bodies[b].pressures)
      if (!pressure.values.empty() && pressure.values.back() != 0) part.pressed_by.push_back(name_of(pressure));
    for (const LoadConfig& load : scene_.bodies[b].loads)
      for (const std::vector<Vec3>* values : {&load.tractions, &load.forces})
        if (!values->empty() && !values->back().isZero(0)) part.pressed_by.push_back(name_of(load));
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
