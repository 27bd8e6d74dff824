#pragma once
// The edges and the volume of a simplex where its nodes stand.
#include <Eigen/LU>
#include <array>

#include "forming_sim/tensor/tensor.h"
#include "forming_sim/tensor/vec.h"

namespace forming_sim {

/// A simplex whose nodes stand at x: its edges as columns (2D: the third is the unit vector e_3,
/// of a ring the hoop r e_3), and its volume.
struct SimplexShape {
  Eigen::Matrix3d edges = Eigen::Matrix3d::Identity();
  double volume = 0;
  SimplexShape(const NodeField& x, const std::array<int, 4>& corner, int dimension, bool ring) {
    for (int m = 0; m < dimension; ++m) edges.col(m) = vec3(x[corner[m + 1]] - x[corner[0]]);
    if (ring) edges(2, 2) = (x[corner[0]][0] + x[corner[1]][0] + x[corner[2]][0]) / 3;
    volume = edges.determinant() / (dimension == 3 ? 6 : ring ? 2 / kTwoPi : 2);
  }
};

}  // namespace forming_sim
