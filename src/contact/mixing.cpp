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

void Mixing::begin(const Numbers& x, const Numbers& weight) {
  weight_ = weight;
  x_ = x;
  f_.resize(x.size());
  g_.resize(x.size());
  columns_ = 0;
  newest_ = -1;
  seen_ = false;
}

template <class Work> void Mixing::each_chunk(Work&& work) {
  const long count = static_cast<long>(x_.size());
  team_.share((count + kNumbersOfAChunk - 1) / kNumbersOfAChunk, kChunksOfAThread, [&](long first, long last) {
    for (long k = first; k < last; ++k) work(k, k * kNumbersOfAChunk, std::min(count, (k + 1) * kNumbersOfAChunk));
  });
}

Mixing::Sums Mixing::products_with(const Numbers& other) {
  of_chunk_.assign((x_.size() + kNumbersOfAChunk - 1) / kNumbersOfAChunk, Sums());
  each_chunk([&](long k, long from, long to) {
    for (int c = 0; c < columns_; ++c) of_chunk_[k].of[c] = part(dF_[c], from, to).dot(part(other, from, to));
  });
  Sums all;
  for (const Sums& each : of_chunk_)
    for (int c = 0; c < columns_; ++c) all.of[c] += each.of[c];
  return all;
}

void Mixing::see(const Numbers& state) {
  if (seen_) {
    newest_ = (newest_ + 1) % kColumns;
    columns_ = std::min(columns_ + 1, kColumns);
    dF_[newest_].resize(x_.size());
    dG_[newest_].resize(x_.size());
  }
  each_chunk([&](long, long from, long to) {
    const auto g = part(state, from, to);
    auto f = part(f_, from, to), x = part(x_, from, to), last = part(g_, from, to);
    if (seen_) {
      part(dF_[newest_], from, to) = part(weight_, from, to).cwiseProduct(g - x) - f;
      part(dG_[newest_], from, to) = g - last;
    }
    f = part(weight_, from, to).cwiseProduct(g - x);
    x = last = g;
  });
  if (seen_) {
    const Sums with_newest = products_with(dF_[newest_]);
    for (int c = 0; c < columns_; ++c) products_[newest_][c] = products_[c][newest_] = with_newest.of[c];
  }
  seen_ = true;
}

void Mixing::mix(Numbers& state) {
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kColumns, kColumns>;
  using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kColumns, 1>;
  const Sums with_f = products_with(f_);
  Square products(columns_, columns_);
  Column aims(columns_), scale(columns_);  // to columns of length 1: the last ones may be far shorter than the first
  for (int a = 0; a < columns_; ++a) scale[a] = products_[a][a] > 0 ? 1 / std::sqrt(products_[a][a]) : 0;
  for (int a = 0; a < columns_; ++a) {
    for (int b = 0; b < columns_; ++b) products(a, b) = scale[a] * scale[b] * products_[a][b];
    aims[a] = scale[a] * with_f.of[a];
  }
  products.diagonal().array() += kLeast;
  const Column gamma = scale.cwiseProduct(products.ldlt().solve(aims));
  if (!gamma.allFinite()) return;
  each_chunk([&](long, long from, long to) {
    for (int c = 0; c < columns_; ++c) part(state, from, to) -= gamma[c] * part(dG_[c], from, to);
    part(x_, from, to) = part(state, from, to);
  });
}

}  // namespace forming_sim
