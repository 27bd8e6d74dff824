#pragma once
// When what is given over times changes: motions of tools and boundaries, pressures, loads.
#include <algorithm>
#include <string>
#include <vector>

#include "forming_sim/loads/config.h"
#include "forming_sim/loads/profile.h"

namespace forming_sim {

/// Calls visit(times, values, moves) for each list of values over times; moves: what is level and not 0 goes on moving.
template <class Visit> void each_course(const MotionConfig& m, Visit&& visit) {
  visit(m.times, m.positions, false);
  visit(m.times, m.rotations_deg, false);
  visit(m.times, m.velocities, true);
  visit(m.times, m.spins_deg_s, true);
  visit(m.times, m.forces, false);
  visit(m.times, m.torques, false);
}
template <class Visit> void each_course(const BoundaryConfig& b, Visit&& visit) {
  visit(b.times, b.velocities, true);
  visit(b.times, b.spins_deg_s, true);
  visit(b.times, b.positions, false);
  visit(b.times, b.rotations_deg, false);
}
template <class Visit> void each_course(const PressureConfig& p, Visit&& visit) { visit(p.times, p.values, false); }
template <class Visit> void each_course(const LoadConfig& l, Visit&& visit) {
  visit(l.times, l.tractions, false);
  visit(l.times, l.forces, false);
}

/// Time of the last knot that differs from the one before, s; 0: nothing changes.
template <class Config> double last_change(const Config& config) {
  double last = 0;
  each_course(config, [&](const std::vector<double>& times, const auto& values, bool) {
    for (std::size_t k = 1; k < values.size(); ++k)
      if (values[k] != values[k - 1]) last = std::max(last, times[k]);
  });
  return last;
}

/// Is it on its way from one knot to another at some time after `from` and before `to`? (A spline swings beyond level knots: not told apart.)
template <class Config> bool changes(const Config& config, double from, double to) {
  const double last = last_change(config);
  bool found = false;
  each_course(config, [&](const std::vector<double>& times, const auto& values, bool moves) {
    for (std::size_t k = 1; k < values.size(); ++k) {
      const bool on_its_way = values[k] != values[k - 1] || (moves && values[k] != 0 * values[k]);
      found = found || (on_its_way && times[k] <= last && from < times[k] && times[k - 1] < to);
    }
  });
  return found;
}

inline bool is_other_than_zero(const std::vector<double>& times, const std::vector<double>& values, const std::string& profile, double t) {
  return ScalarProfile(times, values, profile).at(t) != 0;
}
inline bool is_other_than_zero(const std::vector<double>& times, const std::vector<Vec3>& values, const std::string& profile, double t) {
  return !VelocityProfile(times, values, profile).at(t).isZero(0);
}
/// Does a pressure or a load act at the time t of its own, s? Before 0 it has not begun. Throws Error(invalid_scene) as its profile does.
template <class Config> bool acts(const Config& config, double t) {
  bool found = false;
  each_course(config, [&](const std::vector<double>& times, const auto& values, bool) { found = found || (t >= 0 && !values.empty() && is_other_than_zero(times, values, config.profile, t)); });
  return found;
}

/// Does the centre of a tool with this motion go anywhere? Else it only turns.
inline bool goes(const MotionConfig& m) {
  return std::any_of(m.positions.begin(), m.positions.end(), [&](const Vec3& p) { return p != m.positions.front(); }) ||
         std::any_of(m.velocities.begin(), m.velocities.end(), [](const Vec3& v) { return !v.isZero(0); });
}

/// Calls visit(what, config) for each boundary, pressure and load of a body; what: as sentences call it. Body: whoever has these lists.
template <class Body, class Visit> void each_named_course(const Body& body, const std::string& name, Visit&& visit) {
  const std::string of = " of body " + name;
  for (const BoundaryConfig& b : body.boundaries) visit("the motion of set " + b.set + of, b);
  for (const PressureConfig& p : body.pressures) visit(name_of(p) + of, p);
  for (const LoadConfig& l : body.loads) visit(name_of(l) + of, l);
}

}  // namespace forming_sim
