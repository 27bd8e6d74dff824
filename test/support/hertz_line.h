#pragma once
// A cylinder pressed on a rigid plane or on another cylinder, against Hertz: half width a = sqrt(4 P R / (pi E')),
// pressure p0 = 2 P / (pi a) in the middle and p0 sqrt(1 - (x/a)^2) about it, E' = E / (1 - nu^2). Two equal cylinders
// do to each other what the plane does.
#include <algorithm>
#include <array>
#include <cmath>

#include "support/run_size.h"
#include "support/runs.h"

namespace forming_sim::hertz_line {

constexpr double kYoung = 70e9, kPoisson = 0.3, kRadius = 10e-3;  // Pa, -, m
constexpr double kStiffness = kYoung / (1 - kPoisson * kPoisson);

struct Press {
  double cells = 4;         ///< across a
  double layer = 1e-3;      ///< h0 over a cell
  double load = 1e5;        ///< about so many N/m; compared at the load found
  double size = 16;         ///< height and half the width of the part of the cylinder that is meshed, over a
  double other_cells = 0;   ///< across a of the other cylinder, 0: it is a rigid plane
};

struct Found {
  double force;                      ///< N/m
  double half_width, middle, shape;  ///< over a; over p0; rms of the pressure about Hertz' over p0
  double balance;
  long crossings;
  RunSize run;
};

inline double half_width(double load) { return std::sqrt(4 * load * kRadius / (M_PI * kStiffness)); }

/// The part of a cylinder about its lowest line. Cells grow from the middle of the contact outwards: x = d sinh(s), the
/// same spacing on both sides.
inline Mesh bottom_of_cylinder(double a, double cells_across_a, double size_over_a) {
  const double size = size_over_a * a, d = 1.2 * a, reach = std::asinh(size / d);
  const int half = static_cast<int>(std::ceil(reach * d / (a / cells_across_a)));
  BlankConfig blank = strip_of(2, 1, 2 * half, half);
  blank.origin = Vec3(-1, 0, 0);
  Mesh mesh = generate_blank(blank);
  for (Vec3& X : mesh.nodes) {
    const double x = d * std::sinh(reach * X.x()), y = d * std::sinh(reach * X.y());
    X = Vec3(x, y + x * x / (2 * kRadius) * std::pow(1 - y / size, 2), 0);
  }
  return mesh;
}

inline Found press(const Press& given) {
  const double a = half_width(given.load), size = given.size * a, layer = given.layer * a / given.cells;
  MaterialConfig material;
  material.density = 2700;
  material.youngs_modulus = kYoung;
  material.poissons_ratio = kPoisson;
  const double wave = size / std::sqrt(kYoung / material.density), time = 15 * wave;  // s: through the part; of the loading
  OneBody run(body_of(bottom_of_cylinder(a, given.cells, given.size), material), 2 * time);
  const double approach = given.load / (M_PI * kStiffness) * (2 * std::log(4 * given.size) - 1) * 0.9;
  const auto drive = [&](BodyLoads& loads, double speed) {
    BoundaryConfig top;
    top.set = "top";
    top.kind = "velocity";
    top.times = {0, time / 2, time};
    top.velocities = {Vec3::Zero(), Vec3(0, speed, 0), Vec3::Zero()};
    top.profile = "smooth";
    loads.boundaries.push_back(top);
  };
  drive(run.plan.bodies[0], -approach / (time / 2));
  if (given.other_cells > 0) {
    Mesh mesh = bottom_of_cylinder(a, given.other_cells, given.size);
    for (Vec3& X : mesh.nodes) X = Vec3(-X.x(), -X.y() - layer, 0);
    drive(add_flying(run.model, run.plan, body_of(std::move(mesh), material), "other", Vec3::Zero()), approach / (time / 2));
  } else {
    ToolModel plane;
    plane.name = "plane";
    plane.normal = Vec3::UnitY();
    plane.mesh.dimension = 2;
    run.model.tools.push_back(plane);
  }
  run.plan.time_step.damping = 0.8 / wave;
  run.plan.contact.layer = layer;
  auto sim = run.start();
  while (sim->step()) {
  }
  // Nodes of the lower face from left to right, and the force of each.
  std::vector<int> face = run.model.bodies[0].mesh.sets.at("bottom");
  std::sort(face.begin(), face.end(), [&](int i, int j) { return sim->positions()[i][0] < sim->positions()[j][0]; });
  const auto width = [&](std::size_t i) { return (sim->positions()[face[i + 1]][0] - sim->positions()[face[i - 1]][0]) / 2; };
  const std::vector<double> pressure = sim->contact_pressure();
  std::vector<std::array<double, 3>> nodes;  // place, force, pressure
  // The half width from the second moment of the pressure: a^2 / 4 for Hertz.
  Found found{};
  double moment = 0;
  for (std::size_t i = 1; i + 1 < face.size(); ++i) {
    const double x = sim->positions()[face[i]][0], p = pressure[face[i]], f = p * width(i);
    nodes.push_back({x, f, p});
    found.force += f;
    moment += f * x * x;
  }
  const double exact = half_width(found.force), p0 = 2 * found.force / (M_PI * exact);
  double square = 0, middle = 0;
  int count = 0;
  for (const auto& [x, f, p] : nodes) {
    if (std::abs(x) < 0.05 * a) middle = std::max(middle, p);
    if (std::abs(x) > 1.5 * exact) continue;
    const double hertz = std::abs(x) < exact ? p0 * std::sqrt(1 - x * x / (exact * exact)) : 0;
    square += std::pow(p - hertz, 2);
    ++count;
  }
  found.half_width = 2 * std::sqrt(moment / found.force) / exact;
  found.middle = middle / p0;
  found.shape = std::sqrt(square / count) / p0;
  found.balance = sim->balance_error();
  found.crossings = sim->contact_status().crossings;
  found.run = size_of(*sim);
  return found;
}

}  // namespace forming_sim::hertz_line
