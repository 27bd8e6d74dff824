// Figure 4: quasi-hardening (3.63), eps_s = .01, eps_s' = .1, at a point in tension with
// free sides. In stress it is linear isotropic hardening, a q_S = E (eps_s + eps_s' p).
//
// The paper gives no strain range. Chosen here: nominal strain .03 both ways, as in figure
// 3, and cycles whose half has a plastic strain of .04, in steps of 1e-4.
//
// What is unbounded depends on what is held. With the plastic strain of a cycle held, the
// peak grows by E eps_s' times it in every cycle. With the strain held, the range left to
// plastic flow shrinks as the peak grows, and the peak tends to E times the amplitude.
#include <cmath>

#include "figures.h"
#include "levels.h"

namespace forming_sim::bench {
namespace {

constexpr double kLimit = 0.01, kGrowth = 0.1, kStep = 1e-4, kAmplitude = 0.03, kPlasticHalf = 0.04;
constexpr int kCycles = 12;

MaterialConfig quasi_hardening() {
  MaterialConfig m = paper_material({kLimit});
  m.hardening->curve = "linear";
  m.hardening->modulus = kPaperE * kGrowth;
  return m;
}

/// Stress at the tension peak of every cycle between two strains.
std::vector<double> peaks_at_fixed_strain(const MaterialConfig& material, Figure* figure, const char* series) {
  Pull pull(material);
  std::vector<double> peaks;
  const auto see = [&](double strain, double stress) {
    if (figure) figure->add(series, strain, stress / 1e6);
  };
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    pull.to(kAmplitude, kStep, see);
    peaks.push_back(pull.stress());
    pull.to(-kAmplitude, kStep, see);
  }
  return peaks;
}

/// The same where every half cycle goes on until the plastic strain has grown by kPlasticHalf.
std::vector<double> peaks_at_fixed_plastic_strain(Figure& figure, const char* series) {
  Pull pull(quasi_hardening());
  std::vector<double> peaks;
  for (int half = 0; half < 2 * kCycles; ++half) {
    const double way = half % 2 == 0 ? kStep : -kStep, from = pull.point().plastic_strain();
    while (pull.point().plastic_strain() - from < kPlasticHalf) {
      pull.to(pull.strain() + way, kStep);
      figure.add(series, pull.strain(), pull.stress() / 1e6);
    }
    if (half % 2 == 0) peaks.push_back(pull.stress());
  }
  return peaks;
}

}  // namespace

std::vector<Row> figure_4(const Request& request) {
  const Clock clock;
  Figure one("figure_04", "Figure 4: quasi-hardening, one cycle", "nominal strain x/X - 1", "axial stress, MPa");
  Pull pull(quasi_hardening());
  std::vector<std::pair<double, double>> first;
  for (double turn : {kAmplitude, -kAmplitude, kAmplitude})
    pull.to(turn, kStep, [&](double strain, double stress) {
      one.add("eps_s' = .1", strain, stress / 1e6);
      first.emplace_back(strain, stress);
    });
  one.write(request.directory);
  const auto at = [&](double strain) { return first[static_cast<std::size_t>(std::lround(strain / kStep)) - 1]; };
  const double slope = (at(0.029).second - at(0.015).second) / (std::log1p(0.029) - std::log1p(0.015));

  Figure many("figure_04_cycles", "Figure 4: quasi-hardening, twelve cycles", "nominal strain x/X - 1", "axial stress, MPa");
  const std::vector<double> plastic = peaks_at_fixed_plastic_strain(many, "plastic strain .04 each way");
  const std::vector<double> total = peaks_at_fixed_strain(quasi_hardening(), &many, "strain .03 each way");
  many.write(request.directory);
  const std::vector<double> levels = peaks_at_fixed_strain(paper_material({.01, .02}), nullptr, "");
  Figure peaks("figure_04_peaks", "Figure 4: stress at the tension peak of every cycle", "cycle", "axial stress, MPa");
  for (int k = 0; k < kCycles; ++k) {
    peaks.add("quasi-hardening, plastic strain .04 each way", k + 1, plastic[k] / 1e6);
    peaks.add("quasi-hardening, strain .03 each way", k + 1, total[k] / 1e6);
    peaks.add("two levels, strain .03 each way", k + 1, levels[k] / 1e6);
    peaks.add("E times .03, expected limit", k + 1, kPaperE * kAmplitude / 1e6);
  }
  peaks.write(request.directory);

  const double time = clock.seconds();
  const std::string name = "figure 4";
  std::vector<Row> rows;
  // Small strain: sigma = E (eps_s + eps_s' (eps - sigma/E)); the strain is that of logarithms.
  const double modulus = kPaperE * kGrowth / (1 + kGrowth);
  rows.push_back(near(name, "slope of bc, Pa", slope, modulus, 0.02, time));
  rows.push_back(near(name, "stress at c, first peak, Pa", total[0], modulus * (kLimit / kGrowth + std::log1p(kAmplitude)), 0.005, time));
  rows.push_back(just(name, "second peak, Pa", total[1], time));
  rows.push_back(just(name, "third peak, Pa", total[2], time));
  rows.push_back(near(name, "growth a cycle, plastic strain held, Pa", (plastic[kCycles - 1] - plastic[1]) / (kCycles - 2),
                      kPaperE * kGrowth * 2 * kPlasticHalf, 0.01, time));
  rows.back().note = "the same in every cycle, first " + std::to_string(std::lround((plastic[1] - plastic[0]) / 1e6)) + ", last " +
                     std::to_string(std::lround((plastic[kCycles - 1] - plastic[kCycles - 2]) / 1e6)) + " MPa: unbounded";
  Row held{name, "last growth over first, strain held", (total[kCycles - 1] - total[kCycles - 2]) / (total[1] - total[0]), 1, kNothing, time, true, ""};
  held.error = held.found - 1;
  held.holds = held.found > 0.99;
  held.note = "with the strain held at .03 the growth is not unbounded: it dies away, the peak of cycle " + std::to_string(kCycles) + " is " +
              std::to_string(std::lround(total[kCycles - 1] / 1e6)) + " MPa, and the limit is E times .03";
  rows.push_back(held);
  rows.push_back(just(name, "two levels: 12th over 1st peak", levels[kCycles - 1] / levels[0], time));
  return rows;
}

}  // namespace forming_sim::bench
