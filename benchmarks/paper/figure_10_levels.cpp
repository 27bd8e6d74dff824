// Figures 10 and 11: two and five levels of perfect plasticity at a point in tension with
// free sides, one cycle and three, with the law as printed (3.5), (3.68)-(3.70).
//
// The paper gives no strain range. Chosen here: nominal strain .03 both ways for two levels
// and .06 for five, just beyond their last kinks; steps of at most 1e-5.
// Compared with benchmarks/data/*_levels.csv: the same law in the limit of small steps, as an
// ordinary differential equation (benchmarks/paper/point_by_ode.py; its first line is the
// command), and the overlay of small strain.
#include <cmath>

#include "figures.h"
#include "levels.h"
#include "table.h"

namespace forming_sim::bench {
namespace {

struct Levels {
  const char* figure;
  const char* file;
  std::vector<double> limits;
};

constexpr double kStep = 1e-5;

/// Kinks of a curve told point by point: where the slope falls by more than 2 % of E within
/// three steps, the lines before and after meet.
class KinkFinder {
 public:
  void see(double strain, double stress) {
    points_.push_back({strain, stress});
    const std::size_t n = points_.size() - 1;
    if (n < 4 || n < last_ + 5) return;
    const double before = slope(n - 4), after = slope(n - 1), fall = before - after;
    if (fall < 0.02 * kPaperE || std::fabs(slope(n - 2) - after) > 0.02 * fall) return;
    last_ = n;
    const auto [x, y] = points_[n - 4];
    const double meet = (stress - after * strain - y + before * x) / fall;
    kinks.push_back({meet, y + before * (meet - x)});
  }
  std::vector<std::pair<double, double>> kinks;  ///< strain, stress

