// The pressure of free simplices next to nu = 1/2: element/even_pressure.h.
#include <gtest/gtest.h>

#include <algorithm>

#include "forming_sim/element/even_pressure.h"
#include "support/bodies.h"
#include "support/free_case.h"
#include "support/rings.h"

namespace forming_sim {
namespace {

MaterialConfig nearly_incompressible() {
  MaterialConfig material = aluminium();
  material.poissons_ratio = 0.499;
  return material;
}

class EvenPressureOf : public ::testing::TestWithParam<FreeCase> {
 protected:
  EvenPressureOf() : mesh(free_mesh(GetParam())), X(positions_of(mesh)) { options.axisymmetric = GetParam().ring; }
  Elements elements(const MaterialConfig& material, int threads = 1) const { return Elements({body_of(mesh, material)}, D, X, options, threads); }
  const int D = GetParam().dimension;
  ElementOptions options;
  const Mesh mesh;
  const NodeField X;
};

TEST_P(EvenPressureOf, IsTheGradientOfItsEnergyWithOneThreadAndTwo) {
  NodeField x = X, f(X.size()), other = f;
  const NodeField v(X.size(), Node::Zero());
  shake(x, D, 0.01, 4);
  Elements one = elements(nearly_incompressible()), two = elements(nearly_incompressible(), 2);
  one.forces(x, v, 0, 0, f);
  two.forces(x, v, 0, 0, other);
  double scale = 0;
  for (const Node& n : f) scale = std::max(scale, n.norm());
  const double h = 1e-6;
  for (std::size_t n = 0; n < x.size(); ++n)
    for (int i = 0; i < D; ++i) {
      EXPECT_EQ(f[n][i], other[n][i]);
      NodeField plus = x, minus = x;
      plus[n][i] += h, minus[n][i] -= h;
      EXPECT_NEAR(f[n][i], -(one.stored_energy(plus) - one.stored_energy(minus)) / (2 * h), 1e-6 * scale) << "node " << n << " axis " << i;
    }
}

// p_n = K_r theta_n + (K - K_r)/V_n0 sum_s V_s0/(d+1) theta_s, summed up here by simplices; where theta is uniform that is K theta.
TEST_P(EvenPressureOf, IsThatOfItsHeader) {
  const MaterialConfig material = nearly_incompressible();
  const double K = material.K(), K_r = rough_bulk(K, material.mu());
  ASSERT_LT(K_r, 0.02 * K);
  const auto simplices = mesh.simplices();
  const auto volume = [&](const NodeField& x, const std::array<int, 4>& s) {
    Eigen::Matrix3d e = Eigen::Matrix3d::Identity();
    for (int m = 0; m < D; ++m) e.col(m) = vec3(x[s[m + 1]] - x[s[0]]);
    if (GetParam().ring) e(2, 2) = (x[s[0]][0] + x[s[1]][0] + x[s[2]][0]) / 3;
    return e.determinant();
  };
  const auto mean = [&](const std::vector<double>& of_node, const std::array<int, 4>& s) {
    double sum = 0;
    for (int a = 0; a <= D; ++a) sum += of_node[s[a]] / (D + 1);
    return sum;
  };
  NodeField shaken = X, grown = X;
  shake(shaken, D, 0.01, 4);
  for (Node& x : grown) x *= 1 + 1e-3;
  for (const NodeField& x : {shaken, grown}) {
    std::vector<double> V(X.size()), V0(X.size()), theta(X.size()), smooth(X.size()), p(X.size());
    for (const auto& s : simplices)
      for (int a = 0; a <= D; ++a) V[s[a]] += volume(x, s), V0[s[a]] += volume(X, s);
    for (std::size_t n = 0; n < X.size(); ++n) theta[n] = V[n] / V0[n] - 1;
    for (const auto& s : simplices)
      for (int a = 0; a <= D; ++a) smooth[s[a]] += volume(X, s) * mean(theta, s) / V0[s[a]];
    for (std::size_t n = 0; n < X.size(); ++n) p[n] = K_r * theta[n] + (K - K_r) * smooth[n];
    const ElementFields found = elements(material).observe(x);
    for (std::size_t e = 0; e < simplices.size(); ++e) {
      ASSERT_LT(std::abs(found.volume_ratio[e] - 1), 0.2);  // no guard
      EXPECT_NEAR(found.stress[e].head<3>().mean(), mean(p, simplices[e]), 1e-9 * K);
    }
  }
  const double theta = std::pow(1 + 1e-3, GetParam().ring ? 3 : D) - 1;
  for (const Sym& s : elements(material).observe(grown).stress) EXPECT_NEAR(s.head<3>().mean(), K * theta, 1e-9 * K);
}

// What has K < kRough mu has K in every node.
TEST(EvenPressure, IsNothingOfCommonMetals) { EXPECT_EQ(rough_bulk(aluminium().K(), aluminium().mu()), aluminium().K()); }

INSTANTIATE_TEST_SUITE_P(Free, EvenPressureOf, ::testing::Values(FreeCase{2, false}, FreeCase{2, true}, FreeCase{3, false}));

}  // namespace
}  // namespace forming_sim
