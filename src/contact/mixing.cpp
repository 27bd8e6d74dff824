#include "forming_sim/contact/mixing.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

namespace forming_sim {

namespace {
constexpr long kNumbersOfAChunk = 4096;   ///< whose products are summed in turn: the sums do not depend on the threads
constexpr long kChunksOfAThread = 8;      ///< fewer are not worth another thread
constexpr double kLeast = 1e-12;          ///< columns, of length 1, whose squared distance is less count as one

/// Those from `from` to `to`.
auto part(Mixing::Numbers& of, long from, long to) { return Eigen::Map<Eigen::VectorXd, Eigen::Aligned16>(of.data() + from, to - from); }
auto part(const Mixing::Numbers& of, long from, long to) { return Eigen::Map<const Eigen::VectorXd, Eigen::Aligned16>(of.data() + from, to - from); }
}  // namespace

template <class Work> void Mixing::each_chunk(long count, Work&& work) {
  team_.share((count + kNumbersOfAChunk - 1) / kNumbersOfAChunk, kChunksOfAThread, [&](long first, long last) {
    for (long k = first; k < last; ++k) work(k, k * kNumbersOfAChunk, std::min(count, (k + 1) * kNumbersOfAChunk));
  });
}

void Mixing::begin(const Numbers& x, const Numbers& weight) {
  weight_ = weight;
  x_ = x;
  columns_ = 0;
  newest_ = -1;
  seen_ = false;
}

void Mixing::mix(Numbers& state) {
  const long count = static_cast<long>(state.size());
  f_.resize(count);
  g_.resize(count);
  if (seen_) {
    newest_ = (newest_ + 1) % kColumns;
    columns_ = std::min(columns_ + 1, kColumns);
    dF_[newest_].resize(count);
    dG_[newest_].resize(count);
  }
  measure(state);
  double gamma[kColumns] = {};
  if (seen_) solve(gamma);
  each_chunk(count, [&](long, long from, long to) {
    part(g_, from, to) = part(state, from, to);
    for (int c = 0; c < columns_; ++c) part(state, from, to) -= gamma[c] * part(dG_[c], from, to);
    part(x_, from, to) = part(state, from, to);
  });
  seen_ = true;
}

void Mixing::measure(const Numbers& state) {
  const long count = static_cast<long>(state.size());
  struct Sums {
    double products[kColumns] = {}, aims[kColumns] = {};
  };
  std::vector<Sums> sums((count + kNumbersOfAChunk - 1) / kNumbersOfAChunk);
  each_chunk(count, [&](long k, long from, long to) {
    auto f = part(f_, from, to);
    if (seen_) {
      part(dF_[newest_], from, to) = -f;
      part(dG_[newest_], from, to) = part(state, from, to) - part(g_, from, to);
    }
    f = part(weight_, from, to).cwiseProduct(part(state, from, to) - part(x_, from, to));
    if (seen_) part(dF_[newest_], from, to) += f;
    for (int c = 0; c < columns_; ++c) {
      sums[k].products[c] = part(dF_[c], from, to).dot(part(dF_[newest_], from, to));
      sums[k].aims[c] = part(dF_[c], from, to).dot(f);
    }
  });
  Sums all;
  for (const Sums& each : sums)
    for (int c = 0; c < columns_; ++c) {
      all.products[c] += each.products[c];
      all.aims[c] += each.aims[c];
    }
  for (int c = 0; c < columns_; ++c) {
    products_[newest_][c] = products_[c][newest_] = all.products[c];
    aims_[c] = all.aims[c];
  }
}

void Mixing::solve(double* gamma) const {
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kColumns, kColumns>;
  using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kColumns, 1>;
  Square products(columns_, columns_);
  Column aims(columns_), scale(columns_);  // to columns of length 1: the last ones may be far shorter than the first
  for (int a = 0; a < columns_; ++a) scale[a] = products_[a][a] > 0 ? 1 / std::sqrt(products_[a][a]) : 0;
  for (int a = 0; a < columns_; ++a) {
    for (int b = 0; b < columns_; ++b) products(a, b) = scale[a] * scale[b] * products_[a][b];
    aims[a] = scale[a] * aims_[a];
  }
  products.diagonal().array() += kLeast;
  const Column best = scale.cwiseProduct(products.ldlt().solve(aims));
  if (best.allFinite()) std::copy(best.data(), best.data() + columns_, gamma);
}

}  // namespace forming_sim
