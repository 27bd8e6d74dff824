// Axisymmetric elements: rings whose third edge vector is the hoop.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "forming_sim/material/material_point.h"
#include "support/kernels.h"
#include "support/rings.h"

namespace forming_sim {
namespace {

struct Case { CellKind kind; const char* average; double inner; const char* law = "green_elastic"; };
void PrintTo(const Case& c, std::ostream* out) {
  *out << shape_of(c.kind).name << ", pressure per " << c.average << ", inner radius " << c.inner << ", " << c.law;
}

MaterialConfig material_of(const std::string& law, bool plastic) {
  MaterialConfig m = aluminium(plastic);
  m.law = law;
  if (law == "layers") {
    m.law = "green_elastic";
    m.layers = {{0.6, m.hardening}, {0.4, {}}};
    m.hardening.reset();
  } else if (law == "hyperelastic") {
    m = rubber(100e6);
  }
  return m;
}

class EveryRing : public ::testing::TestWithParam<Case> {
 protected:
  BodyModel body(bool plastic = false, int n = 3) const {
    return body_of(ring_block(GetParam().kind, GetParam().inner, n), material_of(GetParam().law, plastic), GetParam().average);
  }
};

TEST_P(EveryRing, ForcesAreMinusTheGradientOfTheStoredEnergy) {
  const BodyModel b = body();
  NodeField x = positions_of(b.mesh);
  Elements elements({b}, 2, x, rings(), 1);
  const bool paper = std::string(GetParam().law) == "paper";  // S = mu B_D has an energy in small strain only
  shake_rings(x, paper ? 1e-4 : 0.04, 1);
  const NodeField f = ring_forces(elements, x);
  const double h = 1e-6;
  double scale = 0;
  for (const Node& n : f) scale = std::max(scale, n.norm());
  ASSERT_GT(scale, 0);
  for (std::size_t n = 0; n < x.size(); ++n)
    for (int i = x[n][0] == 0 ? 1 : 0; i < 2; ++i) {
      NodeField plus = x, minus = x;
      plus[n][i] += h;
      minus[n][i] -= h;
      const double slope = (elements.stored_energy(plus) - elements.stored_energy(minus)) / (2 * h);
      EXPECT_NEAR(f[n][i], -slope, (paper ? 2e-3 : 2e-7) * scale) << "node " << n << " axis " << i;
    }
}

TEST_P(EveryRing, ForcesAlongTheAxisBalance) {
  const BodyModel b = body(true);
  NodeField x = positions_of(b.mesh);
  Elements elements({b}, 2, x, rings(), 1);
  shake_rings(x, 0.05, 2);
  double sum = 0, scale = 0;
  for (const Node& n : ring_forces(elements, x)) {
    sum += n[1];
    scale += n.norm();
  }
  EXPECT_LT(std::abs(sum), 1e-13 * scale);
  EXPECT_EQ(elements.plastic_work() > 0, std::string(GetParam().law) != "hyperelastic");
}

// Any uniform stress with equal radial and hoop part is in equilibrium, on any mesh:
// all round pressure, tension along the axis, and both at once.
TEST_P(EveryRing, UniformStatesAreExact) {
  const BodyModel b = body();
  NodeField X = positions_of(b.mesh);
  shake_rings(X, 0.03, 3);
  std::vector<char> on_surface(X.size(), 0);
  for (const Facet& facet : b.mesh.surface) on_surface[facet.nodes[0]] = on_surface[facet.nodes[1]] = 1;
  MaterialPoint point(b.material);
  const double slim = point.step_with_free(Vec3(1, 1.02, 1).asDiagonal().toDenseMatrix(), {true, false, true}).stress(1, 1) > 0 ? point.deformation()(0, 0) : 0;
  for (const Vec3& stretch : {Vec3(0.99, 0.99, 0.99), Vec3(slim, 1.02, slim), Vec3(1.01, 0.97, 1.01)}) {
    Elements elements({b}, 2, X, rings(), 1);
    NodeField x = X;
    for (Node& n : x) n = Node(stretch[0] * n[0], stretch[1] * n[1], 0, 0);
    MaterialPoint exact(b.material);
    const Mat3 sigma = exact.step(stretch.asDiagonal()).stress;
    const ElementFields fields = elements.observe(x);
    const double size = std::max(sigma.norm(), 1e-3 * exact.solid().mu);
    for (const Sym& s : fields.stress)
      EXPECT_LT((Vec3(s[0], s[1], s[2]) - sigma.diagonal()).norm() + std::abs(s[3]), 1e-11 * exact.solid().K) << stretch.transpose();
    const NodeField f = ring_forces(elements, x);
    for (std::size_t n = 0; n < x.size(); ++n)
      if (!on_surface[n] && X[n][0] > 0) {
        EXPECT_LT(f[n].norm(), 1e-8 * size) << stretch.transpose();
      }
  }
  EXPECT_LT(slim, 1);
}

TEST_P(EveryRing, TheVolumeIsThatOfTheSolidOfRevolution) {
  const BodyModel b = body();
  NodeField x = positions_of(b.mesh);
  Elements elements({b}, 2, x, rings(), 1);
  double mass = 0;
  for (double m : elements.nodal_mass()) mass += m;
  const double a = GetParam().inner, outer = a + 1;
  EXPECT_NEAR(mass, b.material.density * M_PI * (outer * outer - a * a) * 0.8, 1e-12 * mass);
}

/// The largest stable step of the model, 2/omega, with the axis held.
double true_limit(Elements& elements, const NodeField& x) {
  const int n = static_cast<int>(x.size()) * 2;
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);  // M^-1/2 (-df/dx) M^-1/2 by central differences
  const double h = 1e-6;
  const std::vector<double>& mass = elements.nodal_mass();
  const auto held = [&](int c) { return c % 2 == 0 && x[c / 2][0] == 0; };
  for (int c = 0; c < n; ++c) {
    if (held(c)) continue;
    NodeField plus = x, minus = x;
    plus[c / 2][c % 2] += h;
    minus[c / 2][c % 2] -= h;
    const NodeField fp = ring_forces(elements, plus), fm = ring_forces(elements, minus);
    for (int r = 0; r < n; ++r)
      if (!held(r)) K(r, c) = -(fp[r / 2][r % 2] - fm[r / 2][r % 2]) / (2 * h) / std::sqrt(mass[r / 2] * mass[c / 2]);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(0.5 * (K + K.transpose()), Eigen::EigenvaluesOnly);
  return 2 / std::sqrt(modes.eigenvalues().maxCoeff());
}

TEST_P(EveryRing, TheStableStepIsABoundAndNotATimidOne) {
  const BodyModel b = body();
  NodeField x = positions_of(b.mesh);
  Elements elements({b}, 2, x, rings(), 1);
  for (double size : {0.0, 0.03}) {
    shake_rings(x, size, 4);
    const NodeField zero(x.size(), Node::Zero());
    double dt = 0;
    int element = -1;
    elements.stable_step(x, zero, dt, element);
    EXPECT_GE(element, 0);
    const double exact = true_limit(elements, x);
    EXPECT_LE(dt, exact * (1 + 1e-6));
    EXPECT_GE(dt, 0.4 * exact);
    std::cout << "  bound / true limit = " << dt / exact << "\n";
  }
}

TEST_P(EveryRing, ThreadsChangeNothing) {
  const BodyModel b = body(true, 24);
  NodeField x = positions_of(b.mesh);
  Elements one({b}, 2, x, rings(), 1), two({b}, 2, x, rings(), 2);
  shake_rings(x, 0.004, 5);
  const NodeField f1 = ring_forces(one, x), f2 = ring_forces(two, x);
  for (std::size_t n = 0; n < x.size(); ++n) ASSERT_EQ(f1[n], f2[n]);
  EXPECT_EQ(one.plastic_work(), two.plastic_work());
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryRing,
                         ::testing::Values(Case{CellKind::triangle, "element", 0}, Case{CellKind::triangle, "node", 0},
                                           Case{CellKind::quad2, "cell", 0}, Case{CellKind::quad2, "cell", 0.3},
                                           Case{CellKind::crossed, "cell", 0}, Case{CellKind::crossed, "cell", 0.3},
                                           Case{CellKind::crossed, "cell", 30}, Case{CellKind::crossed, "node", 0},
                                           Case{CellKind::crossed, "cell", 0, "layers"}, Case{CellKind::quad2, "cell", 0, "paper"},
                                           Case{CellKind::crossed, "cell", 0, "hyperelastic"},
                                           Case{CellKind::triangle, "node", 0.3, "hyperelastic"}, Case{CellKind::quad1, "cell", 0},
                                           Case{CellKind::quad1, "cell", 0.3}, Case{CellKind::quad1, "cell", 30}, Case{CellKind::quad1, "cell", 0, "layers"},
                                           Case{CellKind::quad1, "cell", 0.3, "paper"}, Case{CellKind::quad1, "cell", 0, "hyperelastic"}));

// A thin ring far from the axis is a section in plane strain, but for its circumference.
TEST(Rings, FarFromTheAxisTheyAreAPlaneStrainSection) {
  const double radius = 1e6;
  const BodyModel turned = body_of(ring_block(CellKind::crossed, radius - 0.5, 3), aluminium(true));
  const BodyModel flat = body_of(block_of(CellKind::crossed, 3), aluminium(true));
  NodeField X = positions_of(turned.mesh), x = positions_of(flat.mesh);
  Elements ring({turned}, 2, X, rings(), 1), plane({flat}, 2, x, {}, 1);
  shake(X, 2, 0.01, 6);
  shake(x, 2, 0.01, 6);
  const NodeField f = ring_forces(ring, X), g = ring_forces(plane, x);
  double scale = 0;
  for (const Node& n : g) scale = std::max(scale, n.norm());
  for (std::size_t n = 0; n < x.size(); ++n) EXPECT_LT((f[n] / (2 * M_PI * radius) - g[n]).norm(), 1e-4 * scale);
  EXPECT_GT(ring.plastic_work(), 0);
}

TEST(Rings, EveryVectorWidthGivesTheSame) {
  const BodyModel b = body_of(ring_block(CellKind::crossed, 0, 5), aluminium(true));
  expect_widths_agree([&](const char* name) {
    NodeField x = positions_of(b.mesh);
    Elements elements({b}, 2, x, rings(), 1, name);
    shake_rings(x, 0.01, 7);
    return ring_forces(elements, x);
  });
}

// The classical rate law knows the hoop by its rate: v_r / r.
TEST(Rings, TheClassicalLawStretchesTheHoop) {
  MaterialConfig material = aluminium();
  material.law = "classical";
  const BodyModel b = body_of(ring_block(CellKind::crossed, 0.3), material);
  const NodeField X = positions_of(b.mesh);
  Elements elements({b}, 2, X, rings(), 1);
  NodeField x = X, v = X, f(X.size());
  const double radial = 1e-6, axial = -3e-7, dt = 1e-6;
  for (std::size_t n = 0; n < x.size(); ++n) {
    v[n] = Node(radial * X[n][0], axial * X[n][1], 0, 0) / dt;
    x[n] += dt * v[n];
  }
  elements.forces(x, v, dt, dt, f);
  const double volume = 2 * radial + axial, mu = material.mu();
  const double p = material.K() * volume, hoop = p + 2 * mu * (radial - volume / 3), along = p + 2 * mu * (axial - volume / 3);
  for (const Sym& s : elements.observe(x).stress) {
    EXPECT_NEAR(s[0], hoop, 1e-5 * hoop);
    EXPECT_NEAR(s[1], along, 1e-5 * hoop);
    EXPECT_NEAR(s[2], hoop, 1e-5 * hoop);
  }
}

std::string refusal(const NodeField& start, const NodeField& later, const BodyModel& b) {
  try {
    Elements elements({b}, 2, start, rings(), 1);
    ring_forces(elements, later);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::mesh_error);
    return error.what();
  }
  return "";
}

TEST(Rings, NothingMayCrossTheAxis) {
  const BodyModel b = body_of(ring_block(CellKind::crossed, 0), aluminium());
  const NodeField X = positions_of(b.mesh);
  NodeField x = X;
  x[0][0] = -1e-3;
  EXPECT_NE(refusal(x, x, b).find("node 0"), std::string::npos);
  EXPECT_NE(refusal(x, x, b).find("lies at x >= 0"), std::string::npos);
  EXPECT_NE(refusal(X, x, b).find("has crossed"), std::string::npos);
  EXPECT_EQ(refusal(X, X, b), "");
}

}  // namespace
}  // namespace forming_sim
