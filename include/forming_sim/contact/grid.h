#pragma once
// A uniform grid over boxes: which of them may overlap a given box.
#include <algorithm>
#include <array>
#include <vector>

#include "forming_sim/tensor/vec.h"

namespace forming_sim {

struct Box {
  Node low = Node::Constant(1e300), high = Node::Constant(-1e300);
  void add(const Node& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  void add(const Box& b) {
    low = low.cwiseMin(b.low);
    high = high.cwiseMax(b.high);
  }
  void grow(double r) {
    low.array() -= r;
    high.array() += r;
  }
  /// Around these points.
  template <class... Points> static Box of(const Points&... points) {
    Box box;
    (box.add(points), ...);
    return box;
  }
  bool empty() const { return low[0] > high[0]; }
  bool holds(const Node& p) const { return overlaps(of(p)); }
  /// i: 0 ... 7.
  Vec3 corner(int i) const { return Vec3(i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]); }
  bool overlaps(const Box& b) const {
    for (int k = 0; k < 3; ++k)
      if (low[k] > b.high[k] || high[k] < b.low[k]) return false;
    return true;
  }
  /// 0 where they overlap.
  double distance(const Box& b) const;
  /// 0 inside.
  double squared_distance(const Node& p) const {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const double d = std::max({0.0, low[k] - p[k], p[k] - high[k]});
      sum += d * d;
    }
    return sum;
  }
};

class Grid {
 public:
  /// Boxes that lie outside `region` are left out. `cell` is the wanted size;
  /// it is enlarged so that there are not many more cells than boxes.
  Grid(std::vector<Box> boxes, const Box& region, double cell);
  Grid() = default;  ///< of nothing

  /// Calls found(index of box) once for every box that overlaps `query`. Neither this nor nearest() from two threads at once.
  template <class Found> void query(const Box& query, Found&& found) const {
    if (first_.empty() || !region_.overlaps(query)) return;
    const auto range = cells(query);
    ++stamp_now_;
    for (int k = range[4]; k <= range[5]; ++k)
      for (int j = range[2]; j <= range[3]; ++j)
        for (int i = range[0]; i <= range[1]; ++i) {
          const size_t c = (static_cast<size_t>(k) * count_[1] + j) * count_[0] + i;
          for (int e = first_[c]; e < first_[c + 1]; ++e) {
            const int b = entry_[e];
            if (stamp_[b] == stamp_now_) continue;
            stamp_[b] = stamp_now_;
            if (boxes_[b].overlaps(query)) found(b);
          }
        }
  }

  /// The least of `bound` and of distance(index of box), of the boxes that are nearer to p than that: of what lies in a box, the distance from p.
  template <class Distance> double nearest(const Node& p, double bound, Distance&& distance) const {
    Box around = Box::of(p);
    around.grow(bound);
    if (first_.empty() || !reach_.overlaps(around)) return bound;
    const auto range = cells(around);
    const auto away2 = [&](int axis, int cell) {  // of p from it, along the axis
      const double low = cell == 0 ? reach_.low[axis] : region_.low[axis] + cell / inverse_cell_[axis];
      const double high = cell + 1 == count_[axis] ? reach_.high[axis] : region_.low[axis] + (cell + 1) / inverse_cell_[axis];
      const double away = std::max({0.0, low - p[axis], p[axis] - high});
      return away * away;
    };
    ++stamp_now_;
    for (int k = range[4]; k <= range[5]; ++k) {
      const double z2 = away2(2, k);
      for (int j = range[2]; j <= range[3]; ++j) {
        const double yz2 = z2 + away2(1, j);
        if (yz2 >= bound * bound) continue;
        for (int i = range[0]; i <= range[1]; ++i) {
          if (yz2 + away2(0, i) >= bound * bound) continue;
          const size_t c = (static_cast<size_t>(k) * count_[1] + j) * count_[0] + i;
          for (int e = first_[c]; e < first_[c + 1]; ++e) {
            const int b = entry_[e];
            if (stamp_[b] == stamp_now_) continue;
            stamp_[b] = stamp_now_;
            if (boxes_[b].squared_distance(p) < bound * bound) bound = std::min(bound, distance(b));
          }
        }
      }
    }
    return bound;
  }

 private:
  std::array<int, 6> cells(const Box& box) const;

  std::vector<Box> boxes_;
  Box region_, reach_;  ///< reach_: of the boxes, also outside the region
  Node inverse_cell_ = Node::Zero();
  std::array<int, 3> count_{1, 1, 1};
  std::vector<int> first_, entry_;
  mutable std::vector<int> stamp_;  ///< of every box the last query that met it
  mutable int stamp_now_ = 0;
};

}  // namespace forming_sim
