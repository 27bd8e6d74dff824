#include "forming_sim/results/nearest_point.h"

#include <Eigen/Geometry>
#include <limits>
#include <unsupported/Eigen/BVH>

namespace forming_sim {
namespace {

/// What is in a tree; KdBVH and BVMinimize find bounding_box through the namespace.
struct PlacedPoint {
  Vec3 x;
  int index;
};
Eigen::AlignedBox3d bounding_box(const PlacedPoint& point) { return Eigen::AlignedBox3d(point.x); }

/// What BVMinimize asks for: the distance from one place; keeps which point was the nearest.
struct Nearest {
  using Scalar = double;
  Vec3 place;
  double least = std::numeric_limits<double>::infinity();
  int index = -1;
  double minimumOnVolume(const Eigen::AlignedBox3d& box) const { return box.exteriorDistance(place); }
  double minimumOnObject(const PlacedPoint& point) {
    const double distance = (point.x - place).norm();
    if (distance < least) least = distance, index = point.index;
    return distance;
  }
};

std::vector<PlacedPoint> placed(const std::vector<Vec3>& points) {
  std::vector<PlacedPoint> placed;
  for (const Vec3& x : points) placed.push_back({x, static_cast<int>(placed.size())});
  return placed;
}

}  // namespace

struct NearestPoint::Tree {
  explicit Tree(const std::vector<PlacedPoint>& points) : boxes(points.begin(), points.end()) {}
  Eigen::KdBVH<double, 3, PlacedPoint> boxes;
};

NearestPoint::NearestPoint(const std::vector<Vec3>& points) : tree_(std::make_unique<Tree>(placed(points))) {}
NearestPoint::~NearestPoint() = default;

int NearestPoint::to(const Vec3& place) const {
  Nearest nearest{place};
  Eigen::BVMinimize(tree_->boxes, nearest);
  return nearest.index;
}

}  // namespace forming_sim
