// Bodies of every kind of cell whose yield depends on the direction: r values, work, plastic hinges, and without anisotropy the
// same as without.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "forming_sim/element/one_point.h"
#include "support/moved.h"

namespace forming_sim {
namespace {

MaterialConfig rolled(const MaterialConfig& of, double r0, double r45, double r90, const Vec3& rolling = Vec3::Zero(), const Vec3& normal = Vec3::Zero()) {
  MaterialConfig m = of;
  m.anisotropy.emplace();
  m.anisotropy->r0 = r0, m.anisotropy->r45 = r45, m.anisotropy->r90 = r90;
  m.anisotropy->rolling_direction = rolling;
  m.anisotropy->sheet_normal = normal;
  return m;
}

constexpr CellKind kKinds[] = {CellKind::triangle, CellKind::quad2, CellKind::crossed, CellKind::quad1, CellKind::tetrahedron, CellKind::hex6, CellKind::hex24, CellKind::hex1, CellKind::wedge14};

NodeField shaken_end(const Moved& body, int dimension) {
  NodeField end = body.X;
  shake(end, dimension, 0.03, 11);
  return end;
}
NodeField between(const NodeField& X, const NodeField& end, double s) {
  NodeField x = X;
  for (std::size_t n = 0; n < end.size(); ++n) x[n] += s * (end[n] - X[n]);
  return x;
}

TEST(Anisotropy, WorkIsStoredOrDissipated) {
  for (CellKind kind : kKinds) {
    const int D = shape_of(kind).dimension;
    Moved body(block_of(kind, 2), rolled(aluminium(true), 0.6, 1.7, 2.2));
    const NodeField end = shaken_end(body, D);
    const double work = body.work_along(8000, [&](double t) { return between(body.X, end, 1 - std::abs(2 * t - 1)); });
    EXPECT_GT(body.elements.plastic_work(), 0.5 * work);
    EXPECT_NEAR(body.energy() + body.elements.plastic_work(), work, 2e-3 * work) << shape_of(kind).name;
  }
}

// Where no direction differs the forces are those of von Mises: cells that yield in all their shapes.
TEST(Anisotropy, WithoutItABodyIsTheIsotropicOne) {
  for (CellKind kind : kKinds) {
    const int D = shape_of(kind).dimension;
    Moved plain(block_of(kind, 2), aluminium(true)), same(block_of(kind, 2), rolled(aluminium(true), 1, 1, 1));
    const NodeField end = shaken_end(plain, D);
    for (int step = 1; step <= 2000; ++step) {
      plain.x = same.x = between(plain.X, end, step / 2000.);
      plain.forces();
      same.forces();
    }
    double difference = 0;
    for (std::size_t n = 0; n < end.size(); ++n) difference = std::max(difference, (plain.f[n] - same.f[n]).norm());
    EXPECT_LT(difference, 2e-3 * largest(plain.f)) << shape_of(kind).name;
    EXPECT_NEAR(same.elements.plastic_work(), plain.elements.plastic_work(), 1e-3 * plain.elements.plastic_work()) << shape_of(kind).name;
  }
}

// In long steps the stress of the trial and of the end point in different directions. A shape that varies across the cell by next to
// nothing then lies on one side of the edge of the yield surface in the one and on the other in the other; it takes no part in the flow.
TEST(Anisotropy, TrembleOfNodesChangesNoWork) {
  for (CellKind kind : {CellKind::quad1, CellKind::hex1}) {
    const auto pressed = [&](double tremble) {
      Moved body(cell_of(kind, Vec3(1, 1, 1)), rolled(perfectly_plastic(), 1.7, 1.9, 0.41));
      std::mt19937 random(3);
      std::uniform_real_distribution<double> even(-tremble, tremble);
      const double work = body.work_along(166, [&](double t) {
        NodeField x = body.X;
        for (Node& n : x) {
          const double a = std::exp(0.05 * t);
          n = node(Vec3(a * n[0], shape_of(kind).dimension == 2 ? n[1] / a : a * n[1], n[2] / (a * a)));
          for (int i = 0; i < shape_of(kind).dimension; ++i) n[i] += even(random);
        }
        return x;
      });
      EXPECT_NEAR(body.energy() + body.elements.plastic_work(), work, 1e-3 * work) << shape_of(kind).name << ", tremble " << tremble;
      return work;
    };
    const double still = pressed(0);
    EXPECT_NEAR(pressed(1e-6), still, 1e-4 * still) << shape_of(kind).name;
    EXPECT_NEAR(pressed(1e-5), still, 1e-3 * still) << shape_of(kind).name;
  }
}

// In plane strain, r the same all around, the hinge bears (1 + r)/sqrt(1 + 2 r) of the yield stress: 2/sqrt 3 of it for r = 1.
TEST(Anisotropy, ABentCellReachesThePlasticMoment) {
  for (CellKind kind : {CellKind::quad1, CellKind::hex1})
    for (double r : {0.5, 2.0}) {
      const bool flat = kind == CellKind::quad1;
      const int t = flat ? 1 : 2;
      Moved body(cell_of(kind, flat ? Vec3(2, 1, 0) : Vec3(2, 1.5, 1)), rolled(perfectly_plastic(), r, r, r));
      double moment = 0;
      for (int step = 1; step <= 400; ++step) moment = body.bend(0.05 * step / 400, t);
      const double exact = (1 + r) / std::sqrt(1 + 2 * r) * 192.1e6 / 4 * (flat ? 1 : 1.5);
      EXPECT_NEAR(std::abs(moment), exact, 0.01 * exact) << shape_of(kind).name << ", r " << r;
    }
}

// Stretched across the rolling direction with free sides, by forces that vanish: the width shrinks r90 times as much as the thickness.
TEST(Anisotropy, ABlockShrinksByItsRValue) {
  const double r0 = 0.7, r45 = 1.3, r90 = 1.8;
  for (CellKind kind : {CellKind::tetrahedron, CellKind::hex6, CellKind::hex24, CellKind::hex1}) {
    Moved body(block_of(kind, 1), rolled(perfectly_plastic(), r0, r45, r90, Vec3::UnitY()));
    double width = 1, thickness = 1, stress = 0;
    const auto forces_at = [&](double a, double b, double c) {  // on the sides across y and z
      body.place([&](const Vec3& X) { return Vec3(a * X.x(), b * X.y(), c * X.z()); });
      body.forces();
      Vec3 sides = Vec3::Zero();
      for (std::size_t n = 0; n < body.X.size(); ++n)
        for (int i = 0; i < 3; ++i)
          if (body.X[n][i] > (i == 0 ? 0.99 : 0.79)) sides[i] -= body.f[n][i];
      return sides;
    };
    const double E = 70.5e9, nu = 0.34, area = 0.8;  // of a side
    for (int step = 1; step <= 2000; ++step) {
      const double stretch = 1 + 0.02 * step / 2000;
      for (int round = 0; round < 8; ++round) {  // elastic answer to what is left, a part of it: it stays on the surface
        const Vec3 sides = forces_at(stretch, width, thickness) / area;
        width -= 0.4 * (sides.y() - nu * sides.z()) / E;
        thickness -= 0.4 * (sides.z() - nu * sides.y()) / E;
        stress = sides.x() * area / (0.64 * width * thickness);
      }
    }
    const double exact = 192.1e6 * std::sqrt(r90 * (1 + r0) / (r0 * (1 + r90)));
    EXPECT_NEAR(stress, exact, 5e-3 * exact) << shape_of(kind).name;
    EXPECT_NEAR((std::log(width) + nu * stress / E) / (std::log(thickness) + nu * stress / E), r90, 0.01 * r90) << shape_of(kind).name;
  }
}

}  // namespace
}  // namespace forming_sim
