// Cells that stand still are passed over, and nothing that anybody can see changes.
#include <gtest/gtest.h>

#include "forming_sim/element/stillness.h"
#include "support/runs.h"

namespace forming_sim {
namespace {

std::vector<double> state_of(const Elements& elements) {
  std::vector<double> state;
  elements.append_state(state);
  return state;
}

// One side of a block is stretched into yield, later left alone; the other never moves.
// An engine that is told its own state before every step knows of nothing at rest.
void same_bits(CellKind kind, int cells, int threads) {
  const Mesh mesh = block_of(kind, cells);
  const NodeField X = positions_of(mesh);
  const std::vector<BodyModel> bodies{body_of(mesh, aluminium(true))};
  Elements lazy(bodies, mesh.dimension, X, ElementOptions(), threads), busy(bodies, mesh.dimension, X, ElementOptions(), threads);
  const int axis = mesh.dimension - 1;  // cells are numbered along it last: blocks of cells lie across it
  double low = 1e300, high = -1e300;
  for (const Node& n : X) low = std::min(low, n[axis]), high = std::max(high, n[axis]);
  const double middle = 0.5 * (low + high);
  NodeField x = X, f(X.size()), g(X.size());
  const NodeField v(X.size(), Node::Zero());
  long most = 0;
  for (int step = 0; step < 60; ++step) {
    const double stretch = 0.03 * std::sin(0.1 * std::min(step, 40));
    for (std::size_t i = 0; i < x.size(); ++i)
      if (X[i][axis] > middle) x[i][axis] = X[i][axis] + stretch * (X[i][axis] - middle);
    lazy.forces(x, v, 1e-8, 1e-8, f);
    const std::vector<double> before = state_of(busy);
    busy.read_state(before.data());
    busy.forces(x, v, 1e-8, 1e-8, g);
    EXPECT_EQ(busy.blocks_at_rest(), 0);
    ASSERT_EQ(f, g) << "step " << step;
    ASSERT_EQ(state_of(lazy), state_of(busy)) << "step " << step;
    most = std::max(most, lazy.blocks_at_rest());
    if (step > 20 && step < 40) {
      EXPECT_GT(lazy.blocks_at_rest(), lazy.blocks() / 4) << "step " << step;
      EXPECT_LT(lazy.blocks_at_rest(), lazy.blocks() * 3 / 4) << "step " << step;
    }
  }
  EXPECT_GT(lazy.plastic_work(), 0);
  EXPECT_EQ(most, lazy.blocks());  // at the end nothing moves
}

// Every second node is held, and yet no cell rests: looks that gain nothing are as rare as where all move.
TEST(Stillness, LooksThatGainNothingAreRare) {
  Team alone(1);
  Stillness stillness;
  NodeField x(100, Node::Zero());
  const NodeTeam team(alone, static_cast<long>(x.size()));
  int looks = 0;
  for (int call = 0; call < 160; ++call) {
    for (std::size_t n = 0; n < x.size(); n += 2) x[n][0] += 1;
    stillness.look(x, team);
    if (!stillness.any()) continue;
    ++looks;
    EXPECT_TRUE(stillness.moved(0));
    EXPECT_FALSE(stillness.moved(1));
    stillness.no_cell_rests();
  }
  EXPECT_GE(looks, 8);
  EXPECT_LE(looks, 11);
}

// Nothing acts on it: what the rounding of its cells pulls moves no node, far from the origin neither.
TEST(Stillness, ABodyThatNothingTouchesRests) {
  for (CellKind kind : {CellKind::quad2, CellKind::crossed, CellKind::quad1, CellKind::hex6, CellKind::hex24, CellKind::hex1, CellKind::wedge14, CellKind::pyramid8})
    for (double away : {0., 1e3}) {
      Mesh mesh = block_of(kind, 6);
      for (Vec3& X : mesh.nodes) X += Vec3(away, -.3 * away, 0);
      auto sim = OneBody(body_of(mesh, aluminium(true)), 1).start();
      for (int step = 0; step < 300; ++step) sim->step();
      EXPECT_EQ(sim->positions(), sim->initial_positions()) << shape_of(kind).name << " at " << away;
      EXPECT_EQ(sim->velocities(), NodeField(mesh.nodes.size(), Node::Zero())) << shape_of(kind).name << " at " << away;
      EXPECT_EQ(sim->energies().kinetic, 0) << shape_of(kind).name;
    }
}

// A soft body is pulled, and beside it lies a stiff one of far smaller cells that nothing touches: what rounding is for that one is much for the other, and nothing of it is felt.
TEST(Stillness, ANeighbourAtRestHasNoInfluence) {
  MaterialConfig foam;
  foam.density = 50;
  foam.youngs_modulus = 1e4;
  foam.poissons_ratio = .3;
  MaterialConfig steel;
  steel.density = 7850;
  steel.youngs_modulus = 210e9;
  steel.poissons_ratio = .3;
  NodeField alone;
  for (const bool beside : {false, true}) {
    OneBody run(body_of(generate_blank(strip_of(.1, .05, 10, 5)), foam), 1);
    pull_right(run, {0}, {Vec3(.01, 0, 0)});
    if (beside) {
      BlankConfig sheet = strip_of(1e-3, 1e-4, 40, 4);
      sheet.origin = Vec3(0, .2, 0);
      add_flying(run.model, run.plan, body_of(generate_blank(sheet), steel), "sheet", Vec3::Zero());
    }
    run.plan.time_step.limit = "element";
    run.plan.time_step.maximum = 1e-9;
    auto sim = run.start();
    for (int step = 0; step < 2000; ++step) sim->step();
    NodeField x(sim->positions().begin(), sim->positions().begin() + run.model.bodies[0].node_count);
    if (!beside) alone = x;
    EXPECT_EQ(x, alone);
    double most = 0;
    for (std::size_t n = 0; n < x.size(); ++n) most = std::max(most, (x[n] - sim->initial_positions()[n]).norm());
    EXPECT_GT(most, 1e-9);
  }
}

// Gravity that is far less than what rounding could pull is still felt.
TEST(Stillness, ALoadIsNoRounding) {
  OneBody run(body_of(block_of(CellKind::crossed, 4), aluminium()), 1);
  run.plan.gravity = Vec3(0, -1e-4, 0);
  auto sim = run.start();
  for (int step = 0; step < 300; ++step) sim->step();
  for (const Node& v : sim->velocities()) EXPECT_NEAR(v[1], -1e-4 * sim->time(), .01e-4 * sim->time());
}

TEST(Stillness, CrossedTriangles) { same_bits(CellKind::crossed, 16, 1); }
TEST(Stillness, Hexahedra) { same_bits(CellKind::hex24, 8, 1); }
TEST(Stillness, TwoThreads) { same_bits(CellKind::hex24, 8, 2); }

TEST(Stillness, NodalPressureIsAlwaysFoundAnew) {
  const Mesh mesh = block_of(CellKind::tetrahedron, 4);
  const NodeField X = positions_of(mesh), v(X.size(), Node::Zero());
  Elements elements({body_of(mesh, aluminium(), "node")}, 3, X, ElementOptions(), 1);
  NodeField f(X.size());
  for (int step = 0; step < 40; ++step) {
    elements.forces(X, v, 1e-8, 1e-8, f);
    EXPECT_EQ(elements.blocks_at_rest(), 0);
  }
}

}  // namespace
}  // namespace forming_sim
