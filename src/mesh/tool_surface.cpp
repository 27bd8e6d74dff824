#include "tool_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>
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

std::vector<std::pair<int, int>> open_edges(const std::vector<Facet>& surface) {
  std::map<std::pair<int, int>, int> uses;
  for (const Facet& f : surface)
    for (int k = 0; k < 3; ++k) ++uses[std::minmax(f.nodes[k], f.nodes[(k + 1) % 3])];
  std::vector<std::pair<int, int>> open;
  for (const auto& [edge, count] : uses)
    if (count == 1) open.push_back(edge);
  return open;
}

/// Joins vertices of the open edges that differ by what a writer rounds: a surface that closes on itself, or is written piece by
/// piece. Facets that collapse are dropped. Returns how many vertices became another.
int join_seams(const std::vector<std::pair<int, int>>& open, Mesh& mesh) {
  constexpr double kRounding = 1e-6;  // of the largest extent
  std::vector<int> border;
  for (const auto& [a, b] : open) border.insert(border.end(), {a, b});
  std::sort(border.begin(), border.end());
  border.erase(std::unique(border.begin(), border.end()), border.end());
  std::stable_sort(border.begin(), border.end(), [&](int a, int b) { return mesh.nodes[a].x() < mesh.nodes[b].x(); });
  Eigen::AlignedBox3d box;
  for (const Vec3& x : mesh.nodes) box.extend(x);
  const double near = kRounding * box.sizes().maxCoeff();
  std::vector<int> same(mesh.nodes.size());
  std::iota(same.begin(), same.end(), 0);
  int joined = 0;
  for (std::size_t i = 0; i < border.size(); ++i)
    for (std::size_t j = i; j-- > 0 && mesh.nodes[border[i]].x() - mesh.nodes[border[j]].x() <= near;)
      if ((mesh.nodes[border[i]] - mesh.nodes[border[j]]).norm() <= near) {
        same[border[i]] = same[border[j]];
        ++joined;
        break;
      }
  if (joined == 0) return 0;
  for (Facet& facet : mesh.surface)
    for (int k = 0; k < 3; ++k) facet.nodes[k] = same[facet.nodes[k]];
  const auto collapsed = [](const Facet& f) { return f.nodes[0] == f.nodes[1] || f.nodes[1] == f.nodes[2] || f.nodes[2] == f.nodes[0]; };
  mesh.surface.erase(std::remove_if(mesh.surface.begin(), mesh.surface.end(), collapsed), mesh.surface.end());
  return joined;
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
  if (flat + repeated > static_cast<int>(mesh.surface.size()))
    refuse(std::to_string(flat) + " of its " + std::to_string(triangles.corners.size()) + " triangles have no area and " + std::to_string(repeated) + " are there already, more than the rest: it was cut short, or its numbers were written too coarsely; write it again");
  if (flat) notes.push_back(triangles.source + ": " + std::to_string(flat) + " triangles without area removed");
  if (repeated) notes.push_back(triangles.source + ": " + std::to_string(repeated) + " repeated triangles removed");
  std::vector<std::pair<int, int>> open = open_edges(mesh.surface);
  if (const int joined = join_seams(open, mesh)) {
    notes.push_back(triangles.source + ": " + std::to_string(joined) + " vertices along seams joined with those beside them, which differ by rounding");
    open = open_edges(mesh.surface);
  }
  if (!open.empty())
    notes.push_back(triangles.source + ": the surface is open, " + std::to_string(open.size()) +
                    " edges belong to one triangle only; nothing holds the blank back from passing round them");
  return mesh;
}

}  // namespace forming_sim
