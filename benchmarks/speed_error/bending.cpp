// A sheet bent evenly and let go (plane strain): error of its moment and of its
// springback. One column of cells between two sections that stay plane, test/support/column.h;
// of the same length of sheet it would take as many as there are cells through it,
// a quarter of them where the cells are four times as long as high. Free simplices fill a piece as long as thick.
#include "speed_error/families.h"
#include "speed_error/peers.h"
#include "speed_error/problems.h"
#include "support/column.h"

namespace forming_sim::bench {
namespace {

struct Sheet {
  const char* name;
  ExactBend exact;
  const char* curve;
};

MaterialConfig material_of(const Sheet& sheet) {
  MaterialConfig material = aluminium(true);
  material.hardening->curve = sheet.curve;
  return material;
}

Finished bent(const Sheet& sheet, const Family& family, int cells, double aspect, int steps_per_cell) {
  const Clock clock;
  const Bend b = bend(family.dimension, sheet.exact.kt, cells, aspect, material_of(sheet), family.pattern, family.average, steps_per_cell);
  return {family.name, std::to_string(cells) + " through", size_of(b.mesh, b.steps, clock.seconds()), {b.moment, 1 - b.after}};
}

}  // namespace

void bending_problem(Report& report) {
  const Sheet sheets[] = {{"bending", kVoceBends[1], "voce"}, {"bending perfect", kPerfectBends[1], "perfect"}};
  for (const Sheet& sheet : sheets) {
    char title[128];
    std::snprintf(title, sizeof title, "6111-T4 sheet, %s, bent to k t = %g and let go", sheet.curve, sheet.exact.kt);
    report.begin(sheet.name, title, {{"moment, N", sheet.exact.moment, 0.02}, {"springback, 1 - k_after/k", 1 - sheet.exact.after, 0.02}});
    const bool hardening = sheet.curve == std::string("voce");
    for (const Family& family : kFamilies)
      for (double aspect : {1., 4., 8.}) {
        if (aspect > 1 && (!hardening || is_free(family))) continue;
        if (aspect > 4 && family.pattern != std::string("one_point")) continue;
        for (int cells : {2, 4, 8, 16}) {
          if (cells > 8 && (family.dimension == 3 || aspect > 1)) continue;
          Finished run = bent(sheet, family, cells, aspect, 4000);
          if (aspect > 1) run.choice += ", " + std::to_string(static_cast<int>(aspect)) + " times as long as high";
          report.add(run);
        }
      }
    // Slow motion is what makes it quasi-static: how slow need it be?
    for (int cells : {2, 4, 8, 16}) {
      Finished run = bent(sheet, kFamilies[0], cells, 1, 1000);
      run.choice += ", 4 times as fast";
      report.add(run);
    }
    bending_by_calculix(report, sheet.exact, material_of(sheet));
  }
}

}  // namespace forming_sim::bench
