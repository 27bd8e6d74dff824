#pragma once
// All frequencies of a small mesh, and the true limit of its step.
#include <Eigen/Eigenvalues>

#include "forming_sim/element/elements.h"
#include "forming_sim/loads/boundary.h"

namespace forming_sim {

/// M^-1/2 K M^-1/2, 1/s2, at x, plastic flow held: K by central differences of the forces.
inline Eigen::MatrixXd stiffness_over_mass(Elements& elements, const NodeField& x, int D) {
  const int n = static_cast<int>(x.size()) * D;
  const double h = 1e-6;
  const std::vector<double>& mass = elements.nodal_mass();
  Eigen::MatrixXd K(n, n);
  NodeField fp(x.size()), fm(x.size());
  for (int c = 0; c < n; ++c) {
    NodeField plus = x, minus = x;
    plus[c / D][c % D] += h;
    minus[c / D][c % D] -= h;
    elements.elastic_forces(plus, fp);
    elements.elastic_forces(minus, fm);
    for (int r = 0; r < n; ++r)
      K(r, c) = -(fp[r / D][r % D] - fm[r / D][r % D]) / (2 * h) / std::sqrt(mass[r / D] * mass[c / D]);
  }
  return 0.5 * (K + K.transpose());
}

/// omega^2, 1/s2, rising, of the modes at x, plastic flow held.
inline Eigen::VectorXd dense_frequencies(Elements& elements, const NodeField& x, int D, const BoundarySet& held = {}) {
  const Eigen::MatrixXd K = stiffness_over_mass(elements, x, D);
  Eigen::MatrixXd P = Eigen::MatrixXd::Identity(K.rows(), K.cols());
  for (std::size_t k = 0; k < held.nodes().size(); ++k)
    P.block(held.nodes()[k] * D, held.nodes()[k] * D, D, D) = held.projector(static_cast<int>(k)).topLeftCorner(D, D);
  const Eigen::MatrixXd A = P * K * P;
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues();
}

/// 2/omega of the fastest of them, s.
inline double dense_limit(Elements& elements, const NodeField& x, int D, const BoundarySet& held = {}) {
  return 2 / std::sqrt(dense_frequencies(elements, x, D, held).maxCoeff());
}

}  // namespace forming_sim
