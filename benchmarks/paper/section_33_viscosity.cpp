// Section 3.3: viscosity damps the vibration; does the classical method still drift?
//
// The cell of figure 6 (300 MPa by .01 s) three times: vibrating freely, with bulk
// viscosity and damping of the nodes, and with both while a load of 40 MPa along x goes
// to and fro for ever, as the load of a running process does.
#include "paper/figures.h"
#include "paper/single_cell.h"

namespace forming_sim::bench {
namespace {

constexpr double kStress = 300e6, kDriving = 40e6, kStep = 2.5e-5, kEnd = 5;
constexpr double kBulk = 0.1, kDamping = 5;  // linear bulk viscosity; 1/s
constexpr int kWindows = 20;

struct Found {
  std::vector<Window> area;
  double time;
};

Found run(const std::string& law, bool viscous, bool driven) {
  const Clock clock;
  ElementOptions options;
  if (viscous) options.linear_viscosity = kBulk;
  VibratingCell cell(cell_material(law), kStep, options);
  cell.stretch(kStress);
  step_until(cell, kUnloading);
  if (viscous) cell.body.damping = kDamping;
  // Half the frequency of the slowest vibration of a square of this size, sqrt(24 mu / rho) / 2 pi.
  const double pulse = 0.5 * std::sqrt(24 * cell_material(law).mu() / cell_material(law).density);
  if (driven) cell.drive(kDriving, pulse);
  return {windows(cell, kEnd, kWindows, [](const VibratingCell& c) { return c.body.volume_ratio(); }), clock.seconds()};
}

}  // namespace

std::vector<Row> viscosity(const Request& request) {
  std::vector<Row> rows;
  Figure figure("section_3.3_area", "Viscosity and the drift of the area", "time, s", "mean S/S0");
  Figure range("section_3.3_vibration", "Viscosity and the vibration (classical method)", "time, s", "range of S/S0 in .25 s");
  const auto add = [&](const std::string& law, const std::string& name, bool viscous, bool driven) {
    const Found found = run(law, viscous, driven);
    const std::string curve = (law == "paper" ? "new, " : "classical, ") + name;
    for (const Window& w : found.area) figure.add(curve, w.time, w.mean);
    if (law == "classical")
      for (const Window& w : found.area) range.add(name, w.time, w.greatest - w.least);
    return found;
  };
  const Found free = add("classical", "no viscosity", false, false);
  const Found damped = add("classical", "viscous", true, false);
  const Found driven = add("classical", "viscous, driven", true, true);
  const Found new_damped = add("paper", "viscous", true, false);
  const Found new_driven = add("paper", "viscous, driven", true, true);
  const auto last = [](const Found& f) { return f.area.back(); };
  const auto width = [](const Window& w) { return w.greatest - w.least; };

  rows.push_back(just("section 3.3", "classical, no viscosity: drift, 1/s", slope(free.area), free.time));
  rows.back().note = "chosen: as figure 6, dt 2.5e-5 s; linear bulk viscosity .1 and damping 5/s; driven: +-40 MPa along x";
  rows.push_back(at_most("section 3.3", "viscous: vibration at 5 s / at the start", width(last(damped)) / width(damped.area.front()), 1e-3, damped.time));
  const std::size_t late = kWindows / 2;
  Row stays = just("section 3.3", "classical, viscous: drift goes on, 1/s", slope(damped.area, late, kWindows), damped.time);
  stays.expected = slope(free.area, late, kWindows);
  stays.error = stays.found / stays.expected - 1;
  stays.holds = stays.error > -0.5;
  stays.note = "the claim, that viscosity leaves the drift, does not hold where nothing drives the cell: the drift ends with the vibration; see the driven cell below";
  rows.push_back(stays);
  rows.push_back(just("section 3.3", "classical, viscous: mean S/S0 - 1 at 5 s", last(damped).mean - 1, damped.time));
  rows.back().note = "what has drifted until the vibration dies stays for ever; nothing vibrates any more, so nothing drifts any more";
  rows.push_back(at_most("section 3.3", "new, viscous: |mean S/S0 - 1| at 5 s", std::abs(last(new_damped).mean - 1), 1e-9, new_damped.time));
  Row goes_on = just("section 3.3", "classical, viscous, driven: drift, 1/s", slope(driven.area, late, kWindows), driven.time);
  goes_on.expected = 1e-7;
  goes_on.error = goes_on.found / goes_on.expected - 1;
  goes_on.holds = goes_on.found > goes_on.expected;
  goes_on.note = "expected: more than the new method's bound below. The claim holds while a load keeps the cell vibrating";
  rows.push_back(goes_on);
  rows.push_back(at_most("section 3.3", "new, viscous, driven: |drift|, 1/s", std::abs(slope(new_driven.area, late, kWindows)), 1e-7, new_driven.time));
  figure.write(request.directory);
  range.write(request.directory);
  return rows;
}

}  // namespace forming_sim::bench
