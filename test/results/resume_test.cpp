// A run that goes on from a checkpoint: what its files hold, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "results/run_files_tools.h"

namespace forming_sim {
namespace {

using nlohmann::json;

class Resume : public testing::Test {
 protected:
  void SetUp() override { run_scene(small_scene(), whole_.path(), 1, "", kNever); }
  long steps() const { return read_json(whole_.file("summary.json"))["steps"]; }
  TemporaryDirectory whole_;
};

TEST_F(Resume, AfterACancelGivesTheFilesOfAnUnbrokenRun) {
  const json expected = read_json(whole_.file("summary.json"));
  for (double part : {0.1, 0.5, 0.8, 0.97}) {
    const TemporaryDirectory directory;
    CancelAfter canceller(static_cast<long>(part * steps()));
    const Outcome cancelled = run_scene(small_scene(), directory.path(), 1, "", canceller.cancel, {&canceller});
    ASSERT_EQ(cancelled.code, Code::cancelled);
    EXPECT_EQ(read_json(directory.file("summary.json"))["status"]["name"], name_of(Code::cancelled));
    EXPECT_TRUE(ResultReader(directory.file("result.h5")).frames().back().interrupted);

    const Outcome resumed = run_scene(small_scene(), directory.path(), 1, directory.file("checkpoint.h5"), kNever);
    ASSERT_EQ(static_cast<int>(resumed.code), expected["status"]["code"].get<int>()) << resumed.message;
    expect_same_frames(directory.file("result.h5"), whole_.file("result.h5"));
    expect_same_text(directory.file("history.csv"), whole_.file("history.csv"));
    const json summary = read_json(directory.file("summary.json"));
    EXPECT_EQ(comparable(summary), comparable(expected));
    EXPECT_GT(summary["resumed_at_s"].get<double>(), 0);
  }
}

TEST_F(Resume, FromTheLastIntervalGoesOnInTheSameDirectory) {
  run_scene(small_scene(), whole_.path(), 1, whole_.file("checkpoint.h5"), kNever);
  const TemporaryDirectory again;
  run_scene(small_scene(), again.path(), 1, "", kNever);
  expect_same_frames(whole_.file("result.h5"), again.file("result.h5"));
  expect_same_text(whole_.file("history.csv"), again.file("history.csv"));
}

TEST_F(Resume, IntoAnotherDirectoryBeginsThereAndSaysSo) {
  const TemporaryDirectory directory;
  run_scene(small_scene(), directory.path(), 1, whole_.file("checkpoint.h5"), kNever);
  const json summary = read_json(directory.file("summary.json")), expected = read_json(whole_.file("summary.json"));
  EXPECT_EQ(summary["steps"], expected["steps"]);
  EXPECT_EQ(summary["bodies"], expected["bodies"]);
  EXPECT_EQ(summary["warnings"].size(), expected["warnings"].size() + 2);
  const ResultReader result(directory.file("result.h5")), whole(whole_.file("result.h5"));
  EXPECT_GT(result.frames().front().step, 0);
  EXPECT_EQ(result.frame(result.frames().size() - 1).positions, whole.frame(whole.frames().size() - 1).positions);
}

TEST_F(Resume, OfAnotherSceneIsRefusedWithTheDifference) {
  Scene other = small_scene();
  other.tools[0].friction = 0.25;
  const TemporaryDirectory directory;
  const Outcome outcome = run_scene(other, directory.path(), 1, whole_.file("checkpoint.h5"), kNever);
  EXPECT_EQ(outcome.code, Code::resume_error);
  EXPECT_NE(outcome.message.find("was written for another scene"), std::string::npos) << outcome.message;
  EXPECT_NE(outcome.message.find("0.25"), std::string::npos) << outcome.message;
  EXPECT_NE(outcome.message.find("in tools"), std::string::npos) << outcome.message;
  EXPECT_EQ(read_json(directory.file("summary.json"))["status"]["message"], outcome.message);
  // In its own directory the run keeps its summary.
  const std::string before = read_text(whole_.file("summary.json"));
  EXPECT_EQ(run_scene(other, whole_.path(), 1, whole_.file("checkpoint.h5"), kNever).code, Code::resume_error);
  EXPECT_EQ(read_text(whole_.file("summary.json")), before);
}

// What the first part of a run warned of is in the summary of the whole, once.
TEST(ResumedRun, KeepsItsWarnings) {
  Scene scene = small_scene();
  scene.contact.method = "explicit";
  scene.contact.layer = 1e-7;
  scene.stages.resize(1);
  const TemporaryDirectory whole, parts;
  run_scene(scene, whole.path(), 1, "", kNever);
  const json expected = read_json(whole.file("summary.json"));
  const auto overstepped = [](const json& summary) {
    return std::count_if(summary["warnings"].begin(), summary["warnings"].end(), [](const json& w) { return w.get<std::string>().find("explicit contact is stable") != std::string::npos; });
  };
  ASSERT_EQ(overstepped(expected), 1);
  CancelAfter canceller(expected["steps"].get<long>() * 9 / 10);
  ASSERT_EQ(run_scene(scene, parts.path(), 1, "", canceller.cancel, {&canceller}).code, Code::cancelled);
  ASSERT_EQ(overstepped(read_json(parts.file("summary.json"))), 1);
  run_scene(scene, parts.path(), 1, parts.file("checkpoint.h5"), kNever);
  EXPECT_EQ(comparable(read_json(parts.file("summary.json"))), comparable(expected));
}

// A frame that an unbroken run does not write tells of a pressure that its warnings do not know.
TEST(ResumedRun, KnowsNothingOfTheFrameAtWhichItWasCancelled) {
  Scene scene = small_scene();
  scene.tools.clear();
  scene.stages.resize(1);
  scene.output.interval = 0;
  scene.output.frames = 1;
  scene.output.checkpoint_interval = 0;
  scene.bodies[0].material.hardening.reset();
  scene.bodies[0].material.damage.reset();
  scene.bodies[0].boundaries = {};
  for (const char* side : {"left", "right", "bottom"}) {
    BoundaryConfig held;
    held.set = side;
    held.kind = "fixed";
    held.axes = {std::string(side) == "bottom" ? "y" : "x"};
    scene.bodies[0].boundaries.push_back(held);
  }
  PressureConfig pulse;
  pulse.set = "top";
  pulse.profile = "smooth";
  pulse.times = {0, 1e-4, 2e-4};
  pulse.values = {0, 0.15 * scene.bodies[0].material.K(), 0};
  scene.bodies[0].pressures = {pulse};
  const TemporaryDirectory whole, parts;
  run_scene(scene, whole.path(), 1, "", kNever);
  const json expected = read_json(whole.file("summary.json"));
  const auto pressed = [](const json& summary) {
    return std::count_if(summary["warnings"].begin(), summary["warnings"].end(), [](const json& w) { return w.get<std::string>().find("of its bulk modulus") != std::string::npos; });
  };
  ASSERT_EQ(pressed(expected), 0);
  CancelAfter canceller(expected["steps"].get<long>() / 2);
  ASSERT_EQ(run_scene(scene, parts.path(), 1, "", canceller.cancel, {&canceller}).code, Code::cancelled);
  run_scene(scene, parts.path(), 1, parts.file("checkpoint.h5"), kNever);
  EXPECT_EQ(comparable(read_json(parts.file("summary.json"))), comparable(expected));
}

TEST_F(Resume, ARunFromItsStartTakesAwayTheCheckpointOfAnother) {
  const TemporaryDirectory directory;
  std::filesystem::copy_file(whole_.file("checkpoint.h5"), directory.file("checkpoint.h5"));
  Scene other = small_scene();
  other.output.checkpoint_interval = 0;
  const Outcome outcome = run_scene(other, directory.path(), 1, "", kNever);
  EXPECT_EQ(outcome.code, Code::limit_reached) << outcome.message;
  EXPECT_FALSE(std::filesystem::exists(directory.file("checkpoint.h5")));
}

}  // namespace
}  // namespace forming_sim
