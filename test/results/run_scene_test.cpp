// A run from its scene to its files: what they hold, how it fails.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <cmath>
#include <csignal>

#include "forming_sim/element/elements.h"
#include "forming_sim/parallel/interrupt.h"
#include "forming_sim/results/estimate.h"
#include "forming_sim/results/directory_lock.h"
#include "forming_sim/results/start.h"
#include "forming_sim/scene/build.h"
#include "results/run_files_tools.h"

namespace forming_sim {
namespace {

using nlohmann::json;

// A body that nothing has touched rests at once, and its ledger is not open: what rounding makes of nothing is nothing.
TEST(RunScene, NothingHappensAndAllIsWell) {
  const TemporaryDirectory directory;
  Scene scene = small_scene();
  scene.tools.clear();
  scene.bodies[0].blank->origin = Vec3(0.05, 0.3, 0);
  for (ProbeConfig& probe : scene.output.probes) probe.point += Vec3(0.05, 0.3, 0);
  scene.stages.erase(scene.stages.begin() + 1);  // withdraw
  const Outcome outcome = run_scene(scene, directory.path(), 1, "", kNever);
  EXPECT_EQ(outcome.code, Code::success) << outcome.message;
  const json summary = read_json(directory.file("summary.json"));
  for (const json& warning : summary["warnings"]) EXPECT_EQ(warning.get<std::string>().find("do not add up"), std::string::npos) << warning;
}

// Two sweeps are too few for the forces to come to their end, a hundred are not; nothing is said where nothing is near.
TEST(RunScene, TellsHowFarTheSweepsCame) {
  const auto contact_of = [](int max_sweeps, bool punch) {
    const TemporaryDirectory directory;
    Scene scene = small_scene();
    scene.contact.max_sweeps = max_sweeps;
    if (!punch) scene.tools.clear();
    scene.stages.resize(1);
    run_scene(scene, directory.path(), 1, "", kNever);
    return read_json(directory.file("summary.json"))["contact"];
  };
  const json few = contact_of(2, true), enough = contact_of(100, true), none = contact_of(100, false);
  EXPECT_GT(few["share_at_max_sweeps"].get<double>(), 0);
  EXPECT_LE(few["share_at_max_sweeps"].get<double>(), 1);
  EXPECT_LE(few["sweeps_per_step"].get<double>(), 2);
  EXPECT_EQ(enough["share_at_max_sweeps"], 0);
  EXPECT_GT(enough["sweeps_per_step"], few["sweeps_per_step"]);
  EXPECT_TRUE(none["sweeps_per_step"].is_null());
  EXPECT_TRUE(none["share_at_max_sweeps"].is_null());
}

// A one-point cell is shown as two triangles, and stepped as one element.
TEST(RunScene, TellsCellsFromElements) {
  const TemporaryDirectory directory;
  Scene scene = small_scene();
  scene.bodies[0].blank->pattern = "one_point";
  scene.stages.resize(1);
  scene.stages[0].duration = 1e-5;
  run_scene(scene, directory.path(), 1, "", kNever);
  const json summary = read_json(directory.file("summary.json"));
  EXPECT_EQ(summary["cells"], 20);
  EXPECT_EQ(summary["elements"], 40);
  EXPECT_NEAR(summary["ns_per_element_step"].get<double>() * 20 * summary["steps"].get<double>(), 1e9 * summary["wall_time_s"].get<double>(), 1);
}

TEST(RunScene, LeavesFilesThatAgreeWithEachOther) {
  const TemporaryDirectory directory;
  const Outcome outcome = run_scene(small_scene(), directory.path(), 1, "", kNever);
  ASSERT_TRUE(outcome.code == Code::success || outcome.code == Code::limit_reached) << outcome.message;
  const json summary = read_json(directory.file("summary.json"));
  EXPECT_EQ(summary["status"]["code"], static_cast<int>(outcome.code));
  EXPECT_EQ(summary["scene"], "small");
  EXPECT_EQ(summary["cells"], 20);
  EXPECT_EQ(summary["elements"], 80);
  EXPECT_NEAR(summary["ns_per_element_step"].get<double>() * 80 * summary["steps"].get<double>(), 1e9 * summary["wall_time_s"].get<double>(), 1);
  EXPECT_EQ(summary["nodes"], 53);
  EXPECT_LT(summary["energy_J"]["balance_error"].get<double>(), 0.02);
  EXPECT_EQ(summary["contact"]["crossings"], 0);
  EXPECT_GT(summary["plastic_strain"]["max"].get<double>(), 0);
  EXPECT_EQ(summary["plastic_strain"]["where"]["body"], "strip");
  EXPECT_NEAR(summary["thickness_m"]["initial"].get<double>(), 2e-3, 1e-12);
  EXPECT_LT(summary["thickness_m"]["min"].get<double>(), 2e-3);
  EXPECT_GT(summary["thickness_m"]["min"].get<double>(), 1.5e-3);
  EXPECT_NEAR(summary["bodies"][0]["mass"].get<double>(), 2700 * 0.01 * 0.002, 1e-9);
  ASSERT_EQ(summary["stages"].size(), 3u);
  EXPECT_EQ(summary["stages"][1]["name"], "withdraw");
  EXPECT_LT(summary["springback"]["angle_deg_formed"].get<double>(), -0.5);  // pressed down
  EXPECT_NEAR(summary["springback"]["change_deg"].get<double>(),
              summary["springback"]["angle_deg_released"].get<double>() - summary["springback"]["angle_deg_formed"].get<double>(), 1e-12);
  const double peak = summary["tools"][0]["peak_force"][1].get<double>();
  EXPECT_GT(peak, 0);  // the sheet pushes the punch up

  const ResultReader result(directory.file("result.h5"));
  const Frame last = result.frame(result.frames().size() - 1);
  EXPECT_EQ(last.step, summary["steps"].get<long>());
  EXPECT_EQ(result.frames().front().step, 0);
  EXPECT_FALSE(result.frames().back().tools_present[0]);
  EXPECT_FLOAT_EQ(*std::max_element(last.plastic_strain.begin(), last.plastic_strain.end()),
                  summary["plastic_strain"]["max"].get<float>());
  EXPECT_GE(result.frames().size(), 12u);

  const auto history = read_csv(directory.file("history.csv"));
  ASSERT_GE(history.size(), 100u);
  for (const auto& row : history) ASSERT_EQ(row.size(), history[0].size());
  const auto column = [&](const std::string& name) {
    const auto place = std::find(history[0].begin(), history[0].end(), name);
    EXPECT_NE(place, history[0].end()) << name;
    return place - history[0].begin();
  };
  EXPECT_EQ(std::stol(history.back()[column("step")]), last.step);
  EXPECT_EQ(std::stod(history.back()[column("kinetic_J_per_m")]), summary["energy_J"]["kinetic"].get<double>());
  EXPECT_EQ(history.back()[column("stage")], "settle");
  const double tip = std::stod(history.back()[column("probe_tip_position_y_m")]);
  EXPECT_LT(tip, 1e-3);
  double force = 0;
  for (std::size_t i = 1; i < history.size(); ++i)
    force = std::max(force, std::stod(history[i][column("tool_punch_force_y_N_per_m")]));
  EXPECT_GT(force, 0.3 * peak);
  column("probe_all_stress_zx_Pa");
  column("min_gap_over_h0");
}

// Of a stage shorter than the time between two rows there is one row, and it tells what bears the load at rest: not the mean of the
// swings on the way, which for a strip that hangs still at first is a tenth less.
TEST(RunScene, TheLastRowTellsWhatIsFeltAtRest) {
  const TemporaryDirectory directory;
  Scene scene = small_scene();
  scene.tools.clear();
  scene.output.springback.reset();
  scene.output.probes = {{}};
  scene.output.probes[0].name = "wall";
  scene.output.probes[0].set = "left";
  scene.output.interval = 1;
  scene.bodies[0].blank->length = 0.02;
  scene.bodies[0].material.hardening.reset();
  scene.bodies[0].material.damage.reset();
  LoadConfig load;
  load.set = "right";
  load.kind = "force";
  load.times = {0};
  load.forces = {Vec3(0, -1e3, 0)};
  scene.bodies[0].loads = {load};
  scene.stages.resize(1);
  scene.stages[0] = StageConfig();
  scene.stages[0].kind = "settle";
  scene.stages[0].limit = 0.1;
  run_scene(scene, directory.path(), 1, "", kNever);
  const auto history = read_csv(directory.file("history.csv"));
  const auto place = std::find(history[0].begin(), history[0].end(), "probe_wall_reaction_force_y_N_per_m");
  ASSERT_NE(place, history[0].end());
  EXPECT_NEAR(std::stod(history.back()[place - history[0].begin()]), 1e3, 3);
}

// A roller sinks into a strip and turns: its force and its moment about its place do the work of the run.
TEST(RunScene, TheMomentOnAToolIsInItsHistory) {
  const TemporaryDirectory directory;
  Scene scene = small_scene();
  const double sinks = -1, turns = 4000;  // m/s, rad/s
  ToolConfig& roller = scene.tools[0];
  roller.friction = 0.3;
  roller.position = Vec3(5e-3, 4e-3, 0);
  roller.profile->start = Vec3(2e-3, 0, 0);
  roller.profile->pieces.resize(2);
  roller.profile->pieces[0] = {Vec3(-2e-3, 0, 0), 2e-3};
  roller.profile->pieces[1] = {Vec3(2e-3, 0, 0), 2e-3};
  roller.motion->kind = "velocity";
  roller.motion->positions.clear();
  roller.motion->profile = "linear";
  roller.motion->times = {0};
  roller.motion->velocities = {Vec3(0, sinks, 0)};
  roller.motion->spins_deg_s = {Vec3(0, 0, turns * 180 / M_PI)};
  roller.motion->centre = roller.position;
  scene.bodies[0].boundaries[0].set = "bottom";
  scene.stages.resize(1);
  const Outcome outcome = run_scene(scene, directory.path(), 1, "", kNever);
  ASSERT_EQ(outcome.code, Code::success) << outcome.message;
  const auto history = read_csv(directory.file("history.csv"));
  const auto at = [&](std::size_t row, const std::string& name) {
    const auto place = std::find(history[0].begin(), history[0].end(), name);
    EXPECT_NE(place, history[0].end()) << name;
    return std::stod(history[row][static_cast<std::size_t>(place - history[0].begin())]);
  };
  double by_force = 0, by_moment = 0;
  for (std::size_t row = 2; row < history.size(); ++row) {
    const double lapse = at(row, "time_s") - at(row - 1, "time_s");
    by_force -= sinks * at(row, "tool_punch_force_y_N_per_m") * lapse;
    by_moment -= turns * at(row, "tool_punch_moment_z_N_m_per_m") * lapse;
  }
  const double work = at(history.size() - 1, "work_J_per_m");
  std::printf("  by force %g, by moment %g, in all %g J/m\n", by_force, by_moment, work);
  EXPECT_GT(by_moment, 0.2 * work);
  EXPECT_NEAR(by_force + by_moment, work, 0.01 * work);
}

TEST(RunScene, WritesTheSameNumbersWithTwoThreads) {
  const TemporaryDirectory one, two;
  run_scene(small_scene(), one.path(), 1, "", kNever);
  run_scene(small_scene(), two.path(), 2, "", kNever);
  expect_same_frames(one.file("result.h5"), two.file("result.h5"));
  expect_same_text(one.file("history.csv"), two.file("history.csv"));
}

TEST(RunScene, ToolsThatWereWithdrawnLastAreGone) {
  for (const Vec3& way : {Vec3(0, 1e-3, 0), Vec3(0, 0, 0)}) {
    const TemporaryDirectory directory;
    Scene scene = small_scene();
    scene.stages.resize(2);
    scene.stages[1].displacement = way;
    run_scene(scene, directory.path(), 1, "", kNever);
    EXPECT_EQ(read_json(directory.file("summary.json"))["tools"][0]["present"], false);
  }
}

TEST(RunScene, ThatIsInvalidIsRefusedWithAllFaultsInTheSummary) {
  const TemporaryDirectory directory;
  Scene scene = small_scene();
  scene.bodies[0].material.density = -1;
  scene.output.probes[2].set = "nowhere";
  EXPECT_THROW(run_scene(scene, directory.path(), 1, "", kNever), SceneError);
  const json summary = read_json(directory.file("summary.json"));
  EXPECT_EQ(summary["status"]["code"], static_cast<int>(Code::invalid_scene));
  ASSERT_GE(summary["faults"].size(), 1u);
  EXPECT_EQ(summary["faults"][0]["field"], "bodies[0].material.density");
  EXPECT_FALSE(std::ifstream(directory.file("result.h5")).good());
}

TEST(RunScene, IntoADirectoryThatCannotBeMadeIsAnOutcome) {
  const TemporaryDirectory directory;
  std::ofstream(directory.file("occupied")) << "a file";
  const Outcome outcome = run_scene(small_scene(), directory.file("occupied"), 1, "", kNever);
  EXPECT_EQ(outcome.code, Code::output_error);
  EXPECT_NE(outcome.message.find(directory.file("occupied")), std::string::npos) << outcome.message;
}

void run_on_a_small_disk(const std::string& directory, rlim_t bytes) {
  signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{bytes, bytes};
  setrlimit(RLIMIT_FSIZE, &limit);
  const Outcome outcome = run_scene(small_scene(), directory, 1, "", kNever);
  std::fprintf(stderr, "%s\n", outcome.message.c_str());
  std::exit(outcome.code == Code::output_error ? 0 : 1);
}

TEST(RunSceneDeathTest, OnAFullDiskEndsWithASentence) {
  const TemporaryDirectory directory;
  EXPECT_EXIT(run_on_a_small_disk(directory.path(), 60000), testing::ExitedWithCode(0), "^cannot .*: File too large");
  EXPECT_EQ(read_json(directory.file("summary.json"))["status"]["code"], static_cast<int>(Code::output_error));
}

// A run is over before the text that lists its frames is due again.
TEST(RunSceneDeathTest, OnAFullDiskListsTheFramesThatAreThere) {
  const TemporaryDirectory directory;
  EXPECT_EXIT(run_on_a_small_disk(directory.path(), 200000), testing::ExitedWithCode(0), "^cannot .*result.h5.*: File too large");
  const std::size_t frames = ResultReader(directory.file("result.h5")).frames().size();
  EXPECT_GT(frames, 1u);
  std::ifstream file(directory.file("result.xdmf"));
  std::size_t listed = 0;
  for (std::string line; std::getline(file, line);) listed += line.find("<Time ") != std::string::npos;
  EXPECT_EQ(listed, frames);
}

TEST(RunScene, OneRunAtATimeWritesIntoADirectory) {
  const TemporaryDirectory directory;
  const Code alone = run_scene(small_scene(), directory.path(), 1, "", kNever).code;
  const json before = read_json(directory.file("summary.json"));
  {
    const DirectoryLock other(directory.path());
    const Outcome outcome = run_scene(small_scene(), directory.path(), 1, "", kNever);
    EXPECT_EQ(outcome.code, Code::output_error);
    EXPECT_NE(outcome.message.find("another run is writing into"), std::string::npos) << outcome.message;
    EXPECT_EQ(read_json(directory.file("summary.json")), before);
  }
  EXPECT_EQ(run_scene(small_scene(), directory.path(), 1, "", kNever).code, alone);
}

TEST(RunScene, StepsBeyondNumberAreRefused) {
  Scene scene = small_scene();
  scene.time_step.maximum = 1e-300;
  const std::vector<Fault> faults = check_start(scene, {}, 1).faults;
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_NE(faults[0].remedy.find("time_step.maximum"), std::string::npos);
  const TemporaryDirectory directory;
  EXPECT_THROW(run_scene(scene, directory.path(), 1, "", kNever), SceneError);
  EXPECT_EQ(check_start(scene, {}, 1).simulation, nullptr);
}

TEST(RunScene, APreparationStopsWhenItIsTold) {
  std::atomic<bool> cancelled{true};
  {
    const Interruptible while_wanted(cancelled);
    try {
      check_start(small_scene(), {}, 1);
      FAIL() << "it went on";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Code::cancelled);
    }
  }
  EXPECT_TRUE(check_start(small_scene(), {}, 1).simulation);
  // Also where the model is there already.
  const Scene scene = small_scene();
  const Model model = build_model(scene);
  const Interruptible while_wanted(cancelled);
  NodeField x;
  for (const Vec3& X : model.bodies[0].mesh.nodes) x.push_back(node(X));
  for (const bool whole : {true, false}) {
    try {
      if (whole) Simulation(build_plan(scene), model, 1);
      else Elements({model.bodies[0]}, model.dimension, x, ElementOptions(), 1);
      FAIL() << "it went on";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Code::cancelled);
    }
  }
}

