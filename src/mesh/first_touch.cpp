#include "forming_sim/mesh/first_touch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace forming_sim {
namespace {

constexpr double kOnEdge = 1e-9;  ///< of an edge: so far beyond its end still touches it
constexpr double kNone = std::numeric_limits<double>::infinity();

/// A surface seen along the way: u and v across, w along it.
struct Seen {
  int dimension;
  std::vector<Vec3> points;
  const std::vector<std::array<int, 3>>& facets;
  int corners() const { return dimension; }
  const Vec3& at(int facet, int corner) const { return points[facets[facet][corner]]; }
  Eigen::AlignedBox3d box(int facet) const {
    Eigen::AlignedBox3d box;
    for (int c = 0; c < corners(); ++c) box.extend(at(facet, c));
    return box;
  }
};

double cross(const Vec3& a, const Vec3& b) { return a.x() * b.y() - a.y() * b.x(); }

/// w of a facet where `p` is seen before it; NaN: beside it, or it is seen edge on.
double depth_at(const Seen& surface, int facet, const Vec3& p) {
  constexpr double kBeside = std::numeric_limits<double>::quiet_NaN();
  const Vec3 &a = surface.at(facet, 0), &b = surface.at(facet, 1);
  if (surface.dimension == 2) {
    const double s = (p.x() - a.x()) / (b.x() - a.x());
    return s >= -kOnEdge && s <= 1 + kOnEdge ? a.z() + s * (b.z() - a.z()) : kBeside;
  }
  const Vec3 &c = surface.at(facet, 2), ab = b - a, ac = c - a, ap = p - a;
  const double area = cross(ab, ac);
  if (std::abs(area) <= 1e-12 * std::max(ab.squaredNorm(), ac.squaredNorm())) return kBeside;
  const double s = cross(ap, ac) / area, t = cross(ab, ap) / area;
  return s >= -kOnEdge && t >= -kOnEdge && s + t <= 1 + kOnEdge ? a.z() + s * ab.z() + t * ac.z() : kBeside;
}

/// By how much edge q lies before edge p, where they are seen to cross; infinity: nowhere.
double between_edges(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1) {
  const Vec3 p = p1 - p0, q = q1 - q0, apart = q0 - p0;
  const double turn = cross(p, q);
  if (std::abs(turn) <= 1e-12 * (p.squaredNorm() + q.squaredNorm())) return kNone;  // along each other: their ends meet
  const double s = cross(apart, q) / turn, t = cross(apart, p) / turn;
  const auto on = [](double along) { return along >= -kOnEdge && along <= 1 + kOnEdge; };
  return on(s) && on(t) ? q0.z() + t * q.z() - p0.z() - s * p.z() : kNone;
}

double between_facets(const Seen& mover, int m, const Seen& standing, int s) {
  double least = kNone;
  for (int c = 0; c < mover.corners(); ++c)
    if (const double depth = depth_at(standing, s, mover.at(m, c)); !std::isnan(depth)) least = std::min(least, depth - mover.at(m, c).z());
  for (int c = 0; c < standing.corners(); ++c)
    if (const double depth = depth_at(mover, m, standing.at(s, c)); !std::isnan(depth)) least = std::min(least, standing.at(s, c).z() - depth);
  if (mover.dimension == 2) return least;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      least = std::min(least, between_edges(mover.at(m, i), mover.at(m, (i + 1) % 3), standing.at(s, j), standing.at(s, (j + 1) % 3)));
  return least;
}

/// The facets of a surface by where they are seen: a grid of squares across the way.
class SeenGrid {
 public:
  explicit SeenGrid(const Seen& surface) : surface_(surface) {
    const int count = static_cast<int>(surface.facets.size());
    double size = 0;
    for (int f = 0; f < count; ++f) {
      const Eigen::AlignedBox3d box = surface.box(f);
      all_.extend(box);
      size += box.sizes().head<2>().maxCoeff() / count;
    }
    const Vec3 extent = all_.sizes();
    // As wide as facets are in the mean, and not many more squares than facets.
    size = std::max({size, extent.head<2>().maxCoeff() / (2 * std::sqrt(double(count)) + 1) / (surface.dimension == 2 ? std::sqrt(double(count)) : 1), std::numeric_limits<double>::min()});
    size_ = size;
    columns_ = 1 + static_cast<int>(extent.x() / size);
    squares_.resize(static_cast<std::size_t>(columns_) * (1 + static_cast<int>(extent.y() / size)));
    for (int f = 0; f < count; ++f)
      over(surface.box(f), [&](std::vector<int>& square) { square.push_back(f); });
  }
  /// What is kept in the squares that a box covers.
  template <class Do> void over(const Eigen::AlignedBox3d& box, Do&& act) {
    const int rows = static_cast<int>(squares_.size()) / columns_;
    const auto index = [&](double x, int axis, int count) { return static_cast<int>(std::clamp(std::floor((x - all_.min()[axis]) / size_), 0.0, count - 1.0)); };
    const double near = kOnEdge * all_.sizes().maxCoeff();
    for (int axis = 0; axis < 2; ++axis)
      if (box.min()[axis] > all_.max()[axis] + near || box.max()[axis] < all_.min()[axis] - near) return;
    for (int j = index(box.min().y(), 1, rows); j <= index(box.max().y(), 1, rows); ++j)
      for (int i = index(box.min().x(), 0, columns_); i <= index(box.max().x(), 0, columns_); ++i) act(squares_[static_cast<std::size_t>(j) * columns_ + i]);
  }

