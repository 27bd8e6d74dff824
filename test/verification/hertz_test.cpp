// A cylinder pressed on a rigid plane, and on another cylinder, against Hertz.
#include <gtest/gtest.h>

#include "support/hertz_line.h"

namespace forming_sim {

TEST(Hertz, CylinderOnAPlane) {
  struct Allowed {
    double cells, half_width, middle, shape;
  };
  for (const Allowed& allowed : {Allowed{4, .02, .01, .03}, Allowed{8, .005, .005, .015}}) {
    hertz_line::Press given;
    given.cells = allowed.cells;
    const hertz_line::Found found = hertz_line::press(given);
    std::printf("  %g cells across a: %.1f N/mm, half width %+.2f %%, pressure in the middle %+.2f %%, rms %.2f %% of p0; %ld steps, balance %.1e\n", allowed.cells,
                found.force / 1e3, 100 * (found.half_width - 1), 100 * (found.middle - 1), 100 * found.shape, found.run.steps, found.balance);
    EXPECT_NEAR(found.force, 1e5, .1e5);
    EXPECT_NEAR(found.half_width, 1, allowed.half_width);
    EXPECT_NEAR(found.middle, 1, allowed.middle);
    EXPECT_LT(found.shape, allowed.shape);
    EXPECT_EQ(found.crossings, 0);
    EXPECT_LT(found.balance, 1e-4);
  }
}

}  // namespace forming_sim
