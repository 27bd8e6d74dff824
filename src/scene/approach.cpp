#include "approach.h"

#include <algorithm>
#include <optional>
#include <sstream>
#include <string>

#include "forming_sim/config/words.h"
#include "forming_sim/loads/rotation.h"
#include "forming_sim/mesh/first_touch.h"
#include "rules.h"

namespace forming_sim {
namespace {

PlacedSurface placed(const Mesh& mesh, int dimension, const Mat3& rotation, const Vec3& position) {
  PlacedSurface surface;
  surface.dimension = dimension;
  std::vector<int> index(mesh.nodes.size(), -1);  // of the nodes that facets have
  for (const Facet& facet : mesh.surface) {
    std::array<int, 3> corners{-1, -1, -1};
    for (int c = 0; c < dimension; ++c) {
      int& at = index[facet.nodes[c]];
      if (at < 0) {
        at = static_cast<int>(surface.points.size());
        surface.points.push_back(rotation * mesh.nodes[facet.nodes[c]] + position);
      }
      corners[c] = at;
    }
    surface.facets.push_back(corners);
  }
  return surface;
}

PlacedSurface placed(const ToolModel& tool, int dimension) {
  const Mat3 rotation = rotation_matrix(kRadiansPerDegree * tool.rotation_deg);
  PlacedSurface surface = placed(tool.mesh, dimension, rotation, tool.position);
  surface.plane_point = rotation * tool.point + tool.position;
  surface.plane_normal = rotation * tool.normal;
  return surface;
}

}  // namespace

void approach_tools(const Scene& scene, Model& model, std::vector<Fault>& faults) {
  for (std::size_t i = 0; i < scene.tools.size(); ++i) {
    if (!scene.tools[i].approach) continue;
    const ApproachConfig& approach = *scene.tools[i].approach;
    ToolModel& tool = model.tools[i];
    const Vec3 along = approach.along.stableNormalized();
    const PlacedSurface mover = placed(tool, scene.dimension);
    const auto wanted = [&](const std::string& name) { return std::find(approach.to.begin(), approach.to.end(), name) != approach.to.end(); };
    std::optional<double> way;
    std::string touched;
    const auto meet = [&](const std::string& what, const PlacedSurface& standing) {
      const std::optional<double> found = way_to_touch(mover, standing, along);
      if (found && (!way || *found < *way)) way = found, touched = what;
    };
    for (const BodyModel& body : model.bodies)
      if (approach.to.empty() || wanted(body.name)) meet("body " + body.name, placed(body.mesh, scene.dimension, Mat3::Identity(), Vec3::Zero()));
    for (std::size_t k = 0; k < i; ++k)
      if (wanted(model.tools[k].name)) meet("tool " + model.tools[k].name, placed(model.tools[k], scene.dimension));
    if (!way) {
      faults.push_back({Code::invalid_scene, tool_path(i) + ".approach.along", given_text(approach.along), "give a direction along which the tool meets " + (approach.to.empty() ? "a body" : one_of(approach.to, " or ")) + ": on this one it goes by (of two planes none ever meets the other: they have no corners)"});
      continue;
    }
    const Vec3 shift = (*way - approach.gap) * along;
    tool.position += shift;
    if (tool.motion) tool.motion->centre += shift;
    std::ostringstream text;
    text << "tool " << tool.name << " approaches " << touched << ": it was moved by " << *way - approach.gap << " m along " << given_text(approach.along);
    if (approach.gap > 0) text << ", " << approach.gap << " m short of touching it";
    model.notes.push_back(text.str());
  }
}

}  // namespace forming_sim
