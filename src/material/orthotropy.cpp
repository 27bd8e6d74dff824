#include "forming_sim/material/orthotropy.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "forming_sim/config/words.h"

namespace forming_sim {
namespace {

constexpr double kStraight = 1e-6;  ///< cosine up to which two directions are perpendicular

/// Weights of (S_i - S_j)^2 and S_ij^2 in q_H^2, by the axes i and j of a frame.
struct HillWeights {
  double difference[3][3], shear[3][3];
};

HillWeights hill_weights(double r0, double r45, double r90) {
  const double G = 1 / (1 + r0), H = r0 * G, F = H / r90, N = (F + G) * (1 + 2 * r45) / 2, L = 1.5, M = 1.5;
  return {{{0, H, G}, {H, 0, F}, {G, F, 0}}, {{0, N, M}, {N, 0, L}, {M, L, 0}}};
}

/// axis[i]: which of the material's axes is the i-th of the frame.
HillModes modes_of(const HillWeights& w, const int (&axis)[3]) {
  Eigen::Matrix3d form = Eigen::Matrix3d::Zero();  // S . form . S, S the diagonal
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < i; ++j) {
      const double part = w.difference[axis[i]][axis[j]];
      form(i, i) += part, form(j, j) += part, form(i, j) -= part, form(j, i) -= part;
    }
  Eigen::Matrix<double, 3, 2> deviators;  // two unit ones
  deviators << std::sqrt(0.5), std::sqrt(1.0 / 6), -std::sqrt(0.5), std::sqrt(1.0 / 6), 0, -std::sqrt(2.0 / 3);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> own(deviators.transpose() * form * deviators);
  HillModes modes;
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector3d mode = deviators * own.eigenvectors().col(k);
    std::copy_n(mode.data(), 3, modes.normal[k]);
    modes.p[k] = own.eigenvalues()[k];
  }
  for (int i = 0; i < 3; ++i) modes.p[2 + i] = w.shear[axis[i]][axis[(i + 1) % 3]];
  const auto [least, most] = std::minmax_element(std::begin(modes.p), std::end(modes.p));
  modes.most = *most;
  modes.least = *least;
  return modes;
}

Vec3 rolling_of(const AnisotropyConfig& config) { return config.rolling_direction.isZero(0) ? Vec3::UnitX() : Vec3(config.rolling_direction.normalized()); }
Vec3 normal_of(const AnisotropyConfig& config, int dimension) {
  if (!config.sheet_normal.isZero(0)) return config.sheet_normal.normalized();
  return dimension == 2 ? Vec3::UnitY() : Vec3::UnitZ();
}
/// Whether a direction is in the plane of a section (0), along z (1), or neither (-1).
int place_in_section(const Vec3& direction) {
  if (std::abs(direction.z()) < kStraight) return 0;
  return direction.head<2>().norm() < kStraight ? 1 : -1;
}

}  // namespace

std::vector<DirectionFault> find_direction_faults(const AnisotropyConfig& config, int dimension) {
  const Vec3 rolling = rolling_of(config), normal = normal_of(config, dimension);
  std::vector<DirectionFault> faults;
  if (dimension == 2)
    for (const auto& [field, direction] : {std::pair{"rolling_direction", rolling}, {"sheet_normal", normal}})
      if (place_in_section(direction) < 0)
        faults.push_back({field, given_text(direction), "give a direction in the plane x-y or along z: a section cannot follow a material that shears across it"});
  if (std::abs(rolling.dot(normal)) > kStraight)
    faults.push_back({config.rolling_direction.isZero(0) ? "sheet_normal" : "rolling_direction", "rolling direction " + given_text(rolling) + " and normal " + given_text(normal),
                      "give both, at right angles to each other: not given, the rolling direction is x, the normal z, in dimension 2 y"});
  return faults;
}

Orthotropy orthotropy_of(const AnisotropyConfig& config) {
  const double r45 = config.r45 > 0 ? config.r45 : config.r0, r90 = config.r90 > 0 ? config.r90 : config.r0;
  const HillWeights weights = hill_weights(config.r0, r45, r90);
  Orthotropy material;
  const Vec3 rolling = rolling_of(config);
  Eigen::Map<Vec3>(material.space_axes[0]) = rolling;
  Eigen::Map<Vec3>(material.space_axes[1]) = normal_of(config, 3).cross(rolling);
  material.space = modes_of(weights, {0, 1, 2});
  const Vec3 normal = normal_of(config, 2);
  const bool across_the_plane = place_in_section(normal) == 1;
  const Vec3 first = across_the_plane ? rolling : Vec3(normal.y(), -normal.x(), 0), second = Vec3::UnitZ().cross(first);
  Eigen::Map<Eigen::Vector2d>(material.section_axes[0]) = first.head<2>();
  Eigen::Map<Eigen::Vector2d>(material.section_axes[1]) = second.head<2>();
  material.second_fibre = across_the_plane ? 1 : 0;
  material.plane = across_the_plane                 ? modes_of(weights, {0, 1, 2})
                   : place_in_section(rolling) == 0 ? modes_of(weights, {0, 2, 1})
                                                    : modes_of(weights, {1, 2, 0});
  return material;
}

std::vector<double> axes_at_start(const Orthotropy& material, int dimension, const Mat3& edges) {
  const Mat3 up = edges.inverse();  // rows: X^m
  std::vector<double> items;
  for (int k = 0; k < 2; ++k) {
    const Vec3 d = dimension == 3 ? Vec3(Eigen::Map<const Vec3>(material.space_axes[k])) : Vec3(material.section_axes[k][0], material.section_axes[k][1], 0);
    const Vec3 by_edges = up * d;
    items.insert(items.end(), by_edges.data(), by_edges.data() + dimension);
  }
  return items;
}

}  // namespace forming_sim
