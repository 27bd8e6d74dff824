#pragma once
// A thick sphere under inner pressure, perfectly plastic, in small strain (Hill):
//   p(c) = 2 Y ln(c/a) + 2 Y/3 (1 - c^3/b^3) when the plastic front stands at c,
//   u(b) = Y/E (1 - nu) c^3/b^2,
//   u(a) = Y/E [ (1 - nu) c^3/a^2 - 2/3 (1 - 2 nu) a (1 + 3 ln(c/a) - c^3/b^3) ].
//
// The strength is a hundredth of a steel's, so that the strains stay as small as the formulas have them.
#include <cmath>

#include "support/sections.h"

namespace forming_sim {
namespace sphere {

constexpr double kInner = 0.2, kOuter = 1.0, kYield = 1.5e6;  // m, Pa

inline double exact_pressure(double c) {
  return 2 * kYield * std::log(c / kInner) + 2 * kYield / 3 * (1 - std::pow(c / kOuter, 3));
}

inline MaterialConfig steel() {
  MaterialConfig m;
  m.density = 7800;
  m.youngs_modulus = 200e9;
  m.poissons_ratio = 0.3;
  m.hardening.emplace();
  m.hardening->curve = "perfect";
  m.hardening->yield_stress = kYield;
  return m;
}

inline double exact_displacement(double c) {
  const MaterialConfig m = steel();
  const double a = kInner, nu = m.poissons_ratio;
  return kYield / m.youngs_modulus * ((1 - nu) * c * c * c / (a * a) - 2. / 3 * (1 - 2 * nu) * a * (1 + 3 * std::log(c / a) - std::pow(c / kOuter, 3)));
}

/// u(b) when the front stands at c.
inline double exact_shell(double c) {
  const MaterialConfig m = steel();
  return kYield / m.youngs_modulus * (1 - m.poissons_ratio) * c * c * c / (kOuter * kOuter);
}

constexpr double kDuration = 40e-3;  // s: 200 times what a wave takes

/// Pressure rises evenly to `last` on the set `inside`; damped (1/s): 1e3 kills what rings, and
/// costs .2 % of the pressure in late flow.
inline void press(OneBody& run, const std::string& inside, double last, double damping = 1e3) {
  run.plan.time_step.damping = damping;
  PressureConfig pressure;
  pressure.set = inside;
  pressure.times = {0, kDuration};
  pressure.values = {0, last};
  run.plan.bodies[0].pressures.push_back(pressure);
}

/// Radii in geometric progression, so that cells are as long as they are wide.
inline double radius(double s) { return kInner * std::pow(kOuter / kInner, s); }

/// A quarter of the section, the upper half of the sphere, turned about the axis.
inline OneBody section(int cells, const std::string& pattern, const std::string& average = "cell") {
  const Mesh mesh = bent_section(cells, cells, [](double s, double t) {
    const double r = radius(s), angle = M_PI / 2 * t;
    return Vec3(t == 1 ? 0 : r * std::cos(angle), r * std::sin(angle), 0);
  }, pattern);
  OneBody run = one_ring(mesh, steel(), kDuration, average);
  run.plan.bodies[0].boundaries.push_back(symmetric("bottom", Vec3::UnitY()));
  return run;
}

/// A third of an octant: the pyramid over the square 0 <= x <= z, 0 <= y <= z. Its four
/// sides go through the centre, planes of symmetry all.
inline OneBody pyramid(int cells, const std::string& pattern, const std::string& average) {
  BlankConfig blank;
  blank.shape = "plate";
  blank.pattern = pattern;
  blank.length = blank.width = blank.thickness = 1;
  blank.cells_through = cells;
  blank.cells_along = blank.cells_across = std::max(2, cells / 2);
  const Vec3 in_cells(blank.cells_along, blank.cells_across, cells);
  Mesh mesh = pattern == "free" ? free_box(in_cells, 1) : generate_blank(blank);
  if (pattern == "free")
    for (Vec3& X : mesh.nodes) X = X.cwiseQuotient(in_cells);
  for (Vec3& X : mesh.nodes) X = radius(X.z()) * Vec3(X.x(), X.y(), 1).normalized();
  check_volumes(mesh);
  OneBody run(body_of(mesh, steel(), average), kDuration);
  const std::pair<const char*, Vec3> sides[] = {{"left", {1, 0, 0}}, {"right", {1, 0, -1}}, {"front", {0, 1, 0}}, {"back", {0, 1, -1}}};
  for (const auto& [set, normal] : sides) run.plan.bodies[0].boundaries.push_back(symmetric(set, normal));
  return run;
}

}  // namespace sphere
}  // namespace forming_sim
