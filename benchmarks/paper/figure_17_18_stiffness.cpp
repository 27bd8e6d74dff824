// Figures 17 and 18: the impact of figure 16 with other c, and with other c and
// h0 of the same ratio; as printed (algorithm 2, node-node) and by the package's
// own contact at the bulk step.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "paper/figures.h"
#include "paper/two_bodies.h"

namespace forming_sim::bench {
namespace {

constexpr double kStep = 0.1;  // Delta y, m
const char* const kTime = "time, ms";
const char* const kStress = "contact stress, MPa (means over a bulk step)";

std::string words(const char* format, double a, double b = 0) {
  char text[96];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

/// A claim "found is more (less) than expected".
Row claim(const std::string& name, const std::string& quantity, double found, double expected, bool holds, double wall_time, const std::string& note = "") {
  Row row = just(name, quantity, found, wall_time);
  row.expected = expected;
  row.error = expected == 0 ? found : found / expected - 1;
  row.holds = holds;
  row.note = note;
  return row;
}

/// Algorithm 2 at the largest step that keeps the energy within 1 %.
Tried printed(double c, double h0, const std::string& name, std::vector<Row>& rows) {
  const Clock clock;
  Tried t = largest_sound_step(algorithm_2("node_node", h0, c), 0.01);
  const std::string label = name + words(", c = %.0e, h0 = %g", c, h0);
  rows.push_back(just(label, "step with energy in 1 % / bulk", t.fraction, clock.seconds()));
  if (t.fraction == 0) rows.back().note = "at no step from .9 to .025: what follows is empty";
  rows.push_back(near(label, "mean stress, Pa", t.found.mean, kImpactStress, 0.02, t.found.wall_time));
  rows.push_back(near(label, "duration, s", t.found.duration, kImpactDuration, 0.02, t.found.wall_time));
  rows.push_back(just(label, "swing about the mean, rms, Pa", t.found.rms, t.found.wall_time));
  rows.push_back(just(label, "peak stress of a step, Pa", t.found.peak, t.found.wall_time));
  rows.push_back(just(label, "steps", static_cast<double>(t.found.steps), t.found.wall_time));
  return t;
}

void draw(double c, double h0, const Tried& t, Figure& figure) {
  add_stress(figure, words("c = %.0e, h0 = %g", c, h0) + words(", %.2g of the bulk step", t.fraction), t.found);
}

ImpactFound own(double c, double h0) {
  ImpactCase two;
  two.contact = mild("implicit", h0);
  two.contact.stiffness = c / (kStep * h0);
  return collide(two);
}

}  // namespace

std::vector<Row> figure_17(const Request& request) {
  const double h0 = 0.01;
  std::vector<Row> rows;
  Figure figure("figure_17", "Algorithm 2: influence of c, h0 = .01", kTime, kStress);
  const std::string name = "figure 17";
  const Tried soft = printed(7e6, h0, name, rows), middle = printed(7e7, h0, name, rows), stiff = printed(7e8, h0, name, rows);
  draw(7e8, h0, stiff, figure);
  draw(7e7, h0, middle, figure);
  draw(7e6, h0, soft, figure);
  add_analytic(figure);
  figure.write(request.directory);
  const double time = soft.found.wall_time + middle.found.wall_time + stiff.found.wall_time;
  const auto off = [](const Tried& t) { return std::abs(t.found.duration - kImpactDuration); };
  rows.push_back(claim(name + ", 7e6 against 7e7", "duration / duration", soft.found.duration / middle.found.duration, 1, soft.found.duration > middle.found.duration, time, "smaller c: contact becomes longer"));
  rows.push_back(claim(name + ", 7e6 against 7e7", "swing / swing", soft.found.rms / middle.found.rms, 1, soft.found.rms < middle.found.rms, time, "smaller c: oscillation decreases"));
  rows.push_back(claim(name + ", 7e6 against 7e7", "step / step", soft.fraction / middle.fraction, 1, soft.fraction >= middle.fraction, time, "smaller c: the same step will do"));
  rows.push_back(claim(name + ", 7e8 against 7e7", "|duration - 1.6 ms| / same", off(stiff) / off(middle), 1, off(stiff) < off(middle), time,
                       "larger c: duration closer to theory; both differ from it by no more than the ringing moves the last touch"));
  rows.push_back(claim(name + ", 7e8 against 7e7", "swing / swing", stiff.found.rms / middle.found.rms, 1, stiff.found.rms > middle.found.rms, time, "larger c: oscillation much bigger"));
  rows.push_back(claim(name + ", 7e8 against 7e7", "step / step", stiff.fraction / middle.fraction, 0.5, stiff.fraction <= 0.5 * middle.fraction, time, "larger c: step several times smaller"));

  Figure other("figure_17_own", "The package's own contact at the bulk step: influence of c, h0 = .01", kTime, kStress);
  std::vector<double> means;
  for (double c : {7e4, 7e5, 7e6, 7e7, 7e8, 7e9, 7e10}) {
    const ImpactFound found = own(c, h0);
    const std::string label = "figure 17, own contact" + words(", c = %.0e", c);
    rows.push_back(near(label, "mean stress, Pa", found.mean, kImpactStress, 0.02, found.wall_time));
    rows.push_back(near(label, "duration, s", found.duration, kImpactDuration, 0.02, found.wall_time));
    rows.push_back(just(label, "swing about the mean, rms, Pa", found.rms, found.wall_time));
    rows.push_back(just(label, "energy at the end / start - 1", found.energy, found.wall_time));
    if (found.energy < -0.1) rows.back().note = "nodes in hollows of slope 1e-3 are not pushed until h0/2 is left, and start at no force again: a layer pressed by 1 % of h0 is as wavy as that";
    if (c < 1e5 || c == 7e5 || c == 7e7 || c > 1e10) add_stress(other, words("c = %.0e", c), found);
    if (c > 1e6) means.push_back(found.mean);
  }
  for (int skip : {0, 1}) {
    const auto [least, most] = std::minmax_element(means.begin() + skip, means.end());
    rows.push_back(near(skip ? "figure 17, own contact, c = 7e7 to 7e10" : "figure 17, own contact, c = 7e6 to 7e10", "largest mean / least", *most / *least, 1, 0.01, 0));
  }
  add_analytic(other);
  other.write(request.directory);
  return rows;
}

std::vector<Row> figure_18(const Request& request) {
  std::vector<Row> rows;
  Figure figure("figure_18", "Algorithm 2: c and h0 with the same ratio", kTime, kStress);
  const std::string name = "figure 18";
  const Tried a = printed(7e7, 0.01, name, rows), b = printed(7e6, 0.001, name, rows);
  draw(7e6, 0.001, b, figure);
  draw(7e7, 0.01, a, figure);
  add_analytic(figure);
  figure.write(request.directory);
  const double time = a.found.wall_time + b.found.wall_time;
  const std::string both = "figure 18, h0 = .001 against .01";
  rows.push_back(near(both, "mean / mean", b.found.mean / a.found.mean, 1, 0.02, time));
  rows.push_back(near(both, "duration / duration", b.found.duration / a.found.duration, 1, 0.02, time));
  rows.push_back(near(both, "swing / swing", b.found.rms / a.found.rms, 1, 0.2, time));
  rows.back().note = "weakly: mean and duration; not the ringing, nor the step, which falls with sqrt(h0)";
  rows.push_back(near(both, "step / step", b.fraction / a.fraction, 1, 0.2, time));

  ImpactCase parallel;
  parallel.mirror = false;
  parallel.contact = algorithm_2("node_node", 0.001, 7e6);
  parallel.safety = b.fraction > 0 ? b.fraction : 0.05;
  const ImpactFound through = collide(parallel);
  rows.push_back(claim("figure 18, .001, diagonals parallel", "crossings", static_cast<double>(through.crossings), 0, through.crossings == 0, through.wall_time,
                       "without the mirror nodes slide apart by more than h0, and bodies whose nodes alone repel each other pass through"));
  rows.push_back(just("figure 18, .001, diagonals parallel", "restitution", through.restitution, through.wall_time));
  parallel.contact = algorithm_2("node_side", 0.001, 7e6);
  const ImpactFound sides = collide(parallel);
  rows.push_back(claim("figure 18, the same, node-side", "crossings", static_cast<double>(sides.crossings), 0, sides.crossings == 0, sides.wall_time));

  Figure other("figure_18_own", "The package's own contact at the bulk step: c and h0 with the same ratio", kTime, kStress);
  const ImpactFound thick = own(7e7, 0.01), thin = own(7e6, 0.001), thinnest = own(7e4, 1e-5);
  add_stress(other, "c = 7e7, h0 = .01", thick);
  add_stress(other, "c = 7e6, h0 = .001", thin);
  add_stress(other, "c = 7e4, h0 = 1e-5", thinnest);
  add_analytic(other);
  other.write(request.directory);
  for (const ImpactFound* found : {&thin, &thinnest}) {
    const std::string label = found == &thin ? "figure 18, own, h0 .001 against .01" : "figure 18, own, h0 1e-5 against .01";
    rows.push_back(near(label, "mean / mean", found->mean / thick.mean, 1, 0.02, found->wall_time));
    rows.push_back(near(label, "duration / duration", found->duration / thick.duration, 1, 0.02, found->wall_time));
    rows.push_back(near(label, "swing / swing", found->rms / thick.rms, 1, 0.2, found->wall_time));
    rows.push_back(near(label, "steps / steps", static_cast<double>(found->steps) / thick.steps, 1, 0.2, found->wall_time));
  }
  return rows;
}

}  // namespace forming_sim::bench
