// An elastic block on an incline of tan = .5: with friction .5 it sticks, with .49 it slides as a rigid body does.
#include <gtest/gtest.h>

#include "support/incline.h"

namespace forming_sim {

TEST(Incline, StickingAndSlidingBlock) {
  for (int dimension : {2, 3})
    for (double mu : {.5, .49}) {
      incline::Block block;
      block.dimension = dimension;
      block.mu = mu;
      if (mu < .5) {
        block.belt = .5;
        block.damping = 0;
      }
      const incline::Found found = incline::rest_or_slide(block);
      const double exact = incline::exact(block);
      std::printf("  %dD, friction %g: a/g %.7f (exact %.7f), creep %.1e m/s, tangential / normal %.8f\n", dimension, mu, found.acceleration, exact, found.creep, found.ratio);
      // At the very limit, what friction holds sideways against the spreading of the block in space it lacks along the slope.
      EXPECT_NEAR(found.acceleration, exact, 1e-4) << dimension << "D " << mu;
      if (exact == 0) {
        EXPECT_LT(std::abs(found.creep), 1e-5) << dimension << "D";
      } else {
        EXPECT_NEAR(found.acceleration, exact, 1e-3 * exact) << dimension << "D";
        EXPECT_NEAR(found.ratio, mu, 1e-6) << dimension << "D";
      }
      EXPECT_EQ(found.crossings, 0);
    }
}

}  // namespace forming_sim
