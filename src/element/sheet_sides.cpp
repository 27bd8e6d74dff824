#include "forming_sim/element/sheet_sides.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace forming_sim {
namespace {

bool has(const Mesh& mesh, const char* set) {
  const auto found = mesh.sets.find(set);
  return found != mesh.sets.end() && !found->second.empty();
}

bool is_standing_wall(const BodyModel& body, bool axisymmetric) {
  constexpr double kStands = 2, kOnSide = 1e-9;
  const Mesh& mesh = body.mesh;
  if (mesh.dimension != 2 || !has(mesh, "left") || !has(mesh, "right") || !(has(mesh, "bottom") || has(mesh, "top"))) return false;
  const std::vector<Vec3>& X = body.reference();
  Eigen::AlignedBox3d box;
  for (const Vec3& x : X) box.extend(x);
  if (!(box.sizes().y() > kStands * box.sizes().x()) || (axisymmetric && box.min().x() == 0)) return false;
  const auto lie_at = [&](const char* set, int axis, double at) {
    if (!has(mesh, set)) return true;  // an end that has been trimmed away
    const std::vector<int>& nodes = mesh.sets.at(set);
    return std::all_of(nodes.begin(), nodes.end(), [&](int n) { return std::abs(X[n][axis] - at) <= kOnSide * box.sizes().y(); });
  };
  return lie_at("left", 0, box.min().x()) && lie_at("right", 0, box.max().x()) && lie_at("bottom", 1, box.min().y()) && lie_at("top", 1, box.max().y());
}

}  // namespace

std::pair<std::string, std::string> sides_of_sheet(const BodyModel& body, bool axisymmetric) {
  const Mesh& mesh = body.mesh;
  if (is_standing_wall(body, axisymmetric)) return {"left", "right"};
  if (has(mesh, "bottom") && has(mesh, "top")) return {"bottom", "top"};
  if (has(mesh, "inside") && has(mesh, "outside")) return {"inside", "outside"};
  return {};
}

std::array<int, 3> joined_corners(const BodyModel& body, int facet) {
  std::array<int, 3> corners = body.mesh.surface[facet].nodes;
  if (corners[2] < 0) corners[2] = corners[1];
  for (int& n : corners) n += body.first_node;
  return corners;
}

std::vector<int> facets_within(const Mesh& mesh, const std::string& set) {
  const std::vector<int>& nodes = mesh.sets.at(set);
  const auto in_set = [&](int node) { return std::binary_search(nodes.begin(), nodes.end(), node); };
  std::vector<int> facets;
  for (std::size_t i = 0; i < mesh.surface.size(); ++i) {
    const std::array<int, 3>& corners = mesh.surface[i].nodes;
    if (std::all_of(corners.begin(), corners.begin() + mesh.dimension, in_set)) facets.push_back(static_cast<int>(i));
  }
  return facets;
}

}  // namespace forming_sim
