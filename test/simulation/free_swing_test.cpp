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
  }
}

// The limit of rubber that swings by large strains comes and goes: steps that went after it left a ledger that was open by .8 %.
TEST(FreeSwing, OfRubberByLargeStrains) {
  MaterialConfig soft = rubber(1e8);
  soft.h1 = 1e6, soft.h2 = .5e6;
  OneBody run(body_of(generate_blank(strip_of(10e-3, 10e-3, 3, 3)), soft), 0.3);
  run.plan.bodies[0].initial_velocity_field = {"10*(x/.005-1)", "-10*(y/.005-1)"};
  run.plan.time_step.limit = "global";
  auto sim = run.start();
  while (sim->step()) {
  }
  std::printf("  %ld steps, ledger open by %.2g\n", sim->steps(), sim->balance_error());
  EXPECT_GT(sim->steps(), 30000);
  EXPECT_LT(sim->balance_error(), 2e-3);
}

TEST(SteadyStep, IsWhatTheMeshHasBorneForLong) {
  SteadyStep step;
  EXPECT_EQ(step.follow(1), 1) << "it begins at its limit";
  for (int k = 0; k < 5000; ++k) EXPECT_EQ(step.follow(1.2 - .2 * std::cos(2 * M_PI * k / 100)), 1) << "what comes and goes within its memory changes nothing";
  for (int k = 0; k < 5000; ++k) EXPECT_EQ(step.follow(1.015), 1) << "nor what is little";
  for (int k = 0; k < SteadyStep::kAtFirst; ++k) EXPECT_EQ(step.follow(1.5), 1);
  double dt = 1;
  for (int k = 0; k < 2000; ++k) {
    const double before = dt;
    dt = step.follow(1.5);
    EXPECT_LE(dt, 1.0011 * before);
  }
  EXPECT_EQ(dt, 1.5) << "what stays is gone after";
}

// A limit that comes and goes every 1200 steps: its memory becomes longer than that, and the step stays.
TEST(SteadyStep, RemembersForLongerWhatComesAndGoes) {
  SteadyStep step;
  const auto limit = [](int k) { return 1.2 - .2 * std::cos(2 * M_PI * k / 1200); };
  double most = 0;
  for (int k = 0; k < 6000; ++k) most = std::max(most, step.follow(limit(k)));
  EXPECT_GT(most, 1.02);
  const double least = step.follow(limit(6000));
  for (int k = 6001; k < 20000; ++k) EXPECT_NEAR(step.follow(limit(k)), least, 1e-12);
  EXPECT_NEAR(least, 1, 1e-3);
}

TEST(SteadyStep, FallsByAndByAndAtOnceWhereItMust) {
  SteadyStep step;
  step.follow(1.03);
  const double falls = step.follow(1.029);
  EXPECT_LT(falls, 1.03);
  EXPECT_GT(falls, 1.029) << "what falls by little is met by and by";
  EXPECT_NEAR(step.follow(.5), .505, 1e-12) << "and at once by all but a hundredth";
  double dt = 0;
  for (int k = 0; k < 100; ++k) dt = step.follow(.5);
  EXPECT_EQ(dt, .5);
}

}  // namespace forming_sim
