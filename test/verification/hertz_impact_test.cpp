// An elastic sphere hits a rigid plane: Hertz' impact.
#include <gtest/gtest.h>

#include "support/hertz_sphere.h"

namespace forming_sim {
namespace {

hertz_sphere::Found strike(double gather, double speed) {
  hertz_sphere::Strike given;
  given.cells = 28;
  given.gather = gather;
  given.speed = speed;
  const hertz_sphere::Found found = hertz_sphere::strike(given, 2);
  EXPECT_NEAR(found.mass, 1, 0.08);
  EXPECT_EQ(found.crossings, 0);
  EXPECT_LT(found.balance, 1e-3);
  std::cout << "  " << speed << " m/s: approach " << 100 * (found.approach - 1) << " %, force " << 100 * (found.force - 1) << " %, duration "
            << 100 * (found.duration - 1) << " %, rebound at " << found.rebound << ", " << found.run.steps << " steps, " << found.run.wall_time << " s\n";
  return found;
}

// Hertz takes the bodies for half spaces: right in the limit of a small contact radius a.
// At 1 m/s a/R is .042, at .3 m/s .026, and what is left of the error falls with it.
TEST(HertzImpact, SphereOnARigidPlane) {
  const hertz_sphere::Found fast = strike(6, 1), slow = strike(10, 0.3);
  EXPECT_LT(fast.worst(), 0.015);
  EXPECT_LT(slow.worst(), 0.01);
  EXPECT_LT(std::abs(slow.approach - 1), 0.75 * std::abs(fast.approach - 1));
  EXPECT_LT(std::abs(slow.duration - 1), 0.75 * std::abs(fast.duration - 1));
  EXPECT_GT(fast.rebound, 0.999);
}

}  // namespace
}  // namespace forming_sim
