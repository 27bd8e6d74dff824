// One-point cells are the same however they lie: a prism is its section, a numbering and a turn in
// space change nothing, and a plate resists alike in every direction of its plane.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "forming_sim/element/one_point.h"
#include "support/moved.h"

namespace forming_sim {
namespace {

/// Corners of the unit cell by the signs of their coordinates, in the order of mesh.h.
Vec3 unit_corner(int a) { return Vec3(kCornerSides[a][0] > 0, kCornerSides[a][1] > 0, kCornerSides[a][2] > 0); }

/// The hexahedron of eight corners, numbered anew: its corner a is number order[a].
Mesh hexahedron(const std::function<Vec3(const Vec3&)>& place, const std::vector<int>& order = {0, 1, 2, 3, 4, 5, 6, 7}) {
  Mesh mesh = block_of(CellKind::hex1, 1);
  for (int a = 0; a < 8; ++a) mesh.nodes[mesh.cells[0].nodes[a]] = place(unit_corner(order[a]));
  find_surface(mesh);
  check_volumes(mesh);
  return mesh;
}

/// The numberings of a cube's corners that turn it, 24 of them.
std::vector<std::vector<int>> numberings() {
  std::vector<std::vector<int>> all;
  for (int x = 0; x < 6; ++x)
    for (int y = 0; y < 6; ++y) {
      if (x / 2 == y / 2) continue;
      Mat3 R;
      R.col(0) = (x % 2 ? -1 : 1) * Vec3::Unit(x / 2);
      R.col(1) = (y % 2 ? -1 : 1) * Vec3::Unit(y / 2);
      R.col(2) = R.col(0).cross(R.col(1));
      std::vector<int> order;
      for (int a = 0; a < 8; ++a) {
        const Vec3 at = R * (2 * unit_corner(a) - Vec3::Ones());
        for (int b = 0; b < 8; ++b)
          if ((2 * unit_corner(b) - Vec3::Ones() - at).norm() < 1e-9) order.push_back(b);
      }
      all.push_back(order);
    }
  return all;
}

/// Forces of a hexahedron on its corners, in the order of the unit cell.
std::vector<Vec3> corner_forces(const Moved& body, const std::vector<int>& order) {
  std::vector<Vec3> f(8);
  for (int a = 0; a < 8; ++a) f[order[a]] = vec3(body.f[body.body.mesh.cells[0].nodes[a]]);
  return f;
}

/// A skewed and tapered section, unit square to m, and where its corners go: bent about both axes, stretched and sheared.
Vec3 section(const Vec3& s) { return Vec3(1.5 * s.x() + 0.5 * s.y(), 0.3 * s.x() + (1 - 0.2 * s.x()) * s.y(), 0); }
Vec3 strained(const Vec3& X, double s) {
  const double x = X.x() - 1, y = X.y() - 0.6;
  return Vec3(X.x() + s * (0.03 * x + 0.02 * y - 0.04 * x * y), X.y() + s * (0.01 * x - 0.02 * y + 0.03 * x * y), X.z());
}

// In plane strain a hexahedron over a quadrilateral carries what the quadrilateral carries, elastic, yielding and unloaded,
// however it is numbered. Coordinates flow one after the other in the order of the numbering, which makes a difference that falls
// with the step; in the order of the section the forces are the same to rounding.
TEST(OnePointOrientation, APrismIsItsSection) {
  const double width = 0.7;
  for (const MaterialConfig& material : {aluminium(), aluminium(true), perfectly_plastic()}) {
    Mesh flat = block_of(CellKind::quad1, 1);
    for (int a = 0; a < 4; ++a) flat.nodes[flat.cells[0].nodes[a]] = section(unit_corner(a));
    check_volumes(flat);
    for (const std::vector<int>& order : numberings()) {
      Moved prism(hexahedron([&](const Vec3& s) { return Vec3(section(s) + width * s.z() * Vec3::UnitZ()); }, order), material);
      Moved quadrilateral(flat, material);
      // the coordinate along which the second coordinate of the section lies comes before that of the first one
      const auto along = [&](int m) {
        const int away = m == 0 ? 1 : m == 1 ? 3 : 4;  // the corner next to corner 0 along coordinate m
        const Vec3 edge = unit_corner(order[away]) - unit_corner(order[0]);
        return std::abs(edge.x()) > 0.5 ? 0 : std::abs(edge.y()) > 0.5 ? 1 : 2;
      };
      int place[3];
      for (int m = 0; m < 3; ++m) place[along(m)] = m;
      const double allowed = place[1] < place[0] ? 1e-10 : 4e-3;
      double worst = 0, most = 0;
      const int steps = 1600;
      for (int step = 1; step <= 1.5 * steps; ++step) {
        const double s = step <= steps ? double(step) / steps : 1 - 1.2 * (step - steps) / steps;
        quadrilateral.place([&](const Vec3& X) { return strained(X, s); });
        prism.place([&](const Vec3& X) { return strained(X, s); });
        quadrilateral.forces();
        prism.forces();
        const std::vector<Vec3> f = corner_forces(prism, order);
        most = std::max(most, largest(quadrilateral.f));
        for (int a = 0; a < 4; ++a) {
          Vec3 sum = (f[a] + f[a + 4]) / width - vec3(quadrilateral.f[quadrilateral.body.mesh.cells[0].nodes[a]]);
          sum.z() = 0;  // the wall that keeps the width
          worst = std::max(worst, sum.norm());
        }
      }
      EXPECT_LT(worst, allowed * most) << "coordinates along " << along(0) << along(1) << along(2);
      EXPECT_NEAR(prism.elements.plastic_work() / width, quadrilateral.elements.plastic_work(), allowed * quadrilateral.elements.plastic_work());
    }
  }
}

// Numbered in any way and turned in space, a skewed hexahedron that yields carries the same forces, turned.
TEST(OnePointOrientation, NumberingAndTurnDoNotMatter) {
  const auto place = [](const Vec3& s) { return Vec3(2 * s.x() + 0.4 * s.y(), s.y() + 0.2 * s.z(), 0.5 * s.z() * (1 + 0.2 * s.x()) + 0.1 * s.x()); };
  const auto strain = [](const Vec3& X, double s) {
    const double x = X.x() - 1.2, y = X.y() - 0.6, z = X.z() - 0.3;
    return Vec3(X + s * Vec3(0.02 * x - 0.05 * x * z + 0.01 * y * z, -0.01 * y + 0.02 * z + 0.04 * y * z, 0.02 * x * y - 0.01 * z + 0.02 * x * z));
  };
  const auto run = [&](const std::vector<int>& order, const Mat3& R) {
    Moved body(hexahedron([&](const Vec3& s) { return Vec3(R * place(s)); }, order), aluminium(true));
    const int steps = 1600;
    for (int step = 1; step <= steps; ++step) {
      body.place([&](const Vec3& X) { return Vec3(R * strain(R.transpose() * X, double(step) / steps)); });
      body.forces();
    }
    EXPECT_GT(body.elements.plastic_work(), 2 * body.energy());
    std::vector<Vec3> f = corner_forces(body, order);
    for (Vec3& force : f) force = R.transpose() * force;
    return f;
  };
  const std::vector<std::vector<int>> orders = numberings();
  const std::vector<Vec3> first = run(orders[0], Mat3::Identity());
  double most = 0;
  for (const Vec3& f : first) most = std::max(most, f.norm());
  const auto expect_same = [&](const std::vector<Vec3>& f, double allowed) {
    for (int a = 0; a < 8; ++a) EXPECT_LT((f[a] - first[a]).norm(), allowed * most);
  };
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0.3, -2, 1), Vec3(1, 1, 1)})
    expect_same(run(orders[0], Eigen::AngleAxisd(2.2, axis.normalized()).toRotationMatrix()), 1e-10);
  for (const std::vector<int>& order : orders) expect_same(run(order, Mat3::Identity()), 3e-3);
}

