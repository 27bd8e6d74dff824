// Coulomb friction feeds the swing of an elastic body that slides: at the rate that the eigenvalues of the linear problem say
// (support/slide_eigenvalues.h), where they say none not at all; and what becomes of it is the same without the package's contact.
#include <gtest/gtest.h>

#include "support/incline_impulses.h"
#include "support/incline_swing.h"
#include "support/runs.h"

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

// Waves that leave and friction that follows with a delay: by the eigenvalues either alone lets some swing grow, both together none.
TEST(SlidingSwing, WavesThatLeaveAndADelayEndItTogether) {
  struct Case {
    int cells, rows;
    double mu;
  };
  double waves_alone = 0, delay_alone = 0;
  for (const Case& c : {Case{3, 1, .49}, Case{6, 2, .49}, Case{8, 4, .2}, Case{8, 4, .3}, Case{8, 4, .49}, Case{12, 6, .1}, Case{12, 6, .49}}) {
    const incline::Block block = incline::sliding_block(c.cells, c.rows, c.mu, 0);
    incline::LevelBlock level(block);
    std::vector<int> base;
    std::vector<double> area;
    const double cell = .6 / c.cells;
    for (std::size_t i = 0; i < level.X.size(); ++i) {
      if (level.X[i][1] > 1e-9) continue;
      base.push_back(static_cast<int>(i));
      area.push_back(std::abs(level.X[i][0]) > .3 - 1e-9 ? cell / 2 : cell);
    }
    const MaterialConfig material = incline::material_of_block();
    const double speed = std::sqrt(material.mu() / material.density);
    slide::Damped damped{true, true, part_that_leaves(c.mu) * material.density * speed, kSteadyTime * .2 / speed};
    const double both = slide::fastest_growth(level.elements, level.X, base, area, c.mu, damped);
    // And with half of that, as much as friction gives.
    damped.impedance = c.mu * material.density * speed;
    EXPECT_LT(slide::fastest_growth(level.elements, level.X, base, area, c.mu, damped), 1e-2);
    damped.impedance = part_that_leaves(c.mu) * material.density * speed;
    damped.delay = false;
    const double waves = slide::fastest_growth(level.elements, level.X, base, area, c.mu, damped);
    damped = {false, true, damped.impedance, damped.time};
    const double delay = slide::fastest_growth(level.elements, level.X, base, area, c.mu, damped);
    damped.delay = false;
    const double neither = slide::fastest_growth(level.elements, level.X, base, area, c.mu, damped);
    const double free = slide::growth(slide::fastest_growing(slide::eigenvalues(level.elements, level.X, base, c.mu)), 0).real();
    std::printf("  %d x %d cells, friction %g: %.2f 1/s, with the delay alone %.2f, with the waves alone %.2g, with both %.2g\n", c.cells, c.rows, c.mu, free, delay, waves, both);
    EXPECT_NEAR(neither, free, 1e-3 * free);
    EXPECT_GT(free, 30);
    EXPECT_LT(both, 1e-2);  // rounding of the motion as a whole
    waves_alone = std::max(waves_alone, waves);
    delay_alone = std::max(delay_alone, delay);

    incline::Block sliding = block;
    sliding.swing = "damped";
    const incline::Found found = incline::rest_or_slide(sliding);
    std::printf("    acceleration/g %.7f, of a rigid one %.7f\n", found.acceleration, incline::exact(sliding));
    EXPECT_NEAR(found.acceleration, incline::exact(sliding), 2e-6);
  }
  EXPECT_GT(delay_alone, 1);
  EXPECT_GT(waves_alone, 10);
}

// An undamped block slides down as a rigid one, and stops as one does; friction free to feed its swing makes it 1.7 to 4.8 times as fast.
TEST(SlidingSwing, DampedABlockSlidesAsARigidOne) {
  incline::Block block;
  block.facets = false;
  block.damping = 0;
  block.mu = .49;
  for (const int cells : {3, 6}) {
    block.cells = cells;
    block.swing = "damped";
    const incline::Found found = incline::rest_or_slide(block);
    block.swing = "free";
    const incline::Found free = incline::rest_or_slide(block);
    std::printf("  %d cells along: acceleration/g %.6f, free %.6f, of a rigid one %.6f\n", cells, found.acceleration, free.acceleration, incline::exact(block));
    EXPECT_NEAR(found.acceleration, incline::exact(block), 1e-4 * incline::exact(block));
    EXPECT_GT(free.acceleration, 1.3 * incline::exact(block));
  }
  block.mu = .51;
  block.swing = "damped";
  block.belt = .01;
  block.after = 1;
  const incline::Found stopped = incline::rest_or_slide(block);
  const double way = stopped.creep + block.belt;
  std::printf("  friction .51: slip after 1 s %.1e m/s, mean %.1e\n", stopped.slip, way);
  EXPECT_LT(std::abs(stopped.slip), 1e-4);
  EXPECT_NEAR(way, block.belt * block.belt / (2 * incline::kGravity * std::cos(std::atan(incline::kTan)) * .01), .1 * way);
}

// A block of square plan has pairs of swings of one frequency. With its motion as a whole, the reference of the waves that leave, read off some of its nodes,
// these fed it: friction .36 to .45 after .6 ms.
TEST(SlidingSwing, DampedABlockOfSquarePlanFeelsWhatItShould) {
  BlankConfig plate;
  plate.shape = "plate";
  plate.length = plate.width = 10e-3;
  plate.thickness = 4e-3;
  plate.cells_along = plate.cells_across = 10;
  plate.cells_through = 4;
  constexpr double kTime = 1e-3;
  OneBody run(body_of(generate_blank(plate), aluminium(false)), kTime);
  run.plan.bodies[0].initial_velocity = Vec3(1, 0, 0);
  run.plan.gravity = Vec3(0, 0, -1000);
  ToolModel floor = plane_at("floor", 3, Vec3::Zero(), Vec3::UnitZ());
  floor.friction = .3;
  run.model.tools.push_back(floor);
  auto sim = run.start();
  while (sim->time() < .5 * kTime) sim->step();
  const Vec3 before = sim->tools()[0].felt.impulse;
  while (sim->step()) {}
  const Vec3 felt = sim->tools()[0].felt.impulse - before;
  std::printf("  friction over force %.5f\n", std::abs(felt.x() / felt.z()));
  EXPECT_NEAR(std::abs(felt.x()), .3 * std::abs(felt.z()), 1e-3 * .3 * std::abs(felt.z()));
  EXPECT_LT(std::abs(sim->balance_error()), 1e-6);
}

// Friction .51 of .5: what rests, stays, but what slides while it swings is not stopped. A block of one cell, whose swings do
// not grow, is; in the same time as a rigid one.
TEST(SlidingSwing, KeepsABlockSlidingThatAtRestWouldStay) {
  incline::Block block;
  block.mu = .51;
  block.facets = false;
  block.damping = 0;
  block.swing = "free";
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
