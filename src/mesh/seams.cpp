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

std::vector<CrossedCut> find_crossed_cuts(const Mesh& mesh) {
  if (mesh.dimension != 3) return {};
  struct Side {  // of a facet, and the corner across from it
    std::array<int, 2> nodes;
    int across;
    const Facet* facet;
    bool operator<(const Side& other) const { return nodes < other.nodes; }
  };
  std::vector<Side> sides;
  for (const Facet& facet : mesh.surface)
    for (int k = 0; k < 3; ++k) {
      const int a = facet.nodes[(k + 1) % 3], b = facet.nodes[(k + 2) % 3];
      sides.push_back({{std::min(a, b), std::max(a, b)}, facet.nodes[k], &facet});
    }
  std::sort(sides.begin(), sides.end());
  const auto along = [&](int a, int b) { return std::equal_range(sides.begin(), sides.end(), Side{{std::min(a, b), std::max(a, b)}, -1, nullptr}); };
  const auto normal = [&](const Facet& facet) -> Vec3 {
    const Vec3& a = mesh.nodes[facet.nodes[0]];
    return (mesh.nodes[facet.nodes[1]] - a).cross(mesh.nodes[facet.nodes[2]] - a);
  };
  std::vector<CrossedCut> cuts;
  for (auto one = sides.begin(); one != sides.end(); ++one)
    for (auto next = one + 1; next != sides.end() && next->nodes == one->nodes; ++next) {
      // The faces of a single tetrahedron, or of a hole in its place, meet at an edge too; those of one cut are nearly in one plane.
      if (one->facet->element == next->facet->element || one->across == next->across || normal(*one->facet).dot(normal(*next->facet)) <= 0) continue;
      const int a = one->nodes[0], c = one->nodes[1], b = one->across, d = next->across;
      if (a > std::min(b, d)) continue;  // each is found by both of its diagonals
      const auto [first, last] = along(b, d);
      const auto has = [&](int n) { return std::any_of(first, last, [&](const Side& side) { return side.across == n && normal(*side.facet).dot(normal(*one->facet)) < 0; }); };
      if (has(a) && has(c)) cuts.push_back({a, b, c, d});
    }
  return cuts;
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
