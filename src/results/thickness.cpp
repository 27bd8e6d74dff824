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

struct PlacedNode {
  Vec3 x;
  int index;
};

// What is in a tree; KdBVH and BVMinimize find these through their namespace.
Eigen::AlignedBox3d bounding_box(const PlacedFacet& facet) { return Eigen::AlignedBox3d(facet.a).extend(facet.b).extend(facet.c); }
Eigen::AlignedBox3d bounding_box(const PlacedNode& node) { return Eigen::AlignedBox3d(node.x); }

template <class Object> Eigen::KdBVH<double, 3, Object> tree_of(const std::vector<Object>& objects) {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const Object& object : objects) boxes.push_back(bounding_box(object));
  return {objects.begin(), objects.end(), boxes.begin(), boxes.end()};
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

/// Likewise, and keeps which node was the nearest.
struct NearestNode {
  using Scalar = double;
  Vec3 point;
  double least = std::numeric_limits<double>::infinity();
  int index = -1;
  double minimumOnVolume(const Eigen::AlignedBox3d& box) const { return box.exteriorDistance(point); }
  double minimumOnObject(const PlacedNode& node) {
    const double distance = (node.x - point).norm();
    if (distance < least) least = distance, index = node.index;
    return distance;
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

Thickness::Thickness(const Model& model) {
  NodeField start;
  for (const BodyModel& body : model.bodies) {
    const Mesh& mesh = body.mesh;
    for (const Vec3& X : mesh.nodes) start.push_back(node(X));
    const auto top = mesh.sets.find("top"), bottom = mesh.sets.find("bottom");
    if (top == mesh.sets.end() || bottom == mesh.sets.end() || top->second.empty()) continue;
    Sheet sheet;
    sheet.first_node = body.first_node;
    const auto in_bottom = [&](int node) { return std::binary_search(bottom->second.begin(), bottom->second.end(), node); };
    for (const Facet& facet : mesh.surface) {
      std::array<int, 3> nodes = facet.nodes;
      if (nodes[2] < 0) nodes[2] = nodes[1];
      if (!in_bottom(nodes[0]) || !in_bottom(nodes[1]) || !in_bottom(nodes[2])) continue;
      for (int& node : nodes) node += body.first_node;
      sheet.bottom.push_back(nodes);
    }
    if (sheet.bottom.empty()) continue;
    std::vector<PlacedNode> placed;
    for (int node : top->second) {
      placed.push_back({mesh.nodes[node], static_cast<int>(sheet.top.size())});
      sheet.top.push_back(body.first_node + node);
    }
    const auto tree = tree_of(placed);
    for (const Vec3& X : mesh.nodes) {
      NearestNode nearest{X};
      Eigen::BVMinimize(tree, nearest);
      sheet.above.push_back(nearest.index);
    }
    sheets_.push_back(std::move(sheet));
  }
  if (any()) start_ = at(start);
}

std::vector<double> Thickness::at(const NodeField& positions) const {
  std::vector<double> thickness(positions.size(), std::numeric_limits<double>::quiet_NaN());
  for (const Sheet& sheet : sheets_) {
    std::vector<PlacedFacet> facets;
    for (const auto& nodes : sheet.bottom) facets.push_back({vec3(positions[nodes[0]]), vec3(positions[nodes[1]]), vec3(positions[nodes[2]])});
    const auto tree = tree_of(facets);
    std::vector<double> of_top;
    for (int node : sheet.top) {
      DistanceFrom distance{vec3(positions[node])};
      of_top.push_back(Eigen::BVMinimize(tree, distance));
    }
    for (std::size_t i = 0; i < sheet.above.size(); ++i) thickness[sheet.first_node + i] = of_top[sheet.above[i]];
  }
  return thickness;
}

std::vector<double> Thickness::thinning(const std::vector<double>& thickness) const {
  std::vector<double> thinning(thickness.size());
  for (std::size_t i = 0; i < thinning.size(); ++i) thinning[i] = 1 - thickness[i] / start_[i];
  return thinning;
}

std::optional<double> smallest(const std::vector<double>& values) {
  std::optional<double> least;
  for (double value : values)
    if (!std::isnan(value) && !(least && *least <= value)) least = value;
  return least;
}

}  // namespace forming_sim
