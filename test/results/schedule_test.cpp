// How often output is due where the scene gives no interval.
#include "forming_sim/results/schedule.h"

#include <gtest/gtest.h>

namespace forming_sim {
namespace {

StageConfig stage(const std::string& kind, double time) {
  StageConfig s;
  s.kind = kind;
  (kind == "settle" ? s.limit : s.duration) = time;
  return s;
}

OutputIntervals intervals(const std::vector<StageConfig>& stages, int frames = 50) {
  Scene scene;
  scene.stages = stages;
  scene.output.frames = frames;
  return output_intervals(scene);
}

TEST(Schedule, FramesAreSpreadOverTheStages) {
  EXPECT_DOUBLE_EQ(intervals({stage("form", 2e-3), stage("withdraw", 1e-3)}).frames, 3e-3 / 50);
  EXPECT_DOUBLE_EQ(intervals({stage("form", 2e-3), stage("withdraw", 1e-3)}).history, 3e-4 / 50);
  EXPECT_DOUBLE_EQ(intervals({stage("form", 2e-3), stage("settle", 1e-3)}).frames, 3e-3 / 50);
  EXPECT_DOUBLE_EQ(intervals({stage("settle", 1e-3)}).frames, 1e-3 / 50);
}

TEST(Schedule, ALongLimitOfASettleStageLeavesFormingItsFrames) {
  EXPECT_DOUBLE_EQ(intervals({stage("form", 2e-3), stage("settle", 1e-2)}).frames, 4e-3 / 50);
  EXPECT_DOUBLE_EQ(intervals({stage("form", 1e-3), stage("settle", 1e-2), stage("form", 1e-3), stage("settle", 1e-2)}).frames, 4e-3 / 50);
}

TEST(Schedule, ARunToAllLimitsHasAtMostTwentyTimesTheFrames) {
  EXPECT_DOUBLE_EQ(intervals({stage("form", 1e-3), stage("settle", 0.999)}).frames, 0.05 / 50);
}

TEST(Schedule, AGivenIntervalIsKept) {
  Scene scene;
  scene.stages = {stage("form", 1e-3), stage("settle", 1)};
  scene.output.interval = 3e-5;
  scene.output.history_interval = 7e-6;
  EXPECT_EQ(output_intervals(scene).frames, 3e-5);
  EXPECT_EQ(output_intervals(scene).history, 7e-6);
}

}  // namespace
}  // namespace forming_sim
