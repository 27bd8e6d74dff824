#include "forming_sim/element/crossed.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "forming_sim/element/guard.h"
#include "forming_sim/mesh/cell_tables.h"

namespace forming_sim {

namespace {

/// Half the ways between the middles of opposite sides; the first along the sides of triangles 0 and 2, the second along those of 1 and 3.
struct Medians {
  Vec3 a, b;
  explicit Medians(const Vec3* X) : a((X[1] - X[0] + X[2] - X[3]) / 4), b((X[3] - X[0] + X[2] - X[1]) / 4) {}
};

/// tau of the triangles at edges r times as long as the others.
double tau_of(double r) {
  if (r <= 1) return 1 / r;
  const double q = 1 / (r * r);
  return 10.0 / 7 / r / (1 + std::sqrt(1 + 20.0 / 7 * (1 - 9.0 / 7 * q)));
}
/// Up to which |J - 1| these are free of their guard: bending takes the middle node r times as far as in a square cell, but bends where that is more are for shorter cells.
double free_of(double r) { return kFreeOfGuard * std::clamp(r, 1.0, 1.5); }

/// 0 far from the axis, 1 at it.
double near_axis(const Vec3* corners, bool ring) {
  if (!ring) return 0;
  double least = corners[0][0], most = least;
  for (int a = 1; a < 4; ++a) least = std::min(least, corners[a][0]), most = std::max(most, corners[a][0]);
  return (most - least) / (most + least);
}

}  // namespace

double crossed_lambda(const SolidConstants& solid, const Vec3* corners, bool ring) {
  const double nu = (3 * solid.K - 2 * solid.mu) / (2 * (3 * solid.K + solid.mu));
  const Medians m(corners);
  const double sine = m.a.cross(m.b).norm() / (m.a.norm() * m.b.norm());
  const double lambda = sine * std::min(1.0, std::sqrt(7 / (12 * (1 - nu)))), q = near_axis(corners, ring);
  return 1 - (1 - lambda) * (1 - q * q);
}

double crossed_ratio(const Vec3* corners) {
  const Medians m(corners);
  return m.a.norm() / m.b.norm();
}

double renewed_ratio(double first, double of_weights, double now) {
  const auto shortness = [&](double r) { return of_weights > 1 ? 1 / r : r; };  // below 1: long, as the weights have it
  if (is_mild(of_weights)) return of_weights;
  if (const double r = 1 / shortness(of_weights); shortness(first) > stretch_borne(r) * shortness(now)) return r <= kLongest ? 1 : of_weights > 1 ? kLongest : 1 / kLongest;
  if (!(shortness(now) > kStale * shortness(of_weights))) return of_weights;
  return shortness(now) < 1 && shortness(now) < kFlowed * shortness(first) ? now : 1;
}

std::array<double, 4> moved_memory(const std::array<double, 4>& G, const Eigen::Matrix2d& before, const Eigen::Matrix2d& after) {
  const Eigen::Matrix2d A = after.inverse() * before;
  Eigen::Matrix2d in_plane;
  in_plane << G[0], G[3], G[3], G[1];
  const double scale = std::cbrt(1 / (A.determinant() * A.determinant()));  // (J after/J before)^(2/3)
  const Eigen::Matrix2d moved = scale * A * in_plane * A.transpose();
  return {moved(0, 0), moved(1, 1), scale * G[2], moved(0, 1)};
}

std::array<double, kCrossedItems> crossed_weights(const Vec3* corners, bool ring, double lambda, bool by_shape, double ratio) {
  const Vec3& apex = corners[kCrossed[0][0]];
  const Medians m(corners);
  Eigen::Matrix2d up[4];
  Eigen::Matrix<double, 3, 4> affine;  // 1 and X_b over a length
  Eigen::Matrix<double, 2, 4> shift;   // V_s g_s: how sum_s V_s F_s changes with the apex
  double V[4], sum = 0;
  for (int s = 0; s < 4; ++s) {
    Eigen::Matrix2d edges;
    for (int m = 0; m < 2; ++m) edges.col(m) = (corners[kCrossed[s][m + 1]] - apex).head<2>();
    up[s] = edges.inverse();  // rows: X_s^m
    V[s] = edges.determinant();
    if (ring) V[s] *= corners[kCrossed[s][0]][0] + corners[kCrossed[s][1]][0] + corners[kCrossed[s][2]][0];
    sum += V[s];
    shift.col(s) = -V[s] * (up[s].row(0) + up[s].row(1)).transpose();
    affine.col(s) << 1, edges.col(0) / m.a.norm();
  }
  std::array<double, kCrossedItems> items{};
  for (int c = 0; c < 4; ++c) {
    items[c * 4 + c] = lambda;
    for (int s = 0; s < 4; ++s)
      for (int m = 0; m < 2; ++m)
        items[c * 4 + kCrossed[s][m + 1]] += (1 - lambda) * V[s] / sum * up[s].row(m).dot((corners[c] - apex).head<2>());
  }
  for (int s = 0; s < 4; ++s) items[kCrossedGuard + s] = kFreeOfGuard;
  if (!by_shape) return items;
  const Eigen::Vector4d w = affine.transpose() * (affine * affine.transpose()).inverse().col(0);
  const double q = near_axis(corners, ring), first = crossed_ratio(corners);  // what is free at the start stays so: else renewed weights would make energy
  Eigen::Vector4d beta;
  for (int s = 0; s < 4; ++s) {
    const auto own = [s](double r) { return s % 2 == 0 ? r : 1 / r; };
    beta[s] = (1 - tau_of(own(ratio))) * (1 - q * q);
    items[kCrossedGuard + s] = free_of(own(first));
  }
  beta -= shift.transpose() * (shift * shift.transpose()).inverse() * (shift * beta);
  for (int b = 0; b < 4; ++b) {
    items[kCrossedApex + b] = -lambda * w[b];
    items[kCrossedFreed + b] = beta[b];
  }
  return items;
}

}  // namespace forming_sim