 private:
  double slope(std::size_t i) const { return (points_[i + 1].second - points_[i].second) / (points_[i + 1].first - points_[i].first); }
  std::vector<std::pair<double, double>> points_;
  std::size_t last_ = 0;
};

/// Small strain, after (3.68)-(3.70): eps_k = [2 (1+nu) Y_k + (1-2nu) sigma_k] / (3E), levels of equal weight.
double kink_strain(const std::vector<double>& limits, std::size_t k) {
  double sigma = 0;
  for (std::size_t i = 0; i < limits.size(); ++i) sigma += kPaperE * std::min(limits[i], limits[k]) / static_cast<double>(limits.size());
  return (2 * (1 + kPaperNu) * kPaperE * limits[k] + (1 - 2 * kPaperNu) * sigma) / (3 * kPaperE);
}

std::vector<Row> levels_figure(const Request& request, const Levels& levels) {
  const Clock clock;
  const Table exact = read_table(share_file(std::string("benchmarks/data/") + levels.file));
  const int strain = exact.at("strain"), stress = exact.at("stress_Pa"), small = exact.at("small_strain_stress_Pa"), level = exact.at("level");
  const std::string number = levels.figure, what = "Figure " + number + ": " + (levels.limits.size() == 2 ? "two" : "five") + " levels";
  Figure one("figure_" + number, what + ", one cycle", "nominal strain x/X - 1", "axial stress, MPa");
  Figure three("figure_" + number + "_cycles", what + ", three cycles", "nominal strain x/X - 1", "axial stress, MPa");
  Figure difference("figure_" + number + "_difference", what + ", from the ordinary differential equation", "nominal strain x/X - 1", "difference of stress, MPa");

  Pull pull(paper_material(levels.limits));
  KinkFinder there, back;
  std::vector<std::pair<double, double>> turns{{0, 0}};  // strain and stress at reversals
  std::vector<double> even;                              // stresses at the even rows, for the loops
  double peak = 0, off = 0, from_small = 0, at_15 = kNothing, last_strain = 0, way = 1;
  for (const std::vector<double>& row : exact.rows) {
    if ((row[strain] - last_strain) * way < 0) {
      turns.emplace_back(pull.strain(), pull.stress());
      way = -way;
    }
    pull.to(row[strain], kStep, [&](double e, double s) {
      if (turns.size() == 1) there.see(e, s);
      if (turns.size() == 2) back.see(-e, -s);
    });
    last_strain = row[strain];
    const double found = pull.stress();
    if (row[level] == 0) even.push_back(found);
    if (row[level] == 0 && turns.size() == 1 && std::fabs(row[strain] - 0.015) < 1e-12) at_15 = found;
    peak = std::max(peak, std::fabs(row[stress]));
    off = std::max(off, std::fabs(found - row[stress]));
    from_small = std::max(from_small, std::fabs(found - row[small]));
    Figure* curves[] = {turns.size() <= 3 ? &one : nullptr, &three};
    for (Figure* figure : curves) {
      if (!figure) continue;
      figure->add("package", row[strain], found / 1e6);
      figure->add("differential equation, exact", row[strain], row[stress] / 1e6);
      figure->add("small-strain overlay, expected", row[strain], row[small] / 1e6);
    }
    difference.add("small-strain overlay", row[strain], (row[small] - row[stress]) / 1e6);
    difference.add("package, steps of 1e-5", row[strain], (found - row[stress]) / 1e6);
  }
  for (Figure* figure : {&one, &three, &difference}) figure->write(request.directory);

  const double time = clock.seconds();
  const std::string name = "figure " + number;
  std::vector<Row> rows;
  for (std::size_t k = 0; k < levels.limits.size(); ++k)
    rows.push_back(near(name, "kink " + std::to_string(k + 1) + ", strain", k < there.kinks.size() ? there.kinks[k].first : kNothing,
                        kink_strain(levels.limits, k), 0.005, time));
  rows[0].note = "expected: small strain; the finite strain of the law moves the kinks by up to .2 %";
  if (levels.limits.size() == 2) rows.push_back(near(name, "stress at strain .015, Pa", at_15, 1254.61e6, 1e-5, time));
  rows.push_back(near(name, "stress at d, Pa", turns[1].second, kPaperE * [&] {
    double sum = 0;
    for (double limit : levels.limits) sum += limit / static_cast<double>(levels.limits.size());
    return sum;
  }(), 1e-4, time));
  // Seen from below: the finder was given -stress on the way back.
  const double reverse = back.kinks.empty() ? kNothing : std::fabs(back.kinks[0].second);
  rows.push_back(at_most(name, "Bauschinger: |stress at e| over at d", reverse / turns[1].second, 1, time));
  // The even rows: the start, a quarter of a loop, then three loops.
  const std::size_t quarter = (even.size() - 1) / 13, loop = 4 * quarter;
  double second = 0, third = 0;
  for (std::size_t i = 0; i < loop; ++i) {
    second = std::max(second, std::fabs(even[1 + quarter + loop + i] - even[1 + quarter + i]));
    third = std::max(third, std::fabs(even[1 + quarter + 2 * loop + i] - even[1 + quarter + loop + i]));
  }
  rows.push_back(just(name, "loop 2 from loop 1, part of the peak", second / peak, time));
  rows.push_back(at_most(name, "loop 3 from loop 2, part of the peak", third / peak, 1e-3, time));
  rows.back().note = "the paper gives no number; 1e-3 is chosen here. The loops of the differential equation differ as much: finite strain shakes down over a few cycles";
  rows.push_back(at_most(name, "package from the ODE, part of the peak", off / peak, 1e-6, time));
  rows.push_back(just(name, "overlay of small strain: off by, Pa", from_small, time));
  rows.back().note = "both over the nominal strain; over the log strain the overlay would be off by 11 MPa (two levels), 52 MPa (five)";
  return rows;
}

}  // namespace

std::vector<Row> figure_10(const Request& request) { return levels_figure(request, {"10", "two_levels.csv", {.01, .02}}); }
std::vector<Row> figure_11(const Request& request) { return levels_figure(request, {"11", "five_levels.csv", {.01, .02, .03, .04, .05}}); }

}  // namespace forming_sim::bench
