// What elements remember goes over to others: of the same mesh, of a part of it, turned.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numeric>

#include "forming_sim/element/formed.h"
#include "support/bodies.h"

namespace forming_sim {
namespace {

struct Case { CellKind kind; const char* average; const char* law; bool ring = false; };
void PrintTo(const Case& c, std::ostream* out) { *out << shape_of(c.kind).name << ", pressure per " << c.average << ", " << c.law << (c.ring ? ", ring" : ""); }

MaterialConfig material_of(const std::string& law) {
  MaterialConfig m = aluminium(true);
  if (law == "layers") {
    m.layers = {{0.6, m.hardening}, {0.4, m.hardening}};
    m.layers[1].hardening->yield_stress = 300e6;
    m.hardening.reset();
  } else if (law == "rolled") {
    m.anisotropy.emplace();
    m.anisotropy->r0 = .6, m.anisotropy->r45 = 1.2, m.anisotropy->r90 = 1.9;
    m.anisotropy->rolling_direction = Vec3(1, 0, 0);
  } else if (law == "rubber") {
    m = rubber(100e6);
  } else if (law == "classical") {
    m.law = law;
  }
  return m;
}

/// A body that has flowed, and what it is made of.
struct Formed {
  BodyModel body;
  NodeField X, x;
  ElementOptions options;
  Elements elements;

  Formed(const Case& c, int n = 2)
      : body(body_of(block_of(c.kind, n), material_of(c.law), c.average)), X(positions_of(body.mesh)), x(X), options(options_of(c)), elements({body}, body.mesh.dimension, X, options, 1) {}
  static ElementOptions options_of(const Case& c) {
    ElementOptions options;
    options.axisymmetric = c.ring;
    return options;
  }
  NodeField forces() {
    NodeField f(x.size()), v(x.size(), Node::Zero());
    elements.forces(x, v, 0, 0, f);
    return f;
  }
  /// Nodes move a little, several times.
  void form(double size) {
    for (unsigned k = 0; k < 3; ++k) {
      NodeField v(x.size(), Node::Zero()), f = v;
      const NodeField before = x;
      shake(x, body.mesh.dimension, size, k);
      for (std::size_t i = 0; i < x.size(); ++i) {
        if (options.axisymmetric && X[i][0] == 0) x[i][0] = 0;
        v[i] = (x[i] - before[i]) / 1e-6;
      }
      elements.forces(x, v, 1e-6, 1e-6, f);
    }
  }
  BodyModel part() const {
    BodyModel part = body;
    part.formed = elements.memory_of(body, x);
    part.formed->reference = body.mesh.nodes;
    for (int i = 0; i < body.node_count; ++i) part.mesh.nodes[i] = vec3(x[i]);
    return part;
  }
};

/// Elements of a part and what they find where it stands.
struct Next {
  NodeField x;
  Elements elements;
  NodeField f;

