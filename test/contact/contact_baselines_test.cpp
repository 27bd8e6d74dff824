// The two baselines: plain explicit mild contact, and the correction of places alone.
#include <gtest/gtest.h>

#include "contact/point_bodies.h"
#include "forming_sim/contact/power_law.h"
#include "support/bounce.h"
#include "support/runs.h"

using contact_test::polyline;
using contact_test::World;
using namespace forming_sim;

namespace {

ContactConfig method(const std::string& name, double layer = 0) {
  ContactConfig config;
  config.method = name;
  config.layer = layer;
  return config;
}

// The paper's impact (VERIFICATION 9): blocks of 4 m x 2 m, closing at 10 m/s, or one at 5 m/s on a rigid plane.
struct Meeting {
  double mean = 0, peak = 0;   ///< contact stress from .4 to 1.4 ms after the first contact, and in any step, Pa
  double duration = 0;         ///< s
  double energy = 0;           ///< kinetic and elastic at the end over the kinetic energy at the start, less 1
  double restitution = 0;
  double momentum = 0;         ///< of all bodies over that of one
  double balance = 0, stable_dt = 0, dt = 0;
  std::size_t warnings = 0;
  long crossings = 0, steps = 0;
  std::string error;
};

Meeting meet(const ContactConfig& contact, double safety, bool wall = false, int through = 20, double other = 1) {
  const double rho = 2800, v = 5, L = 4, height = 2, gap = 0.015;
  const MaterialConfig m = impact_material();
  Model model;
  RunPlan plan;
  model.dimension = 2;
  plan.stages.push_back(form_for(3.5e-3));
  plan.contact = contact;
  plan.time_step.safety = safety;
  for (int side = 0; side < (wall ? 1 : 2); ++side) {
    const int cells = side == 0 ? through : static_cast<int>(through * other);
    BlankConfig blank = strip_of(L, height, 2 * cells, cells);
    blank.pattern = "fine";
    blank.origin = Vec3(side == 0 ? gap / 2 : -L - gap / 2, 0, 0);
    BodyModel body = body_of(generate_blank(blank), m);
    add_flying(model, plan, std::move(body), side == 0 ? "right" : "left", Vec3(side == 0 ? -v : v, 0, 0));
  }
  if (wall) {
    model.tools.push_back(wall_at_zero());
  }
  Simulation sim(plan, model, 1);
  const auto momentum = [&](std::size_t body) {
    double p = 0;
    for (int i = model.bodies[body].first_node, last = i + model.bodies[body].node_count; i < last; ++i) p += sim.nodal_mass()[i] * sim.velocities()[i][0];
    return p;
  };
  const double whole = rho * L * height * v;
  Meeting found;
  double first = 0, early = 0, late = 0, t_early = 0, t_late = 0, last = 0, before = 0;
  try {
    while (sim.step()) {
      const double t = sim.time(), impulse = momentum(0) + whole;
      if (impulse > before + 1e-9 * whole) {
        if (first == 0) first = t;
        last = t;
        found.peak = std::max(found.peak, (impulse - before) / sim.dt() / height);
      }
      before = std::max(before, impulse);
      if (first == 0 || t < first + .4e-3) early = impulse, t_early = t;
      if (first == 0 || t < first + 1.4e-3) late = impulse, t_late = t;
      if (found.dt == 0) found.dt = sim.dt();
    }
  } catch (const Error& e) {
    found.error = e.what();
  }
  found.mean = (late - early) / (t_late - t_early) / height;
  found.duration = last - first;
  const Energies& e = sim.energies();
  found.energy = (e.kinetic + e.elastic) / e.initial - 1;
  found.restitution = momentum(0) / whole;
  found.momentum = wall ? 0 : std::abs(momentum(0) + momentum(1)) / whole;
  found.balance = sim.balance_error();
  found.crossings = sim.contact_status().crossings;
  found.stable_dt = sim.contact_status().explicit_stable_dt;
  found.steps = sim.steps();
  found.warnings = sim.warnings().size();
  std::cout << "  " << contact.method << " " << contact.pairing << " n " << contact.exponent << ", " << safety << " of the bulk step"
            << (wall ? ", wall" : other == 1 ? "" : ", other mesh") << ": mean " << found.mean / 1e6 << " MPa, peak " << found.peak / 1e6
            << ", duration " << found.duration * 1e3 << " ms, restitution " << found.restitution << ", energy " << found.energy * 100 << " %, balance " << found.balance << ", crossings "
            << found.crossings << ", steps " << found.steps << ", dt " << found.dt << ", stable dt of the layer " << found.stable_dt << ", momentum "
            << found.momentum << (found.error.empty() ? "" : ", error: ") << found.error << "\n";
  return found;
}

ContactConfig printed() {
  ContactConfig config = method("explicit", 0.01);
  config.coefficient = 7e7;
  return config;
}

}  // namespace

