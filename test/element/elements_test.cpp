#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "support/bodies.h"
#include "support/kernels.h"

namespace forming_sim {
namespace {

struct Case { CellKind kind; const char* average; const char* law = "one layer"; };
void PrintTo(const Case& c, std::ostream* out) { *out << shape_of(c.kind).name << ", pressure per " << c.average << ", " << c.law; }

MaterialConfig material_of(const std::string& law, bool plastic) {
  MaterialConfig m = aluminium(plastic);
  if (law == "layers") {
    m.layers = {{0.6, m.hardening}, {0.3, m.hardening}, {0.1, {}}};
    if (plastic) m.layers[1].hardening->yield_stress = 300e6;
    m.hardening.reset();
  } else if (law == "rubber") {
    m = rubber(100e6);
  } else if (law == "classical") {
    m.law = law;
  }
  return m;
}

class EveryKind : public ::testing::TestWithParam<Case> {
 protected:
  int dimension() const { return shape_of(GetParam().kind).dimension; }
  BodyModel body(bool plastic = false) const { return body_of(block_of(GetParam().kind), material_of(GetParam().law, plastic), GetParam().average); }
  bool yields() const { return std::string(GetParam().law) != "rubber"; }
  static NodeField forces_at(Elements& elements, const NodeField& x) {
    NodeField f(x.size()), v(x.size(), Node::Zero());
    elements.forces(x, v, 0, 0, f);
    return f;
  }
};

TEST_P(EveryKind, ForcesAreMinusTheGradientOfTheStoredEnergy) {
  const BodyModel b = body();
  NodeField x = positions_of(b.mesh);
  Elements elements({b}, dimension(), x, {}, 1);
  shake(x, dimension(), 0.05, 1);
  const NodeField f = forces_at(elements, x);
  const double h = 1e-6;
  double scale = 0;
  for (const Node& n : f) scale = std::max(scale, n.norm());
  ASSERT_GT(scale, 0);
  for (std::size_t n = 0; n < x.size(); n += 3)
    for (int i = 0; i < dimension(); ++i) {
      NodeField plus = x, minus = x;
      plus[n][i] += h;
      minus[n][i] -= h;
      const double slope = (elements.stored_energy(plus) - elements.stored_energy(minus)) / (2 * h);
      EXPECT_NEAR(f[n][i], -slope, 1e-6 * scale) << "node " << n << " axis " << i;
    }
}

TEST_P(EveryKind, ForcesBalanceInSumAndMoment) {
  const BodyModel b = body(true);
  NodeField x = positions_of(b.mesh);
  Elements elements({b}, dimension(), x, {}, 1);
  shake(x, dimension(), 0.05, 2);
  const NodeField f = forces_at(elements, x);
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  double scale = 0;
  for (std::size_t n = 0; n < x.size(); ++n) {
    sum += vec3(f[n]);
    moment += vec3(x[n]).cross(vec3(f[n]));
    scale += f[n].norm();
  }
  EXPECT_LT(sum.norm(), 1e-13 * scale);
  EXPECT_LT(moment.norm(), 1e-13 * scale);
  EXPECT_EQ(elements.plastic_work() > 0, yields());
}

TEST_P(EveryKind, PatchTest) {
  const BodyModel b = body();
  NodeField x = positions_of(b.mesh);
  shake(x, dimension(), 0.04, 3);
  Elements elements({b}, dimension(), x, {}, 1);
  Mat3 F = Mat3::Identity();
  F(0, 0) = 1.01;
  F(0, 1) = 0.02;
  F(1, 0) = -0.005;
  if (dimension() == 3) F(2, 1) = 0.015;
  for (Node& n : x) n = node(F * vec3(n));
  const ElementFields fields = elements.observe(x);
  for (const Sym& sigma : fields.stress) EXPECT_LT((sigma - fields.stress[0]).norm(), 1e-9 * fields.stress[0].norm());
  const NodeField f = forces_at(elements, x);
  std::vector<char> on_surface(x.size(), 0);
  for (const Facet& facet : b.mesh.surface)
    for (int a = 0; a < dimension(); ++a) on_surface[facet.nodes[a]] = 1;
  for (std::size_t n = 0; n < x.size(); ++n)
    if (!on_surface[n]) {
      EXPECT_LT(f[n].norm(), 1e-9 * fields.stress[0].norm());
    }
}

TEST_P(EveryKind, StressOfFewIsThatOfAll) {
  const BodyModel b = body_of(block_of(GetParam().kind, 6), material_of(GetParam().law, true), GetParam().average);
  NodeField x = positions_of(b.mesh);
  Elements elements({b}, dimension(), x, {}, 1);
  const bool flat_simplices = GetParam().kind == CellKind::wedge14 || GetParam().kind == CellKind::pyramid8;  // which .02 would turn inside out
  shake(x, dimension(), flat_simplices ? 0.01 : 0.02, 8);
  forces_at(elements, x);  // flows
  const std::vector<Sym> all = elements.observe(x).stress;
  const int last = static_cast<int>(all.size()) - 1;
  ASSERT_GT(last, 32);
  for (const std::vector<int>& few : {std::vector<int>{last, 0, last / 2 + 1, last / 2}, std::vector<int>{last}, std::vector<int>()}) {
    const std::vector<Sym> found = elements.stress_of(few, x);
    ASSERT_EQ(found.size(), few.size());
    for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(found[i], all[few[i]]);
  }
}

TEST_P(EveryKind, TheStableStepIsABoundAndNotATimidOne) {
  const BodyModel b = body();
  NodeField x = positions_of(b.mesh);
  shake(x, dimension(), 0.03, 4);
  Elements elements({b}, dimension(), x, {}, 1);
  const NodeField zero(x.size(), Node::Zero());
  double dt = 0;
  int element = -1;
  elements.stable_step(x, zero, dt, element);
  EXPECT_GE(element, 0);
  const int D = dimension(), n = static_cast<int>(x.size()) * D;
  Eigen::MatrixXd K(n, n);  // M^-1/2 (-df/dx) M^-1/2 by central differences
  const double h = 1e-6;
  const std::vector<double>& mass = elements.nodal_mass();
  for (int c = 0; c < n; ++c) {
    NodeField plus = x, minus = x;
    plus[c / D][c % D] += h;
    minus[c / D][c % D] -= h;
    const NodeField fp = forces_at(elements, plus), fm = forces_at(elements, minus);
    for (int r = 0; r < n; ++r)
      K(r, c) = -(fp[r / D][r % D] - fm[r / D][r % D]) / (2 * h) / std::sqrt(mass[r / D] * mass[c / D]);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(0.5 * (K + K.transpose()), Eigen::EigenvaluesOnly);
  const double exact = 2 / std::sqrt(modes.eigenvalues().maxCoeff());
  EXPECT_LE(dt, exact * (1 + 1e-6));
  EXPECT_GE(dt, 0.4 * exact);
  RecordProperty("share_of_true_limit", std::to_string(dt / exact));
  std::cout << "  bound / true limit = " << dt / exact << "\n";
}

TEST_P(EveryKind, ThreadsChangeNothing) {
  BodyModel b = body_of(block_of(GetParam().kind, dimension() == 2 ? 24 : 6), material_of(GetParam().law, true), GetParam().average);
  NodeField x = positions_of(b.mesh);
  Elements one({b}, dimension(), x, {}, 1), two({b}, dimension(), x, {}, 2);
  shake(x, dimension(), 0.004, 5);
  const NodeField f1 = forces_at(one, x), f2 = forces_at(two, x);
  for (std::size_t n = 0; n < x.size(); ++n) ASSERT_EQ(f1[n], f2[n]);
  EXPECT_EQ(one.plastic_work() > 0, yields());
  EXPECT_EQ(one.plastic_work(), two.plastic_work());
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryKind,
                         ::testing::Values(Case{CellKind::triangle, "element"}, Case{CellKind::triangle, "node"},
                                           Case{CellKind::quad2, "cell"}, Case{CellKind::crossed, "cell"},
                                           Case{CellKind::crossed, "element"}, Case{CellKind::tetrahedron, "element"},
                                           Case{CellKind::tetrahedron, "node"}, Case{CellKind::hex6, "cell"},
                                           Case{CellKind::hex24, "cell"}, Case{CellKind::hex24, "node"},
                                           Case{CellKind::wedge14, "cell"}, Case{CellKind::wedge14, "cell", "layers"}, Case{CellKind::pyramid8, "cell"},
                                           Case{CellKind::crossed, "cell", "layers"}, Case{CellKind::hex6, "cell", "layers"},
                                           Case{CellKind::crossed, "cell", "rubber"}, Case{CellKind::hex24, "cell", "rubber"},
                                           Case{CellKind::tetrahedron, "node", "rubber"}, Case{CellKind::quad1, "cell"},
                                           Case{CellKind::hex1, "cell"}, Case{CellKind::quad1, "cell", "layers"},
                                           Case{CellKind::hex1, "cell", "layers"}, Case{CellKind::quad1, "cell", "rubber"},
                                           Case{CellKind::hex1, "cell", "rubber"}));

// The bound holds where rubber is stretched and sheared far, where its tangent is not that at rest.
TEST(Hyperelastic, TheStableStepIsABoundWhereItIsStretchedFar) {
  for (const Vec3& stretch : {Vec3(2.5, 0.7, 1), Vec3(0.5, 1.6, 1.2), Vec3(1.5, 1.5, 0.45)}) {
    const BodyModel b = body_of(block_of(CellKind::hex6), material_of("rubber", false));
    const NodeField X = positions_of(b.mesh);
    Elements elements({b}, 3, X, {}, 1);
    NodeField x = X;
    for (Node& n : x) n = node(Vec3(stretch[0] * n[0] + 0.4 * n[1], stretch[1] * n[1], stretch[2] * n[2] - 0.3 * n[0]));
    const int n = static_cast<int>(x.size()) * 3;
    const NodeField zero(x.size(), Node::Zero());
    NodeField f(x.size());
    double dt = 0;
    int element = -1;
    elements.stable_step(x, zero, dt, element);
    // Power iteration on M^-1 K with K d by central differences of the forces.
    Eigen::VectorXd d = Eigen::VectorXd::Random(n);
    double omega2 = 0;
    for (int i = 0; i < 300; ++i) {
      d /= d.norm();
      NodeField plus = x, minus = x, fp(x.size()), fm(x.size());
      const double h = 1e-5;
      for (int k = 0; k < n; ++k) plus[k / 3][k % 3] += h * d[k], minus[k / 3][k % 3] -= h * d[k];
      elements.forces(plus, zero, 0, 0, fp);
      elements.forces(minus, zero, 0, 0, fm);
      Eigen::VectorXd next(n);
      for (int k = 0; k < n; ++k) next[k] = -(fp[k / 3][k % 3] - fm[k / 3][k % 3]) / (2 * h) / elements.nodal_mass()[k / 3];
      omega2 = d.dot(next);
      d = next;
    }
    EXPECT_LE(dt, 2 / std::sqrt(omega2)) << stretch.transpose();
    std::cout << "  bound / true limit = " << dt * std::sqrt(omega2) / 2 << "\n";
  }
}

// The classical method has forces only after a motion; they balance, and threads change nothing.
TEST(Classical, ForcesBalanceAndThreadsChangeNothing) {
  for (CellKind kind : {CellKind::crossed, CellKind::quad2, CellKind::hex6, CellKind::tetrahedron, CellKind::quad1, CellKind::hex1, CellKind::wedge14}) {
    const int D = shape_of(kind).dimension;
    const BodyModel b = body_of(block_of(kind, D == 2 ? 24 : 6), material_of("classical", true));
    const NodeField X = positions_of(b.mesh);
    NodeField x = X, v = X, f1(X.size()), f2(X.size());
    Elements one({b}, D, X, {}, 1), two({b}, D, X, {}, 2);
    shake(x, D, 0.004, 5);
    for (std::size_t n = 0; n < X.size(); ++n) v[n] = (x[n] - X[n]) / 1e-6;
    one.forces(x, v, 1e-6, 1e-6, f1);
    two.forces(x, v, 1e-6, 1e-6, f2);
    EXPECT_GT(one.plastic_work(), 0);
    EXPECT_GT(one.stored_energy(x), 0);
    Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
    double scale = 0;
    for (std::size_t n = 0; n < x.size(); ++n) {
      ASSERT_EQ(f1[n], f2[n]);
      sum += vec3(f1[n]);
      moment += vec3(x[n]).cross(vec3(f1[n]));
      scale += f1[n].norm();
    }
    EXPECT_GT(scale, 0);
    EXPECT_LT(sum.norm(), 1e-13 * scale);
    EXPECT_LT(moment.norm(), 1e-13 * scale);
  }
}

TEST(Kernels, EveryVectorWidthGivesTheSame) {
  for (CellKind kind : {CellKind::crossed, CellKind::hex24, CellKind::quad1, CellKind::hex1, CellKind::wedge14}) {
    const int D = shape_of(kind).dimension;
    for (const char* curve : {"perfect", "linear", "voce", "swift", "table"}) {
      const BodyModel b = body_of(block_of(kind, 3), aluminium_by(curve));
      expect_widths_agree([&](const char* name) {
        NodeField x = positions_of(b.mesh);
        Elements elements({b}, D, x, {}, 1, name);
        shake(x, D, 0.01, 7);
        NodeField f(x.size()), v(x.size(), Node::Zero());
        elements.forces(x, v, 0, 0, f);
        return f;
      });
    }
  }
}

TEST(Elements, AnInvertedElementIsNamed) {
  const BodyModel b = body_of(block_of(CellKind::crossed), aluminium());
  NodeField x = positions_of(b.mesh);
  Elements elements({b}, 2, x, {}, 1);
  x[4][1] += 3;
  NodeField f(x.size()), v(x.size(), Node::Zero());
  try {
    elements.forces(x, v, 0, 0, f);
    FAIL() << "an inverted element went unnoticed";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::mesh_error);
    EXPECT_NE(std::string(error.what()).find("body block"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace forming_sim
