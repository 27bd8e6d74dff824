#pragma once
// Torsion of a round bar between two discs that stay round, perfectly plastic, in small strain: with the twist
// t = theta/theta_y and the torque over the one at first yield, T_y = pi R^3 tau_y/2, tau_y = Y/sqrt(3), theta_y = tau_y L/(G R),
//   T/T_y = t (t <= 1),   4/3 - 1/(3 t^3) (t > 1),   and t - T/T_y when it is let go.
// The ends may move along the axis. The yield strain is .001, so that strains stay as small as the formulas have them.
#include "support/free_mesh.h"
#include "support/run_size.h"
#include "support/runs.h"

namespace forming_sim {
namespace torsion {

constexpr double kRadius = 10e-3, kLength = 5e-3, kYieldStrain = 1e-3;  // m, m, tau_y/G

inline double exact_torque(double twist) { return twist <= 1 ? twist : 4. / 3 - 1 / (3 * twist * twist * twist); }

inline MaterialConfig perfect() {
  MaterialConfig m = aluminium();
  m.hardening.emplace();
  m.hardening->curve = "perfect";
  m.hardening->yield_stress = std::sqrt(3) * kYieldStrain * m.mu();
  return m;
}

inline Mesh bar_of(int cells, const std::string& pattern) {
  if (pattern == "free") return free_bar(kRadius, kLength, kRadius / cells);
  BlankConfig blank;
  blank.shape = "bar";
  blank.pattern = pattern;
  blank.radius = kRadius;
  blank.length = kLength;
  blank.cells_radius = cells;
  blank.cells_along = std::max(1, cells / 2);
  return generate_blank(blank);
}

struct Twisted {
  std::vector<double> torque;  ///< over T_y, at rest at each twist asked for
  double balance;
  RunSize size;
};

/// Turned to one twist (over theta_y of `perfect`) after the other, with a rest at each.
inline Twisted twist(int cells, const std::string& pattern, const std::vector<double>& twists, const MaterialConfig& material, int threads = 1) {
  constexpr double kTurn = 160e-6, kRest = 40e-6;  // s: 100 times what a wave takes, and some
  const double theta_y = kYieldStrain * kLength / kRadius, torque_y = M_PI / 2 * std::pow(kRadius, 3) * kYieldStrain * material.mu();
  OneBody run(body_of(bar_of(cells, pattern), material), static_cast<double>(twists.size()) * (kTurn + kRest));
  run.plan.time_step.damping = 1e5;
  BoundaryConfig held, turned;
  held.set = "bottom";
  held.kind = "fixed";
  turned.set = "top";
  turned.kind = "velocity";
  turned.axes = {"x", "y"};
  turned.profile = "smooth";
  double last = 0;
  for (std::size_t k = 0; k < twists.size(); ++k) {
    const double start = static_cast<double>(k) * (kTurn + kRest);
    const double peak = (twists[k] - last) * theta_y / (0.5 * kTurn) * (180 / M_PI);
    last = twists[k];
    for (const auto& [t, w] : {std::pair{0., 0.}, {0.5 * kTurn, peak}, {kTurn, 0.}}) {
      turned.times.push_back(start + t);
      turned.spins_deg_s.push_back(Vec3(0, 0, w));
    }
  }
  run.plan.bodies[0].boundaries = {held, turned};
  auto sim = run.start(threads);
  const std::vector<int>& top = run.model.bodies[0].mesh.sets.at("top");
  Twisted found;
  // The torque is the mean over the second half of each rest.
  const auto run_to = [&](double time) {
    while (sim->time() < time && sim->step()) {}
    return std::pair{sim->time(), sim->reaction(top).angular.z()};
  };
  for (std::size_t k = 0; k < twists.size(); ++k) {
    const double end = static_cast<double>(k + 1) * (kTurn + kRest);
    const auto [t0, before] = run_to(end - 0.5 * kRest);
    const auto [t1, after] = run_to(end);
    found.torque.push_back((after - before) / (t1 - t0) / torque_y);
  }
  found.balance = sim->balance_error();
  found.size = size_of(*sim);
  return found;
}

/// Twist that stays when a bar that bears `torque` at `twist` is let go: it goes back along the line to (other, other_torque), elastic.
inline double left_over(double twist, double torque, double other, double other_torque) {
  return twist - torque * (twist - other) / (torque - other_torque);
}

}  // namespace torsion
}  // namespace forming_sim
