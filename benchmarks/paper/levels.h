#pragma once
// The material of the paper's section 3.3 and how its figures drive it.
#include <algorithm>
#include <cmath>
#include <vector>

#include "forming_sim/material/material_point.h"

namespace forming_sim::bench {

constexpr double kPaperE = 100e9, kPaperNu = 0.45;  // Pa, -

/// E 100 GPa, nu .45 and the law as printed (3.5), with perfectly plastic levels of equal
/// weight at these eps_s; one level is the plain law.
inline MaterialConfig paper_material(const std::vector<double>& limits) {
  MaterialConfig m;
  m.density = 2700;  // of no effect at a point
  m.youngs_modulus = kPaperE;
  m.poissons_ratio = kPaperNu;
  m.law = "paper";
  for (double limit : limits) {
    HardeningConfig h;
    h.curve = "perfect";
    h.yield_stress = kPaperE * limit;
    LayerConfig layer;
    layer.weight = 1.0 / static_cast<double>(limits.size());
    layer.hardening = h;
    if (limits.size() == 1) m.hardening = h;
    else m.layers.push_back(layer);
  }
  return m;
}

/// A point in tension with free sides over the nominal strain x/X - 1.
class Pull {
 public:
  explicit Pull(const MaterialConfig& material) : point_(material) {}

  /// In even steps of at most `step`, each told to see(strain, stress).
  template <class See> void to(double strain, double step, See&& see) {
    const double from = strain_;
    const int n = std::max(1, static_cast<int>(std::ceil(std::fabs(strain - from) / step - 1e-9)));
    for (int i = 1; i <= n; ++i) {
      strain_ = i == n ? strain : from + (strain - from) * i / n;
      stress_ = point_.uniaxial(1 + strain_);
      see(strain_, stress_);
    }
  }
  double to(double strain, double step) {
    to(strain, step, [](double, double) {});
    return stress_;
  }
  double strain() const { return strain_; }
  double stress() const { return stress_; }
  const MaterialPoint& point() const { return point_; }

 private:
  MaterialPoint point_;
  double strain_ = 0, stress_ = 0;
};

}  // namespace forming_sim::bench
