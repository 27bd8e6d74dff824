#include "forming_sim/results/thickness.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/BVH>

namespace forming_sim {
namespace {

struct PlacedFacet {
  Vec3 a, b, c;
};

/// A facet of the tree; found by bounding_box() below through its namespace.
Eigen::AlignedBox3d bounding_box(const PlacedFacet& facet) {
  return Eigen::AlignedBox3d(facet.a).extend(facet.b).extend(facet.c);
}

/// What BVMinimize asks for: the distance of one point.
struct DistanceFrom {
  using Scalar = double;
  Vec3 point;
  double minimumOnVolume(const Eigen::AlignedBox3d& box) const { return box.exteriorDistance(point); }
  double minimumOnObject(const PlacedFacet& facet) const {
    return distance_to_facet(point, facet.a, facet.b, facet.c);
  }
};

double distance_to_segment(const Vec3& point, const Vec3& a, const Vec3& b) {
  const Vec3 edge = b - a;
  const double length2 = edge.squaredNorm();
  const double s = length2 > 0 ? std::clamp((point - a).dot(edge) / length2, 0.0, 1.0) : 0.0;
  return (point - a - s * edge).norm();
}

}  // namespace

double distance_to_facet(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a);
  const bool over_the_face = normal.squaredNorm() > 0 && (b - a).cross(point - a).dot(normal) >= 0 &&
                             (c - b).cross(point - b).dot(normal) >= 0 && (a - c).cross(point - c).dot(normal) >= 0;
  if (over_the_face) return std::abs((point - a).dot(normal.normalized()));
  return std::min({distance_to_segment(point, a, b), distance_to_segment(point, b, c), distance_to_segment(point, c, a)});
}

std::optional<Thickness> Thickness::of(const Mesh& mesh, int first_node) {
  const auto top = mesh.sets.find("top"), bottom = mesh.sets.find("bottom");
  if (top == mesh.sets.end() || bottom == mesh.sets.end()) return std::nullopt;
  const auto in_bottom = [&](int node) {
    return std::binary_search(bottom->second.begin(), bottom->second.end(), node);
  };
  Thickness thickness;
  for (int node : top->second) thickness.top_.push_back(first_node + node);
  for (const Facet& facet : mesh.surface) {
    std::array<int, 3> nodes = facet.nodes;
    if (nodes[2] < 0) nodes[2] = nodes[1];
    if (!in_bottom(nodes[0]) || !in_bottom(nodes[1]) || !in_bottom(nodes[2])) continue;
    for (int& node : nodes) node += first_node;
    thickness.bottom_.push_back(nodes);
  }
  if (thickness.top_.empty() || thickness.bottom_.empty()) return std::nullopt;
  return thickness;
}

double Thickness::smallest(const NodeField& positions) const {
  std::vector<PlacedFacet> facets;
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const auto& nodes : bottom_) {
    facets.push_back({vec3(positions[nodes[0]]), vec3(positions[nodes[1]]), vec3(positions[nodes[2]])});
    boxes.push_back(bounding_box(facets.back()));
  }
  const Eigen::KdBVH<double, 3, PlacedFacet> tree(facets.begin(), facets.end(), boxes.begin(), boxes.end());
  double smallest = std::numeric_limits<double>::infinity();
  for (int node : top_) {
    DistanceFrom distance{vec3(positions[node])};
    smallest = std::min(smallest, Eigen::BVMinimize(tree, distance));
  }
  return smallest;
}

}  // namespace forming_sim
