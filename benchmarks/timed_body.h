#pragma once
// A body whose nodes move to and fro while its forces are timed: in turns, so
// that bodies can be compared with those beside them.
#include <algorithm>
#include <cmath>
#include <memory>

#include "rows.h"
#include "support/bodies.h"

namespace forming_sim::bench {

class TimedBody {
 public:
  /// cells: along each side of a block of that kind; stretch: amplitude along x.
  TimedBody(CellKind kind, int cells, const MaterialConfig& material, double stretch)
      : X_(positions_of(block_of(kind, cells))), x_(X_), v_(X_.size(), Node::Zero()), f_(v_), stretch_(stretch) {
    const Mesh mesh = block_of(kind, cells);
    elements_ = std::make_unique<Elements>(std::vector<BodyModel>{body_of(mesh, material)}, mesh.dimension, X_, ElementOptions(), 1);
  }

  /// ns an element and step, the mean of one turn.
  double turn() {
    constexpr int calls = 20;
    constexpr double dt = 1e-8;
    double time = 0;
    for (int call = 0; call < calls; ++call) {
      const double stretch = 1 + stretch_ * std::sin(0.05 * static_cast<double>(calls_++));
      for (std::size_t i = 0; i < x_.size(); ++i) {
        v_[i][0] = (stretch * X_[i][0] - x_[i][0]) / dt;
        x_[i][0] = stretch * X_[i][0];
      }
      const Clock clock;
      elements_->forces(x_, v_, dt, dt, f_);
      time += clock.seconds();
    }
    return 1e9 * time / calls / static_cast<double>(elements_->simplices().size());
  }
  double plastic_work() const { return elements_->plastic_work(); }

 private:
  NodeField X_, x_, v_, f_;
  std::unique_ptr<Elements> elements_;
  double stretch_;
  long calls_ = 0;
};

/// ns of `turns` turns of each body, alternating.
inline std::vector<std::vector<double>> alternate(std::vector<TimedBody>& bodies, int turns) {
  std::vector<std::vector<double>> ns(bodies.size());
  for (TimedBody& body : bodies) body.turn();
  for (int turn = 0; turn < turns; ++turn)
    for (std::size_t k = 0; k < bodies.size(); ++k) ns[k].push_back(bodies[k].turn());
  return ns;
}

inline double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Median over turns of a / b.
inline double median_ratio(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> ratios;
  for (std::size_t turn = 0; turn < a.size(); ++turn) ratios.push_back(a[turn] / b[turn]);
  return median(std::move(ratios));
}

}  // namespace forming_sim::bench