  Next(const BodyModel& part, const ElementOptions& options, int threads = 2) : x(positions_of(part.mesh)), elements({part}, part.mesh.dimension, reference_of(part), options, threads), f(x.size()) {
    const NodeField v(x.size(), Node::Zero());
    elements.forces(x, v, 0, 0, f);
  }
  static NodeField reference_of(const BodyModel& part) {
    NodeField X;
    for (const Vec3& at : part.reference()) X.push_back(node(at));
    return X;
  }
};

double largest(const NodeField& f) {
  double most = 0;
  for (const Node& n : f) most = std::max(most, n.norm());
  return most;
}

class OfEveryKind : public ::testing::TestWithParam<Case> {};

TEST_P(OfEveryKind, GoesOnWhereItWas) {
  Formed first(GetParam());
  first.form(.03);
  const BodyModel part = first.part();  // before it is asked where it stands: what yields there flows on by a little
  const double flowed = first.elements.plastic_work();
  const NodeField f = first.forces();
  Next next(part, first.options);
  const double scale = largest(f);
  ASSERT_GT(scale, 0);
  for (std::size_t i = 0; i < f.size(); ++i) EXPECT_LT((f[i] - next.f[i]).norm(), 1e-11 * scale) << "node " << i;
  const double energy = first.elements.stored_energy(first.x);
  EXPECT_NEAR(next.elements.stored_energy(next.x), energy, 1e-11 * energy);
  const std::vector<double> p = first.elements.plastic_strain(), q = next.elements.plastic_strain();
  for (std::size_t e = 0; e < p.size(); ++e) EXPECT_NEAR(p[e], q[e], 1e-11);
  EXPECT_NEAR(next.elements.plastic_work(), first.elements.plastic_work() - flowed, 1e-10 * flowed) << "what the first run dissipated is not the next one's";
  // and goes on as it would have
  shake(first.x, first.body.mesh.dimension, .002, 9);
  if (first.options.axisymmetric)
    for (std::size_t i = 0; i < f.size(); ++i)
      if (first.X[i][0] == 0) first.x[i][0] = 0;
  NodeField v(f.size());
  for (std::size_t i = 0; i < f.size(); ++i) v[i] = (first.x[i] - next.x[i]) / 1e-6;
  next.x = first.x;
  NodeField a(f.size()), b(f.size());
  first.elements.forces(first.x, v, 1e-6, 1e-6, a);
  next.elements.forces(next.x, v, 1e-6, 1e-6, b);
  for (std::size_t i = 0; i < f.size(); ++i) EXPECT_LT((a[i] - b[i]).norm(), 1e-9 * largest(a)) << "node " << i;
}

TEST_P(OfEveryKind, TurnsWithItsStresses) {
  if (GetParam().ring) return;  // they stay beside their axis
  Formed first(GetParam());
  first.form(.03);
  BodyModel part = first.part();
  const NodeField f = first.forces();
  const bool flat = part.mesh.dimension == 2;
  const Mat3 R = Eigen::AngleAxisd(1.1, flat ? Vec3::UnitZ() : Vec3(1, 2, -2).normalized()).toRotationMatrix();
  for (Vec3& x : part.mesh.nodes) x = R * x + Vec3(3, -2, 0);
  turn(*part.formed, part.material.law, part.mesh.dimension, R);
  const Next next(part, first.options);
  for (std::size_t i = 0; i < f.size(); ++i) EXPECT_LT((R * vec3(f[i]) - vec3(next.f[i])).norm(), 1e-9 * largest(f)) << "node " << i;
}

TEST_P(OfEveryKind, WhatIsLeftOfItKeepsItsStresses) {
  // Evenly strained, so that also the points that a cut goes through have the same mean, and then with the part cut through.
  Formed first(GetParam(), 3);
  const int D = first.body.mesh.dimension;
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  F(0, 0) = 1.03, F(0, 1) = GetParam().ring ? 0 : .02, F(1, 0) = GetParam().ring ? 0 : .01;
  if (GetParam().ring) F(2, 2) = 1;
  if (D == 3) F(2, 1) = -.02;
  for (Node& n : first.x) n = node(Vec3(F * vec3(n)));
  NodeField v(first.x.size()), f(first.x.size());
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = (first.x[i] - first.X[i]) / 1e-6;
  first.elements.forces(first.x, v, 1e-6, 1e-6, f);
  const std::vector<Sym> before = first.elements.observe(first.x).stress;
  BodyModel part = first.part();
  TrimConfig cut;
  cut.choose = "plane";
  cut.point = Vec3(.55, 0, 0), cut.normal = Vec3(1, 0, 0);
  const Remainder left = find_remainder(part.mesh, {cut});
  ASSERT_LT(left.cells[0].size(), static_cast<std::size_t>(part.mesh.cells[0].count()));
  FormedMemory memory = remaining(*part.formed, left);
  part = body_of(remaining(part.mesh, left), part.material, part.pressure_average);
  part.formed = std::move(memory);
  const Next next(part, first.options);
  const std::vector<Sym> after = next.elements.observe(next.x).stress;
  const int parts = shape_of(GetParam().kind).simplices;
  for (std::size_t k = 0; k < left.cells[0].size(); ++k)
    for (int s = 0; s < parts; ++s)
      EXPECT_LT((after[k * parts + s] - before[left.cells[0][k] * parts + s]).norm(), 1e-9 * before[0].norm()) << "cell " << k << " part " << s;
}

TEST_P(OfEveryKind, UnevenlyStrainedIsCutWithoutAJump) {
  // Points at the edges of free simplices lose part of what they are the mean of, by as much as plastic strain differs from cell to cell; their
  // stresses stay.
  Formed first(GetParam(), 4);
  const int D = first.body.mesh.dimension;
  for (Node& n : first.x) n[0] += .15 * n[0] * n[0];
  if (D == 3)
    for (Node& n : first.x) n[1] += .05 * n[0] * n[1];
  NodeField v(first.x.size()), f(first.x.size());
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = (first.x[i] - first.X[i]) / 1e-6;
  first.elements.forces(first.x, v, 1e-6, 1e-6, f);
  const auto mises = [](const Sym& s) { return std::sqrt(.5 * (std::pow(s[0] - s[1], 2) + std::pow(s[1] - s[2], 2) + std::pow(s[2] - s[0], 2)) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5])); };
  const std::vector<Sym> before = first.elements.observe(first.x).stress;
  double most = 0;
  for (const Sym& s : before) most = std::max(most, mises(s));
  BodyModel part = first.part();
  TrimConfig cut;
  cut.choose = "plane";
  cut.point = Vec3(.55, 0, 0), cut.normal = Vec3(1, 0, 0);
  const Remainder left = find_remainder(part.mesh, {cut});
  FormedMemory memory = remaining(*part.formed, left);
  part = body_of(remaining(part.mesh, left), part.material, part.pressure_average);
  part.formed = std::move(memory);
  const Next next(part, first.options);
  EXPECT_LE(next.elements.plastic_work(), 3e-3 * first.elements.plastic_work()) << "next to nothing flows by being cut";
  for (const Sym& s : next.elements.observe(next.x).stress) EXPECT_LT(mises(s), (std::string(GetParam().law) == "rubber" ? 1.5 : 1.001) * most);
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const char* law : {"one layer", "layers", "rolled", "rubber", "classical"}) {
    const bool classical = std::string(law) == "classical";
    for (CellKind kind : {CellKind::triangle, CellKind::quad2, CellKind::crossed, CellKind::tetrahedron, CellKind::hex6, CellKind::hex24, CellKind::quad1, CellKind::hex1, CellKind::wedge14, CellKind::pyramid8}) {
      all.push_back({kind, "cell", law});
      if (!classical && !is_one_point(kind)) all.push_back({kind, "node", law});
    }
    for (CellKind kind : {CellKind::triangle, CellKind::crossed, CellKind::quad1}) all.push_back({kind, "cell", law, true});
  }
  return all;
}
INSTANTIATE_TEST_SUITE_P(Formed, OfEveryKind, ::testing::ValuesIn(cases()));

}  // namespace
}  // namespace forming_sim
