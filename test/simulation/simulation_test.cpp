#include <gtest/gtest.h>

#include <cmath>

#include "support/runs.h"

namespace forming_sim {
namespace {

const std::atomic<bool> kNoCancel{false};

/// A plastic block that flies, turns and rings.
OneBody tumbling(CellKind kind, double duration, int n = 3) {
  OneBody run(body_of(block_of(kind, n), aluminium(true)), duration);
  run.plan.bodies[0].initial_velocity = Vec3(30, -10, shape_of(kind).dimension == 2 ? 0 : 20);
  run.plan.bodies[0].initial_spin_deg_s = Vec3(0, 0, 2e4);
  run.plan.bodies[0].spin_centre = Vec3(0.2, 0.1, 0);
  return run;
}

class Families : public ::testing::TestWithParam<CellKind> {};

TEST_P(Families, MomentumAndEnergyStay) {
  auto sim = tumbling(GetParam(), 4e-3).start();
  sim->step();
  const Momenta before = momenta(*sim);
  ASSERT_EQ(sim->run(kNoCancel).code, Code::success);
  const Momenta after = momenta(*sim);
  EXPECT_LT((after.linear - before.linear).norm(), 1e-12 * before.linear.norm());
  EXPECT_LT((after.angular - before.angular).norm(), 1e-10 * before.angular.norm());
  EXPECT_GT(sim->energies().elastic, 0);
  EXPECT_LT(sim->balance_error(), 2e-3);
}

TEST_P(Families, AResumedRunIsTheUnbrokenOne) {
  auto whole = tumbling(GetParam(), 1e-3).start();
  for (int i = 0; i < 20; ++i) whole->step();
  const std::vector<char> saved = whole->save();
  whole->run(kNoCancel);
  auto resumed = tumbling(GetParam(), 1e-3).start();
  resumed->restore(saved);
  resumed->run(kNoCancel);
  ASSERT_EQ(whole->steps(), resumed->steps());
  for (std::size_t i = 0; i < whole->positions().size(); ++i) ASSERT_EQ(whole->positions()[i], resumed->positions()[i]);
  EXPECT_EQ(whole->energies().residual(), resumed->energies().residual());
}

INSTANTIATE_TEST_SUITE_P(Kinds, Families,
                         ::testing::Values(CellKind::crossed, CellKind::hex6, CellKind::hex24, CellKind::tetrahedron, CellKind::wedge14));

// Of blocks of so many cells that the loops are shared.
TEST(Simulation, OneThreadAndTwoGiveTheSameBits) {
  for (const CellKind kind : {CellKind::triangle, CellKind::crossed, CellKind::quad1, CellKind::tetrahedron, CellKind::hex6, CellKind::hex24, CellKind::hex1, CellKind::wedge14}) {
    OneBody run = tumbling(kind, 1, shape_of(kind).dimension == 2 ? 110 : kind == CellKind::hex24 || kind == CellKind::wedge14 ? 16 : 22);
    run.plan.bodies[0].initial_spin_deg_s *= 50;  // so that it flows at once
    ASSERT_GT(run.model.node_count(), 2 * kNodesOfAThread);
    auto one = run.start(1), two = run.start(2);
    for (int i = 0; i < 20; ++i) one->step(), two->step();
    ASSERT_EQ(one->time(), two->time()) << shape_of(kind).name;
    for (std::size_t i = 0; i < one->positions().size(); ++i) ASSERT_EQ(one->positions()[i], two->positions()[i]) << shape_of(kind).name << ", node " << i;
    EXPECT_GT(one->energies().plastic, 0) << shape_of(kind).name;
    EXPECT_EQ(one->energies().residual(), two->energies().residual()) << shape_of(kind).name;
  }
}

// A flight so slow that positions round each step: the energies are rounding, and no fraction of them means anything.
TEST(Simulation, WhereNothingHappensTheLedgerHasNoError) {
  OneBody run(body_of(block_of(CellKind::crossed, 3), aluminium()), 1e-3);
  run.plan.bodies[0].initial_velocity = Vec3(1e-11, 1e-11, 0);
  auto sim = run.start();
  ASSERT_EQ(sim->run(kNoCancel).code, Code::success);
  const Energies e = sim->energies();
  EXPECT_GT(std::abs(e.residual()), .1 * (e.work + e.initial));
  EXPECT_LT(sim->balance_error(), 1e-2);
}

TEST(Simulation, TheSwingingCubeConvergesToSecondOrder) {  // reference value 16, A = B = 1, C = -2
  const double E = 17e6, nu = 0.3, rho = 1100, U0 = 1e-4, exact = 29.954e-3;
  double errors[2];
  int at = 0;
  for (int n : {4, 8}) {
    BlankConfig blank;
    blank.shape = "plate";
    blank.length = blank.width = blank.thickness = 1;
    blank.cells_along = blank.cells_across = blank.cells_through = n;
    MaterialConfig rubber;
    rubber.density = rho;
    rubber.youngs_modulus = E;
    rubber.poissons_ratio = nu;
    OneBody run(body_of(generate_blank(blank), rubber), 0.25 * exact * 1.3);
    const char* sets[6] = {"left", "right", "front", "back", "bottom", "top"};
    for (int face = 0; face < 6; ++face) {
      BoundaryConfig b;
      b.set = sets[face];
      b.kind = "fixed";
      for (int axis = 0; axis < 3; ++axis)
        if ((face % 2 == 0) == (axis == face / 2)) b.axes.push_back(std::string(1, "xyz"[axis]));
      run.plan.bodies[0].boundaries.push_back(b);
    }
    // start at rest in the deformed state: give it as an initial velocity instead, a quarter period later
    // the displacement peaks, and the velocity of a corner passes through zero
    auto sim = run.start();
    NodeField& v = const_cast<NodeField&>(sim->velocities());
    const double omega = 2 * M_PI / exact;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const Vec3 X = 0.5 * M_PI * vec3(sim->initial_positions()[i]);
      const Vec3 s = X.array().sin(), c = X.array().cos();
      v[i] = node(U0 * omega * Vec3(s[0] * c[1] * c[2], c[0] * s[1] * c[2], -2 * c[0] * c[1] * s[2]));
    }
    int corner = 0;
    for (std::size_t i = 0; i < v.size(); ++i)
      if ((vec3(sim->initial_positions()[i]) - Vec3(1, 0, 0)).norm() < 1e-9) corner = static_cast<int>(i);
    ASSERT_GT(v[corner][0], 0);
    double before = 0, t_before = 0, zero = 0;
    while (sim->step() && zero == 0) {
      const double now = sim->velocities()[corner][0], t = sim->time() - 0.5 * sim->dt();
      if (now < 0) zero = t_before + (t - t_before) * before / (before - now);
      before = now;
      t_before = t;
    }
    ASSERT_GT(zero, 0);
    errors[at++] = std::fabs(4 * zero / exact - 1);
    std::cout << "  " << n << " cells: period " << 4e3 * zero << " ms, error " << 4 * zero / exact - 1 << "\n";
  }
  EXPECT_LT(errors[1], 0.01);
  EXPECT_LT(errors[1], 0.35 * errors[0]);
}

TEST(Simulation, WorkOfAPulledStripIsBooked) {
  OneBody run(body_of(generate_blank(strip_of(20e-3, 2e-3, 20, 2)), aluminium(true)), 2e-4);
  pull_right(run, {0, 1e-4}, {Vec3::Zero(), Vec3(8, 0, 0)});
  run.plan.bodies[0].boundaries[1].profile = "smooth";
  auto sim = run.start();
  ASSERT_EQ(sim->run(kNoCancel).code, Code::success);
  EXPECT_GT(sim->energies().plastic, 0.5 * sim->energies().work);
  EXPECT_LT(sim->balance_error(), 2e-3);
  double far = 0;
  for (const Node& n : sim->positions()) far = std::max(far, n[0]);
  EXPECT_NEAR(far, 20e-3 + 8 * (0.5e-4 + 1e-4), 1e-6);
}

TEST(Simulation, DampingViscosityAndGravityAreInTheLedger) {
  OneBody run(body_of(block_of(CellKind::crossed, 4), aluminium()), 5e-4);
  run.plan.time_step.limit = "element";  // the ledger is of second order in the step, and this body starts with a blow
  run.plan.time_step.damping = 500;
  run.plan.time_step.linear_viscosity = 0.1;
  run.plan.time_step.quadratic_viscosity = 1.2;
  run.plan.gravity = Vec3(0, -2e4, 0);
  run.plan.bodies[0].initial_velocity = Vec3(5, 0, 0);
  BoundaryConfig floor;
  floor.set = "bottom";
  floor.kind = "fixed";
  run.plan.bodies[0].boundaries = {floor};
  auto sim = run.start();
  ASSERT_EQ(sim->run(kNoCancel).code, Code::success);
  EXPECT_GT(sim->energies().damping, 0);
  EXPECT_GT(std::fabs(sim->energies().work), 0);
  EXPECT_LT(sim->balance_error(), 3e-3);
}

/// Cells that ring at the step's own frequency lose a good part of their energy to the viscosity in each step: q takes what it takes
/// over the kick, not what the velocities before it would say.
TEST(Simulation, ViscosityOfARingingCellIsInTheLedger) {
  for (CellKind kind : {CellKind::crossed, CellKind::quad1, CellKind::triangle})
    for (double safety : {0.9, 0.3}) {
      OneBody run(body_of(block_of(kind, 1), aluminium()), 5e-3);
      if (kind == CellKind::triangle) run.model.bodies[0].pressure_average = "node";
      run.plan.time_step.limit = "element";
      run.plan.time_step.safety = safety;
      run.plan.time_step.linear_viscosity = 0.06;
      run.plan.bodies[0].initial_velocity_field = {"x", "y"};
      auto sim = run.start();
      ASSERT_EQ(sim->run(kNoCancel).code, Code::success);
      const Energies& e = sim->energies();
      EXPECT_GT(e.viscosity, 0.3 * e.initial);
      EXPECT_LT(sim->balance_error(), safety < 0.5 ? 1e-3 : 1e-2);
    }
}

TEST(Simulation, MassScalingLengthensTheStepByItsRoot) {
  OneBody run(body_of(block_of(CellKind::crossed, 4), aluminium()), 1);
  auto plain = run.start();
  run.plan.time_step.mass_scaling = 100;
  auto scaled = run.start();
  plain->step();
  scaled->step();
  EXPECT_NEAR(scaled->dt() / plain->dt(), 10, 1e-6);
}

TEST(Simulation, ASettlingCantileverComesToRest) {
  OneBody run(body_of(generate_blank(strip_of(20e-3, 1e-3, 40, 2)), aluminium()), 1e-5);
  hang_from_left(run);
  auto sim = run.start();
  const Outcome outcome = sim->run(kNoCancel);
  ASSERT_EQ(outcome.code, Code::success) << outcome.message;
  double tip = 0;
  for (const Node& n : sim->positions()) tip = std::min(tip, n[1]);
  const double E = 70.5e9 / (1 - 0.34 * 0.34), L = 20e-3, t = 1e-3;
  const double exact = -12 * 2710 * 1e4 * std::pow(L, 4) / (8 * E * t * t);  // q L^4 / (8 E' I)
  EXPECT_NEAR(tip, exact, 0.06 * std::fabs(exact));
  EXPECT_LT(sim->balance_error(), 1e-3);
}

TEST(Simulation, CancelEndsTheRunAndSaysSo) {
  std::atomic<bool> cancel{true};
  auto sim = tumbling(CellKind::crossed, 1e-3).start();
  EXPECT_EQ(sim->run(cancel).code, Code::cancelled);
}

TEST(Simulation, ACheckpointOfAnotherMeshIsRefused) {
  const auto run = [] { return tumbling(CellKind::crossed, 1e-3); };
  const std::vector<char> saved = run().start()->save();
  const auto refused = [&](OneBody other) {
    try {
      other.start()->restore(saved);
    } catch (const Error& error) {
      return std::string(error.what()).find("the mesh of body block has changed") == 0;
    }
    return false;
  };
  EXPECT_FALSE(refused(run()));
  OneBody other = run();
  ASSERT_FALSE(other.model.bodies[0].mesh.sets["left"].empty());
  other.model.bodies[0].mesh.sets["right"].push_back(0);
  EXPECT_TRUE(refused(other)) << "a set has another node";
  other = run();
  std::vector<int>& corners = other.model.bodies[0].mesh.cells[0].nodes;
  std::rotate(corners.begin(), corners.begin() + 1, corners.begin() + 4);
  EXPECT_TRUE(refused(other)) << "a cell begins at another corner";
}

TEST(Simulation, ADamagedCheckpointIsRefused) {
  auto sim = tumbling(CellKind::crossed, 1e-3).start();
  std::vector<char> saved = sim->save();
  saved.resize(saved.size() / 2);
  EXPECT_THROW(tumbling(CellKind::crossed, 1e-3).start()->restore(saved), Error);
  auto other = tumbling(CellKind::hex6, 1e-3).start();
  EXPECT_THROW(other->restore(sim->save()), Error);
}

}  // namespace
}  // namespace forming_sim