 private:
  const Seen& surface_;
  Eigen::AlignedBox3d all_;
  double size_ = 1;
  int columns_ = 1;
  std::vector<std::vector<int>> squares_;
};

/// w of a plane where points are seen before it, less theirs: the least of `points` (a plane that stands) or of a plane that comes.
std::optional<double> to_plane(const std::vector<Vec3>& points, const PlacedSurface& plane, const Vec3& along, bool plane_comes) {
  const double meets = along.dot(plane.plane_normal);
  if (plane_comes ? !(meets > 0) : !(meets < 0)) return std::nullopt;
  std::optional<double> least;
  for (const Vec3& x : points) {
    const double way = (plane_comes ? 1 : -1) * (x - plane.plane_point).dot(plane.plane_normal) / meets;
    if (!least || way < *least) least = way;
  }
  return least;
}

}  // namespace

std::optional<double> way_to_touch(const PlacedSurface& mover, const PlacedSurface& standing, const Vec3& along) {
  if (mover.facets.empty() && standing.facets.empty()) return std::nullopt;
  if (mover.facets.empty()) return to_plane(standing.points, mover, along, true);
  if (standing.facets.empty()) return to_plane(mover.points, standing, along, false);
  const Vec3 u = mover.dimension == 2 ? Vec3(along.y(), -along.x(), 0) : Vec3(along.unitOrthogonal()), v = along.cross(u);
  const auto seen = [&](const PlacedSurface& surface) {
    Seen result{surface.dimension, {}, surface.facets};
    for (const Vec3& x : surface.points) result.points.emplace_back(u.dot(x), surface.dimension == 2 ? 0 : v.dot(x), along.dot(x));
    return result;
  };
  const Seen coming = seen(mover), there = seen(standing);
  SeenGrid grid(there);
  std::vector<double> first(standing.facets.size());  // w at which each begins
  for (std::size_t f = 0; f < first.size(); ++f) first[f] = there.box(static_cast<int>(f)).min().z();
  double least = kNone;
  for (int m = 0; m < static_cast<int>(mover.facets.size()); ++m) {
    const Eigen::AlignedBox3d box = coming.box(m);
    grid.over(box, [&](const std::vector<int>& square) {
      for (int s : square)
        if (first[s] - box.max().z() < least) least = std::min(least, between_facets(coming, m, there, s));
    });
  }
  return least < kNone ? std::optional<double>(least) : std::nullopt;
}

}  // namespace forming_sim
