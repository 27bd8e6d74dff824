#pragma once
// The triangles of a mesh that are worth drawing, at most a budget of them,
// chosen once so that their count stays constant while the mesh deforms.
#include <array>
#include <vector>

#include "forming_sim/mesh/mesh.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

class DisplayMesh {
 public:
  DisplayMesh() = default;
  /// dimension 3: the surface facets; 2: the elements of the section.
  /// positions: at the start, m. elements: corners of each simplex.
  /// Above `budget` (at least 1) triangles, nodes that share a cell of a regular
  /// grid are joined in the one nearest to their mean, the grid as fine as the
  /// budget allows; no node is moved or made.
  DisplayMesh(int dimension, const NodeField& positions, const std::vector<std::array<int, 4>>& elements,
              const std::vector<Facet>& surface, int budget);

  const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }
  /// Per place in drawn_nodes(), the mean over the elements around that node.
  std::vector<double> node_means(const std::vector<double>& element_values) const;
  /// Nodes that any triangle uses, increasing.
  const std::vector<int>& drawn_nodes() const { return drawn_; }
  /// Corners as places in drawn_nodes(), same order as triangles().
  const std::vector<std::array<int, 3>>& corners() const { return corners_; }

 private:
  void index_nodes(const std::vector<std::array<int, 4>>& elements, int corner_count);

  std::vector<std::array<int, 3>> triangles_, corners_;
  std::vector<int> drawn_;
  std::vector<int> first_, around_;  ///< elements around drawn_[k]: around_[first_[k]..first_[k + 1])
};

/// Triangles with the nodes of each occupied grid cell (edge `size`, m) joined;
/// those that collapse or come twice are left out.
std::vector<std::array<int, 3>> join_by_grid(const std::vector<std::array<int, 3>>& triangles,
                                             const NodeField& positions, double size);

}  // namespace forming_sim
