#include "forming_sim/mesh/measure.h"

#include <algorithm>
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

double flatness(const Mesh& mesh) {
  static constexpr int along[3][4][2] = {{{0, 1}, {3, 2}, {4, 5}, {7, 6}}, {{0, 3}, {1, 2}, {4, 7}, {5, 6}}, {{0, 4}, {1, 5}, {2, 6}, {3, 7}}};
  double sum = 0;
  int count = 0;
  for (const Cells& cells : mesh.cells) {
    const bool wedges = cells.kind == CellKind::wedge14;
    if (!wedges && cells.kind != CellKind::hex6 && cells.kind != CellKind::hex24) continue;
    const int size = shape_of(cells.kind).nodes;
    for (int cell = 0; cell < cells.count(); ++cell) {
      const auto edge = [&](int from, int to) -> Vec3 { return mesh.nodes[cells.nodes[cell * size + to]] - mesh.nodes[cells.nodes[cell * size + from]]; };
      std::array<double, 3> length{0, 0, 0};
      if (wedges) {
        for (int k = 0; k < 3; ++k) length[0] += (edge(k, (k + 1) % 3) + edge(k + 3, (k + 1) % 3 + 3)).norm() / 6;
        length[1] = length[0];
        length[2] = (edge(0, 3) + edge(1, 4) + edge(2, 5)).norm() / 3;
      } else {
        for (int m = 0; m < 3; ++m) {
          Vec3 edges = Vec3::Zero();
          for (const auto& ends : along[m]) edges += edge(ends[0], ends[1]);
          length[m] = edges.norm();
        }
      }
      std::sort(length.begin(), length.end());
      sum += length[1] / length[0];
      ++count;
    }
  }
  return count > 0 ? sum / count : 0;
}

double edge_of_tetrahedra(const Mesh& mesh) {
  double sum = 0;
  long count = 0;
  for (const Cells& cells : mesh.cells) {
    if (cells.kind != CellKind::tetrahedron) continue;
    for (std::size_t first = 0; first < cells.nodes.size(); first += 4)
      for (int a = 0; a < 4; ++a)
        for (int b = 0; b < a; ++b, ++count) sum += (mesh.nodes[cells.nodes[first + a]] - mesh.nodes[cells.nodes[first + b]]).norm();
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

std::vector<char> cut_facets(const Mesh& mesh, const std::vector<SymmetryPlane>& planes) {
  constexpr double kParallel = 0.99, kSamePlane = 1e-6;  // cosine; of the size of the mesh
  std::vector<char> cut(mesh.surface.size(), 0);
  for (const SymmetryPlane& plane : planes) {
    const auto set = mesh.sets.find(plane.set);
    if (set == mesh.sets.end()) continue;
    const auto in_set = [&](int n) { return std::binary_search(set->second.begin(), set->second.end(), n); };
    // Of the facets across the normal, how far along it they lie.
    const Vec3 normal = plane.normal.normalized();
    std::vector<std::pair<double, std::size_t>> across;
    for (std::size_t i = 0; i < cut.size(); ++i)
      if (const Vec3 area = area_vector(mesh, mesh.surface[i]); std::abs(area.dot(normal)) >= kParallel * area.norm()) across.emplace_back(mesh.nodes[mesh.surface[i].nodes[0]].dot(normal), i);
    std::sort(across.begin(), across.end());
    const double same = kSamePlane * size_of(mesh);
    for (std::size_t first = 0, last = 0; first < across.size(); first = last) {
      bool whole = true;
      for (; last < across.size() && across[last].first <= across[first].first + same; ++last) {
        const auto& corners = mesh.surface[across[last].second].nodes;
        whole = whole && std::all_of(corners.begin(), corners.begin() + mesh.dimension, in_set);
      }
      for (std::size_t i = first; whole && i < last; ++i) cut[across[i].second] = 1;
    }
  }
  return cut;
}

double thickness_of(const Mesh& mesh, bool axisymmetric, const std::vector<char>& cut) {
  double volume = 0, free = 0, of_cuts = 0;
  const auto& X = mesh.nodes;
  for (const auto& s : mesh.simplices()) {
    Mat3 edges = Mat3::Identity();
    for (int m = 0; m < mesh.dimension; ++m) edges.col(m) = X[s[m + 1]] - X[s[0]];
    const double radius = axisymmetric ? (X[s[0]].x() + X[s[1]].x() + X[s[2]].x()) / 3 : 1;
    volume += radius * edges.determinant() / (mesh.dimension == 2 ? 2 : 6);
  }
  for (std::size_t i = 0; i < mesh.surface.size(); ++i) {
    const Facet& f = mesh.surface[i];
    const double radius = axisymmetric ? (X[f.nodes[0]].x() + X[f.nodes[1]].x()) / 2 : 1;
    (cut[i] ? of_cuts : free) += radius * area_vector(mesh, f).norm();
  }
  return 2 * volume / (free > 0 ? free : of_cuts);
}

bool is_sheet(const Mesh& mesh, double thickness) {
  Vec3 sizes = bounds(mesh).sizes();
  std::sort(sizes.data(), sizes.data() + 3);
  return sizes[2] >= 8 * thickness && (mesh.dimension == 2 || sizes[1] >= 3 * thickness);
}

int nearest_node(const Mesh& mesh, const Vec3& point) {
  const auto closer = [&](const Vec3& a, const Vec3& b) { return (a - point).squaredNorm() < (b - point).squaredNorm(); };
  return static_cast<int>(std::min_element(mesh.nodes.begin(), mesh.nodes.end(), closer) - mesh.nodes.begin());
}

std::string place(const Vec3& x) {
  std::ostringstream text;
  text << '(' << x.x() << ", " << x.y() << ", " << x.z() << ") m";
  return text.str();
}

}  // namespace forming_sim