TEST(ContactExplicit, ForceIsMinusTheGradientOfThePotentialAndHasItsStiffness) {
  for (int n : {1, 2, 3})
    for (double h : {1e-3, .05, .3, .7, .95}) {
      const PowerLaw law{n, 2e-2};
      const double at = h * law.h0, c = 3, e = 1e-5 * at;
      const double slope = (law.potential(at + e, c) - law.potential(at - e, c)) / (2 * e);
      EXPECT_NEAR(law.force(at, c), -slope, 1e-8 * law.force(at, c)) << n << " " << h;
      const double bend = (law.force(at + e, c) - law.force(at - e, c)) / (2 * e);
      EXPECT_NEAR(law.stiffness(at, c), -bend, 1e-7 * law.stiffness(at, c)) << n << " " << h;
      // The same stiffness at h0 for every n.
      const double same = law.coefficient(c);
      EXPECT_NEAR(n * same * std::pow(law.h0, -n - 1), c / (law.h0 * law.h0), 1e-12 * c / (law.h0 * law.h0));
    }
  const PowerLaw law{2, 1};
  EXPECT_EQ(law.force(1, 3), 0);
  EXPECT_EQ(law.potential(1.1, 3), 0);
}

// Bodies of springs that meet askew, with friction; both pairings.
TEST(ContactExplicit, MomentumIsKept) {
  for (const char* pairing : {"node_side", "node_node"}) {
    World world;
    world.add_strip(Vec3(0, 0, 0), 6, 2, .1, .1, 2700, 2e8);
    world.add_strip(Vec3(pairing == std::string("node_node") ? .003 : .03, .215, 0), 6, 2, .1, .1, 2700, 2e8);
    for (size_t i = 0; i < world.x.size(); ++i) world.v[i] = i < 21 ? Node(0, 8, 0, 0) : Node(3, -8, 0, 0);
    world.config = method("explicit", 8e-3);
    world.config.pairing = pairing;
    world.config.stiffness = 1e8;
    world.config.friction = .2;
    Contact contact = world.make();
    const Vec3 p0 = world.momentum();
    double stable = 1;
    for (int i = 0; i < 3000; ++i) {
      world.step(contact, 1e-6, false);
      if (world.last.stable_dt > 0) stable = std::min(stable, world.last.stable_dt);
    }
    EXPECT_GT(world.exchanged, 0) << pairing;
    EXPECT_LT((world.momentum() - p0).norm(), 1e-12 * 8 * 2700 * .12);
    EXPECT_LT(stable, 1) << "something was in the layer";
  }
}

// One node of inverse mass w in a layer of stiffness k: 2 / sqrt(k w).
TEST(ContactExplicit, StableStepOfOneNode) {
  World world;
  world.add_strip(Vec3(0, 2e-3, 0), 1, 1, 1, 1, 1, 0);
  world.config = method("explicit", 1e-3);
  world.config.coefficient = 5;
  for (auto& v : world.v) v = Node(0, -1, 0, 0);
  world.add_plane("plane", Vec3::Zero(), Vec3(0, 1, 0), 0, [](double) { return Vec3::Zero(); });
  Contact contact = world.make();
  while (world.last.active == 0) world.step(contact, 1e-6, false);
  const double h = world.x[0][1] + 1e-3 - 1e-6 * world.v[0][1];  // at the start of that step; the plane is set back by the layer
  EXPECT_NEAR(world.last.stable_dt, 2 / std::sqrt(5 / (h * h) / world.mass[0]), 1e-5 * world.last.stable_dt);
}

// The exact bounce on a mild layer (VERIFICATION 10), in small steps.
TEST(ContactExplicit, BounceOnAMildLayer) {
  for (const bounce::Exact& exact : bounce::kExact) {
    const bounce::Found found = bounce::fall("explicit", 2, exact.phi, 1e-4);
    // Second order in dt but for the step in which contact begins and ends: 2 dt, 2e-4 of h0/v.
    EXPECT_NEAR(found.least, exact.least, 1e-3 * exact.least);
    EXPECT_NEAR(found.duration, exact.duration, 4e-4);
    EXPECT_NEAR(found.rebound, 1, 1e-3);
    EXPECT_LT(found.closure, 1e-3);
  }
}

