#include "forming_sim/contact/grid.h"

#include <algorithm>
#include <cmath>

namespace forming_sim {

double Box::distance(const Box& b) const {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const double d = std::max({0.0, low[k] - b.high[k], b.low[k] - high[k]});
    sum += d * d;
  }
  return std::sqrt(sum);
}

Grid::Grid(std::vector<Box> all, const Box& region, double cell) : boxes_(std::move(all)), stamp_(boxes_.size(), 0) {
  const std::vector<Box>& boxes = boxes_;
  long inside = 0;
  for (const Box& b : boxes) {
    if (!b.overlaps(region)) continue;
    region_.add(b);
    ++inside;
  }
  if (inside == 0) return;
  reach_ = region_;
  for (int k = 0; k < 3; ++k) {
    region_.low[k] = std::max(region_.low[k], region.low[k]);
    region_.high[k] = std::min(region_.high[k], region.high[k]);
  }
  const double most = 4.0 * inside + 64;
  for (;; cell *= 1.3) {
    double cells = 1;
    for (int k = 0; k < 3; ++k) cells *= std::floor((region_.high[k] - region_.low[k]) / cell) + 1;
    if (cells <= most) break;
  }
  for (int k = 0; k < 3; ++k) {
    count_[k] = static_cast<int>(std::floor((region_.high[k] - region_.low[k]) / cell)) + 1;
    inverse_cell_[k] = 1 / cell;
  }
  // Counting sort of the boxes into cells.
  first_.assign(static_cast<size_t>(count_[0]) * count_[1] * count_[2] + 1, 0);
  const auto each = [&](auto&& act) {
    for (size_t b = 0; b < boxes.size(); ++b) {
      if (!boxes[b].overlaps(region_)) continue;
      const auto r = cells(boxes[b]);
      for (int k = r[4]; k <= r[5]; ++k)
        for (int j = r[2]; j <= r[3]; ++j)
          for (int i = r[0]; i <= r[1]; ++i) act(static_cast<int>(b), (static_cast<size_t>(k) * count_[1] + j) * count_[0] + i);
    }
  };
  each([&](int, size_t c) { ++first_[c + 1]; });
  for (size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  entry_.resize(first_.back());
  std::vector<int> next(first_.begin(), first_.end() - 1);
  each([&](int b, size_t c) { entry_[next[c]++] = b; });
}

std::array<int, 6> Grid::cells(const Box& box) const {
  std::array<int, 6> r;
  for (int k = 0; k < 3; ++k) {
    const double low = (box.low[k] - region_.low[k]) * inverse_cell_[k], high = (box.high[k] - region_.low[k]) * inverse_cell_[k];
    r[2 * k] = static_cast<int>(std::min(std::max(low, 0.0), count_[k] - 1.0));
    r[2 * k + 1] = static_cast<int>(std::min(std::max(high, 0.0), count_[k] - 1.0));
  }
  return r;
}

}  // namespace forming_sim
