#pragma once
// The Taylor bar of copper: R 3.2, L 32.4 mm, 227 m/s, 80 us (VERIFICATION: length 21.42 +- .03,
// face radius 7.22 +- .02 mm for a face that stays on the wall).
#include "support/sections.h"

namespace forming_sim {

constexpr double kTaylorRadius = 3.2e-3, kTaylorLength = 32.4e-3, kTaylorSpeed = 227, kTaylorTime = 80e-6;

inline MaterialConfig copper() {
  MaterialConfig m;
  m.density = 8930;
  m.youngs_modulus = 117e9;
  m.poissons_ratio = 0.35;
  m.hardening.emplace();
  m.hardening->curve = "linear";
  m.hardening->yield_stress = 400e6;
  m.hardening->modulus = 100e6;
  return m;
}

/// The quarter bar along z, its face at z = 0, ten cells along for one of the radius; pattern "free": of tetrahedra about as large.
inline Mesh quarter_bar(int cells, const std::string& pattern) {
  if (pattern == "free") return free_quarter_bar(kTaylorRadius, kTaylorLength, kTaylorRadius / cells);
  BlankConfig bar;
  bar.shape = "bar";
  bar.portion = "quarter";
  bar.pattern = pattern;
  bar.length = kTaylorLength;
  bar.radius = kTaylorRadius;
  bar.cells_radius = cells;
  bar.cells_along = 10 * cells;
  return generate_blank(bar);
}

/// dimension 3: the quarter bar; 2: its section, turned about the axis. The face stays on the wall.
inline OneBody taylor_bar(int dimension, int cells, const std::string& pattern, const std::string& average) {
  const Mesh section = bent_section(cells, 10 * cells, [](double s, double t) { return Vec3(kTaylorRadius * s, kTaylorLength * t, 0); }, pattern);
  OneBody run = dimension == 2 ? one_ring(section, copper(), kTaylorTime, average) : OneBody(body_of(quarter_bar(cells, pattern), copper(), average), kTaylorTime);
  run.plan.bodies[0].initial_velocity = -kTaylorSpeed * Vec3::Unit(dimension - 1);
  std::vector<BoundaryConfig>& boundaries = run.plan.bodies[0].boundaries;
  boundaries = {symmetric("bottom", Vec3::Unit(dimension - 1))};
  if (dimension == 3)
    for (int axis : {0, 1}) boundaries.push_back(symmetric(axis == 0 ? "symmetry_x" : "symmetry_y", Vec3::Unit(axis)));
  return run;
}

struct TaylorShape {
  double length, radius;  ///< in the unit of the positions
};
inline TaylorShape taylor_shape(const NodeField& x, int dimension) {
  double low = x[0][dimension - 1], high = low, radius = 0;
  for (const Node& n : x) {
    low = std::min(low, n[dimension - 1]);
    high = std::max(high, n[dimension - 1]);
    radius = std::max(radius, dimension == 2 ? n[0] : n.head<2>().norm());
  }
  return {high - low, radius};
}

}  // namespace forming_sim