/// A plate of one cell, 1 m thick, its edges a and b at an angle, that is bent and twisted to the curvatures K: u = -z grad w,
/// w = X . K X/2, of which the corners' deflection is what varies across the cell.
struct Plate {
  Vec3 a, b;
  Moved body;
  Plate(double length, double width, double angle, double turn, const MaterialConfig& material)
      : a(length * std::cos(turn), length * std::sin(turn), 0), b(width * std::cos(turn + angle), width * std::sin(turn + angle), 0),
        body(hexahedron([&](const Vec3& s) { return Vec3((s.x() - 0.5) * a + (s.y() - 0.5) * b + (s.z() - 0.5) * Vec3::UnitZ()); }), material) {}
  double area() const { return a.cross(b).z(); }
  void bend(const Mat3& K) {
    body.place([&](const Vec3& X) {
      Vec3 flat = X;
      flat.z() = 0;
      return Vec3(X - X.z() * (K * flat) + 0.5 * flat.dot(K * flat) * Vec3::UnitZ());
    });
    body.forces();
  }
};

Mat3 curvatures(double xx, double yy, double xy) {
  Mat3 K = Mat3::Zero();
  K(0, 0) = xx;
  K(1, 1) = yy;
  K(0, 1) = K(1, 0) = xy;
  return K;
}

