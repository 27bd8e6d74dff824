#include "forming_sim/mesh/seams.h"

#include <Eigen/Dense>
#include <algorithm>
#include <numeric>

#include "forming_sim/mesh/measure.h"

namespace forming_sim {
namespace {

constexpr double kOn = 1e-8;  ///< of a facet's longest edge: the rounding of files, far below any gap that contact can use

double longest_edge(const Mesh& mesh, const Facet& facet) {
  double longest = 0;
  for (int k = 0; k < mesh.dimension; ++k)
    longest = std::max(longest, (mesh.nodes[facet.nodes[k]] - mesh.nodes[facet.nodes[(k + 1) % mesh.dimension]]).norm());
  return longest;
}

bool on_segment(const Vec3& p, const Vec3& a, const Vec3& b, double near) {
  const Vec3 along = b - a;
  const double s = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - a - s * along).norm() <= near;
}

bool on_facet(const Mesh& mesh, const Facet& facet, const Vec3& p, double near) {
  const Vec3 &a = mesh.nodes[facet.nodes[0]], &b = mesh.nodes[facet.nodes[1]];
  if (mesh.dimension == 2) return on_segment(p, a, b, near);
  const Vec3& c = mesh.nodes[facet.nodes[2]];
  if (on_segment(p, a, b, near) || on_segment(p, b, c, near) || on_segment(p, c, a, near)) return true;
  const Vec3 n = (b - a).cross(c - a);
  if (std::abs(n.dot(p - a)) > near * n.norm()) return false;
  return n.dot((b - a).cross(p - a)) > 0 && n.dot((c - b).cross(p - b)) > 0 && n.dot((a - c).cross(p - c)) > 0;
}

}  // namespace

std::vector<Seam> find_seams(const Mesh& mesh) {
  if (mesh.surface.empty()) return {};
  std::vector<int> outer;
  for (const Facet& facet : mesh.surface) outer.insert(outer.end(), facet.nodes.begin(), facet.nodes.begin() + mesh.dimension);
  std::sort(outer.begin(), outer.end());
  outer.erase(std::unique(outer.begin(), outer.end()), outer.end());
  // Along the longest axis, so that few nodes lie in the slab of a facet.
  int axis = 0;
  bounds(mesh).sizes().maxCoeff(&axis);
  const auto before = [&](int n, double at) { return mesh.nodes[n][axis] < at; };
  std::sort(outer.begin(), outer.end(), [&](int a, int b) { return mesh.nodes[a][axis] < mesh.nodes[b][axis]; });
  std::vector<Seam> seams;
  for (const Facet& facet : mesh.surface) {
    const double near = kOn * longest_edge(mesh, facet);
    Eigen::AlignedBox3d box;
    for (int k = 0; k < mesh.dimension; ++k) box.extend(mesh.nodes[facet.nodes[k]]);
    box.min().array() -= near;
    box.max().array() += near;
    for (auto n = std::lower_bound(outer.begin(), outer.end(), box.min()[axis], before); n != outer.end() && mesh.nodes[*n][axis] <= box.max()[axis]; ++n) {
      if (!box.contains(mesh.nodes[*n]) || std::count(facet.nodes.begin(), facet.nodes.end(), *n) > 0) continue;
      if (on_facet(mesh, facet, mesh.nodes[*n], near)) seams.push_back({*n, facet});
    }
  }
  std::stable_sort(seams.begin(), seams.end(), [](const Seam& a, const Seam& b) { return a.node < b.node; });
  seams.erase(std::unique(seams.begin(), seams.end(), [](const Seam& a, const Seam& b) { return a.node == b.node; }), seams.end());
  return seams;
}

int count_parts(const Mesh& mesh) {
  std::vector<int> root(mesh.nodes.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int n) {
    while (root[n] != n) n = root[n] = root[root[n]];
    return n;
  };
  int parts = static_cast<int>(root.size());
  for (const Cells& block : mesh.cells) {
    const int corners = shape_of(block.kind).nodes;
    for (std::size_t i = 0; i < block.nodes.size(); ++i) {
      const int a = find(block.nodes[i]), b = find(block.nodes[i - i % corners]);
      parts -= a != b;
      root[a] = b;
    }
  }
  return parts;
}

}  // namespace forming_sim
