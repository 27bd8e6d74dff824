#include "forming_sim/mesh/axis.h"

#include <algorithm>

#include "forming_sim/config/fault.h"
#include "forming_sim/mesh/measure.h"

namespace forming_sim {

namespace {
constexpr double kOnAxis = 1e-9;  // of the body's size
}

void close_at_axis(Mesh& mesh) {
  const double near = kOnAxis * size_of(mesh);
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    Vec3& X = mesh.nodes[n];
    if (X.x() < -near)
      throw Error(Code::mesh_error, "node " + std::to_string(n) + " lies at " + place(X) +
                                        "; an axisymmetric section lies at x >= 0, since the y axis is its axis: move it, or give only the half at x >= 0");
    if (X.x() <= near) X.x() = 0;
  }
  const auto on_axis = [&](const Facet& facet) { return mesh.nodes[facet.nodes[0]].x() == 0 && mesh.nodes[facet.nodes[1]].x() == 0; };
  mesh.surface.erase(std::remove_if(mesh.surface.begin(), mesh.surface.end(), on_axis), mesh.surface.end());
}

std::vector<int> axis_nodes(const Mesh& mesh) {
  std::vector<int> nodes;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (mesh.nodes[n].x() == 0) nodes.push_back(static_cast<int>(n));
  return nodes;
}

}  // namespace forming_sim
