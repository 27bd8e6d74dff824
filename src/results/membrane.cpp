#include "forming_sim/results/membrane.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "forming_sim/contact/facet_grid.h"
#include "forming_sim/element/sheet_sides.h"
#include "forming_sim/results/nearest_point.h"

namespace forming_sim {
namespace {

/// Of a segment of a ring, the ring's.
double area_of(const std::array<Vec3, 3>& X, int dimension, bool axisymmetric) {
  if (dimension == 3) return 0.5 * (X[1] - X[0]).cross(X[2] - X[0]).norm();
  return (X[1] - X[0]).norm() * (axisymmetric ? M_PI * (X[0].x() + X[1].x()) : 1);
}

}  // namespace

Membrane::Membrane(const Model& model, bool (*wanted)(const BodyModel&)) : dimension_(model.dimension), axisymmetric_(model.axisymmetric) {
  if (std::none_of(model.bodies.begin(), model.bodies.end(), wanted)) return;
  for (const BodyModel& body : model.bodies)
    for (const Vec3& X : body.reference()) reference_.push_back(node(X));
  opposite_.resize(reference_.size());
  int first_facet = 0;
  for (const BodyModel& body : model.bodies) {
    const auto [bottom, top] = sides_of_sheet(body, model.axisymmetric);
    if (wanted(body) && !top.empty()) {
      std::vector<std::array<int, 3>> nodes[2];
      std::size_t ends[3] = {facets_.size()};
      for (const int side : {0, 1}) {
        for (const int facet : facets_within(body.mesh, side == 0 ? bottom : top)) {
          const std::array<int, 3> corners = joined_corners(body, facet);
          nodes[side].push_back(corners);
          std::array<Vec3, 3> X;
          for (int k = 0; k < 3; ++k) X[k] = vec3(reference_[corners[k]]);
          facets_.push_back({static_cast<int>(&body - model.bodies.data()), first_facet + facet, corners, area_of(X, dimension_, axisymmetric_)});
        }
        ends[side + 1] = facets_.size();
      }
      if (nodes[0].empty() || nodes[1].empty()) {
        facets_.resize(ends[0]);
      } else {
        oppose(ends[0], ends[1], nodes[1]);
        oppose(ends[1], ends[2], nodes[0]);
      }
    }
    first_facet += static_cast<int>(body.mesh.surface.size());
  }
  for (const SideFacet& facet : facets_) middle_.push_back(middle(facet, reference_));
}

/// other: the side across from the facets `from` to before `to`.
void Membrane::oppose(std::size_t from, std::size_t to, const std::vector<std::array<int, 3>>& other) {
  std::vector<Vec3> first_nodes;
  for (const auto& corners : other) first_nodes.push_back(vec3(reference_[corners[0]]));
  const NearestPoint near(first_nodes);
  const FacetGrid grid(dimension_, other, reference_);
  for (std::size_t i = from; i < to; ++i) {
    for (const int n : facets_[i].nodes) {
      if (opposite_[n].weights != std::array<double, 3>{}) continue;
      const Node& X = reference_[n];
      int nearest = near.to(vec3(X));
      double least = std::numeric_limits<double>::infinity();
      grid.nearest(X, nearest, [&](int facet, double distance) {
        if (distance < least) least = distance, nearest = facet;
        return distance;
      });
      const Closest at = grid.closest(X, nearest);
      opposite_[n] = {other[nearest], {at.weight[0], at.weight[1], at.weight[2]}};
    }
  }
}

std::array<Vec3, 3> Membrane::middle(const SideFacet& facet, const NodeField& positions) const {
  std::array<Vec3, 3> points;
  for (int k = 0; k < 3; ++k) {
    const Opposite& other = opposite_[facet.nodes[k]];
    Vec3 across = Vec3::Zero();
    for (int c = 0; c < 3; ++c) across += other.weights[c] * vec3(positions[other.nodes[c]]);
    points[k] = 0.5 * (vec3(positions[facet.nodes[k]]) + across);
  }
  return points;
}

std::vector<SurfaceStrain> Membrane::at(const NodeField& positions) const {
  std::vector<SurfaceStrain> strains;
  for (std::size_t i = 0; i < facets_.size(); ++i) {
    const std::array<Vec3, 3>&X = middle_[i], x = middle(facets_[i], positions);
    strains.push_back(dimension_ == 2 ? strain_of_segment(X, x, axisymmetric_) : strain_of_triangle(X, x));
  }
  return strains;
}

}  // namespace forming_sim
