// time_step.limit: the bounds on the step against the true limit of small meshes.
#include <gtest/gtest.h>

#include "forming_sim/simulation/fastest_swing.h"
#include "support/dense_limit.h"
#include "support/rings.h"
#include "support/runs.h"

namespace forming_sim {
namespace {

struct Limits {
  double element, node, global, exact;
  int products;
};

/// The bounds of a body at x and the truth; run: of the random start.
Limits limits_of(Elements& elements, const NodeField& x, int dimension, long run, const BoundarySet& held = {}) {
  const NodeField rest(x.size(), Node::Zero());
  CellRates rates;
  elements.find_rates(x, rest, rates);
  const NodalRates nodal = elements.sum_rates(rates);
  const SpectrumBound swing = fastest_swing(elements, x, nodal, held, dimension, run);
  return {elements.slowest_cell(rates).dt, slowest_node(nodal, elements.nodal_mass()).dt, stable_step(swing.above, 0),
          dense_limit(elements, x, dimension, held), swing.products};
}

void expect_right(const Limits& limits, const std::string& what) {
  EXPECT_LE(limits.element, limits.node * (1 + 1e-12)) << what;
  EXPECT_LE(limits.node, limits.exact * (1 + 1e-6)) << what;
  EXPECT_LE(limits.global, limits.exact) << what;
  EXPECT_GE(limits.global, 0.9 * limits.exact) << what;
  std::printf("  of the true limit: element %.3f, node %.3f, global %.3f (%d products) %s\n", limits.element / limits.exact,
              limits.node / limits.exact, limits.global / limits.exact, limits.products, what.c_str());
}

ElementOptions with_shares(bool axisymmetric = false) {
  ElementOptions options;
  options.shares = true;
  options.axisymmetric = axisymmetric;
  return options;
}

struct Case { CellKind kind; const char* average; };
void PrintTo(const Case& c, std::ostream* out) { *out << shape_of(c.kind).name << ", pressure per " << c.average; }

class EveryFamily : public ::testing::TestWithParam<Case> {
 protected:
  int dimension() const { return shape_of(GetParam().kind).dimension; }
  Mesh mesh() const { return block_of(GetParam().kind, dimension() == 2 ? 5 : 2); }
  /// A body whose nodes were shaken by `size` before it became one.
  void check(const MaterialConfig& material, double size, const std::string& what, const std::function<void(Elements&, NodeField&)>& deform) const {
    const BodyModel b = body_of(mesh(), material, GetParam().average);
    NodeField x = positions_of(b.mesh);
    shake(x, dimension(), size, 3);
    Elements elements({b}, dimension(), x, with_shares(), 1);
    deform(elements, x);
    for (long run = 0; run < 3; ++run) expect_right(limits_of(elements, x, dimension(), run), what);
  }
  static void nothing(Elements&, NodeField&) {}
};

TEST_P(EveryFamily, RegularAndDistortedCells) {
  check(aluminium(), 0, "regular", nothing);
  check(aluminium(), 0.04, "distorted", nothing);
}

TEST_P(EveryFamily, NearlyIncompressible) {
  MaterialConfig m = aluminium();
  m.poissons_ratio = 0.4999;
  check(m, 0.04, "nu .4999", nothing);
}

TEST_P(EveryFamily, AfterPlasticFlow) {
  const int D = dimension();
  check(aluminium(true), 0.02, "plastic", [&](Elements& elements, NodeField& x) {
    const NodeField rest(x.size(), Node::Zero());
    NodeField f(x.size());
    for (int step = 0; step < 20; ++step) {
      for (Node& n : x) {
        n[0] *= 1.01, n[1] /= 1.01;
        n[0] += 0.004 * n[1];
      }
      shake(x, D, 5e-4, static_cast<unsigned>(step));
      elements.forces(x, rest, 0, 0, f);
    }
    EXPECT_GT(elements.plastic_work(), 0);
  });
}

// What a cell keeps of its initial shape stays when it has flowed into another one: long cells become square, and long the other way.
TEST_P(EveryFamily, FarFromTheInitialShape) {
  const int D = dimension();
  for (bool renew : {false, true}) for (double ratio : {4., .25}) {
    Mesh long_cells = mesh();
    for (Vec3& X : long_cells.nodes) X.x() *= ratio;
    const BodyModel b = body_of(std::move(long_cells), aluminium(true), GetParam().average);
    NodeField x = positions_of(b.mesh), f(x.size());
    const NodeField rest(x.size(), Node::Zero());
    shake(x, D, .01, 3);
    Elements elements({b}, D, x, with_shares(), 1);
    constexpr int kSteps = 60;
    const double a = std::pow(ratio, -1. / kSteps);  // of a step
    for (int step = 1; step <= 2 * kSteps; ++step) {
      for (Node& n : x) n[0] *= std::sqrt(a), n[1] /= std::sqrt(a);
      elements.forces(x, rest, 0, 0, f);
      if (renew) elements.renew_weights(x);
      if (step % kSteps == 0) expect_right(limits_of(elements, x, D, step), "cells of " + std::to_string(ratio) + " flowed to " + std::to_string(ratio * std::pow(a, step)));
    }
    EXPECT_GT(elements.plastic_work(), 0);
  }
}

TEST_P(EveryFamily, StretchedRubber) {
  check(rubber(500e6), 0.02, "rubber", [](Elements&, NodeField& x) {
    for (Node& n : x) n[0] *= 1.6, n[1] /= 1.6, n[0] += 0.3 * n[1];
  });
}

// The product with the stiffness leaves no trace: the next forces are those that would have been.
TEST_P(EveryFamily, LookingForTheFastestSwingChangesNothing) {
  const int D = dimension();
  const BodyModel b = body_of(mesh(), aluminium(true), GetParam().average);
  const NodeField X = positions_of(b.mesh), rest(X.size(), Node::Zero());
  NodeField f(X.size()), g(X.size());
  Elements plain({b}, D, X, with_shares(), 1), asked({b}, D, X, with_shares(), 1);
  for (int step = 0; step < 12; ++step) {
    NodeField x = X;
    if (step > 3) shake(x, D, 0.01, static_cast<unsigned>(step) / 4);  // rests now and then: blocks are passed over
    plain.forces(x, rest, 0, 0, f);
    asked.forces(x, rest, 0, 0, g);
    for (std::size_t n = 0; n < x.size(); ++n) ASSERT_EQ(f[n], g[n]) << "step " << step << " node " << n;
    if (step % 3 == 1) limits_of(asked, x, D, step);
  }
  EXPECT_GT(plain.plastic_work(), 0);
  std::vector<double> one, two;
  plain.append_state(one);
  asked.append_state(two);
  EXPECT_EQ(one, two);
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryFamily,
                         ::testing::Values(Case{CellKind::triangle, "element"}, Case{CellKind::triangle, "node"}, Case{CellKind::quad2, "cell"},
                                           Case{CellKind::crossed, "cell"}, Case{CellKind::tetrahedron, "node"}, Case{CellKind::hex6, "cell"},
                                           Case{CellKind::hex24, "cell"}, Case{CellKind::quad1, "cell"}, Case{CellKind::hex1, "cell"},
                                           Case{CellKind::wedge14, "cell"}, Case{CellKind::pyramid8, "cell"}));

TEST(StepLimit, OfRings) {
  for (CellKind kind : {CellKind::triangle, CellKind::quad2, CellKind::crossed, CellKind::quad1})
    for (double inner : {0.0, 0.3}) {
      const BodyModel b = body_of(ring_block(kind, inner, 4), aluminium(), kind == CellKind::triangle ? "node" : "cell");
      NodeField x = positions_of(b.mesh);
      shake_rings(x, 0.02, 4);
      Elements elements({b}, 2, x, with_shares(true), 1);
      ResolvedBoundary axis;
      axis.config.kind = "symmetric";
      axis.config.normal = Vec3::UnitX();
      axis.config.set = "axis";
      for (std::size_t n = 0; n < x.size(); ++n)
        if (x[n][0] == 0) axis.nodes.push_back(static_cast<int>(n));
      const BoundarySet held(axis.nodes.empty() ? std::vector<ResolvedBoundary>() : std::vector<ResolvedBoundary>{axis}, 2);
      expect_right(limits_of(elements, x, 2, 0, held), std::string("ring of ") + shape_of(kind).name);
    }
}

// One thin column of cells in an even mesh, which its neighbours' mass slows down.
Mesh mesh_with_a_sliver(CellKind kind, double thin) {
  Mesh mesh = block_of(kind, 6);
  for (Vec3& X : mesh.nodes)
    if (X.x() > 0.5 + 1e-9) X.x() -= (1 - thin) * std::min(1.0 / 6, X.x() - 0.5);
  return mesh;
}

TEST(StepLimit, OfSlivers) {
  for (CellKind kind : {CellKind::quad1, CellKind::crossed, CellKind::quad2, CellKind::hex1}) {
    const int D = shape_of(kind).dimension;
    const BodyModel b = body_of(mesh_with_a_sliver(kind, 0.1), aluminium());
    const NodeField x = positions_of(b.mesh);
    Elements elements({b}, D, x, with_shares(), 1);
    const Limits limits = limits_of(elements, x, D, 1);
    expect_right(limits, std::string("sliver of ") + shape_of(kind).name);
    if (is_one_point(kind)) {
      EXPECT_GT(limits.node, 1.5 * limits.element);  // its nodes are all its neighbours' too
    }
  }
}

// One fast mode far above a crowd, which a random start hardly sees.
TEST(Lanczos, TheBoundHoldsForEveryStart) {
  const std::size_t nodes = 300;
  for (double crowd : {0.999, 0.9, 0.5, 0.01}) {
    int most = 0;
    double worst = 1;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
      const SpectrumBound bound = bound_spectrum(nodes, 2, seed, 10.0, [](NodeField&) {}, [&](const NodeField& v, NodeField& w) {
        for (std::size_t n = 0; n < nodes; ++n) w[n] = (n == 17 ? 1 : crowd * static_cast<double>(n) / nodes) * v[n];
      });
      ASSERT_GE(bound.above, 1) << crowd << ' ' << seed;
      ASSERT_LE(bound.below, 1 + 1e-5);
      worst = std::max(worst, bound.above);
      most = std::max(most, bound.products);
    }
    EXPECT_LT(worst, 1.1);
    EXPECT_LT(most, 60);
    std::printf("  crowd below %.3f: at most %.4f, %d products\n", crowd, worst, most);
  }
}

/// Largest total energy over the first of a free swing at a step that is `share` of the global limit; infinite where it ended.
double growth_of_energy(CellKind kind, double share) {
  const int D = shape_of(kind).dimension;
  const BodyModel b = body_of(block_of(kind, D == 2 ? 5 : 2), aluminium());
  NodeField x = positions_of(b.mesh);
  shake(x, D, 0.03, 5);
  Elements elements({b}, D, x, with_shares(), 1);
  const double dt = share * limits_of(elements, x, D, 2).global;
  NodeField v(x.size(), Node::Zero()), f(x.size());
  shake(v, D, 1e-3, 6);
  double first = 0, most = 0;
  for (int step = 0; step < 60000; ++step) {
    try {
      elements.forces(x, v, dt, dt, f);
    } catch (const Error&) {
      return std::numeric_limits<double>::infinity();  // a cell turned inside out
    }
    double energy = 0;
    for (std::size_t n = 0; n < x.size(); ++n) {
      const Node before = v[n];
      v[n] += dt / elements.nodal_mass()[n] * f[n];
      energy += 0.5 * elements.nodal_mass()[n] * before.dot(v[n]);  // with the stored energy: kept exactly where all is linear
    }
    if (step % 100 == 0) energy += elements.stored_energy(x);
    if (step == 0) first = energy;
    if (step % 100 == 0) most = std::max(most, energy);
    if (!(most < 100 * first)) return most / first;
    for (std::size_t n = 0; n < x.size(); ++n) x[n] += dt * v[n];
  }
  return most / first;
}

TEST(StepLimit, ALongSwingAtTheGlobalLimitKeepsItsEnergy) {
  for (CellKind kind : {CellKind::crossed, CellKind::quad1, CellKind::hex6, CellKind::hex1}) {
    EXPECT_LT(growth_of_energy(kind, 0.99), 1.01) << shape_of(kind).name;
    EXPECT_GT(growth_of_energy(kind, 1.15), 100) << shape_of(kind).name;  // the limit is near
  }
}

struct Shares {
  double least = 1, most = 0;
};
/// Of the step that a run takes, without safety, in the true limit, every so many steps. The run's
/// body must be elastic: then its memory never changes, and elements of one's own tell the truth at any moment.
Shares shares_of(Simulation& sim, const BoundarySet& held, long every) {
  const int D = sim.model().dimension;
  Elements elements(sim.model().bodies, D, sim.initial_positions(), with_shares(), 1);
  Shares shares;
  NodeField x = sim.positions();
  for (bool more = true; more; x = sim.positions()) {
    more = sim.step();
    if (sim.steps() % every != 0) continue;
    const double share = sim.step_limit().dt / sim.plan().time_step.safety / dense_limit(elements, x, D, held);
    shares.most = std::max(shares.most, share), shares.least = std::min(shares.least, share);
  }
  return shares;
}

// Rubber squeezed to half its height within about the time between two Lanczos runs.
TEST(StepLimit, FollowsABodyThatIsSqueezedFast) {
  for (CellKind kind : {CellKind::crossed, CellKind::quad1, CellKind::hex1}) {
    const int D = shape_of(kind).dimension;
    const Mesh mesh = block_of(kind, D == 2 ? 5 : 2);
    OneBody run(body_of(mesh, rubber(500e6)), 1);
    run.plan.time_step.limit = "global";
    const double duration = 500 * run.start()->dt(), height = 0.8;
    run.plan.stages[0].duration = duration;
    BoundaryConfig bottom, top;
    bottom.set = "bottom";
    top.set = "top";
    bottom.kind = "fixed";
    top.kind = "velocity";
    top.axes = {D == 2 ? "y" : "z"};
    top.times = {0, duration};
    top.velocities = {Vec3::Zero(), Vec3::Zero()};
    top.velocities[1][D - 1] = -height / duration;
    run.plan.bodies[0].boundaries = {bottom, top};
    auto sim = run.start();
    const double first = sim->dt();
    const Shares shares = shares_of(*sim, BoundarySet({resolve(bottom, "block", mesh, 0), resolve(top, "block", mesh, 0)}, D), 10);
    std::printf("  %s: the step falls to %.2f; limit over the true one %.3f to %.3f, %ld runs\n", shape_of(kind).name,
                sim->step_limit().dt / first, shares.least, shares.most, sim->step_limit_cost().estimates);
    EXPECT_LT(sim->step_limit().dt, 0.8 * first);
    EXPECT_LE(shares.most, 1);
  }
}

// Rubber pulled to three times its size along one axis or two, its other faces free. Even cells begin with bounds that are
// level in the strain while the mesh already gains on them.
TEST(StepLimit, FollowsABodyThatIsStretchedFast) {
  const Case cases[] = {{CellKind::quad2, "cell"}, {CellKind::crossed, "cell"}, {CellKind::quad1, "cell"}, {CellKind::triangle, "node"},
                        {CellKind::hex6, "cell"}, {CellKind::hex24, "cell"}, {CellKind::hex1, "cell"}, {CellKind::tetrahedron, "node"}};
  const double stretch = 3, length = 1, width = 0.8;  // the last two of block_of()
  for (const Case& c : cases) {
    const int D = shape_of(c.kind).dimension, pulled = D - 1;
    const Mesh mesh = block_of(c.kind, 2);
    OneBody run(body_of(mesh, rubber(1000e6), c.average), 1);
    run.plan.time_step.limit = "global";
    run.plan.time_step.damping = 20;
    const double duration = 1000 * run.start()->dt();
    run.plan.stages[0].duration = duration;
    std::vector<BoundaryConfig>& boundaries = run.plan.bodies[0].boundaries;
    boundaries = {symmetric("left", Vec3::UnitX()), symmetric(D == 2 ? "bottom" : "front", Vec3::UnitY())};
    if (D == 3) boundaries.push_back(symmetric("bottom", Vec3::UnitZ()));
    for (int i = 0; i < pulled; ++i) {
      BoundaryConfig pull;
      pull.set = i == 0 ? "right" : "back";
      pull.kind = "velocity";
      pull.axes = {i == 0 ? "x" : "y"};
      pull.times = {0, duration / 2, duration};
      pull.velocities = {Vec3::Zero(), 2 * (stretch - 1) * (i == 0 ? length : width) / duration * Vec3::Unit(i), Vec3::Zero()};
      boundaries.push_back(pull);
    }
    std::vector<ResolvedBoundary> held;
    for (const BoundaryConfig& b : boundaries) held.push_back(resolve(b, "block", mesh, 0));
    auto sim = run.start();
    const Shares shares = shares_of(*sim, BoundarySet(held, D), 10);
    const StepLimitCost cost = sim->step_limit_cost();
    std::printf("  %s, pressure per %s: limit over the true one %.3f to %.3f; %ld steps, %ld runs of %ld products\n", shape_of(c.kind).name, c.average,
                shares.least, shares.most, sim->steps(), cost.estimates, cost.products);
    EXPECT_LE(shares.most, 1.05) << shape_of(c.kind).name;  // with a safety of .9 a tenth is left; a hundredth is what a step may be over a limit that falls fast
    EXPECT_LT(sim->balance_error(), 1e-6) << shape_of(c.kind).name;
  }
}

// A rubber block that has flown undeformed for a hundred steps, so that its step is asked for seldom, meets a wall.
TEST(StepLimit, FollowsABodyThatMeetsAWallAfterALongFlight) {
  for (CellKind kind : {CellKind::crossed, CellKind::quad2, CellKind::quad1}) {
    const double gap = 0.5, speed = 140, wave = 700;
    Mesh mesh = block_of(kind, 5);
    for (Vec3& X : mesh.nodes) X.x() += gap;
    OneBody run(body_of(mesh, rubber(500e6)), gap / speed + 2 / wave);
    run.plan.bodies[0].initial_velocity = Vec3(-speed, 0, 0);
    run.plan.time_step.limit = "global";
    run.model.tools.push_back(wall_at_zero());
    auto sim = run.start();
    const Shares shares = shares_of(*sim, {}, 1);
    std::printf("  %s: limit over the true one %.3f to %.3f in %ld steps\n", shape_of(kind).name, shares.least, shares.most, sim->steps());
    EXPECT_GT(sim->energies().elastic, 0.1 * sim->energies().initial);  // it has met it
    EXPECT_LE(shares.most, 1);
  }
}

// Long and halved steps by turns feed swings that steps of either length would bear: after a halved step the next ones rise slowly.
TEST(StepLimit, RisesSlowlyAfterHalvedSteps) {
  for (const char* limit : {"element", "node", "global"}) {
    Model model;
    RunPlan plan;
    model.dimension = 2;
    plan.time_step.limit = limit;
    plan.contact.layer = 1e-7;  // far thinner than the way of a step, so that frozen normals ask for halved ones
    plan.stages = {form_for(1e-3)};
    for (int side = 0; side < 2; ++side) {
      Mesh mesh = block_of(CellKind::crossed, side == 0 ? 4 : 5);
      for (Vec3& X : mesh.nodes) X.x() += side == 0 ? -1.01 : 0.01;
      add_flying(model, plan, body_of(mesh, aluminium()), side == 0 ? "left" : "right", Vec3(side == 0 ? 250 : -250, 0, 0));
    }
    Simulation sim(plan, model, 1);
    double least = 1;
    for (bool more = true; more;) {
      const double last = sim.dt();
      more = sim.step();
      least = std::min(least, sim.dt() / last);
      ASSERT_LE(sim.dt(), 1.0101 * last) << limit << ", step " << sim.steps();
    }
    EXPECT_GT(sim.contact_status().halvings, 0) << limit;
    EXPECT_LT(least, 0.6) << limit;
    EXPECT_LT(sim.balance_error(), 0.02) << limit;
  }
}

// A sheet that flows, pulled and let go: the step follows it, and a run is the same for
// one and two threads and across a checkpoint.
OneBody pulled_strip() {
  OneBody run(body_of(generate_blank(strip_of(20e-3, 1e-3, 40, 3)), aluminium(true)), 4e-5);
  pull_right(run, {0, 1e-5}, {Vec3::Zero(), Vec3(60, 0, 0)});
  run.plan.time_step.limit = "global";
  return run;
}

TEST(StepLimit, ARunIsTheSameOnTwoThreadsAndAcrossACheckpoint) {
  OneBody run = pulled_strip();
  run.plan.time_step.raise_to = 4e-8;
  run.plan.time_step.raise_limit = 10;
  auto one = run.start(1), two = run.start(2), later = run.start(1);
  for (int step = 0; step < 500; ++step) one->step(), two->step();
  later->restore(one->save());
  for (bool more = true; more;) {
    more = one->step();
    EXPECT_EQ(later->step(), more);
    EXPECT_EQ(two->step(), more);
  }
  ASSERT_GT(one->steps(), 700);
  EXPECT_GT(one->step_limit_cost().estimates, 1);
  EXPECT_EQ(one->step_limit_cost().products, later->step_limit_cost().products);
  for (std::size_t n = 0; n < one->positions().size(); ++n) {
    ASSERT_EQ(one->positions()[n], two->positions()[n]);
    ASSERT_EQ(one->positions()[n], later->positions()[n]);
  }
  EXPECT_EQ(one->energies().plastic, later->energies().plastic);
}

TEST(StepLimit, IsGlobalWhereTheLawAllowsIt) {
  OneBody run = pulled_strip();
  run.plan.time_step.limit.clear();
  EXPECT_EQ(run.start()->plan().time_step.limit, "global");
  EXPECT_EQ(run.start()->step_limit().reason, "the whole mesh");
  run.model.bodies[0].material.law = "classical";
  auto classical = run.start();
  EXPECT_EQ(classical->plan().time_step.limit, "node");
  const std::atomic<bool> go_on{false};
  ASSERT_EQ(classical->run(go_on).code, Code::success);
  EXPECT_EQ(classical->step_limit_cost().products, 0);
  EXPECT_LT(classical->balance_error(), 1e-2);
}

TEST(StepLimit, TheGlobalLimitIsTakenAndTold) {
  OneBody run = pulled_strip();
  auto global = run.start();
  run.plan.time_step.limit = "element";
  auto element = run.start();
  const std::atomic<bool> go_on{false};
  ASSERT_EQ(global->run(go_on).code, Code::success);
  ASSERT_EQ(element->run(go_on).code, Code::success);
  std::printf("  steps %ld, by elements %ld\n", global->steps(), element->steps());
  EXPECT_LT(static_cast<double>(global->steps()), 0.85 * static_cast<double>(element->steps()));
  EXPECT_EQ(global->smallest_step().reason, "the whole mesh");
  EXPECT_GT(global->step_limit_cost().share, 0.99);
  EXPECT_LT(global->balance_error(), 2e-3);
  EXPECT_NEAR(global->energies().plastic, element->energies().plastic, 0.005 * element->energies().plastic);
}

}  // namespace
}  // namespace forming_sim
