#include "forming_sim/simulation/lanczos.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace forming_sim {
namespace {

/// Uniform bits from a counter (splitmix64), so that a run can be repeated anywhere.
class Normal {
 public:
  explicit Normal(std::uint64_t seed) : state_(seed) {}
  /// Normally distributed, mean 0, variance 1 (Box and Muller).
  double next() { return std::sqrt(-2 * std::log(uniform())) * std::cos(2 * M_PI * uniform()); }

 private:
  double uniform() {  // in (0, 1)
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15ull;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return (static_cast<double>((z ^ (z >> 31)) >> 11) + 0.5) * 0x1p-53;
  }
  std::uint64_t state_;
};

double dot(const NodeField& a, const NodeField& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

/// The recurrence so far: alpha_1 .. alpha_k, beta_1 .. beta_k.
struct Recurrence {
  std::vector<double> alpha, beta;

  /// ln p_k(t); below the largest root of one of the polynomials: minus infinity.
  double log_polynomial(double t) const {
    double sum = 0, ratio = 0;  // ratio: p_j / p_(j-1)
    for (std::size_t j = 0; j < alpha.size(); ++j) {
      double value = t - alpha[j];
      if (j > 0) value -= beta[j - 1] / ratio;
      if (!(value > 0)) return -INFINITY;
      ratio = value / beta[j];
      sum += std::log(ratio);
    }
    return sum;
  }
  /// The smallest t with ln p_k(t) >= level, between two numbers.
  double solve(double level, double low, double high) const {
    for (int i = 0; i < 60 && high - low > 1e-6 * high; ++i) {
      const double middle = 0.5 * (low + high);
      (log_polynomial(middle) >= level ? high : low) = middle;
    }
    return high;
  }
};

}  // namespace

SpectrumBound bound_spectrum(std::size_t nodes, int dimension, std::uint64_t seed, double cap, const std::function<void(NodeField&)>& project,
                             const std::function<void(const NodeField& v, NodeField& w)>& apply) {
  Normal normal(seed);
  NodeField v(nodes, Node::Zero()), before(v), w(v);
  for (Node& n : v)
    for (int i = 0; i < dimension; ++i) n[i] = normal.next();
  project(v);
  const double length = std::sqrt(dot(v, v));
  if (!(length > 0)) return {0, cap, 0};  // nothing is free to move: what is known of it is all there is
  for (Node& n : v) n /= length;
  const double level = -std::log(kDoubt * std::sqrt(M_PI / (2.0 * static_cast<double>(nodes) * dimension)));

  Recurrence run;
  SpectrumBound bound{0, cap, 0};
  while (bound.products < kMostProducts) {
    apply(v, w);
    ++bound.products;
    const double alpha = dot(v, w), last = run.beta.empty() ? 0 : run.beta.back();
    double square = 0;
    for (std::size_t n = 0; n < nodes; ++n) {
      w[n] -= alpha * v[n] + last * before[n];
      square += w[n].squaredNorm();
    }
    const double beta = std::sqrt(square);
    if (!std::isfinite(beta)) break;
    run.alpha.push_back(alpha);
    run.beta.push_back(std::max(beta, 1e-14 * cap));
    bound.below = run.solve(-1e300, bound.below, cap);
    bound.above = std::min(bound.above, run.solve(level, bound.below, cap));
    const bool idle = bound.below > (1 - kSlack) * cap, near = bound.above < (1 + kSlack) * bound.below, spent = beta < 1e-9 * bound.below;
    if (idle || near || spent) break;
    for (std::size_t n = 0; n < nodes; ++n) {
      before[n] = v[n];
      v[n] = w[n] / beta;
    }
  }
  return bound;
}

}  // namespace forming_sim
