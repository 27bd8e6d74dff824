// Coulomb friction feeds the swing of an elastic body that slides: at the rate that the eigenvalues of the linear problem say
// (support/slide_eigenvalues.h), where they say none not at all; and what becomes of it is the same without the package's contact.
#include <gtest/gtest.h>

#include "support/incline_impulses.h"
#include "support/incline_swing.h"

namespace forming_sim {

namespace {
void tell(int cells, int rows, double mu, const incline::Grown& grown) {
  std::printf("  %d x %d cells, friction %g: %.2f 1/s at %.1f rad/s, by steps %.2f at %.1f, found %.2f at %.1f; speed of the swing %.1e to %.1e m/s\n", cells, rows, mu, grown.linear.rate,
              grown.linear.frequency, grown.stepped.rate, grown.stepped.frequency, grown.found.rate, grown.found.frequency, grown.first, grown.last);
}
}  // namespace

TEST(SlidingSwing, GrowsAsTheEigenvaluesSay) {
  struct Case {
    int cells, rows;
    double mu;
    bool facets = false;
  };
  for (const Case& c : {Case{2, 1, .3}, Case{3, 1, .3}, Case{3, 1, .49}, Case{6, 2, .49}, Case{8, 4, .49}, Case{8, 4, .49, true}}) {
    incline::Block block = incline::sliding_block(c.cells, c.rows, c.mu, 0);
    block.facets = c.facets;
    const incline::Grown grown = incline::let_swing(block);
    tell(c.cells, c.rows, c.mu, grown);
    EXPECT_GT(grown.linear.rate, 30);
    EXPECT_NEAR(grown.found.rate, grown.stepped.rate, .01 * grown.stepped.rate);
    EXPECT_NEAR(grown.found.frequency, grown.stepped.frequency, .005 * grown.stepped.frequency);
  }
}

// Friction is an impulse of the step, found with the normal one. It adds no growth of its own: what steps change is what central
// differences change, of second order, and as they become short the rate stays that of the eigenvalues.
TEST(SlidingSwing, IsNotMadeByTheSteps) {
  double longest = 0;  // what the longest steps change
  for (double steps : {.8, .4, .1}) {
    // Of this block one swing alone grows.
    const incline::Grown grown = incline::let_swing(incline::sliding_block(2, 1, .3, 0), steps, 1e-8);
    tell(2, 1, .3, grown);
    const double change = grown.stepped.rate / grown.linear.rate - 1;
    if (longest == 0) longest = change;
    EXPECT_NEAR(change, longest * std::pow(steps / .8, 2), .1 * longest * std::pow(steps / .8, 2));
    EXPECT_NEAR(grown.found.rate, grown.stepped.rate, .003 * grown.stepped.rate);
  }
  EXPECT_GT(longest, .02);  // much more than the .003 of above
}

// Control: without friction, with too little of it, and of a body whose swings it does not couple.
TEST(SlidingSwing, DoesNotGrowWhereTheEigenvaluesAreReal) {
  struct Case {
    int cells, rows;
    double mu;
  };
  for (const Case& c : {Case{2, 1, 0}, Case{8, 4, 0}, Case{2, 1, .1}, Case{3, 1, .1}, Case{1, 1, .49}}) {
    const incline::Grown grown = incline::let_swing(incline::sliding_block(c.cells, c.rows, c.mu, 0));
    tell(c.cells, c.rows, c.mu, grown);
    EXPECT_LT(grown.linear.rate, 1e-3);  // rounding
    EXPECT_LT(grown.last, 50 * grown.first);  // a rate of 10/s would make it 55 times as fast
  }
}

TEST(SlidingSwing, IsEndedByTwiceItsRateOfDamping) {
  for (double share : {.8, 1.2}) {
    incline::Block block = incline::sliding_block(3, 1, .49, 0);
    block.damping = share * incline::let_swing(block).damping;
    const incline::Grown grown = incline::let_swing(block, .4, 1e-8, 1e-6);
    tell(3, 1, .49, grown);
    if (share < 1) {
      EXPECT_NEAR(grown.found.rate, grown.stepped.rate, .03 * grown.stepped.rate);
    } else {
      EXPECT_LT(grown.stepped.rate, 0);
      EXPECT_LT(grown.last, grown.first);
    }
  }
  // A sixth of critical of the slowest swing is not enough for every mesh.
  const incline::Grown finer = incline::let_swing(incline::sliding_block(8, 4, .49, 500));
  tell(8, 4, .49, finer);
  EXPECT_NEAR(finer.found.rate, finer.stepped.rate, .01 * finer.stepped.rate);
}

// Friction .51 of .5: what rests, stays, but what slides while it swings is not stopped. A block of one cell, whose swings do
// not grow, is; in the same time as a rigid one.
TEST(SlidingSwing, KeepsABlockSlidingThatAtRestWouldStay) {
  incline::Block block;
  block.mu = .51;
  block.facets = false;
  block.damping = 0;
  block.after = 1;
  for (double belt : {0., .01})
    for (int cells : {1, 3}) {
      block.cells = cells;
      block.belt = belt;
      const bool swings = cells == 3 && belt > 0;
      const incline::BothWays both = incline::both_ways(block, .4, swings ? 16 : 1);
      const double found = both.found.slip, other = both.by_impulses.slip, way = both.found.creep + belt, other_way = both.by_impulses.creep + belt;
      std::printf("  %d x 1 cells on a belt of %g m/s: slip after 1 s %.1e m/s, by impulses %.1e; mean %.1e and %.1e\n", cells, belt, found, other, way, other_way);
      if (swings) {
        EXPECT_GT(found, .02);
        EXPECT_GT(other, .02);
        EXPECT_NEAR(way, other_way, .2 * other_way);
      } else {
        const double still = belt == 0 ? 1e-7 : 1e-4;
        EXPECT_LT(std::abs(found), still);
        EXPECT_LT(std::abs(other), still);
        // Until then it has slowed down evenly.
        EXPECT_NEAR(way, belt * belt / (2 * incline::kGravity * std::cos(std::atan(incline::kTan)) * (block.mu - incline::kTan)), .05 * way + 1e-7);
      }
    }
}

}  // namespace forming_sim
