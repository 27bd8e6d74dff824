#include "forming_sim/mesh/measure.h"

#include <sstream>

namespace forming_sim {

double signed_volume(const std::vector<Vec3>& nodes, const std::array<int, 4>& simplex, int dimension) {
  const Vec3 a = nodes[simplex[1]] - nodes[simplex[0]];
  const Vec3 b = nodes[simplex[2]] - nodes[simplex[0]];
  if (dimension == 2) return (a.x() * b.y() - a.y() * b.x()) / 2;
  return a.cross(b).dot(nodes[simplex[3]] - nodes[simplex[0]]) / 6;
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (const auto& simplex : mesh.simplices()) sum += signed_volume(mesh.nodes, simplex, mesh.dimension);
  return sum;
}

Vec3 area_vector(const Mesh& mesh, const Facet& facet) {
  const Vec3& origin = mesh.nodes[facet.nodes[0]];
  const Vec3 a = mesh.nodes[facet.nodes[1]] - origin;
  if (facet.nodes[2] < 0) return Vec3(a.y(), -a.x(), 0);
  return a.cross(mesh.nodes[facet.nodes[2]] - origin) / 2;
}

Eigen::AlignedBox3d bounds(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vec3& x : mesh.nodes) box.extend(x);
  return box;
}

double size_of(const Mesh& mesh) { return mesh.nodes.empty() ? 0 : bounds(mesh).diagonal().norm(); }

std::string place(const Vec3& x) {
  std::ostringstream text;
  text << '(' << x.x() << ", " << x.y() << ", " << x.z() << ") m";
  return text.str();
}

}  // namespace forming_sim
