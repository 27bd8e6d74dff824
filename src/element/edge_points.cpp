#include "forming_sim/element/edge_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "element/simplex_shape.h"

namespace forming_sim {
namespace {

/// An edge of a simplex: its ends, the lower number first.
struct Side {
  int low, high, number;  ///< simplex * k + which of its edges
};

/// Of the simplices' edges which are the same: numbered by the first simplex that has them.
std::vector<int> number_edges(const std::vector<std::array<int, 4>>& simplices, int dimension, std::vector<std::array<int, 2>>& ends) {
  const int k = edges_of_simplex(dimension);
  std::vector<Side> sides;
  sides.reserve(simplices.size() * k);
  for (std::size_t s = 0; s < simplices.size(); ++s)
    for (int a = 0; a <= dimension; ++a)
      for (int b = 0; b < a; ++b) {
        const auto [low, high] = std::minmax(simplices[s][a], simplices[s][b]);
        sides.push_back({low, high, static_cast<int>(sides.size())});
      }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.number) < std::tie(b.low, b.high, b.number);
  });
  std::vector<int> first(sides.size()), number(sides.size());  // first: number of the side that comes first at the same edge
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool same = i > 0 && sides[i].low == sides[i - 1].low && sides[i].high == sides[i - 1].high;
    first[sides[i].number] = same ? first[sides[i - 1].number] : sides[i].number;
  }
  int count = 0;
  for (std::size_t i = 0; i < first.size(); ++i) number[i] = first[i] == static_cast<int>(i) ? count++ : number[first[i]];
  ends.resize(count);
  for (const Side& side : sides) ends[number[side.number]] = {side.low, side.high};
  return number;
}

}  // namespace

Eigen::Matrix3d EdgePoints::edges(int point) const {
  Eigen::Matrix3d E = Eigen::Matrix3d::Identity();
  const double extent = ring ? volume[point] / (kTwoPi * radius[point]) : volume[point];
  E.topLeftCorner(dimension, dimension) *= dimension == 2 ? std::sqrt(2 * extent) : std::cbrt(6 * extent);
  if (ring) E(2, 2) = radius[point];
  return E;
}

EdgePoints find_edge_points(const std::vector<std::array<int, 4>>& simplices, const NodeField& X, int dimension, bool ring) {
  const int D = dimension, k = edges_of_simplex(D), weights = edge_weights(D, ring);
  EdgePoints points;
  points.dimension = D;
  points.ring = ring;
  points.of_simplex = number_edges(simplices, D, points.ends);
  const int count = static_cast<int>(points.ends.size());

  std::vector<int> around_start(count + 1, 0), around(points.of_simplex.size());  // simplices around an edge
  for (int point : points.of_simplex) ++around_start[point + 1];
  std::partial_sum(around_start.begin(), around_start.end(), around_start.begin());
  std::vector<int> at(around_start.begin(), around_start.end() - 1);
  for (std::size_t i = 0; i < points.of_simplex.size(); ++i) around[at[points.of_simplex[i]]++] = static_cast<int>(i) / k;

  points.start.push_back(0);
  for (int point = 0; point < count; ++point) {
    const int first = points.start.back();
    double volume = 0, area = 0;
    for (int i = around_start[point]; i < around_start[point + 1]; ++i) {
      const std::array<int, 4>& simplex = simplices[around[i]];
      const SimplexShape shape(X, simplex, D, ring);
      const Eigen::Matrix3d up = shape.edges.inverse();  // rows: X^m
      const double share = shape.volume / k;
      volume += share;
      if (ring) area += share / (kTwoPi * shape.edges(2, 2));
      Eigen::Vector3d balance = Eigen::Vector3d::Zero();
      for (int a = D; a >= 0; --a) {
        Eigen::Vector3d g = balance;  // of the first corner: the others' together, turned round
        if (a > 0) {
          g = up.row(a - 1).transpose();
          balance -= g;
        }
        const auto place = std::find(points.node.begin() + first, points.node.end(), simplex[a]) - points.node.begin();
        if (place == static_cast<long>(points.node.size())) {
          points.node.push_back(simplex[a]);
          points.weight.resize(points.weight.size() + weights, 0.0);
          points.share.push_back(0);
        }
        points.share[place] += share / (D + 1);
        double* w = &points.weight[place * weights];
        for (int m = 0; m < D; ++m) w[m] += share * g[m];
        if (ring) w[D] += share / (3 * shape.edges(2, 2));
      }
    }
    points.start.push_back(static_cast<int>(points.node.size()));
    points.volume.push_back(volume);
    if (ring) points.radius.push_back(volume / (kTwoPi * area));
    const double c = points.edges(point)(0, 0);
    for (std::size_t i = static_cast<std::size_t>(first) * weights; i < points.weight.size(); ++i)
      points.weight[i] *= (static_cast<int>(i) % weights < D ? c : points.radius[point]) / volume;
    for (std::size_t i = first; i < points.share.size(); ++i) points.share[i] /= volume;
  }
  return points;
}

}  // namespace forming_sim