TEST(RunScene, WhatCannotStartIsAFault) {
  Scene scene = small_scene();
  scene.tools[0].profile->start.y() = -8e-3;  // the punch reaches through the strip
  const std::vector<Fault> faults = check_start(scene, {}, 1).faults;
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].code, Code::initial_penetration);
  EXPECT_TRUE(check_start(small_scene(), {}, 1).faults.empty());
}

TEST(RunScene, TakesWhatTheCheckHasBuilt) {
  const TemporaryDirectory one, two;
  run_scene(small_scene(), one.path(), 1, "", kNever);
  StartCheck start = check_start(small_scene(), {}, 1);
  ASSERT_TRUE(start.simulation);
  run_scene(small_scene(), two.path(), 1, "", kNever, {}, std::move(start.simulation));
  EXPECT_EQ(comparable(read_json(two.file("summary.json"))), comparable(read_json(one.file("summary.json"))));
  expect_same_text(two.file("history.csv"), one.file("history.csv"));
}

TEST(EstimateRun, IsThatOfTheRunItself) {
  const TemporaryDirectory directory;
  run_scene(small_scene(), directory.path(), 1, "", kNever);
  const json summary = read_json(directory.file("summary.json"));
  const Estimate estimate = estimate_run(*check_start(small_scene(), {}, 1).simulation);
  EXPECT_EQ(estimate.nodes, summary["nodes"].get<long>());
  EXPECT_EQ(estimate.elements, summary["elements"].get<long>());
  // The settle stage may end before its limit, and the step changes as the sheet deforms.
  EXPECT_NEAR(estimate.time_step_s, summary["time_step_s"]["first"].get<double>(), 0.1 * estimate.time_step_s);
  EXPECT_GT(estimate.steps, 0.8 * summary["steps"].get<double>());
  EXPECT_GT(estimate.wall_time_s, 0);
  EXPECT_GT(estimate.memory_bytes, 0);
}

}  // namespace
}  // namespace forming_sim
