// Weights of crossed triangles that follow the shape of their cells (element/crossed.h).
#include <algorithm>
#include <cmath>

#include "element/group.h"
#include "forming_sim/element/crossed.h"

namespace forming_sim {

void Elements::Group::set_weights(int block) {
  std::vector<Lane> items(kCrossedItems);
  for (int l = 0; l < kLanes; ++l) {
    const Vec3* corners = first_corners_of(block, l).data();
    const auto weights = crossed_weights(corners, ring, crossed_lambda(solid, corners, ring), true, weight_ratio[block][l]);
    for (int i = 0; i < kCrossedItems; ++i) items[i][l] = weights[i];
  }
  int& set = constant_sets[block];
  if (set < shared_sets) {
    set = static_cast<int>(constants_storage.size() / kCrossedItems);
    constants_storage.insert(constants_storage.end(), items.begin(), items.end());
    constants = reinterpret_cast<double*>(constants_storage.data());
  } else {
    std::copy(items.begin(), items.end(), constants_storage.begin() + static_cast<std::ptrdiff_t>(set) * kCrossedItems);
  }
}

void Elements::Group::set_changed_weights(const LargeArray<Lane>& ratio_before) {
  for (std::size_t block = 0; block < ratio_before.size(); ++block)
    if (!std::equal(ratio_before[block].value, ratio_before[block].value + kLanes, weight_ratio[block].value)) set_weights(static_cast<int>(block));
}

Eigen::Matrix2d Elements::Group::law_edges(int block, int l, const Vec3* corners, int s) const {
  Eigen::Vector2d way[4];
  for (int b = 0; b < 4; ++b) way[b] = (corners[b] - corners[4]).head<2>();
  const auto y = crossed_edges([&](int i) { return constant(block, i, l); }, way, s);
  Eigen::Matrix2d columns;
  columns << y[0], y[1];
  return columns;
}

double Elements::Group::least_seen(int block, int l, const Vec3* corners) const {
  const auto areas = [&](const Vec3* at) {
    std::array<double, 5> area{};  // by the law's edges; the last: of the cell
    for (int s = 0; s < 4; ++s) area[4] += area[s] = law_edges(block, l, at, s).determinant();
    return area;
  };
  const auto first = areas(first_corners_of(block, l).data()), now = areas(corners);
  double least = 1;
  for (int s = 0; s < 4; ++s) least = std::min(least, now[s] / first[s] * (first[4] / now[4]));
  return least;
}

void Elements::renew_weights(const NodeField& x) {
  constexpr int triangles = 4;
  for (Group& g : groups_) {
    for (int block = 0; block < static_cast<int>(g.weight_ratio.size()); ++block) {
      const Lane before = g.weight_ratio[block];
      Lane now = before;
      bool any = false;
      const auto corners_of = [&](int l) {
        std::array<Vec3, 5> corners;
        const int cell = std::min(block * kLanes + l, g.cells - 1);
        for (int a = 0; a < 5; ++a) corners[a] = vec3(x[g.node(cell, a)]);
        return corners;
      };
      for (int l = 0; l < kLanes; ++l) {
        if (is_mild(before[l])) continue;
        const std::array<Vec3, 5> corners = corners_of(l);
        const double ratio = crossed_ratio(corners.data());
        if (std::isfinite(ratio)) now[l] = renewed_ratio(crossed_ratio(g.first_corners_of(block, l).data()), before[l], ratio);
        if (g.least_seen(block, l, corners.data()) < kSeen) now[l] = 1;
        any = any || now[l] != before[l];
      }
      if (!any) continue;
      Eigen::Matrix2d edges[triangles][kLanes];  // of the law, with the weights of before
      for (int l = 0; l < kLanes; ++l) {
        const std::array<Vec3, 5> corners = corners_of(l);
        for (int s = 0; s < triangles; ++s) edges[s][l] = g.law_edges(block, l, corners.data(), s);
      }
      g.weight_ratio[block] = now;
      g.set_weights(block);
      for (int l = 0; l < kLanes; ++l) {
        if (now[l] == before[l]) continue;
        const std::array<Vec3, 5> corners = corners_of(l);
        for (int s = 0; s < triangles; ++s) {
          const Eigen::Matrix2d after = g.law_edges(block, l, corners.data(), s);
          Lane* memory = g.memory_storage.data() + (static_cast<std::size_t>(block) * triangles + s) * g.items;
          for (int k = 0; k < g.solid.layers; ++k) {
            Lane* layer = memory + k * kLayerItems<2>;
            const auto G = moved_memory({layer[0][l], layer[1][l], layer[2][l], layer[3][l]}, edges[s][l], after);
            for (int i = 0; i < 4; ++i) layer[i][l] = G[i];
          }
          if (g.solid.law != Law::hill) continue;
          Lane* axes = memory + g.solid.layers * kLayerItems<2>;  // the fibres stay where they are
          for (int fibre = 0; fibre < 2; ++fibre) {
            const auto item = [&](int m) -> double& { return axes[fibre * 2 + m][l]; };
            const Eigen::Vector2d d = after.inverse() * (edges[s][l] * Eigen::Vector2d(item(0), item(1)));
            for (int m = 0; m < 2; ++m) item(m) = d[m];
          }
        }
      }
      stillness_.forget();  // the forces that are kept are those of before
    }
  }
}

}  // namespace forming_sim