// A node dragged over a plane: Coulomb, and it stops.
TEST(ContactExplicit, Friction) {
  World world;
  world.add_strip(Vec3(0, 2e-3, 0), 4, 1, .1, .1, 2700, 0);
  world.config = method("explicit", 1e-3);
  world.config.stiffness = 1e6;
  world.gravity = Vec3(0, -50, 0);
  for (auto& v : world.v) v = Node(1, 0, 0, 0);
  for (int i = 5; i < 10; ++i) {  // the upper row is held out of the way
    world.held.push_back({i, Mat3::Zero()});
    world.held_velocity.push_back(Node::Zero());
  }
  world.add_plane("table", Vec3::Zero(), Vec3(0, 1, 0), .3, [](double) { return Vec3::Zero(); });
  Contact contact = world.make();
  double normal = 0, tangent = 0;
  for (int i = 0; i < 40000; ++i) {
    world.step(contact, 2e-6, false);
    normal -= world.last.tool_impulse[0].y();
    tangent += world.last.tool_impulse[0].x();
    ASSERT_LE(tangent, .3 * normal * (1 + 1e-9) + 1e-12);
  }
  // From 1 m/s to rest, and no further.
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(world.v[i][0], 0, 1e-9);
}

// 70 MPa from the bar, within what the lateral inertia of so short a bar changes (CONTACT.md 2.1: 70.2 from .4 to 1.4 ms),
// for 1.6 ms and the way through the layer; the energy is kept as long as the step resolves the layer.
TEST(ContactExplicit, ThePapersImpactAtASmallStep) {
  const Meeting small = meet(printed(), .025);
  EXPECT_TRUE(small.error.empty());
  EXPECT_NEAR(small.mean, 70e6, .02 * 70e6);
  EXPECT_NEAR(small.duration, 1.6e-3, .06e-3);
  EXPECT_LT(std::abs(small.energy), .02);
  EXPECT_LT(small.balance, .02);
  EXPECT_LT(small.momentum, 1e-10);
  EXPECT_EQ(small.crossings, 0);
  EXPECT_EQ(small.warnings, 0u);
}

// The same at the step of the elements: what is printed fails, the package's own method does not.
TEST(ContactExplicit, ThePapersImpactAtTheBulkStepFails) {
  const Meeting fails = meet(printed(), .9);
  EXPECT_TRUE(!fails.error.empty() || fails.crossings > 0 || fails.energy > 1) << "the control must fail";
  EXPECT_LT(fails.stable_dt, .5 * fails.dt);
  EXPECT_EQ(fails.warnings, 1u);
  const Meeting own = meet(method("implicit", .01), .9);
  EXPECT_TRUE(own.error.empty());
  EXPECT_NEAR(own.mean, 70e6, .02 * 70e6);
  EXPECT_EQ(own.crossings, 0);
}

// The layer is as stiff at h0 for every exponent, so that the impact is the same.
TEST(ContactExplicit, TheExponentDoesNotMatter) {
  for (int n : {2, 3}) {
    ContactConfig config = method("explicit", .01);
    config.exponent = n;
    const Meeting found = meet(config, .05);
    EXPECT_NEAR(found.mean, 70e6, .02 * 70e6);
    EXPECT_NEAR(found.duration, 1.6e-3, .06e-3);
    EXPECT_EQ(found.crossings, 0);
  }
}

// Algorithm 1: what the package's own method gives on the same mesh and step, to the .1 % by which CONTACT.md 2.1 has them differ.
TEST(ContactGeometric, BlockOnARigidPlane) {
  const Meeting wall = meet(method("geometric", .01), .9, true), own = meet(method("implicit", .01), .9, true);
  EXPECT_NEAR(wall.mean, 70.33e6, .02 * 70.33e6);
  EXPECT_NEAR(wall.mean, own.mean, 3e-3 * own.mean);
  EXPECT_NEAR(wall.duration, 1.603e-3, .05e-3);
  EXPECT_EQ(wall.crossings, 0);
  EXPECT_LT(wall.balance, 1e-2);
}

TEST(ContactGeometric, TwoBlocks) {
  const Meeting same = meet(method("geometric", .01), .9), other = meet(method("geometric", .01), .9, false, 20, 1.15);
  for (const Meeting& found : {same, other}) {
    EXPECT_NEAR(found.mean, 70e6, .02 * 70e6);
    EXPECT_NEAR(found.duration, 1.6e-3, .06e-3);
    EXPECT_LT(found.momentum, 1e-10);
    EXPECT_LT(found.energy, 0);
    EXPECT_GT(found.energy, -.02);
  }
  // Where both passes disturb each other, places and velocities part, and the ledger shows it.
  EXPECT_LT(same.balance, 2e-3);
  EXPECT_GT(other.balance, 10 * same.balance);
}

