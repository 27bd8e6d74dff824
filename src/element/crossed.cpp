#include "forming_sim/element/crossed.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "forming_sim/mesh/cell_tables.h"

namespace forming_sim {

double crossed_lambda(const SolidConstants& solid) {
  const double nu = (3 * solid.K - 2 * solid.mu) / (2 * (3 * solid.K + solid.mu));
  return std::min(1.0, std::sqrt(7 / (12 * (1 - nu))));
}

std::vector<double> crossed_weights(const Vec3* corners, double lambda) {
  const Vec3& apex = corners[kCrossed[0][0]];
  Eigen::Matrix2d up[4];
  double V[4], sum = 0;
  for (int s = 0; s < 4; ++s) {
    Eigen::Matrix2d edges;
    for (int m = 0; m < 2; ++m) edges.col(m) = (corners[kCrossed[s][m + 1]] - apex).head<2>();
    up[s] = edges.inverse();  // rows: X_s^m
    V[s] = edges.determinant();
    sum += V[s];
  }
  std::vector<double> W(kCrossedItems, 0.0);
  for (int c = 0; c < 4; ++c) {
    W[c * 4 + c] = lambda;
    for (int s = 0; s < 4; ++s)
      for (int m = 0; m < 2; ++m)
        W[c * 4 + kCrossed[s][m + 1]] += (1 - lambda) * V[s] / sum * up[s].row(m).dot((corners[c] - apex).head<2>());
  }
  return W;
}

}  // namespace forming_sim
