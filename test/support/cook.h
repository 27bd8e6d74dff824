#pragma once
// Cook's membrane: a tapered panel clamped at the left, sheared at the right, plane strain,
// elastic-plastic (VERIFICATION: its upper right corner rises by 6.95 +- .1 mm).
#include <algorithm>
#include <cmath>

#include "support/sections.h"

namespace forming_sim {

constexpr double kCookTraction = 0.3125e9;  ///< Pa, upwards on the right edge, a dead load
constexpr double kCookRise = 6.95;          ///< mm, of the upper right corner, +- .1

/// sigma = 450 + 129.24 p + 265 (1 - exp(-16.93 p)) MPa.
inline MaterialConfig cook_material() {
  MaterialConfig m;
  m.density = 7800;
  m.youngs_modulus = 206.9e9;
  m.poissons_ratio = 0.29;
  m.hardening.emplace();
  m.hardening->curve = "voce";
  m.hardening->yield_stress = 450e6;
  m.hardening->saturation_stress = 715e6;
  m.hardening->rate = 16.93;
  m.hardening->modulus = 129.24e6;
  return m;
}

// The traction rises smoothly and stays. A straight ramp, or one that is four times as fast, overshoots, and what overshoots
// stays as plastic strain.
constexpr double kCookLoading = 5e-3, kCookHold = 1e-3;  ///< s; the panel swings in about .1 ms, in plastic flow in some ms
constexpr double kCookDamping = 6e3;                     ///< 1/s

/// Share of the traction after `time`, s, of a loading that takes `loading`.
inline double cook_share(double time, double loading = kCookLoading) {
  const double s = std::min(1.0, time / loading);
  return s * s * s * (10 - 15 * s + 6 * s * s);
}

/// Corners (0,0) (48,44) (48,60) (0,44) mm, cells x cells.
inline Mesh membrane(int cells, const std::string& pattern) {
  return mapped_section(cells, cells, [](double s, double t) { return Vec3(48e-3 * s, 44e-3 * s + t * (44e-3 - 28e-3 * s), 0); }, pattern);
}

/// The traction as forces on the nodes, N: half of that on a segment of the edge to each of its ends.
inline NodeField cook_load(const Mesh& mesh) {
  NodeField load(mesh.nodes.size(), Node::Zero());
  std::vector<int> edge = mesh.sets.at("right");
  std::sort(edge.begin(), edge.end(), [&](int a, int b) { return mesh.nodes[a].y() < mesh.nodes[b].y(); });
  for (std::size_t i = 1; i < edge.size(); ++i)
    for (int end : {edge[i - 1], edge[i]}) load[end][1] += 0.5 * kCookTraction * (mesh.nodes[edge[i]].y() - mesh.nodes[edge[i - 1]].y());
  return load;
}

/// Its node at (48,60) mm.
inline int upper_right(const Mesh& mesh) {
  int best = 0;
  for (int n = 0; n < static_cast<int>(mesh.nodes.size()); ++n)
    if (mesh.nodes[n].sum() > mesh.nodes[best].sum()) best = n;
  return best;
}

/// What the corner does while the load comes and stays, mm.
struct CookRise {
  double end, highest, loaded;  ///< at last, on the way, when the load was full
};
inline CookRise cook_rise(int cells, const std::string& pattern) {
  const Mesh mesh = membrane(cells, pattern);
  const NodeField X = positions_of(mesh), load = cook_load(mesh);
  Elements elements({body_of(mesh, cook_material())}, 2, X, {}, 1);
  NodeField x = X, v(X.size(), Node::Zero()), f(X.size());
  const int top = upper_right(mesh);
  CookRise rise{};
  double dt = 0;
  long step = 0;
  for (double time = 0; time < kCookLoading + kCookHold; time += dt) {
    int element;
    if (step++ % 50 == 0) elements.stable_step(x, v, dt, element), dt *= 0.8;
    const double keep = (1 - 0.5 * kCookDamping * dt) / (1 + 0.5 * kCookDamping * dt), kick = dt / (1 + 0.5 * kCookDamping * dt);
    elements.forces(x, v, dt, dt, f);
    const double share = cook_share(time + dt);
    for (std::size_t i = 0; i < X.size(); ++i) {
      v[i] = keep * v[i] + kick / elements.nodal_mass()[i] * (f[i] + share * load[i]);
      if (X[i][0] < 1e-9) v[i].setZero();
      x[i] += dt * v[i];
    }
    rise.end = 1e3 * (x[top][1] - X[top][1]);
    rise.highest = std::max(rise.highest, rise.end);
    if (time < kCookLoading) rise.loaded = rise.end;
  }
  return rise;
}

}  // namespace forming_sim
