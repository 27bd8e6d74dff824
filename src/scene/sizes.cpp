// A wrong unit_scale shows in the size of things.
#include <algorithm>
#include <cmath>
#include <limits>

#include "forming_sim/config/reflect.h"
#include "forming_sim/config/words.h"
#include "forming_sim/mesh/measure.h"
#include "geometry.h"

namespace forming_sim {

namespace {

constexpr double kLargest = 100, kSmallest = 1e-6;  // m
constexpr double kRatio = 200;                      // of a tool to the bodies
constexpr double kOddRatio = 20;                    // likewise: taken, and told
constexpr double kOddSize = 5;                      // of a body from a mesh, m: likewise
constexpr double kOddThickness = 0.3;               // of a blank, m: likewise

/// Largest extent along an axis, m; 0 without nodes.
double extent(const Mesh& mesh) { return mesh.nodes.empty() ? 0 : bounds(mesh).sizes().maxCoeff(); }

/// Smallest extent along an axis, m; 0 without nodes.
double least_extent(const Mesh& mesh) {
  if (mesh.nodes.empty()) return 0;
  const Vec3 sizes = bounds(mesh).sizes();
  return mesh.dimension == 2 ? std::min(sizes.x(), sizes.y()) : sizes.minCoeff();
}

/// Shortest edge of the surface, m; infinite without one.
double shortest_edge(const Mesh& mesh) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Facet& facet : mesh.surface)
    for (int k = 0; k < mesh.dimension; ++k)
      shortest = std::min(shortest, (mesh.nodes[facet.nodes[k]] - mesh.nodes[facet.nodes[(k + 1) % mesh.dimension]]).norm());
  return shortest;
}

std::string in_metres(double size) { return three_digits(size) + " m"; }

/// "with unit_scale 0.001 it would be 0.25 m": a size that is `wrong` times too large.
std::string right_scale(const MeshConfig& mesh, double size, double wrong) {
  const double step = wrong > 1 ? 1e-3 : 1e3;
  double factor = step;
  for (double left = wrong * step; (wrong > 1 ? left > 1 : left < 1) && std::abs(std::log10(factor)) < 12; left *= step) factor *= step;
  return "with unit_scale " + number_text(mesh.unit_scale * factor) + " it would be " + in_metres(size * factor) + "; give the metres per unit of the mesh (0.001 for millimetres)";
}

void check_extent(const std::optional<MeshConfig>& mesh, double size, const std::string& path, std::vector<Fault>& faults) {
  if (size == 0 || (size <= kLargest && size >= kSmallest)) return;
  const std::string bounds_text = "sizes from 1e-6 m to 100 m are taken; ";
  if (mesh) {
    const double wrong = size > kLargest ? size / kLargest : size / kSmallest;
    faults.push_back({Code::invalid_scene, path + ".mesh.unit_scale", number_text(mesh->unit_scale) + ", which makes a size of " + in_metres(size), bounds_text + right_scale(*mesh, size, wrong)});
  } else {
    faults.push_back({Code::invalid_scene, path, "a size of " + in_metres(size), bounds_text + "give lengths in metres"});
  }
}

}  // namespace

void check_sizes(const Scene& scene, const std::vector<Mesh>& bodies, const std::vector<Mesh>& tools, std::vector<Fault>& faults, std::vector<std::string>& notes) {
  const std::size_t before = faults.size();
  double largest_body = 0, least_edge = std::numeric_limits<double>::infinity();
  bool all_known = true;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const double size = extent(bodies[i]);
    largest_body = std::max(largest_body, size);
    least_edge = std::min(least_edge, shortest_edge(bodies[i]));
    all_known = all_known && size > 0;
    if (size > kOddSize && size <= kLargest && scene.bodies[i].mesh)
      notes.push_back("body " + scene.bodies[i].name + " measures " + in_metres(size) + ": " + right_scale(*scene.bodies[i].mesh, size, size / kOddSize));
    if (const double least = least_extent(bodies[i]); scene.bodies[i].blank && least > kOddThickness && size <= kLargest)
      notes.push_back("body " + scene.bodies[i].name + " measures " + in_metres(size) + " and " + in_metres(least) + " where it is thinnest: give lengths in metres, 0.001 for a millimetre");
    check_extent(scene.bodies[i].mesh, size, join_path("bodies", i) + (scene.bodies[i].blank ? ".blank" : ""), faults);
  }
  for (std::size_t i = 0; i < tools.size(); ++i) {
    check_extent(scene.tools[i].mesh, extent(tools[i]), join_path("tools", i) + (scene.tools[i].profile ? ".profile" : ""), faults);
  }
  if (!all_known || largest_body == 0 || faults.size() > before) return;
  for (std::size_t i = 0; i < tools.size(); ++i) {
    const double size = extent(tools[i]);
    const bool large = size > kRatio * largest_body;
    if (!large && size > kOddRatio * largest_body && scene.tools[i].mesh)
      notes.push_back("tool " + scene.tools[i].name + " measures " + in_metres(size) + ", the bodies " + in_metres(largest_body) + ": " +
                      right_scale(*scene.tools[i].mesh, size, size / (kOddRatio * largest_body)));
    if (size == 0 || !(large || size < least_edge)) continue;
    const std::string given = "a tool of " + in_metres(size) + " to bodies of " + in_metres(largest_body) + " with elements of " + in_metres(least_edge) + " and more";
    const std::string refused = "a tool is refused that is more than 200 times larger than the bodies or smaller than their elements; ";
    if (const auto& mesh = scene.tools[i].mesh) {
      const double wrong = large ? size / (kRatio * largest_body) : size / least_edge;
      faults.push_back({Code::invalid_scene, join_path("tools", i) + ".mesh.unit_scale", number_text(mesh->unit_scale) + ", which makes " + given, refused + right_scale(*mesh, size, wrong)});
    } else {
      faults.push_back({Code::invalid_scene, join_path("tools", i) + ".profile", given, refused + "give lengths in metres, and check the unit_scale of the bodies"});
    }
  }
}

}  // namespace forming_sim
