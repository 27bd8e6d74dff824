// The bent sheet by CalculiX: static, the same column of bricks between two sections
// that stay plane. The far one is held in the plane through three points that turn
// about its middle; the near one may move along the sheet as a whole, so that there is
// no pull. The moment is that of the near section's nodal forces. Elements C3D8 lock in
// bending (moment + 88 % at 4 through, + 23 % at 8) and are left out.
#include <cmath>
#include <sstream>

#include "speed_error/peers.h"

namespace forming_sim::bench {
namespace {

constexpr double kReach = 10;  ///< of the three points, in thicknesses

/// A step that turns the far section from one angle to another: the points at -+ kReach t
/// move by kReach t (+-sin, +-(1 - cos)) of the angle.
std::string turning(const std::string& name, double from, double to, int lower, int upper, int beside) {
  std::ostringstream text;
  text.precision(12);
  constexpr int knots = 50;
  for (const bool sine : {true, false}) {
    text << "*AMPLITUDE, NAME=" << name << (sine ? "_S" : "_C") << "\n";
    for (int k = 0; k <= knots; ++k) {
      const double s = static_cast<double>(k) / knots, angle = from + (to - from) * s;
      text << s << ", " << (sine ? std::sin(angle) : 1 - std::cos(angle)) << "\n";
    }
  }
  const double arm = kReach * 1e3 * kSheetThickness;
  text << "*STEP, NLGEOM, INC=1000\n*STATIC\n0.02, 1., 1e-6, 0.02\n";
  for (const auto& [point, sign] : {std::pair<int, int>{lower, 1}, {upper, -1}})
    text << "*BOUNDARY, AMPLITUDE=" << name << "_S\n" << point << ", 1, 1, " << sign * arm << "\n*BOUNDARY, AMPLITUDE=" << name << "_C\n"
         << point << ", 2, 2, " << sign * arm << "\n";
  text << "*BOUNDARY\n" << beside << ", 1, 2\n*NODE PRINT, NSET=left\nU, RF\n*END STEP\n";
  return text.str();
}

}  // namespace

void bending_by_calculix(Report& report, const ExactBend& exact, const MaterialConfig& material) {
  if (!calculix_or_say(report)) return;
  for (const std::string type : {"C3D8I", "C3D20R"})
    for (int cells : {2, 4, 8}) {
      const double t = kSheetThickness, length = t / cells, angle = exact.kt / t * length;
      BlankConfig blank = strip_of(length, t, 1, cells);
      blank.origin = Vec3(0, -0.5 * t, 0);
      blank.pattern = "coarse";
      Deck deck(generate_blank(blank), type, length);
      deck.material(material);
      const int lower = deck.point(Vec3(length, -kReach * t, 0)), upper = deck.point(Vec3(length, kReach * t, 0)), beside = deck.point(Vec3(length, 0, kReach * t));
      const std::vector<int> left = deck.set("left"), right = deck.set("right");
      std::ostringstream held;
      held << "*BOUNDARY\n" << left[0] << ", 2, 2\n*EQUATION\n";
      for (std::size_t i = 1; i < left.size(); ++i) held << "2\n" << left[i] << ", 1, 1., " << left[0] << ", 1, -1.\n";
      for (std::size_t i = 0; i < right.size(); ++i) {
        if (i % 12 == 0) held << "*MPC\nPLANE, " << lower << ", " << upper << ", " << beside;
        held << ", " << right[i] << (i % 12 == 11 || i + 1 == right.size() ? "\n" : "");
      }
      // The way back is half as long again as an elastic sheet would need.
      const double stiffness = material.youngs_modulus / (1 - std::pow(material.poissons_ratio, 2));
      const double back = 1.5 * 12 * exact.moment / (stiffness * std::pow(t, 3)) * length;
      deck.steps = held.str() + turning("BEND", 0, angle, lower, upper, beside) + turning("BACK", angle, angle - back, lower, upper, beside);
      const std::string choice = "CalculiX " + type, mesh = std::to_string(cells) + " through", name = std::to_string(cells) + "_" + type;
      const CalculixRun run(deck, "bending_" + material.hardening->curve + "_" + name, report.request());
      if (run.failed()) {
        report.no_answer(choice + ", " + mesh, run.failure(), run.wall_time(), false);
        continue;
      }
      // Moment over total time: 1 when bent, then back to where it vanishes.
      double bent = 0, after = angle, time = 0, moment = 0;
      const std::vector<Printed>& tables = run.printed();
      for (std::size_t k = 1; k < tables.size(); ++k) {
        const Printed &table = tables[k], &moved = tables[k - 1];  // forces, displacements
        if (table.what != "forces") continue;
        double now = 0;
        for (std::size_t i = 0; i < table.rows.size(); ++i)
          now += table.rows[i].at(1) * (deck.place(static_cast<int>(table.rows[i][0])).y() + moved.rows.at(i).at(2)) / (1e3 * length);
        if (table.time < 1 + 1e-9) bent = now;
        else if (moment > 0 && now <= 0) after = angle - back * (time - 1 + (table.time - time) * moment / (moment - now));
        moment = now;
        time = table.time;
      }
      RunSize size = deck.size();
      size.steps = run.increments();
      size.wall_time = run.wall_time();
      report.add({choice, mesh, size, {bent, 1 - after / angle}});
    }
}

}  // namespace forming_sim::bench
