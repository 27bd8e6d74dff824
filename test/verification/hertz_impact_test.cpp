// An elastic sphere hits a rigid plane: Hertz' impact.
//
// Aluminium, radius 10 mm, 1 m/s: approach 18.020 um, peak force 784.54 N, contact
// 53.037 us. The cells shrink towards the point of contact: the section of the sphere is mapped
// onto itself by z -> (z + a)/(1 + a z), which keeps shapes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "forming_sim/mesh/measure.h"
#include "forming_sim/mesh/split.h"
#include "support/sections.h"

namespace forming_sim {
namespace {

constexpr double kRadius = 10e-3, kApproach = 18.020e-6, kForce = 784.54, kDuration = 53.037e-6, kAbove = 0.5e-6;  // the last: height at the start

/// Half a disc as complex numbers, the real axis along y: a half square of cells x 2 cells
/// in the middle, and `cells` layers from there to the rim. At the contact the cells
/// are `gather` times smaller than in the middle.
Mesh sphere(int cells, double gather, double above) {
  using Point = std::complex<double>;
  const int n = cells, rim = 4 * n;
  std::vector<Point> points;
  std::vector<Quad> quads;
  const double half = 0.5;
  const auto rounded = [&](double u, double v) { return half * Point(v * std::sqrt(1 - 0.25 * u * u), u * std::sqrt(1 - 0.25 * v * v)); };
  const auto inner = [&](int i, int j) { return i + (n + 1) * j; };
  for (int j = 0; j <= 2 * n; ++j)
    for (int i = 0; i <= n; ++i) points.push_back(rounded(double(i) / n, double(j) / n - 1));
  for (int j = 0; j < 2 * n; ++j)
    for (int i = 0; i < n; ++i) quads.push_back({inner(i, j), inner(i + 1, j), inner(i + 1, j + 1), inner(i, j + 1)});
  // Around the half square: along its lower side, up, and back.
  std::vector<int> border;
  for (int k = 0; k <= rim; ++k) border.push_back(k <= n ? inner(k, 0) : k <= 3 * n ? inner(n, k - n) : inner(rim - k, 2 * n));
  std::vector<int> before = border;
  for (int layer = 1; layer <= n; ++layer) {
    std::vector<int> now;
    for (int k = 0; k <= rim; ++k) {
      const Point from = points[border[k]];
      const Point to = std::polar(1.0, M_PI * (1 - double(k) / rim));
      const double s = double(layer) / n;
      now.push_back(static_cast<int>(points.size()));
      points.push_back((1 - s) * from + s * to);
    }
    for (int k = 0; k < rim; ++k) quads.push_back({before[k], now[k], now[k + 1], before[k + 1]});
    before = now;
  }
  const double a = (gather - 1) / (gather + 1);
  Mesh mesh;
  mesh.dimension = 2;
  for (const Point& p : points) {
    const Point z = (p - a) / (1.0 - a * p);
    mesh.nodes.emplace_back(kRadius * z.imag(), kRadius * (1 + z.real()) + above, 0);
  }
  split_quads(mesh, quads, CellKind::crossed);
  find_surface(mesh);
  check_volumes(mesh);
  close_at_axis(mesh);
  return mesh;
}

/// Errors against Hertz: approach ~ v^(4/5), force ~ v^(6/5), duration ~ v^(-1/5); and the
/// speed after over that before.
struct Impact {
  double approach, force, duration, rebound;
  double worst() const { return std::max({std::abs(approach), std::abs(force), std::abs(duration)}); }
};

Impact impact(int cells, double gather, double speed) {
  MaterialConfig m;
  const Mesh mesh = sphere(cells, gather, kAbove);
  double volume = 0;
  for (const auto& e : mesh.simplices())
    volume += 2 * M_PI / 3 * (mesh.nodes[e[0]].x() + mesh.nodes[e[1]].x() + mesh.nodes[e[2]].x()) * signed_volume(mesh.nodes, e, 2);
  // Chords make the sphere a little lighter, which the density makes up for.
  const double exact = 4 * M_PI / 3 * std::pow(kRadius, 3);
  EXPECT_NEAR(volume, exact, 0.08 * exact);
  m.density = 2700 * exact / volume;
  m.youngs_modulus = 70e9;
  m.poissons_ratio = 0.3;
  OneBody run = one_ring(mesh, m, kAbove / speed + 1.1 * kDuration * std::pow(speed, -0.2));
  run.plan.bodies[0].initial_velocity = Vec3(0, -speed, 0);
  ToolModel plane;
  plane.name = "plane";
  plane.normal = Vec3::UnitY();
  plane.mesh.dimension = 2;
  run.model.tools.push_back(plane);
  run.plan.contact.layer = 0.05e-6;
  auto sim = run.start(2);
  const std::vector<double>& mass = sim->nodal_mass();
  double total = 0;
  for (double each : mass) total += each;
  const auto height = [&] {
    double sum = 0;
    for (std::size_t i = 0; i < mass.size(); ++i) sum += mass[i] * sim->positions()[i][1];
    return sum / total;
  };
  const double start = height(), end_of_flight = start - kAbove;
  Impact found{0, 0, 0, 0};
  double before = 0, since = 0, first = -1, last = 0;
  while (sim->step()) {
    if (sim->contact_status().active_pairs > 0) {
      if (first < 0) first = sim->time();
      last = sim->time();
    }
    if (sim->steps() % 10 == 0) found.approach = std::max(found.approach, end_of_flight - height());
    if (sim->time() - since < 0.05 * kDuration) continue;  // nodes that come into contact one by one even out
    const double impulse = sim->tools()[0].impulse.y();
    found.force = std::max(found.force, -(impulse - before) / (sim->time() - since));
    before = impulse;
    since = sim->time();
  }
  found.duration = last - first;
  double momentum = 0;
  for (std::size_t i = 0; i < mass.size(); ++i) momentum += mass[i] * sim->velocities()[i][1];
  found.rebound = momentum / (total * speed);
  EXPECT_EQ(sim->contact_status().crossings, 0);
  EXPECT_LT(sim->balance_error(), 1e-3);
  found.approach = found.approach / (kApproach * std::pow(speed, 0.8)) - 1;
  found.force = found.force / (kForce * std::pow(speed, 1.2)) - 1;
  found.duration = found.duration / (kDuration * std::pow(speed, -0.2)) - 1;
  std::cout << "  " << speed << " m/s, " << cells << " cells: approach " << 100 * found.approach << " %, force " << 100 * found.force << " %, duration "
            << 100 * found.duration << " %, rebound at " << found.rebound << ", " << sim->steps() << " steps, " << sim->wall_time() << " s\n";
  return found;
}

// Hertz takes the bodies for half spaces: right in the limit of a small contact radius a.
// At 1 m/s a/R is .042, at .3 m/s .026, and what is left of the error falls with it.
TEST(HertzImpact, SphereOnARigidPlane) {
  const Impact fast = impact(14, 6, 1), slow = impact(14, 10, 0.3);
  EXPECT_LT(fast.worst(), 0.015);
  EXPECT_LT(slow.worst(), 0.01);
  EXPECT_LT(std::abs(slow.approach), 0.75 * std::abs(fast.approach));
  EXPECT_LT(std::abs(slow.duration), 0.75 * std::abs(fast.duration));
  EXPECT_GT(fast.rebound, 0.999);
}

}  // namespace
}  // namespace forming_sim
