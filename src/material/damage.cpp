#include "forming_sim/material/damage.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace forming_sim {

DamageCriterion damage_criterion(const std::string& word) {
  if (word == "cockcroft_latham") return DamageCriterion::cockcroft_latham;
  if (word == "rice_tracey") return DamageCriterion::rice_tracey;
  return DamageCriterion::normalized_cockcroft_latham;
}

const char* damage_unit(const std::string& criterion) { return criterion == "cockcroft_latham" ? "Pa" : "1"; }

DamageStress damage_stress(const Mat3& sigma) {
  DamageStress s;
  s.sigma_1 = Eigen::SelfAdjointEigenSolver<Mat3>().computeDirect(sigma, Eigen::EigenvaluesOnly).eigenvalues()[2];
  s.sigma_m = sigma.trace() / 3;
  s.sigma_e = std::sqrt(1.5) * (sigma - s.sigma_m * Mat3::Identity()).norm();
  return s;
}

double damage_per_strain(DamageCriterion criterion, const DamageStress& s, double flow) {
  constexpr double kMost = 5;  // sigma_m / sigma_e
  if (!(flow > 0)) return 0;
  const double tension = std::max(s.sigma_1, 0.0);
  if (criterion == DamageCriterion::cockcroft_latham) return tension;
  if (criterion == DamageCriterion::normalized_cockcroft_latham) return tension / flow;
  return std::exp(1.5 * std::min(s.sigma_m / flow, kMost));
}

}  // namespace forming_sim
