#include "forming_sim/ros/display_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace forming_sim {
namespace {

double area(const std::vector<std::array<int, 3>>& triangles, const NodeField& x) {
  double sum = 0;
  for (const auto& t : triangles) {
    sum += 0.5 * vec3(x[t[1]] - x[t[0]]).cross(vec3(x[t[2]] - x[t[0]])).norm();
  }
  return sum;
}

}  // namespace

std::vector<std::array<int, 3>> join_by_grid(const std::vector<std::array<int, 3>>& triangles,
                                             const NodeField& positions, double size) {
  std::set<int> used;
  for (const auto& t : triangles) used.insert(t.begin(), t.end());

  std::map<std::array<long, 3>, std::vector<int>> cells;
  for (const int n : used) {
    std::array<long, 3> cell;
    for (int k = 0; k < 3; ++k) cell[k] = std::lround(std::floor(positions[n][k] / size));
    cells[cell].push_back(n);
  }
  std::map<int, int> stands_for;
  for (const auto& [cell, nodes] : cells) {
    Node mean = Node::Zero();
    for (const int n : nodes) mean += positions[n] / static_cast<double>(nodes.size());
    const int best = *std::min_element(nodes.begin(), nodes.end(), [&](int a, int b) {
      return (positions[a] - mean).squaredNorm() < (positions[b] - mean).squaredNorm();
    });
    for (const int n : nodes) stands_for[n] = best;
  }

  std::vector<std::array<int, 3>> joined;
  std::set<std::array<int, 3>> known;
  for (const auto& t : triangles) {
    const std::array<int, 3> j{stands_for[t[0]], stands_for[t[1]], stands_for[t[2]]};
    if (j[0] == j[1] || j[1] == j[2] || j[2] == j[0]) continue;
    std::array<int, 3> key = j;
    std::sort(key.begin(), key.end());
    if (known.insert(key).second) joined.push_back(j);
  }
  return joined;
}

DisplayMesh::DisplayMesh(int dimension, const NodeField& positions,
                         const std::vector<std::array<int, 4>>& elements, const std::vector<Facet>& surface,
                         int budget) {
  if (dimension == 2) {
    for (const auto& e : elements) triangles_.push_back({e[0], e[1], e[2]});
  } else {
    for (const Facet& facet : surface) triangles_.push_back(facet.nodes);
  }
  if (static_cast<int>(triangles_.size()) > budget) {
    const std::vector<std::array<int, 3>> all = triangles_;
    // Two triangles a grid square would just meet the budget; coarser until it holds.
    double size = std::sqrt(2 * area(all, positions) / budget);
    do {
      triangles_ = join_by_grid(all, positions, size);
      size *= 1.1;
    } while (static_cast<int>(triangles_.size()) > budget);
  }
  index_nodes(elements, dimension + 1);
}

void DisplayMesh::index_nodes(const std::vector<std::array<int, 4>>& elements, int corner_count) {
  std::map<int, int> place;
  for (const auto& t : triangles_) for (const int n : t) place[n] = 0;
  for (auto& [n, k] : place) {
    k = static_cast<int>(drawn_.size());
    drawn_.push_back(n);
  }
  for (const auto& t : triangles_) corners_.push_back({place[t[0]], place[t[1]], place[t[2]]});

  std::vector<std::vector<int>> lists(drawn_.size());
  for (std::size_t e = 0; e < elements.size(); ++e) {
    for (int c = 0; c < corner_count; ++c) {
      const auto found = place.find(elements[e][c]);
      if (found != place.end()) lists[found->second].push_back(static_cast<int>(e));
    }
  }
  first_.assign(1, 0);
  for (const auto& list : lists) {
    around_.insert(around_.end(), list.begin(), list.end());
    first_.push_back(static_cast<int>(around_.size()));
  }
}

std::vector<double> DisplayMesh::node_means(const std::vector<double>& element_values) const {
  std::vector<double> means(drawn_.size(), 0);
  for (std::size_t k = 0; k < drawn_.size(); ++k) {
    for (int i = first_[k]; i < first_[k + 1]; ++i) means[k] += element_values[around_[i]];
    if (first_[k + 1] > first_[k]) means[k] /= first_[k + 1] - first_[k];
  }
  return means;
}

}  // namespace forming_sim
