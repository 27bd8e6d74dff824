// Figure 9 and section 3.3: the elastic-plastic spring (3.42)-(3.48) and several of them
// side by side (3.66), (3.67). Its "initial length" X is its memory, which plastic flow moves.
#include <cmath>

#include "paper/figures.h"

namespace forming_sim::bench {
namespace {

struct Spring {
  double E, k;   ///< sigma = E (x/X - 1) (3.42), |x/X - 1| <= k = K/E (3.44)
  double X = 1;  ///< length without force, m

  double force(double x) const { return E * (x / X - 1); }

  /// The spring is led to the length x.
  void lead(double x) {
    if (std::abs(x / X - 1) <= k) return;
    const double limit = x > X ? 1 + k : 1 - k;
    const double a = (x - limit * X) / (limit * (x - X));  // (3.47)
    X = (1 - a) * X + a * x;                               // (3.45), which is x / limit (3.48)
  }
};

struct Springs {
  std::vector<Spring> all;
  void lead(double x) {
    for (Spring& s : all) s.lead(x);
  }
  double force(double x) const {
    double sum = 0;
    for (const Spring& s : all) sum += s.force(x);  // (3.66)
    return sum;
  }
  /// Length at which the forces cancel, nothing yielding on the way.
  double length_without_force() const {
    double E = 0, slope = 0;
    for (const Spring& s : all) {
      E += s.E;
      slope += s.E / s.X;
    }
    return E / slope;
  }
};

/// Strains of a cycle: out to `strain`, back to -`strain` and out again.
template <class Visit> void cycle(double strain, int steps, Visit&& visit) {
  double from = 0;
  for (double to : {strain, -strain, strain}) {
    for (int i = 1; i <= steps; ++i) visit(from + (to - from) * i / steps);
    from = to;
  }
}

}  // namespace

std::vector<Row> figure_9(const Request& request) {
  const Clock clock;
  std::vector<Row> rows;
  constexpr double E = 100e9, k = 0.01, most = 0.035;
  constexpr int n = 3500;
  const auto add = [&](Row row) { row.wall_time = clock.seconds(), rows.push_back(std::move(row)); };

  Figure one("figure_9_spring", "An elastic-plastic spring (3.42)-(3.48)", "x/X0 - 1", "force per area, MPa");
  Spring spring{E, k};
  double plateau = 0, beyond = 0;
  one.add("spring", 0, 0);
  cycle(most, n, [&](double strain) {
    spring.lead(1 + strain);
    const double sigma = spring.force(1 + strain);
    one.add("spring", strain, 1e-6 * sigma);
    beyond = std::max(beyond, std::abs(sigma));
    if (strain == most && plateau == 0) plateau = sigma;
  });
  add(near("figure 9", "one spring: plateau K, Pa", plateau, E * k, 1e-12, 0));
  add(near("figure 9", "one spring: largest |force| of a cycle, Pa", beyond, E * k, 1e-12, 0));
  add(near("figure 9", "one spring: length without force, m", spring.X, (1 + most) / (1 + k), 1e-12, 0));
  for (int i = 0; i <= 20; ++i) {  // unloading from the end of the cycle goes to that length
    const double x = 1 + most + (spring.X - 1 - most) * i / 20;
    one.add("unloading to X (exact)", x - 1, 1e-6 * spring.force(x));
  }
  one.write(request.directory);

  // Three springs of E/3 that yield at .01, .015 and .03.
  Figure figure("figure_9", "Three springs side by side (3.66), (3.67)", "x/X0 - 1", "force per area, MPa");
  const std::vector<double> yields{0.01, 0.015, 0.03};
  Springs springs;
  for (double yield : yields) springs.all.push_back({E / 3, yield});
  std::vector<double> first;  // the force along the first loading
  double envelope = 0;
  figure.add("sum", 0, 0);
  int steps = 0;
  Springs loaded;
  cycle(most, n, [&](double strain) {
    springs.lead(1 + strain);
    figure.add("sum", strain, 1e-6 * springs.force(1 + strain));
    if (++steps > n) return;
    double expected = 0;
    for (double yield : yields) expected += E / 3 * std::min(strain, yield);
    envelope = std::max(envelope, std::abs(springs.force(1 + strain) - expected) / (E / 3 * 0.055));
    first.push_back(springs.force(1 + strain));
    if (steps % 70 == 0) figure.add("piecewise linear (exact)", strain, 1e-6 * expected);
    if (steps == n) loaded = springs;
  });
  add(at_most("figure 9", "three springs: off the lines / plateau", envelope, 1e-12, 0));
  std::size_t kink = 0;
  const double step = most / n;
  for (std::size_t i = 1; i + 1 < first.size(); ++i)
    if (std::abs(first[i + 1] - 2 * first[i] + first[i - 1]) > 1e-3 * E * step && kink < yields.size()) {
      add(near("figure 9", "three springs: kink " + std::to_string(kink + 1) + " at strain", step * static_cast<double>(i + 1), yields[kink], 1e-9, 0));
      ++kink;
    }
  add(near("figure 9", "three springs: kinks of the first loading", static_cast<double>(kink), 3, 0, 0));
  add(near("figure 9", "three springs: last plateau, Pa", first.back(), E / 3 * 0.055, 1e-12, 0));

  // Let go: residual forces that cancel.
  const double rest = loaded.length_without_force();
  Springs released = loaded;
  for (int i = 1; i <= n; ++i) released.lead(1 + most + (rest - 1 - most) * i / n);
  double yielded = 0;
  for (std::size_t i = 0; i < yields.size(); ++i) yielded = std::max(yielded, std::abs(released.all[i].X - loaded.all[i].X));
  add(at_most("figure 9", "let go: X_i moved on the way back, m", yielded, 1e-15, 0));
  add(at_most("figure 9", "let go: sum of forces / plateau", std::abs(released.force(rest)) / first.back(), 1e-12, 0));
  for (std::size_t i = 0; i < yields.size(); ++i) {
    // X_i = (1 + most)/(1 + k_i) since all have yielded, and the sum of E (x/X_i - 1) is zero.
    const double x = 3 * (1 + most) / 3.055;
    const double expected = E / 3 * (x * (1 + yields[i]) / (1 + most) - 1);
    add(near("figure 9", "let go: force of spring " + std::to_string(i + 1) + ", Pa", released.all[i].force(rest), expected, 1e-9, 0));
  }
  add(near("figure 9", "let go: length, m", rest, 3 * (1 + most) / 3.055, 1e-12, 0));
  figure.write(request.directory);
  return rows;
}

}  // namespace forming_sim::bench
