// The plan of a scene names what it has, and what it has not.
#include "forming_sim/results/plan_text.h"

#include <gtest/gtest.h>

#include "forming_sim/element/crossed.h"
#include "support/runs.h"

namespace forming_sim {
namespace {

/// The rest of the line that holds the word, from the word on.
std::string line_with(const std::string& text, const std::string& word) {
  const std::size_t at = text.find(word);
  return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
}

TEST(Plan, NothingButCells) {
  const OneBody run(body_of(generate_blank(strip_of(.1, .01, 10, 2)), aluminium()), 1e-3);
  const std::string plan = plan_text(*run.start());
  EXPECT_EQ(line_with(plan, "block:"), "block: 20 crossed, 80 elements; pressure per cell; green_elastic, elastic");
  const std::string absent = line_with(plan, "not there");
  for (const char* name : {"held or driven nodes", "pressure on surfaces", "gravity", "initial motion", "damping", "bulk viscosity", "mass scaling", "contact", "nodal pressure"})
    EXPECT_NE(absent.find(name), std::string::npos) << name << "\n" << plan;
  EXPECT_EQ(plan.find("friction"), std::string::npos) << plan;
}

TEST(Plan, WhyTheStepIsNotTakenFromTheWholeMesh) {
  OneBody run(body_of(generate_blank(strip_of(.1, .01, 10, 2)), aluminium()), 1e-3);
  EXPECT_NE(plan_text(*run.start()).find("step         by global\n"), std::string::npos);
  run.plan.bodies[0].initial_velocity = Vec3::UnitX();
  EXPECT_NE(plan_text(*run.start()).find("step         by element; global would take fewer steps"), std::string::npos);
  run.model.bodies[0].material.law = "classical";
  EXPECT_NE(plan_text(*run.start()).find("step         by node; not by global: the law of body block is classical\n"), std::string::npos);
}

TEST(Plan, ReactionsOfThoseThatAreAskedFor) {
  OneBody run(body_of(generate_blank(strip_of(.1, .01, 10, 2)), aluminium()), 1e-3);
  EXPECT_EQ(plan_text(*run.start()).find("reactions"), std::string::npos);
  pull_right(run, {0, 1e-3}, {Vec3::Zero(), Vec3::UnitX()});  // holds the left end
  auto sim = run.start();
  sim->keep_reactions(run.model.bodies[0].mesh.sets.at("left"));
  EXPECT_NE(plan_text(*sim).find("reactions of 3 held nodes, for probes"), std::string::npos);
  sim->keep_reactions({});
  EXPECT_NE(line_with(plan_text(*sim), "not there").find("reactions of held nodes"), std::string::npos);
}

TEST(Plan, BytesAreThoseOfTheArrays) {
  const OneBody run(body_of(generate_blank(strip_of(.1, .01, 16, 2)), aluminium()), 1e-3);
  const std::vector<GroupPlan> groups = run.start()->groups();
  ASSERT_EQ(groups.size(), 1u);
  // Four blocks of eight cells. Per element: four components of G, the plastic strain, V0; one set of weights (element/crossed.h).
  EXPECT_EQ(groups[0].memory_bytes, 128 * 6 * 8 + kCrossedItems * kLanes * 8);
  // All cells are one tile: two components at each of 17 x 3 corners and 32 centres.
  EXPECT_EQ(groups[0].force_bytes, (17 * 3 + 32) * 2 * 8);
  EXPECT_EQ(groups[0].index_bytes, (32 * 5 * 2 + 17 * 3 + 32) * 4);
}

TEST(Plan, EverythingThatIsAskedFor) {
  Model model;
  RunPlan plan;
  model.dimension = 2;
  plan.stages.push_back(form_for(1e-3));
  plan.gravity = Vec3(0, -9.81, 0);
  plan.time_step.damping = 5;
  plan.time_step.quadratic_viscosity = 1.2;
  MaterialConfig layered = aluminium();
  layered.layers.resize(2);
  for (LayerConfig& layer : layered.layers) layer.weight = .5;
  BodyModel body = body_of(generate_blank(strip_of(.1, .01, 10, 2)), layered);
  for (Vec3& X : body.mesh.nodes) X.x() += 1;
  add_flying(model, plan, std::move(body), "sheet", Vec3(-1, 0, 0));
  model.bodies[0].self_contact = true;
  model.tools.push_back(wall_at_zero());
  model.tools[0].friction = .2;
  model.tools.push_back(wall_at_zero());
  ToolModel& driven = model.tools[1];
  driven.name = "hammer";
  driven.point = Vec3(-1, 0, 0);
  driven.motion.emplace();
  driven.motion->kind = "force";
  driven.motion->times = {0};
  driven.motion->forces = {Vec3::UnitX()};
  const std::string text = plan_text(Simulation(plan, model, 1));
  for (const char* line : {"hammer is driven by a force", "green_elastic, 2 layers", "gravity", "damping 5 1/s", "bulk viscosity", "initial motion", "sheet with itself: no friction",
                           "sheet with wall: friction 0.2", "form: 0.001 s"})
    EXPECT_NE(text.find(line), std::string::npos) << line << "\n" << text;
  EXPECT_EQ(line_with(text, "not there").find("gravity"), std::string::npos) << text;
}

}  // namespace
}  // namespace forming_sim
