#pragma once
// An upper bound on the largest eigenvalue of a symmetric operator A on nodal vectors,
// from a Lanczos run with a random start.
//
// The run makes v_(k+1) = p_k(A) v_1 of unit length, p_k the polynomial of its recurrence
//   beta_k p_k(t) = (t - alpha_k) p_(k-1)(t) - beta_(k-1) p_(k-2)(t),  p_0 = 1.
// With g the component of v_1 along the eigenvector of the largest eigenvalue L that means
// |g p_k(L)| <= 1, and beyond its largest root p_k only grows: L <= t with p_k(t) = 1/|g|.
// A start that is uniform on the sphere of n dimensions has |g| < d with a probability
// below d sqrt(2n/pi); kDoubt is that probability. No gap between eigenvalues and no
// earlier vector enters, so that a mode that has just become the fastest is not missed.
// (van Dorsselaer, Hochstenbach, van der Vorst: Computing probabilistic bounds for extreme
// eigenvalues of symmetric matrices with the Lanczos method, SIAM J. Matrix Anal. 22, 2001.)
#include <cstdint>
#include <functional>

#include "forming_sim/tensor/vec.h"

namespace forming_sim {

constexpr double kDoubt = 1e-6;   ///< probability that a bound is none
constexpr double kSlack = 0.08;   ///< a run ends when the bound is within this of the Ritz value below it
constexpr int kMostProducts = 120;

struct SpectrumBound {
  double below = 0, above = 0;  ///< largest Ritz value, bound
  int products = 0;
};

/// apply(v, w): w = A v, both with the components [0, dimension) of each node.
/// project: takes out of the start what A does not act on.
/// cap: a bound known beforehand; a run ends when it cannot be lowered by more than kSlack.
SpectrumBound bound_spectrum(std::size_t nodes, int dimension, std::uint64_t seed, double cap,
                             const std::function<void(NodeField&)>& project,
                             const std::function<void(const NodeField& v, NodeField& w)>& apply);

}  // namespace forming_sim
