// time_step.raise_to: mass for the few small cells.
#include <gtest/gtest.h>

#include "support/dense_limit.h"
#include "support/runs.h"

namespace forming_sim {
namespace {

/// A strip of cells as long as high, two through, one column of which is ten times thinner.
OneBody strip_with_a_sliver(int columns = 60) {
  Mesh mesh = generate_blank(strip_of(1e-3 * columns, 2e-3, columns, 2));
  for (Vec3& X : mesh.nodes)
    if (X.x() > 10e-3 + 1e-9) X.x() -= 0.9 * std::min(1e-3, X.x() - 10e-3);
  OneBody run(body_of(mesh, aluminium()), 1e-4);
  run.plan.time_step.limit = "element";  // raise_to counts by nodes, whatever the limit
  return run;
}
double sum(const std::vector<double>& values) {
  double total = 0;
  for (double value : values) total += value;
  return total;
}

TEST(RaisedStep, IsTakenAndCostsTheMassThatItSays) {
  OneBody run = strip_with_a_sliver();
  auto plain = run.start();
  OneBody without(body_of(generate_blank(strip_of(60e-3, 2e-3, 60, 2)), aluminium()), 1e-4);
  without.plan.time_step.limit = "element";
  const double even = without.start()->dt();
  run.plan.time_step.raise_to = 0.68 * even;
  ASSERT_GT(run.plan.time_step.raise_to, 2 * plain->dt());
  auto raised = run.start();
  EXPECT_GE(raised->dt(), run.plan.time_step.raise_to * (1 - 1e-12));
  EXPECT_LE(raised->dt(), run.plan.time_step.raise_to * 1.2);
  const AddedMass& added = raised->added_mass();
  EXPECT_GT(added.fraction, 0);
  EXPECT_LT(added.fraction, 0.05);
  EXPECT_NEAR(added.total, sum(raised->nodal_mass()) - sum(plain->nodal_mass()), 1e-12 * sum(plain->nodal_mass()));
  EXPECT_NEAR(added.fraction, added.total / sum(plain->nodal_mass()), 1e-12);
  EXPECT_NEAR(sum(added.bodies), added.total, 1e-12 * added.total);
  // Only around the sliver, and nowhere more than the step asks for.
  for (std::size_t n = 0; n < plain->nodal_mass().size(); ++n) {
    const double more = raised->nodal_mass()[n] - plain->nodal_mass()[n], place = plain->positions()[n][0];
    if (place < 10e-3 - 1e-9 || place > 10.1e-3 + 1e-9) {
      EXPECT_EQ(more, 0) << place;
    }
    EXPECT_LE(more, added.most);
  }
  ASSERT_GE(added.node, 0);
  EXPECT_EQ(raised->warnings().size(), 1u);
  // The step is one that the mesh bears: below the true limit with these masses.
  const NodeField x = raised->positions();
  Elements elements(run.model.bodies, 2, x, {}, 1);
  std::vector<double> kg = raised->nodal_mass();
  for (std::size_t n = 0; n < kg.size(); ++n) kg[n] -= elements.nodal_mass()[n];
  elements.add_mass(kg);
  EXPECT_LE(raised->dt() / run.plan.time_step.safety, dense_limit(elements, x, 2));
}

TEST(RaisedStep, WhatTheMeshBearsAnywayCostsNothing) {
  OneBody run = strip_with_a_sliver();
  run.plan.time_step.raise_to = 0.99 * run.start()->dt();
  auto raised = run.start();
  EXPECT_EQ(raised->added_mass().total, 0);
  EXPECT_EQ(raised->added_mass().node, -1);
  EXPECT_TRUE(raised->warnings().empty());
}

TEST(RaisedStep, TooMuchMassIsRefusedWithTheStepThatWouldDo) {
  OneBody run = strip_with_a_sliver();
  run.plan.time_step.raise_to = 1e-6;
  double right = 0;
  try {
    run.start();
    FAIL() << "no refusal";
  } catch (const SceneError& error) {
    ASSERT_EQ(error.faults().size(), 1u);
    EXPECT_EQ(error.faults()[0].field, "time_step.raise_to");
    const std::string& remedy = error.faults()[0].remedy;
    const std::size_t at = remedy.find("give at most ");
    ASSERT_NE(at, std::string::npos) << remedy;
    right = std::stod(remedy.substr(at + 13));
  }
  run.plan.time_step.raise_to = 0.99 * right;  // it is told in three digits
  EXPECT_LE(run.start()->added_mass().fraction, run.plan.time_step.raise_limit);
  run.plan.time_step.raise_to = 1.02 * right;
  EXPECT_THROW(run.start(), SceneError);
}

// The weight of a body is that of its own mass: it hangs as heavily with and without.
TEST(RaisedStep, GravityDoesNotSeeIt) {
  OneBody run = strip_with_a_sliver(20);
  hang_from_left(run);
  double tip[2];
  for (bool raised : {false, true}) {
    run.plan.time_step.raise_to = raised ? 1.2e-7 : 0;
    run.plan.time_step.raise_limit = 10;
    auto sim = run.start();
    const std::atomic<bool> go_on{false};
    ASSERT_EQ(sim->run(go_on).code, Code::success);
    EXPECT_EQ(sim->added_mass().fraction > 0.2, raised) << sim->added_mass().fraction;
    tip[raised] = 0;
    for (const Node& n : sim->positions()) tip[raised] = std::min(tip[raised], n[1]);
  }
  EXPECT_NEAR(tip[1], tip[0], 2e-3 * std::fabs(tip[0]));
}

TEST(RaisedStep, ComesBesideUniformScaling) {
  OneBody run = strip_with_a_sliver();
  run.plan.time_step.raise_to = 4e-8;
  auto plain = run.start();
  run.plan.time_step.mass_scaling = 4;
  run.plan.time_step.raise_to = 8e-8;
  auto scaled = run.start();
  EXPECT_GT(plain->added_mass().fraction, 0);
  EXPECT_NEAR(scaled->added_mass().fraction, plain->added_mass().fraction, 1e-9);
  EXPECT_NEAR(scaled->dt(), 2 * plain->dt(), 1e-9 * plain->dt());
}

}  // namespace
}  // namespace forming_sim
