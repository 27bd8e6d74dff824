#pragma once
// The single square cell of figures 5 to 8: four crossed triangles, loaded on its
// sides until .01 s and left to vibrate.
//
// The paper gives E, nu and eps_s = .01, and neither density, load nor time step.
// Chosen here: side 1 m, 2800 kg/m3 (its impact example), stable step 4.7e-5 s.
#include <cmath>
#include <string>
#include <vector>

#include "figure.h"
#include "stepped_body.h"
#include "rows.h"

namespace forming_sim::bench {

constexpr double kUnloading = 0.01;  // s

inline MaterialConfig cell_material(const std::string& law, bool plastic = false) {
  MaterialConfig m;
  m.density = 2800;
  m.youngs_modulus = 100e9;
  m.poissons_ratio = 0.45;
  m.law = law;
  if (plastic) {
    m.hardening.emplace();
    m.hardening->curve = "perfect";
    m.hardening->yield_stress = 1e9;  // eps_s = .01
  }
  return m;
}

inline Mesh square(int cells, const std::string& pattern = "fine") {
  BlankConfig blank;
  blank.shape = "strip";
  blank.pattern = pattern;
  blank.origin = Vec3(-0.5, -0.5, 0);
  blank.length = blank.thickness = 1;
  blank.cells_along = blank.cells_through = cells;
  return generate_blank(blank);
}

/// The cell is loaded until .01 s and free from then on.
class VibratingCell {
 public:
  VibratingCell(const MaterialConfig& material, double dt, const ElementOptions& options = {})
      : body(square(1), material, "cell", options), dt_(dt) {
    const Vec3 places[4] = {{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}};
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t n = 0; n < body.X.size(); ++n)
        if ((vec3(body.X[n]) - places[k]).norm() < 1e-9) corners_[k] = n;
  }

  /// stress: on the sides x = -1/2 and 1/2, Pa; it grows smoothly until .01 s and is then
  /// taken away, so that the vibration does not depend on where a step finds the load.
  void stretch(double stress) { stress_ = stress; }
  /// The corners are led into simple shear, by an angle whose tangent is gamma at .01 s,
  /// from rest to rest: when they are let go nothing turns.
  void shear(double gamma) { gamma_ = gamma; }

  /// From now on a load along x goes to and fro: stress sin(pulse t), Pa and 1/s.
  void drive(double stress, double pulse) { driving_ = stress, pulse_ = pulse; }

  SteppedBody body;

  void step() {
    accelerate();
    body.move(dt_);
  }
  /// The first half of a step, after which stresses and energy are those at time().
  void accelerate() {
    const double tau = static_cast<double>(steps_ + 1) * dt_ / kUnloading;
    const bool loaded = tau < 1 + 1e-9;
    const double half = std::sin(0.5 * M_PI * tau);
    pull(loaded ? stress_ * half * half : driving_ * std::sin(pulse_ * time()));
    body.accelerate(dt_);
    if (loaded && gamma_ != 0)
      for (std::size_t k = 0; k < 4; ++k)
        body.v[corner(k)] = Node(gamma_ / kUnloading * (1 - std::cos(2 * M_PI * tau)) * body.X[corner(k)][1], 0, 0, 0);
    ++steps_;
  }
  void move() { body.move(dt_); }
  double time() const { return static_cast<double>(steps_) * dt_; }
  double dt() const { return dt_; }

  /// Corners counter-clockwise from the least x and y.
  std::size_t corner(std::size_t k) const { return corners_[k]; }
  Vec3 at(std::size_t k) const { return vec3(body.x[corner(k)]); }
  /// Angle of the left side from the y axis, degrees.
  double angle() const {
    const Vec3 side = at(3) - at(0);
    return std::atan2(side.x(), side.y()) * 180 / M_PI;
  }

 private:
  /// The load of a stress on the sides x = -1/2 and 1/2, Pa.
  void pull(double stress) {
    for (std::size_t k = 0; k < 4; ++k) body.load[corner(k)][0] = body.X[corner(k)][0] > 0 ? stress / 2 : -stress / 2;
  }

  std::size_t corners_[4] = {};
  double dt_, stress_ = 0, gamma_ = 0, driving_ = 0, pulse_ = 0;
  long steps_ = 0;
};

/// Steps the cell until a time, s.
inline void step_until(VibratingCell& cell, double time) {
  while (cell.time() < time - 0.5 * cell.dt()) cell.step();
}

/// The outline of the cell as a closed curve, moved to the right and up.
inline void outline(Figure& figure, const std::string& name, const VibratingCell& cell, double right, double up) {
  for (std::size_t k : {0, 1, 2, 3, 0}) figure.add(name, cell.at(k).x() + right, cell.at(k).y() + up);
  figure.add(name, kNothing, kNothing);  // lifts the pen
}

/// Mean, least and greatest value in a stretch of time.
struct Window {
  double time, mean, least, greatest;
};

/// Means, and least and greatest values, as curves.
inline void draw(Figure& figure, const std::string& name, const std::vector<Window>& windows, bool range) {
  for (const Window& w : windows) figure.add(name + ", mean", w.time, w.mean);
  if (!range) return;
  for (const Window& w : windows) figure.add(name + ", range", w.time, w.least);
  figure.add(name + ", range", kNothing, kNothing);
  for (const Window& w : windows) figure.add(name + ", range", w.time, w.greatest);
}

/// Steps the cell to `until` and looks at measure(cell) after each step, in windows of
/// equal length. The mean is weighted by sin^2, which leaves nothing of a vibration
/// that the window cuts.
template <class Measure> std::vector<Window> windows(VibratingCell& cell, double until, int count, Measure&& measure) {
  std::vector<Window> all;
  const long steps = std::lround((until - cell.time()) / cell.dt() / count);
  for (int i = 0; i < count; ++i) {
    Window w{cell.time() + 0.5 * static_cast<double>(steps) * cell.dt(), 0, 1e300, -1e300};
    double weight = 0;
    for (long k = 0; k < steps; ++k) {
      cell.step();
      const double value = measure(cell), s = std::sin(M_PI * (static_cast<double>(k) + 0.5) / static_cast<double>(steps));
      w.mean += s * s * value;
      weight += s * s;
      w.least = std::min(w.least, value);
      w.greatest = std::max(w.greatest, value);
    }
    w.mean /= weight;
    all.push_back(w);
  }
  return all;
}

/// Slope of the straight line through the means of windows [first, last), per s.
inline double slope(const std::vector<Window>& w, std::size_t first, std::size_t last) {
  double n = 0, t = 0, m = 0, tt = 0, tm = 0;
  for (std::size_t i = first; i < last; ++i) {
    n += 1;
    t += w[i].time;
    m += w[i].mean;
    tt += w[i].time * w[i].time;
    tm += w[i].time * w[i].mean;
  }
  return (n * tm - t * m) / (n * tt - t * t);
}
inline double slope(const std::vector<Window>& w) { return slope(w, 0, w.size()); }

}  // namespace forming_sim::bench
