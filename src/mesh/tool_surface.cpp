#include "tool_surface.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "forming_sim/config/fault.h"
#include "forming_sim/mesh/measure.h"

namespace forming_sim {
namespace {

constexpr double kNoArea = 1e-12;  // of the square of the longest edge

bool has_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return (b - a).cross(c - a).norm() / 2 > kNoArea * longest;
}

int count_open_edges(const std::vector<Facet>& surface) {
  std::map<std::pair<int, int>, int> uses;
  for (const Facet& f : surface)
    for (int k = 0; k < 3; ++k) ++uses[std::minmax(f.nodes[k], f.nodes[(k + 1) % 3])];
  return static_cast<int>(std::count_if(uses.begin(), uses.end(), [](const auto& edge) { return edge.second == 1; }));
}

}  // namespace

Mesh clean_surface(const Triangles& triangles, std::vector<std::string>& notes) {
  const auto refuse = [&](const std::string& what) { throw Error(Code::mesh_error, triangles.source + ": " + what); };
  if (triangles.corners.empty()) refuse("holds no triangles; a tool needs a surface of triangles");
  for (const Vec3& x : triangles.points)
    if (!x.allFinite()) refuse("a vertex lies at " + place(x) + "; every coordinate must be a finite number");

  Mesh mesh;
  std::map<std::tuple<double, double, double>, int> index;
  std::set<std::array<int, 3>> known;
  int flat = 0, repeated = 0;
  for (const auto& corners : triangles.corners) {
    const Vec3 &a = triangles.points[corners[0]], &b = triangles.points[corners[1]], &c = triangles.points[corners[2]];
    if (!has_area(a, b, c)) {
      ++flat;
      continue;
    }
    Facet facet;
    for (int k = 0; k < 3; ++k) {
      const Vec3& x = triangles.points[corners[k]];
      const auto [entry, is_new] = index.try_emplace({x.x(), x.y(), x.z()}, static_cast<int>(mesh.nodes.size()));
      if (is_new) mesh.nodes.push_back(x);
      facet.nodes[k] = entry->second;
    }
    std::array<int, 3> key = facet.nodes;
    std::sort(key.begin(), key.end());
    if (known.insert(key).second) mesh.surface.push_back(facet);
    else ++repeated;
  }
  if (mesh.surface.empty())
    refuse("none of its " + std::to_string(flat) + " triangles has an area; check how it was written, and its precision");
  if (flat) notes.push_back(triangles.source + ": " + std::to_string(flat) + " triangles without area removed");
  if (repeated) notes.push_back(triangles.source + ": " + std::to_string(repeated) + " repeated triangles removed");
  if (const int open = count_open_edges(mesh.surface))
    notes.push_back(triangles.source + ": the surface is open, " + std::to_string(open) +
                    " edges belong to one triangle only; nothing holds the blank back from passing round them");
  return mesh;
}

}  // namespace forming_sim
