#include "forming_sim/mesh/sets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>

#include "forming_sim/config/fault.h"
#include "forming_sim/mesh/cell_tables.h"
#include "forming_sim/mesh/measure.h"

namespace forming_sim {
namespace {

constexpr double kTolerance = 1e-6;  // of the body's size

std::vector<char> on_surface(const Mesh& mesh) {
  std::vector<char> on(mesh.nodes.size(), 0);
  for (const Facet& facet : mesh.surface)
    for (int n : facet.nodes)
      if (n >= 0) on[n] = 1;
  return on;
}

/// Whether a node counts as in the set.
std::function<bool(const Vec3&)> place_of(const SetConfig& set, bool flat, double tolerance) {
  const std::string name = "set " + set.name + ": ", in_plane = flat ? " in x and y" : "";
  const auto direction = [&](Vec3 given, const char* whose) {
    if (!(given.norm() > 0) || !given.allFinite() || !set.point.allFinite())
      throw Error(Code::mesh_error, name + "the " + whose + " has no length" + in_plane + "; give a direction");
    return Vec3(given.normalized());
  };
  const Vec3 point = set.point;
  const double radius = set.radius;
  if (set.choose == "plane") {
    const Vec3 normal = direction(flat ? Vec3(set.normal.x(), set.normal.y(), 0) : set.normal, "normal of its plane");
    return [=](const Vec3& x) { return std::abs(normal.dot(x - point)) <= tolerance; };
  }
  if (set.choose == "cylinder") {
    const Vec3 axis = flat || set.axis.isZero(0) ? Vec3(Vec3::UnitZ()) : direction(set.axis, "axis of its cylinder");
    return [=](const Vec3& x) { return std::abs(axis.cross(x - point).norm() - radius) <= tolerance; };
  }
  if (set.choose == "sphere") return [=](const Vec3& x) { return std::abs((x - point).norm() - radius) <= tolerance; };
  if (set.choose != "box") throw Error(Code::mesh_error, name + "given choose \"" + set.choose + "\"; plane, box, cylinder or sphere is needed");
  Vec3 least = set.min, greatest = set.max;
  if (flat) least.z() = greatest.z() = 0;
  if (!(least.array() <= greatest.array()).all())
    throw Error(Code::mesh_error, name + "the least corner " + place(set.min) + " of its box is beyond the greatest " + place(set.max) + "; exchange the coordinates");
  return [=](const Vec3& x) { return ((least - x).array() <= tolerance).all() && ((x - greatest).array() <= tolerance).all(); };
}

/// On what is round the centre of a face lies beside its corners: it belongs to the set as they do.
void add_face_centres(const Mesh& mesh, std::vector<char>& chosen) {
  for (const Cells& cells : mesh.cells) {
    if (cells.kind != CellKind::hex24) continue;
    const int size = shape_of(cells.kind).nodes;
    for (std::size_t first = 0; first < cells.nodes.size(); first += size)
      for (int face = 0; face < 6; ++face) {
        const auto& corners = kHexFaces[face];
        if (std::all_of(corners, corners + 4, [&](int corner) { return chosen[cells.nodes[first + corner]] != 0; })) chosen[cells.nodes[first + 8 + face]] = 1;
      }
  }
}

}  // namespace

std::vector<int> choose_nodes(const Mesh& mesh, const SetConfig& set) {
  const double tolerance = set.tolerance > 0 ? set.tolerance : kTolerance * size_of(mesh);
  const auto is_there = place_of(set, mesh.dimension == 2, tolerance);
  const std::vector<char> surface = set.surface_only ? on_surface(mesh) : std::vector<char>(mesh.nodes.size(), 1);
  std::vector<char> there(mesh.nodes.size());
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) there[n] = is_there(mesh.nodes[n]);
  if (set.choose == "cylinder" || set.choose == "sphere") add_face_centres(mesh, there);
  std::vector<int> chosen;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (surface[n] && there[n]) chosen.push_back(static_cast<int>(n));
  return chosen;
}

}  // namespace forming_sim
