#include "forming_sim/mesh/sets.h"

#include "forming_sim/config/fault.h"
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

}  // namespace

std::vector<int> choose_nodes(const Mesh& mesh, const SetConfig& set) {
  const std::string name = "set " + set.name + ": ";
  const double tolerance = set.tolerance > 0 ? set.tolerance : kTolerance * size_of(mesh);
  const bool flat = mesh.dimension == 2;
  Vec3 normal = set.normal;
  Eigen::AlignedBox3d box;
  if (set.choose == "plane") {
    if (flat) normal.z() = 0;
    if (!(normal.norm() > 0) || !normal.allFinite() || !set.point.allFinite())
      throw Error(Code::mesh_error,
                  name + "the normal of its plane has no length" + (flat ? " in x and y" : "") + "; give a direction");
    normal.normalize();
  } else if (set.choose == "box") {
    Vec3 least = set.min, greatest = set.max;
    if (flat) least.z() = greatest.z() = 0;
    if (!(least.array() <= greatest.array()).all())
      throw Error(Code::mesh_error, name + "the least corner " + place(set.min) +
                                        " of its box is beyond the greatest " + place(set.max) + "; exchange the coordinates");
    box = Eigen::AlignedBox3d(least, greatest);
  } else {
    throw Error(Code::mesh_error, name + "given choose \"" + set.choose + "\"; plane or box is needed");
  }

  const std::vector<char> surface = set.surface_only ? on_surface(mesh) : std::vector<char>(mesh.nodes.size(), 1);
  std::vector<int> chosen;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const Vec3& x = mesh.nodes[n];
    const bool inside = set.choose == "plane"
                            ? std::abs(normal.dot(x - set.point)) <= tolerance
                            : ((box.min() - x).array() <= tolerance).all() && ((x - box.max()).array() <= tolerance).all();
    if (inside && surface[n]) chosen.push_back(static_cast<int>(n));
  }
  return chosen;
}

}  // namespace forming_sim
