// Pressure and gravity: gradient of p V, no net force on a closed surface.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "forming_sim/config/fault.h"
#include "forming_sim/loads/gravity.h"
#include "forming_sim/loads/pressure.h"

namespace forming_sim {
namespace {

/// A closed surface: counter-clockwise polygon (2D), also turned about the y axis, or
/// outward octahedron or hexahedron of bilinear faces (3D), distorted.
struct Closed {
  int dimension;
  NodeField x;
  std::vector<Face> faces;
  bool axisymmetric = false;

  void add(std::array<int, 4> nodes) { faces.push_back({nodes, static_cast<int>(std::count_if(nodes.begin(), nodes.end(), [](int n) { return n >= 0; }))}); }
  double volume(const NodeField& at) const {
    double sum = 0;
    for (const Face& facet : faces) {
      const Vec3 a = vec3(at[facet.nodes[0]]), b = vec3(at[facet.nodes[1]]);
      if (facet.corners == 4) sum += of_bilinear(at, facet);
      else if (axisymmetric) sum += M_PI / 3 * (b.y() - a.y()) * (a.x() * a.x() + a.x() * b.x() + b.x() * b.x());
      else sum += dimension == 2 ? 0.5 * (a.x() * b.y() - b.x() * a.y())
                            : a.cross(b).dot(vec3(at[facet.nodes[2]])) / 6;
    }
    return sum;
  }
  /// 1/3 of the integral of x . n over it, by four points of Gauss, which are exact.
  static double of_bilinear(const NodeField& at, const Face& face) {
    double sum = 0;
    const double one = 0.5 - 0.5 / std::sqrt(3), two = 1 - one;
    const auto corner = [&](int k) { return vec3(at[face.nodes[k]]); };
    for (double s : {one, two})
      for (double t : {one, two}) {
        const Vec3 x = (1 - t) * ((1 - s) * corner(0) + s * corner(1)) + t * ((1 - s) * corner(3) + s * corner(2));
        const Vec3 along_s = (1 - t) * (corner(1) - corner(0)) + t * (corner(2) - corner(3)), along_t = (1 - s) * (corner(3) - corner(0)) + s * (corner(2) - corner(1));
        sum += x.dot(along_s.cross(along_t)) / 12;
      }
    return sum;
  }
};

Closed polygon() {
  Closed shape{2, {}, {}, false};
  for (int k = 0; k < 7; ++k) {
    const double angle = 2 * 3.14159265358979 * k / 7, radius = 1 + 0.3 * std::sin(5. * k);
    shape.x.push_back(Node(2 + radius * std::cos(angle), radius * std::sin(angle), 0, 0));
    shape.add({k, (k + 1) % 7, -1, -1});
  }
  return shape;
}

Closed octahedron() {
  Closed shape{3, {}, {}, false};
  shape.x = {Node(1.2, .1, 0, 0), Node(-.9, 0, .2, 0), Node(0, 1.4, .1, 0),
             Node(.2, -1, 0, 0),  Node(0, .3, .8, 0),  Node(.1, 0, -1.1, 0)};
  const int corners[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                             {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (const auto& c : corners) shape.add({c[0], c[1], c[2], -1});
  return shape;
}

Closed hexahedron() {
  Closed shape{3, {}, {}, false};
  shape.x = {Node(0, 0, .1, 0),   Node(1.1, -.2, 0, 0), Node(1, .9, .2, 0),   Node(-.1, 1, 0, 0),
             Node(.2, .1, 1, 0), Node(.9, 0, 1.3, 0),  Node(1.2, 1.1, .8, 0), Node(0, .8, 1.1, 0)};
  for (const auto& nodes : {std::array<int, 4>{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}) shape.add(nodes);
  return shape;
}

Closed ring() {
  Closed shape = polygon();
  shape.axisymmetric = true;
  return shape;
}

/// Half a polygon, from the axis to the axis: a ball.
Closed ball() {
  Closed shape{2, {}, {}, true};
  for (int k = 0; k <= 6; ++k) {
    const double angle = M_PI * (k / 6. - 0.5), radius = 1 + 0.2 * std::sin(5. * k);
    shape.x.push_back(Node(k % 6 == 0 ? 0 : radius * std::cos(angle), radius * std::sin(angle), 0, 0));
    if (k < 6) shape.add({k, k + 1, -1, -1});
  }
  return shape;
}

PressureSet constant(const Closed& shape, double p) {
  return PressureSet({{ScalarProfile({0}, {p}), shape.faces}}, shape.axisymmetric);
}

class ClosedSurface : public ::testing::TestWithParam<Closed> {};

TEST_P(ClosedSurface, force_is_minus_the_gradient_of_p_times_volume) {
  const Closed& shape = GetParam();
  ASSERT_GT(shape.volume(shape.x), 0);
  const double p = 3, h = 1e-4;
  NodeField f(shape.x.size(), Node::Zero());
  constant(shape, p).add(0, shape.x, f);
  for (size_t i = 0; i < shape.x.size(); ++i)
    for (int k = 0; k < shape.dimension; ++k) {
      NodeField more = shape.x, less = shape.x;
      more[i][k] += h;
      less[i][k] -= h;
      // The volume is linear in each single coordinate, turned quadratic: the difference is exact up to rounding.
      const double gradient = p * (shape.volume(more) - shape.volume(less)) / (2 * h);
      // Inside pushes out: a pressure from outside pushes against the growth of the volume.
      EXPECT_NEAR(f[i][k], -gradient, 1e-10 * (1 + std::abs(gradient))) << "node " << i << " axis " << k;
    }
}

TEST_P(ClosedSurface, has_no_net_force_and_no_net_moment) {
  const Closed& shape = GetParam();
  NodeField f(shape.x.size(), Node::Zero());
  constant(shape, 3).add(0, shape.x, f);
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  for (size_t i = 0; i < f.size(); ++i) {
    EXPECT_GT(f[i].norm(), 0.05);
    force += vec3(f[i]);
    moment += vec3(shape.x[i]).cross(vec3(f[i]));
  }
  if (shape.axisymmetric) {  // around the circle what is radial cancels, and so do the moments
    EXPECT_LT(std::abs(force.y()), 1e-12);
    return;
  }
  EXPECT_LT(force.norm(), 1e-14);
  EXPECT_LT(moment.norm(), 1e-14);
}

std::string name_of(const ::testing::TestParamInfo<Closed>& info) {
  const char* names[] = {"polygon", "ring", "ball", "octahedron", "hexahedron"};
  return names[info.index];
}

INSTANTIATE_TEST_SUITE_P(Shapes, ClosedSurface, ::testing::Values(polygon(), ring(), ball(), octahedron(), hexahedron()), name_of);

TEST(PressureSet, follows_its_pulse) {
  const PressureSet pulse({{ScalarProfile({0, 1, 2}, {0, 10, 0}), polygon().faces}});
  const NodeField x = polygon().x;
  NodeField none(7, Node::Zero()), half(7, Node::Zero()), full(7, Node::Zero());
  pulse.add(2, x, none);
  pulse.add(0.5, x, half);
  pulse.add(1, x, full);
  for (int i = 0; i < 7; ++i) {
    EXPECT_EQ(none[i], Node(Node::Zero()));
    EXPECT_GT(full[i].norm(), 1);
    EXPECT_LT((2 * half[i] - full[i]).norm(), 1e-12);
  }
}

TEST(PressureSet, takes_the_faces_whose_nodes_are_all_in_the_set) {
  Mesh mesh;
  mesh.dimension = 2;
  for (const Face& side : polygon().faces) mesh.surface.push_back({{side.nodes[0], side.nodes[1], -1}, -1});
  mesh.sets["arc"] = {2, 3, 4};
  mesh.sets["dots"] = {0, 2};
  PressureConfig config;
  config.set = "arc";
  config.times = {0};
  config.values = {1};
  const ResolvedPressure resolved = resolve(config, "sheet", mesh, 100);
  ASSERT_EQ(resolved.faces.size(), 2u);
  EXPECT_EQ(resolved.faces[0].nodes[0], 102);
  EXPECT_EQ(resolved.faces[1].nodes[1], 104);
  EXPECT_EQ(resolved.faces[0].nodes[2], -1);
  for (const char* name : {"dots", "absent"}) {
    config.set = name;
    EXPECT_THROW(resolve(config, "sheet", mesh, 0), Error) << name;
  }
  config.set = "arc";
  config.values = {1, 2};
  EXPECT_THROW(resolve(config, "sheet", mesh, 0), Error);
}

TEST(Gravity, weighs_every_node) {
  const Vec3 g(0, 0, -9.81);
  const std::vector<double> mass{1, 4};
  NodeField f(2, Node(1, 0, 0, 0));
  add_gravity(g, mass, f);
  EXPECT_EQ(f[0], Node(1, 0, -9.81, 0));
  EXPECT_EQ(f[1], Node(1, 0, 4 * -9.81, 0));
}

}  // namespace
}  // namespace forming_sim
