#pragma once
// Blocks of one-point cells that have the same shape share their constants (element/one_point.h): a blank of even
// cells keeps those of one block, and a step reads them from the cache.
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "forming_sim/element/cell_group.h"
#include "forming_sim/parallel/large_array.h"

namespace forming_sim {

class AlikeBlocks {
 public:
  /// The number of the set of constants in `sets` that a block has, to 2^-36 of each; a set that is not there yet is appended.
  int find(const std::vector<Lane>& constants, LargeArray<Lane>& sets) {
    std::vector<double> rounded;
    rounded.reserve(constants.size() * kLanes);
    for (const Lane& lane : constants)
      for (double value : lane.value) rounded.push_back(round(value));
    const auto [at, fresh] = known_.try_emplace(std::move(rounded), static_cast<int>(known_.size()));
    if (fresh) sets.insert(sets.end(), constants.begin(), constants.end());
    return at->second;
  }

 private:
  /// Numbers below 1 to an absolute 2^-36: all but a stiffness are ratios.
  static double round(double value) {
    int exponent = 0;
    std::frexp(std::max(1.0, std::abs(value)), &exponent);
    return std::ldexp(std::nearbyint(std::ldexp(value, 36 - exponent)), exponent - 36) + 0.0;  // + 0.0: no negative zero
  }

  std::map<std::vector<double>, int> known_;
};

}  // namespace forming_sim
