// What swings freely for long keeps its energy, with the default time step.
#include <gtest/gtest.h>

#include "forming_sim/simulation/steady_step.h"
#include "support/runs.h"

namespace forming_sim {
namespace {

BlankConfig plate(const char* pattern, double length, double width, double thickness, int along, int across, int through) {
  BlankConfig blank = strip_of(length, thickness, along, through);
  blank.shape = "plate";
  blank.width = width;
  blank.cells_across = across;
  blank.pattern = pattern;
  return blank;
}

}  // namespace

// Steps that followed the limit of the mesh made some ten times the work in such a time.
TEST(FreeSwing, OfABlockUnderAPressureThatIsThereAtOnce) {
  const double side = 10e-3;
  OneBody run(body_of(generate_blank(plate("coarse", side, side, side, 3, 3, 3)), aluminium()), 40e-3);
  PressureConfig pressure;
  pressure.set = "top";
  pressure.times = {0};
  pressure.values = {100e6};
  run.plan.bodies[0].pressures = {pressure};
  run.plan.bodies[0].boundaries = {symmetric("bottom", Vec3::UnitZ())};
  auto sim = run.start();
  ASSERT_EQ(sim->plan().time_step.limit, "global");
  while (sim->step()) {
  }
  std::printf("  %ld steps, ledger open by %.2g\n", sim->steps(), sim->balance_error());
  EXPECT_GT(sim->steps(), 100000);
  EXPECT_LT(sim->balance_error(), 1e-3);
  EXPECT_EQ(sim->step_limit_cost().shortened, 0);
}

// What came from nowhere flowed: a plate that had been pulled and let go found 50 to 130 % more plastic work, and strains of 1.
TEST(FreeSwing, OfAPlateThatHasBeenPulledBeyondYieldMakesItFlowNoMore) {
  for (const char* pattern : {"one_point", "coarse"}) {
    OneBody run(body_of(generate_blank(plate(pattern, 20e-3, 10e-3, 5e-3, 8, 4, 2)), aluminium(true)), 40e-6);
    pull_right(run, {0}, {Vec3(10, 0, 0)});
    run.plan.bodies[0].boundaries[1].until = "free";
    run.plan.stages.push_back(form_for(40e-3));
    run.plan.stages[1].name = "free";
    run.plan.stages[1].release = "sudden";
    auto sim = run.start();
    while (sim->step()) {
    }
    const Energies& e = sim->energies();
    std::printf("  %s: %ld steps, plastic work %.4g J of %.4g J, ledger open by %.2g\n", pattern, sim->steps(), e.plastic, e.work, sim->balance_error());
    EXPECT_LT(sim->balance_error(), .01) << pattern;
    EXPECT_LT(e.plastic, e.work) << pattern;
    EXPECT_EQ(sim->step_limit_cost().shortened, 0) << pattern;
  }
}

TEST(SteadyStep, ChangesLittleFromOneStepToTheNext) {
  SteadyStep step;
  EXPECT_EQ(step.follow(1), 1) << "it begins at its limit";
  EXPECT_EQ(step.follow(1.015), 1) << "a limit that comes and goes by less than its band changes nothing";
  const double rises = step.follow(1.03);
  EXPECT_GT(rises, 1);
  EXPECT_LT(rises, 1.001);
  double dt = rises;
  for (int k = 0; k < 1000; ++k) dt = step.follow(1.03);
  EXPECT_EQ(dt, 1.03) << "once it rises it comes to its limit";
  const double falls = step.follow(1.029);
  EXPECT_LT(falls, 1.03);
  EXPECT_GT(falls, 1.029) << "what falls by little is met by and by";
  EXPECT_NEAR(step.follow(.5), .505, 1e-12) << "and at once by all but a hundredth";
  for (int k = 0; k < 100; ++k) dt = step.follow(.5);
  EXPECT_EQ(dt, .5);
}

}  // namespace forming_sim
