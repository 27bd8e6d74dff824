#pragma once
// An elastic sphere hits a rigid plane: Hertz' impact.
//
// Aluminium, radius 10 mm, 1 m/s: approach 18.020 um, peak force 784.54 N, contact
// 53.037 us. The cells shrink towards the point of contact: the section of the sphere is mapped
// onto itself by z -> (z + a)/(1 + a z), which keeps shapes. Axisymmetric, and a quarter in 3D.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <map>

#include "forming_sim/mesh/measure.h"
#include "forming_sim/mesh/split.h"
#include "support/run_size.h"
#include "support/sections.h"

namespace forming_sim::hertz_sphere {

constexpr double kRadius = 10e-3, kApproach = 18.020e-6, kForce = 784.54, kDuration = 53.037e-6, kAbove = 0.5e-6;  // the last: height at the start

struct Strike {
  int dimension = 2;        ///< 2: axisymmetric
  int cells = 14;           ///< along a radius; half of them in the square or cube in the middle
  double gather = 6;        ///< cells at the contact are so many times smaller than in the middle
  double speed = 1;         ///< m/s
  double layer = 0.05e-6;   ///< h0, m
  const char* pattern = "fine";  ///< 3D: fine (24 tetrahedra a hexahedron) or coarse (6)
};

/// Over Hertz: approach ~ v^(4/5), force ~ v^(6/5), duration ~ v^(-1/5); and the speed after over that before.
struct Found {
  double approach, force, duration, rebound;
  double mass;              ///< of the mesh over that of a sphere, at the same density
  double balance;
  long crossings;
  RunSize run;
  double worst() const { return std::max({std::abs(approach - 1), std::abs(force - 1), std::abs(duration - 1)}); }
};

/// Half width of the greatest contact over the radius of the sphere: a^2 = R times the approach.
inline double half_width(double speed) { return std::sqrt(kApproach * std::pow(speed, 0.8) / kRadius); }

/// A place of the unit sphere (along the axis, from it) on the gathered sphere of radius R that stands at y = above.
inline Vec3 gathered(const std::complex<double>& p, double gather, double above) {
  const double a = (gather - 1) / (gather + 1);
  const std::complex<double> z = (p - a) / (1.0 - a * p);
  return Vec3(kRadius * z.imag(), kRadius * (1 + z.real()) + above, 0);
}

/// Half a disc as complex numbers, the real axis along y: a half square of n x 2 n cells
/// in the middle, and n layers from there to the rim.
inline Mesh section(int n, double gather, double above) {
  using Point = std::complex<double>;
  const int rim = 4 * n;
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
  Mesh mesh;
  mesh.dimension = 2;
  for (const Point& p : points) mesh.nodes.push_back(gathered(p, gather, above));
  split_quads(mesh, quads, CellKind::crossed);
  find_surface(mesh);
  check_volumes(mesh);
  close_at_axis(mesh);
  return mesh;
}

/// The quarter x, z >= 0: a cube of n x 2 n x n cells in the middle, rounded, and n layers from there to the surface,
/// with the planes of symmetry as the sets x and z.
inline Mesh quarter(int n, double gather, double above, CellKind kind) {
  Mesh mesh;
  mesh.dimension = 3;
  std::map<std::array<int, 4>, int> known;
  // A point of the lattice -n..n is on the sphere where one of its coordinates is n; the cube is the half of it.
  const auto at = [&](int i, int j, int k, int layer) {
    const auto [place, is_new] = known.insert({{i, j, k, layer}, static_cast<int>(mesh.nodes.size())});
    if (is_new) {
      const double u = double(i) / n, v = double(j) / n, w = double(k) / n;
      const Vec3 round(u * std::sqrt(1 - v * v / 2 - w * w / 2 + v * v * w * w / 3), v * std::sqrt(1 - w * w / 2 - u * u / 2 + w * w * u * u / 3),
                       w * std::sqrt(1 - u * u / 2 - v * v / 2 + u * u * v * v / 3));
      const Vec3 p = (0.5 + 0.5 * layer / n) * round;
      const double out = std::hypot(p.x(), p.z());
      const Vec3 y = gathered({p.y(), out}, gather, above);
      mesh.nodes.push_back(out > 0 ? Vec3(y.x() * p.x() / out, y.y(), y.x() * p.z() / out) : Vec3(0, y.y(), 0));
      if (i == 0) mesh.sets["x"].push_back(place->second);
      if (k == 0) mesh.sets["z"].push_back(place->second);
    }
    return place->second;
  };
  std::vector<Hex> hexes;
  const auto take = [&](Hex hex) {
    const Vec3 &o = mesh.nodes[hex[0]], a = mesh.nodes[hex[1]] - o, b = mesh.nodes[hex[3]] - o, c = mesh.nodes[hex[4]] - o;
    if (a.cross(b).dot(c) < 0)
      for (int corner = 0; corner < 4; ++corner) std::swap(hex[corner], hex[corner + 4]);
    hexes.push_back(hex);
  };
  for (int i = 0; i < n; ++i)
    for (int j = -n; j < n; ++j)
      for (int k = 0; k < n; ++k)
        take({at(i, j, k, 0), at(i + 1, j, k, 0), at(i + 1, j + 1, k, 0), at(i, j + 1, k, 0), at(i, j, k + 1, 0), at(i + 1, j, k + 1, 0), at(i + 1, j + 1, k + 1, 0), at(i, j + 1, k + 1, 0)});
  const auto column = [&](const std::array<std::array<int, 3>, 4>& face) {
    for (int layer = 0; layer < n; ++layer) {
      Hex hex;
      for (int c = 0; c < 4; ++c)
        for (int up = 0; up < 2; ++up) hex[c + 4 * up] = at(face[c][0], face[c][1], face[c][2], layer + up);
      take(hex);
    }
  };
  for (int p = 0; p < n; ++p)
    for (int q = -n; q < n; ++q) {
      column({{{n, q, p}, {n, q + 1, p}, {n, q + 1, p + 1}, {n, q, p + 1}}});
      column({{{p, q, n}, {p + 1, q, n}, {p + 1, q + 1, n}, {p, q + 1, n}}});
      if (q < 0) continue;
      for (int end : {-n, n}) column({{{p, end, q}, {p + 1, end, q}, {p + 1, end, q + 1}, {p, end, q + 1}}});
    }
  split_hexes(mesh, hexes, kind);
  find_surface(mesh);
  check_volumes(mesh);
  // Centres of faces on the planes of symmetry.
  for (const auto& [set, axis] : {std::pair{"x", 0}, std::pair{"z", 2}}) {
    mesh.sets[set].clear();
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
      if (std::abs(mesh.nodes[i][axis]) < 1e-12 * kRadius) mesh.sets[set].push_back(static_cast<int>(i));
  }
  return mesh;
}

inline Found strike(const Strike& given, int threads = 1) {
  const bool flat = given.dimension == 2;
  const Mesh mesh = flat ? section(given.cells / 2, given.gather, kAbove)
                         : quarter(given.cells / 2, given.gather, kAbove, given.pattern == std::string("fine") ? CellKind::hex24 : CellKind::hex6);
  double volume = 0;
  for (const auto& e : mesh.simplices())
    volume += flat ? 2 * M_PI / 3 * (mesh.nodes[e[0]].x() + mesh.nodes[e[1]].x() + mesh.nodes[e[2]].x()) * signed_volume(mesh.nodes, e, 2) : 4 * signed_volume(mesh.nodes, e, 3);
  // Chords make the sphere a little lighter, which the density makes up for.
  const double exact = 4 * M_PI / 3 * std::pow(kRadius, 3), speed = given.speed;
  MaterialConfig m;
  m.density = 2700 * exact / volume;
  m.youngs_modulus = 70e9;
  m.poissons_ratio = 0.3;
  OneBody run = one_ring(mesh, m, kAbove / speed + 1.1 * kDuration * std::pow(speed, -0.2));
  run.model.axisymmetric = flat;
  run.plan.bodies[0].initial_velocity = Vec3(0, -speed, 0);
  if (!flat) run.plan.bodies[0].boundaries = {symmetric("x", Vec3::UnitX()), symmetric("z", Vec3::UnitZ())};
  ToolModel plane;
  plane.name = "plane";
  plane.normal = Vec3::UnitY();
  plane.mesh.dimension = given.dimension;
  run.model.tools.push_back(plane);
  run.plan.contact.layer = given.layer;
  auto sim = run.start(threads);
  const std::vector<double>& mass = sim->nodal_mass();
  double total = 0;
  for (double each : mass) total += each;
  const auto height = [&] {
    double sum = 0;
    for (std::size_t i = 0; i < mass.size(); ++i) sum += mass[i] * sim->positions()[i][1];
    return sum / total;
  };
  const double start = height(), end_of_flight = start - kAbove, parts = flat ? 1 : 4;
  Found found{};
  double before = 0, since = 0, first = -1, last = 0;
  while (sim->step()) {
    if (sim->contact_status().active_pairs > 0) {
      if (first < 0) first = sim->time();
      last = sim->time();
    }
    if (sim->steps() % 10 == 0) found.approach = std::max(found.approach, end_of_flight - height());
    if (sim->time() - since < 0.05 * kDuration) continue;  // nodes that come into contact one by one even out
    const double impulse = sim->tools()[0].felt.impulse.y();
    found.force = std::max(found.force, -parts * (impulse - before) / (sim->time() - since));
    before = impulse;
    since = sim->time();
  }
  double momentum = 0;
  for (std::size_t i = 0; i < mass.size(); ++i) momentum += mass[i] * sim->velocities()[i][1];
  found.rebound = momentum / (total * speed);
  found.approach /= kApproach * std::pow(speed, 0.8);
  found.force /= kForce * std::pow(speed, 1.2);
  found.duration = (last - first) / (kDuration * std::pow(speed, -0.2));
  found.mass = volume / exact;
  found.crossings = sim->contact_status().crossings;
  found.balance = sim->balance_error();
  found.run = size_of(*sim);
  return found;
}

}  // namespace forming_sim::hertz_sphere
