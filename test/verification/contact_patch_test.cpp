// Two blocks whose meshes do not match, pressed together: the stress is the same everywhere.
#include <gtest/gtest.h>

#include "support/patch.h"

namespace forming_sim {

// Matching meshes carry the exact stress; others come as near to it as the sweeps of a step find the forces of an even pressure.
TEST(ContactPatch, MatchingAndNonMatchingMeshes) {
  for (int dimension : {2, 3})
    for (const auto& [n, m] : {std::pair{4, 4}, std::pair{4, 6}, std::pair{7, 5}, std::pair{14, 10}}) {
      if (dimension == 3 && n > 10) continue;
      patch::Blocks blocks;
      blocks.dimension = dimension;
      blocks.lower = n;
      blocks.upper = m;
      const patch::Found found = patch::press(blocks);
      std::printf("  %dD, %d on %d cells: mean %+.2e, rms %.2e, largest %.2e, balance %.1e\n", dimension, m, n, found.mean - 1, found.spread, found.worst, found.balance);
      const bool match = n == m;
      EXPECT_LT(std::abs(found.mean - 1), match ? 1e-4 : 5e-4) << dimension << "D " << n << " " << m;
      EXPECT_LT(found.spread, match ? 1e-4 : 2e-3) << dimension << "D " << n << " " << m;
      EXPECT_LT(found.worst, match ? 1e-3 : 1e-2) << dimension << "D " << n << " " << m;
      EXPECT_EQ(found.crossings, 0);
      EXPECT_LT(found.balance, 1e-3);
    }
}

}  // namespace forming_sim
