// Torsion of a round bar against exact values: torque while it yields, twist that stays when it is let go, and
// layers of plasticity, which bear the sum of what bars of their own would.
#include <gtest/gtest.h>

#include "support/torsion.h"

namespace forming_sim {
namespace {

using namespace torsion;

constexpr double kTwists[] = {1.5, 2, 3};

/// Largest errors of T/T_y, relative, and of the twist that stays, over theta_y.
struct Errors {
  double torque = 0, twist = 0;
};

Errors errors(int cells, const std::string& pattern) {
  std::vector<double> path;
  for (double t : kTwists) {
    path.push_back(t);
    path.push_back(t - exact_torque(t));
  }
  const Twisted found = twist(cells, pattern, path, perfect(), 2);
  EXPECT_LT(found.balance, 1e-3);
  Errors worst;
  for (std::size_t k = 0; k < path.size(); k += 2) {
    const double torque = found.torque[k] / exact_torque(path[k]) - 1;
    const double stays = left_over(path[k], found.torque[k], path[k + 1], found.torque[k + 1]) - path[k + 1];
    std::printf("  %s, %d a radius, theta/theta_y %g: T/T_y %.5f (%+.2f %%), twist that stays %+.5f\n", pattern.c_str(), cells, path[k], found.torque[k], 100 * torque, stays);
    worst.torque = std::max(worst.torque, std::abs(torque));
    worst.twist = std::max(worst.twist, std::abs(stays));
  }
  return worst;
}

// A polygon of N sides has a polar moment that is smaller by (2 pi/N)^2/3: N is 16 at 4 and 32 at 8 a radius.
void expect_convergence(const std::string& pattern, int few, int many) {
  const Errors coarse = errors(few, pattern), fine = errors(many, pattern);
  EXPECT_LT(fine.torque, 0.02);
  EXPECT_LT(fine.twist, 0.01);
  EXPECT_LT(fine.torque, 0.5 * coarse.torque);
}

TEST(Torsion, OnePointHexahedra) { expect_convergence("one_point", 4, 8); }
TEST(Torsion, TwentyFourTetrahedra) { expect_convergence("fine", 4, 6); }
TEST(Torsion, SixTetrahedra) { expect_convergence("coarse", 4, 8); }
TEST(Torsion, FreeTetrahedra) { expect_convergence("free", 4, 8); }

// Layers of weight w_i that yield at Y_i share the strain: T = sum w_i T_i, T_i the torque of a bar that yields at Y_i. On
// the way back from t the torque falls by twice what a virgin bar bears at half the way (Masing).
TEST(Torsion, LayersAreBarsInOne) {
  constexpr double weight[] = {0.5, 0.3, 0.2}, yield[] = {0.8, 1.6, 4};  // yield: over that of the perfect bar
  MaterialConfig material = perfect();
  for (int i = 0; i < 3; ++i) {
    LayerConfig layer;
    layer.weight = weight[i];
    layer.hardening = material.hardening;
    layer.hardening->yield_stress *= yield[i];
    material.layers.push_back(layer);
  }
  material.hardening.reset();
  const auto virgin = [&](double t) {
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += weight[i] * yield[i] * exact_torque(t / yield[i]);
    return sum;
  };
  const Twisted found = twist(8, "one_point", {1.2, 3, 0.5, -3}, material, 2), elastic = twist(8, "one_point", {0.5}, material, 2);
  const double stiffness = elastic.torque[0] / 0.5;  // of the polygon over that of the circle
  EXPECT_NEAR(stiffness, 1, 0.02);
  const double exact[] = {virgin(1.2), virgin(3), virgin(3) - 2 * virgin(1.25), -virgin(3)};
  for (int k = 0; k < 4; ++k) {
    std::printf("  torque %.5f, exact %.5f\n", found.torque[k] / stiffness, exact[k]);
    EXPECT_NEAR(found.torque[k] / stiffness, exact[k], 0.004 * virgin(3));
  }
}

}  // namespace
}  // namespace forming_sim