// The energy of Kirchhoff's plate, D/2 (xx^2 + yy^2 + 2 nu xx yy + 2 (1-nu) xy^2), whatever the plan of the cell: right-angled or
// a rhomboid, thin or compact. Shear across the thickness, which such a bending does not have, would weigh as (length/thickness)^2.
TEST(OnePointOrientation, APlateOfAnyPlanIsElasticAsAPlate) {
  const MaterialConfig m = aluminium();
  const double nu = m.poissons_ratio, D = m.youngs_modulus / (12 * (1 - nu * nu)), k = 1e-7;
  for (double length : {1.0, 4.0, 30.0})
    for (double angle : {90.0, 60.0, 135.0})
      for (double turn : {0.0, 0.4})
        for (const Vec3& c : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0), Vec3(0, 0, 1), Vec3(0.5, 0.5, 0.5)}) {
          Plate plate(length, 0.8 * length, angle * M_PI / 180, turn, m);
          plate.bend(curvatures(k * c[0], k * c[1], k * c[2]));
          const double exact = D / 2 * k * k * (c[0] * c[0] + c[1] * c[1] + 2 * nu * c[0] * c[1] + 2 * (1 - nu) * c[2] * c[2]) * plate.area();
          EXPECT_NEAR(plate.body.energy(), exact, 1e-3 * exact) << "length " << length << ", angle " << angle << ", turned by " << turn << ", curvatures " << c.transpose();
        }
}

// Bent on beyond yield, a perfectly plastic plate takes the work of its plastic moments, (h^2/4) Y times the equivalent rate
// 2/sqrt 3 sqrt(xx^2 + yy^2 + xx yy + xy^2) of von Mises: along, across and askew, both ways at once, and in twist.
TEST(OnePointOrientation, APlateOfAnyPlanYieldsAsAPlate) {
  const double yield = 192.1e6, k = 0.04;
  for (double length : {1.0, 4.0})
    for (double angle : {90.0, 60.0})
      for (const Vec3& c : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.5, 0.5, 0.5), Vec3(1, 1, 0), Vec3(1, -1, 0), Vec3(0, 0, 1)}) {
        Plate plate(length, 0.8 * length, angle * M_PI / 180, 0, perfectly_plastic());
        double before = 0;
        const int steps = 400;
        for (int step = 1; step <= steps; ++step) {
          if (step == steps / 2 + 1) before = plate.body.elements.plastic_work() + plate.body.energy();
          const double s = k * step / steps;
          plate.bend(curvatures(s * c[0], s * c[1], s * c[2]));
        }
        const double work = plate.body.elements.plastic_work() + plate.body.energy() - before;
        const double rate = 2 / std::sqrt(3.) * std::sqrt(c[0] * c[0] + c[1] * c[1] + c[0] * c[1] + c[2] * c[2]);
        const double exact = yield / 4 * rate * 0.5 * k * plate.area();
        EXPECT_NEAR(work, exact, 0.01 * exact) << "length " << length << ", angle " << angle << ", curvatures " << c.transpose();
      }
}

}  // namespace
}  // namespace forming_sim