// A wedge sharper than the mesh hits between two nodes: it goes through, because only nodes of the body
// are looked at; the package's own method sees the tip.
TEST(ContactGeometric, LetsATipThroughBetweenNodes) {
  for (const char* name : {"geometric", "implicit"}) {
    World world;
    world.add_strip(Vec3(-1, 0, 0), 4, 2, .5, .5, 2700, 5e9);
    world.config = method(name, 1e-3);
    world.add_tool("wedge", polyline({Vec3(-.02, -1, 0), Vec3(0, 0, 0), Vec3(.02, -1, 0)}), 0, [](double t) { return Vec3(.23, -.01 + 50 * t, 0); });
    Contact contact = world.make();
    for (int i = 0; i < 400; ++i) world.step(contact, 2e-5);
    EXPECT_EQ(world.crossings > 0, name == std::string("geometric")) << name << ": " << world.crossings;
  }
}

// Friction and a moving tool: the ledger of the velocities closes.
TEST(ContactGeometric, LedgerAndFriction) {
  World world;
  world.add_strip(Vec3(0, 2e-3, 0), 6, 2, .1, .1, 2700, 1e8);
  world.config = method("geometric", 1e-3);
  for (auto& v : world.v) v = Node(4, -5, 0, 0);
  world.add_tool("table", polyline({Vec3(-2, 0, 0), Vec3(.33, 0, 0), Vec3(3, 0, 0)}), .3, [](double t) { return Vec3(0, t, 0); });
  Contact contact = world.make();
  Vec3 given = Vec3::Zero();
  const Vec3 p0 = world.momentum();
  for (int i = 0; i < 1500; ++i) {
    world.step(contact, 1e-5);
    given += world.last.tool_impulse[0];
  }
  EXPECT_GT(world.friction, 0);
  EXPECT_GT(world.dissipated, 0);
  EXPECT_NEAR(world.closure(), 0, 1e-12 * world.exchanged);
  EXPECT_LT((world.momentum() + given - p0).norm(), 1e-12 * p0.norm());
  EXPECT_LE(given.x(), .3 * -given.y() * (1 + 1e-9));
  EXPECT_EQ(world.crossings, 0);
}

// Saved and restored, a run goes on to the same bits.
TEST(ContactBaselines, ResumedRunGivesTheSameBits) {
  for (const char* name : {"explicit", "geometric"}) {
    World a;
    a.add_strip(Vec3(0, 2e-3, 0), 6, 2, .1, .1, 2700, 1e8);
    a.config = method(name, 1e-3);
    a.config.stiffness = name == std::string("explicit") ? 1e7 : 0;
    for (auto& v : a.v) v = Node(4, -5, 0, 0);
    a.add_tool("table", polyline({Vec3(-2, 0, 0), Vec3(.33, 0, 0), Vec3(3, 0, 0)}), .3, [](double) { return Vec3::Zero(); });
    Contact ca = a.make(), cb = a.make();
    for (int i = 0; i < 200; ++i) a.step(ca, 1e-5, false);
    EXPECT_GT(a.exchanged, 0);
    World b = a;
    cb.restore(ca.save());
    for (int i = 0; i < 100; ++i) {
      a.step(ca, 1e-5, false);
      b.step(cb, 1e-5, false);
    }
    for (size_t i = 0; i < a.x.size(); ++i) ASSERT_TRUE(a.x[i] == b.x[i] && a.v[i] == b.v[i]) << name;
    EXPECT_EQ(ca.save(), cb.save());
  }
}

// In three dimensions: a box on a wavy sheet and on a plane.
TEST(ContactBaselines, BoxOnASheet) {
  for (const char* name : {"explicit", "geometric"})
    for (bool plane : {false, true}) {
      World world;
      world.dimension = 3;
      world.add_box(Vec3(-.2, -.2, .03), 4, 4, 2, .1, 2700, 5e7);
      world.config = method(name, 2e-3);
      world.config.stiffness = name == std::string("explicit") ? 1e8 : 0;
      for (auto& v : world.v) v = Node(0, 0, -3, 0);
      if (plane)
        world.add_plane("table", Vec3::Zero(), Vec3(0, 0, 1), 0, [](double) { return Vec3::Zero(); });
      else
        world.add_tool("sheet", contact_test::sheet(12, 1, [](double a, double b) { return .02 * std::cos(9 * a) * std::cos(7 * b); }), 0, [](double) { return Vec3::Zero(); });
      Contact contact = world.make();
      const Vec3 p0 = world.momentum();
      Vec3 given = Vec3::Zero();
      for (int i = 0; i < 3000; ++i) {
        world.step(contact, 1e-5, i % 10 == 0);
        given += world.last.tool_impulse[0];
      }
      EXPECT_GT(world.momentum().z(), 0) << name << ": it came back";
      EXPECT_LT((world.momentum() + given - p0).norm(), 1e-11 * p0.norm());
      EXPECT_EQ(world.crossings, 0) << name << plane;
    }
}
