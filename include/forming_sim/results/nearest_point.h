#pragma once
// Which of many points is nearest to a place.
#include <memory>
#include <vector>

#include "forming_sim/tensor/vec.h"

namespace forming_sim {

class NearestPoint {
 public:
  /// One point at least.
  explicit NearestPoint(const std::vector<Vec3>& points);
  ~NearestPoint();
  /// Its index.
  int to(const Vec3& place) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace forming_sim
