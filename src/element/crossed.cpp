#include "forming_sim/element/crossed.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "forming_sim/mesh/cell_tables.h"

namespace forming_sim {

double crossed_lambda(const SolidConstants& solid, const Vec3* corners, bool ring) {
  const double nu = (3 * solid.K - 2 * solid.mu) / (2 * (3 * solid.K + solid.mu));
  const double lambda = std::min(1.0, std::sqrt(7 / (12 * (1 - nu))));
  if (!ring) return lambda;
  double least = corners[0][0], most = least;
  for (int a = 1; a < 4; ++a) least = std::min(least, corners[a][0]), most = std::max(most, corners[a][0]);
  const double q = (most - least) / (most + least);
  return 1 - (1 - lambda) * (1 - q * q);
}

std::vector<double> crossed_weights(const Vec3* corners, bool ring, double lambda) {
  const Vec3& apex = corners[kCrossed[0][0]];
  Eigen::Matrix2d up[4];
  double V[4], sum = 0;
  for (int s = 0; s < 4; ++s) {
    Eigen::Matrix2d edges;
    for (int m = 0; m < 2; ++m) edges.col(m) = (corners[kCrossed[s][m + 1]] - apex).head<2>();
    up[s] = edges.inverse();  // rows: X_s^m
    V[s] = edges.determinant();
    if (ring) V[s] *= corners[kCrossed[s][0]][0] + corners[kCrossed[s][1]][0] + corners[kCrossed[s][2]][0];
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
