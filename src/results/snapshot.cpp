#include "forming_sim/results/snapshot.h"

#include <functional>

#include "forming_sim/element/sheet_sides.h"
#include "forming_sim/material/damage.h"
#include "forming_sim/results/history.h"
#include "forming_sim/results/version.h"
#include "forming_sim/scene/yaml.h"

namespace forming_sim {

ResultHeader take_header(const Simulation& simulation, const Scene& scene, const std::string& meaning) {
  const Model& model = simulation.model();
  ResultHeader header;
  header.version = package_version();
  header.scene_name = scene.name;
  header.scene_text = scene.text.empty() ? write_scene(scene) : scene.text;
  header.scene_hash = static_cast<std::int64_t>(std::hash<std::string>()(meaning));
  header.dimension = model.dimension;
  header.axisymmetric = model.axisymmetric;
  header.elements = simulation.elements();
  header.element_body.resize(header.elements.size());
  header.initial_positions = simulation.initial_positions();
  header.surface = simulation.surface();
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    header.bodies.push_back(body.name);
    const auto [bottom, top] = sides_of_sheet(body, model.axisymmetric);
    header.sheet_sides.push_back(top.empty() ? "" : bottom + " " + top);
    std::vector<std::array<double, 2>>& curve = header.forming_limits.emplace_back();
    if (const auto& limit = body.material.forming_limit)
      for (std::size_t i = 0; i < limit->minor_strains.size(); ++i) curve.push_back({limit->minor_strains[i], limit->major_strains[i]});
    for (int e = 0; e < body.element_count; ++e) header.element_body[body.first_element + e] = static_cast<int>(b);
    for (const auto& [name, nodes] : body.mesh.sets) {
      std::vector<int>& joined = header.sets[body.name + "/" + name];
      for (int node : nodes) joined.push_back(body.first_node + node);
    }
  }
  for (const ToolModel& tool : model.tools) {
    ToolShape shape;
    shape.name = tool.name;
    if (tool.is_plane()) {
      shape.plane_point = tool.point;
      shape.plane_normal = tool.normal;
    } else {
      shape.points = tool.mesh.nodes;
      for (const Facet& facet : tool.mesh.surface) shape.facets.push_back(facet.nodes);
    }
    header.tools.push_back(std::move(shape));
  }
  return header;
}

Frame take_frame(const Simulation& simulation, const Measures& measures) {
  Frame frame;
  frame.time = simulation.time();
  frame.step = simulation.steps();
  frame.stage = stage_name(simulation);
  frame.positions = simulation.positions();
  frame.velocities = simulation.velocities();
  const auto single = [](const std::vector<double>& values) { return std::vector<float>(values.begin(), values.end()); };
  frame.plastic_strain = single(simulation.plastic_strain());
  for (const SurfaceStrain& strain : simulation.surface_strain()) {
    frame.surface_strain.push_back(static_cast<float>(strain.major));
    frame.surface_strain_minor.push_back(static_cast<float>(strain.minor));
  }
  for (const SurfaceStrain& strain : measures.limits.strain) {
    frame.membrane_strain.push_back(static_cast<float>(strain.major));
    frame.membrane_strain_minor.push_back(static_cast<float>(strain.minor));
  }
  frame.limit_ratio = single(measures.limits.ratio);
  frame.thickness = single(measures.thickness_of_nodes);
  frame.thinning = single(measures.thinning_of_nodes);
  frame.contact_pressure = single(simulation.contact_pressure());
  frame.contact_gap = single(simulation.contact_gap());
  frame.contact_slip = single(simulation.contact_slip());
  const ElementFields fields = simulation.element_fields();
  frame.volume_ratio = single(fields.volume_ratio);
  frame.damage = single(simulation.damage());
  for (const BodyModel* body : with_damage(simulation.model())) {
    const std::string unit = damage_unit(body->material.damage->criterion);
    frame.damage_unit = frame.damage_unit.empty() || frame.damage_unit == unit ? unit : "Pa or 1, by the criterion of the body";
  }
  for (const Sym& stress : fields.stress) {
    std::array<float, 6> row;
    for (int k = 0; k < 6; ++k) row[k] = static_cast<float>(stress[k]);
    frame.stress.push_back(row);
  }
  for (const ToolStatus& tool : simulation.tools())
    frame.tools.push_back({tool.position, tool.rotation, tool.force, tool.moment, tool.present});
  return frame;
}

}  // namespace forming_sim
