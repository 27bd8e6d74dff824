// checkpoint.h5: what is saved is loaded; what is damaged is refused with a sentence.
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <csignal>
#include <cstdio>
#include <fstream>

#include "forming_sim/results/checkpoint.h"
#include "forming_sim/results/meaning.h"
#include "forming_sim/results/version.h"
#include "results/small_scene.h"

namespace forming_sim {
namespace {

Checkpoint example_checkpoint() {
  Checkpoint checkpoint;
  checkpoint.version = package_version();
  checkpoint.scene = write_scene(small_scene());
  checkpoint.time = 1.25e-3;
  checkpoint.step = 4711;
  for (int i = 0; i < 3000000; ++i) checkpoint.state.push_back(static_cast<char>(i * 31 + i / 256));
  RunRecord record;
  record.thickness_min = 0.9e-3;
  record.angle_formed_deg = -89.5;
  record.surface_strain = {0.3, 12, Vec3(1, 2, 3), 1e-3};
  record.thinning = {0.2, 7, Vec3(4, 5, 6), 2e-3};
  record.limit_ratio = {{0.9, 3, Vec3(7, 6, 5), 4e-3}};
  record.pressed = {0.3, 8, Vec3(7, 8, 9), 3e-3};
  record.stages.push_back({"form", "form", 1e-3, 1, 2, 3});
  record.history_tools = {{{Vec3(0, -1, 0), Vec3(0, 0, 2), 3}, Vec3(4, 5, 6)}};
  checkpoint.record = record.to_json();
  return checkpoint;
}

void expect_refused(const std::string& path, const std::string& words) {
  try {
    load_checkpoint(path);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::resume_error);
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
  }
}

TEST(Checkpoint, IsLoadedAsSaved) {
  const TemporaryDirectory directory;
  const Checkpoint saved = example_checkpoint();
  save_checkpoint(directory.file("checkpoint.h5"), saved);
  const Checkpoint loaded = load_checkpoint(directory.file("checkpoint.h5"));
  EXPECT_EQ(loaded.version, saved.version);
  EXPECT_EQ(loaded.scene, saved.scene);
  EXPECT_EQ(loaded.time, saved.time);
  EXPECT_EQ(loaded.step, saved.step);
  EXPECT_EQ(loaded.state, saved.state);
  EXPECT_EQ(loaded.record, saved.record);
  const RunRecord record = RunRecord::from_json(loaded.record);
  EXPECT_EQ(record.thickness_min, 0.9e-3);
  EXPECT_FALSE(record.thickness_initial);
  EXPECT_EQ(record.angle_formed_deg, -89.5);
  EXPECT_EQ(record.surface_strain.position, Vec3(1, 2, 3));
  EXPECT_EQ(record.thinning.value, 0.2);
  EXPECT_EQ(record.pressed.value, 0.3);
  ASSERT_EQ(record.limit_ratio.size(), 1u);
  EXPECT_EQ(record.limit_ratio[0].value, 0.9);
  EXPECT_EQ(record.limit_ratio[0].position, Vec3(7, 6, 5));
  EXPECT_EQ(record.thinning.position, Vec3(4, 5, 6));
  EXPECT_EQ(record.stages[0].kinetic_over_internal(), 0.2);
  EXPECT_EQ(record.history_tools[0].felt.impulse, Vec3(0, -1, 0));
  EXPECT_EQ(record.history_tools[0].felt.angular, Vec3(0, 0, 2));
  EXPECT_EQ(record.history_tools[0].felt.radial, 3);
  EXPECT_EQ(record.history_tools[0].position, Vec3(4, 5, 6));
  EXPECT_NO_THROW(require_same_run(loaded, meaning_of(small_scene()), "checkpoint.h5"));
}

/// In a process of its own, whose files may grow to `bytes`. Exits with 0 where the failure is the sentence that it should be.
void save_on_a_small_disk(const std::string& path, rlim_t bytes) {
  signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{bytes, bytes};
  setrlimit(RLIMIT_FSIZE, &limit);
  try {
    save_checkpoint(path, example_checkpoint());
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    std::exit(error.code() == Code::output_error ? 0 : 1);
  }
  std::exit(2);
}

TEST(CheckpointDeathTest, OnAFullDiskTheOneBeforeStays) {
  for (rlim_t bytes : {1000, 100000, 1000000, 2500000, 3000000}) {
    const TemporaryDirectory directory;
    const std::string path = directory.file("checkpoint.h5");
    Checkpoint before = example_checkpoint();
    before.state.resize(500);
    save_checkpoint(path, before);
    EXPECT_EXIT(save_on_a_small_disk(path, bytes), testing::ExitedWithCode(0), "^cannot .*checkpoint.h5.part.*: File too large\n$") << bytes;
    EXPECT_EQ(load_checkpoint(path).state, before.state) << bytes;
    EXPECT_FALSE(std::ifstream(path + ".part").good());
  }
}

// Wherever a byte is changed: it is told or it does not matter, and nothing hangs or crashes.
TEST(Checkpoint, DamageIsToldOrDoesNotMatter) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("checkpoint.h5");
  Checkpoint small = example_checkpoint();
  small.state.resize(500);
  save_checkpoint(path, small);
  const std::string whole = read_text(path);
  int told = 0;
  for (std::size_t at = 0; at < whole.size(); at += 3) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x5a);
    replace_file(path, damaged);
    try {
      const Checkpoint loaded = load_checkpoint(path);
      EXPECT_EQ(loaded.state, small.state) << at;
      EXPECT_EQ(loaded.scene, small.scene) << at;
      EXPECT_EQ(loaded.record, small.record) << at;
      EXPECT_EQ(loaded.version, small.version) << at;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Code::resume_error);
      ++told;
    }
  }
  EXPECT_GT(told, static_cast<int>(whole.size() / 3) / 2);
}

TEST(Checkpoint, ThatIsMissingCutOffOrDamagedIsRefused) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("checkpoint.h5");
  expect_refused(path, "does not exist");
  save_checkpoint(path, example_checkpoint());
  const std::string whole = read_text(path);
  replace_file(path, whole.substr(0, whole.size() / 2));
  expect_refused(path, "damaged");
  std::string flipped = whole;
  flipped[whole.size() / 2] ^= 1;  // one bit of the state
  replace_file(path, flipped);
  expect_refused(path, "damaged");
  replace_file(path, "name: scene.yaml");
  expect_refused(path, "damaged");
}

TEST(Checkpoint, OfAnotherVersionIsRefused) {
  Checkpoint checkpoint = example_checkpoint();
  checkpoint.version = "0.0.1";
  try {
    require_same_run(checkpoint, meaning_of(small_scene()), "checkpoint.h5");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::resume_error);
    EXPECT_EQ(std::string(error.what()), std::string("checkpoint.h5 was written by version 0.0.1, this is version ") +
                                             package_version() + "; resume with the version that wrote it");
  }
}

TEST(Checkpoint, StaysTheOldOneWhereTheNewOneCannotBeWritten) {
  EXPECT_THROW(save_checkpoint("/nonexistent/checkpoint.h5", example_checkpoint()), Error);
  const TemporaryDirectory directory;
  const std::string path = directory.file("checkpoint.h5");
  save_checkpoint(path, example_checkpoint());
  EXPECT_FALSE(std::ifstream(path + ".part").good());
}

TEST(RunRecord, RefusesWhatIsNotOne) {
  EXPECT_THROW(RunRecord::from_json("{}"), Error);
  EXPECT_THROW(RunRecord::from_json("not json"), Error);
}

}  // namespace
}  // namespace forming_sim
