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

double damage_per_strain(DamageCriterion criterion, const Mat3& sigma) {
  const double sigma_m = sigma.trace() / 3;
  const double sigma_e = std::sqrt(1.5) * (sigma - sigma_m * Mat3::Identity()).norm();
  if (!(sigma_e > 0)) return 0;  // nothing flows
  if (criterion == DamageCriterion::rice_tracey) return std::exp(1.5 * sigma_m / sigma_e);
  const double sigma_1 = Eigen::SelfAdjointEigenSolver<Mat3>().computeDirect(sigma, Eigen::EigenvaluesOnly).eigenvalues()[2];
  const double tension = std::max(sigma_1, 0.0);
  return criterion == DamageCriterion::cockcroft_latham ? tension : tension / sigma_e;
}

}  // namespace forming_sim
