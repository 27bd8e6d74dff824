// Bending and springback of a sheet against exact values, and how fast they are reached.
#include <gtest/gtest.h>

#include "support/column.h"

namespace forming_sim {
namespace {

struct Allowed {
  int cells;
  double moment, thickness, after;  ///< relative, mm, 1
};
/// Square cells through the thickness. The sheet thins by the shift of its neutral
/// axis, which is less than a cell for 4 and 8 of them: thickness converges last.
constexpr Allowed kAllowed[] = {{4, 0.012, 0.0045, 0.0006}, {8, 0.009, 0.0035, 0.0003}, {16, 0.004, 0.0012, 0.0002}};

void expect_bend(int dimension, const ExactBend& exact, const MaterialConfig& material) {
  for (const Allowed& allowed : kAllowed) {
    const Bend b = bend(dimension, exact.kt, allowed.cells, 1, material);
    std::printf("  %dD, k t %.2f, %d cells: M %.3f N (%+.2f %%), thickness %.5f mm (%+.5f), k_after/k %.5f (%+.5f)\n", dimension, exact.kt,
                allowed.cells, b.moment, 100 * (b.moment / exact.moment - 1), b.thickness * 1e3, b.thickness * 1e3 - exact.thickness, b.after,
                b.after - exact.after);
    EXPECT_NEAR(b.moment, exact.moment, allowed.moment * exact.moment);
    EXPECT_NEAR(b.thickness * 1e3, exact.thickness, allowed.thickness);
    EXPECT_NEAR(b.after, exact.after, allowed.after);
    if (dimension == 3) break;  // more cells take too long here; the kernels are the same
  }
}

TEST(Bending, HardeningSheet) {
  for (const ExactBend& exact : kVoceBends) expect_bend(2, exact, aluminium(true));
}
TEST(Bending, PerfectlyPlasticSheet) {
  MaterialConfig material = aluminium(true);
  material.hardening->curve = "perfect";
  for (const ExactBend& exact : kPerfectBends) expect_bend(2, exact, material);
}

// One-point cells, as long as they are high and several times longer, in 2D and 3D alike. Chords of long cells stand for
// the arc: 8 times longer, a cell turns by 11 degrees.
TEST(Bending, HardeningSheetOfOnePointCells) {
  struct Case {
    int cells;
    double aspect, moment, after;
  };
  const ExactBend& exact = kVoceBends[1];
  for (int dimension : {2, 3})
    for (const Case& c : {Case{2, 1, 0.035, 0.0015}, {4, 1, 0.015, 0.0003}, {8, 1, 0.007, 0.0002}, {4, 4, 0.025, 0.0006}, {8, 4, 0.01, 0.0004}, {8, 8, 0.02, 0.001}}) {
      const Bend b = bend(dimension, exact.kt, c.cells, c.aspect, aluminium(true), "one_point");
      std::printf("  %dD, %d cells, %g times longer: M %+.2f %%, k_after/k %+.5f\n", dimension, c.cells, c.aspect, 100 * (b.moment / exact.moment - 1), b.after - exact.after);
      EXPECT_NEAR(b.moment, exact.moment, c.moment * exact.moment);
      EXPECT_NEAR(b.after, exact.after, c.after);
    }
}
TEST(Bending, HardeningSheetOfTetrahedra) { expect_bend(3, kVoceBends[1], aluminium(true)); }

}  // namespace
}  // namespace forming_sim
