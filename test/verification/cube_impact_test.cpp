// A cube of aluminium that meets a plane as fast as metal flows: no cell collapses in it.
#include <gtest/gtest.h>

#include "support/runs.h"

namespace forming_sim {

TEST(CubeImpact, NoCellOfAnyFamilyCollapsesAt1000MetresPerSecond) {
  const double side = 10e-3, speed = 1000;
  for (const char* pattern : {"fine", "coarse", "one_point"})
    for (const int cells : {3, 6}) {
      BlankConfig blank = strip_of(side, side, cells, cells);
      blank.shape = "plate";
      blank.width = side;
      blank.cells_across = cells;
      blank.pattern = pattern;
      OneBody run(body_of(generate_blank(blank), aluminium(true)), 2 * side / speed);
      run.plan.bodies[0].initial_velocity = Vec3(0, 0, -speed);
      run.model.tools = {plane_at("wall", 3, Vec3(0, 0, -1e-5), Vec3::UnitZ())};
      auto sim = run.start();
      const Outcome outcome = sim->run(std::atomic<bool>(false));
      const Energies& e = sim->energies();
      std::printf("  %s, %d cells a side: %ld steps, plastic work %.2f of the kinetic energy, ledger open by %.2g\n", pattern, cells, sim->steps(), e.plastic / e.initial, sim->balance_error());
      EXPECT_EQ(outcome.code, Code::success) << pattern << ", " << cells << ": " << outcome.message;
      EXPECT_GT(e.plastic, .5 * e.initial) << pattern;  // it has met it
      EXPECT_LT(sim->balance_error(), .02) << pattern;
      EXPECT_EQ(sim->contact_status().crossings, 0) << pattern;
    }
}

// Sections of soft aluminium, of crossed cells 2 to 4 times as high as wide. The law saw triangles flat of which three fifths were there, and their cells collapsed within 2 us.
TEST(CubeImpact, HighCellsOfASectionBearIt) {
  MaterialConfig soft = aluminium_by("linear");
  soft.hardening->yield_stress = soft.hardening->modulus = 50e6;
  for (const double speed : {300., 500.})
    for (const auto& [along, through] : {std::pair(8, 6), {12, 6}, {16, 12}, {8, 8}}) {
      BlankConfig blank = strip_of(6e-3, 12e-3, along, through);
      blank.origin = Vec3(0, 1e-5, 0);
      OneBody run(body_of(generate_blank(blank), soft), 20e-6);
      run.plan.bodies[0].initial_velocity = Vec3(0, -speed, 0);
      run.plan.bodies[0].boundaries = {symmetric("left", Vec3::UnitX())};
      run.model.tools = {plane_at("wall", 2, Vec3::Zero(), Vec3::UnitY())};
      auto sim = run.start();
      const Outcome outcome = sim->run(std::atomic<bool>(false));
      const Energies& e = sim->energies();
      std::printf("  %d x %d cells at %g m/s: %ld steps, plastic work %.2f of the kinetic energy, ledger open by %.2g\n", along, through, speed, sim->steps(), e.plastic / e.initial, sim->balance_error());
      EXPECT_EQ(outcome.code, Code::success) << along << " x " << through << " at " << speed << ": " << outcome.message;
      EXPECT_GT(e.plastic, .1 * e.initial);
      EXPECT_LT(sim->balance_error(), .01);
      EXPECT_EQ(sim->contact_status().crossings, 0);
    }
}

}  // namespace forming_sim
