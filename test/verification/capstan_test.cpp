// A thin strip around a drum that turns under it: F2 / F1 = exp(mu theta).
#include <gtest/gtest.h>

#include "support/capstan.h"

namespace forming_sim {

// The strip is not quite thin: friction acts at its inner side, t/2 from its middle, which takes t/(2R) from the exponent.
TEST(Capstan, RightAngleAndHalfTurn) {
  struct Case {
    double mu, degrees;
    int cells;
    double allowed;
  };
  for (const Case& c : {Case{.2, 90, 20, .005}, Case{.2, 90, 40, .005}, Case{.2, 180, 40, .01}, Case{.4, 90, 20, .01}, Case{.4, 180, 40, .02}}) {
    capstan::Strip strip;
    strip.mu = c.mu;
    strip.degrees = c.degrees;
    strip.cells = c.cells;
    const capstan::Found found = capstan::brake(strip);
    const double exact = capstan::exact(strip);
    std::printf("  mu %g, %g degrees, %d cells: F2/F1 %.5f, exact %.6f (%+.2f %%), %ld steps, balance %.1e\n", c.mu, c.degrees, c.cells, found.ratio, exact,
                100 * (found.ratio / exact - 1), found.run.steps, found.balance);
    EXPECT_NEAR(found.ratio, exact, c.allowed * exact) << c.mu << ", " << c.degrees << " degrees";
    EXPECT_EQ(found.crossings, 0);
    EXPECT_LT(found.balance, 1e-3);
  }
}

}  // namespace forming_sim
