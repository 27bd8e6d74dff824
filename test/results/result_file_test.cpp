// result.h5: what is written is read, up to the last complete frame, and what
// cannot be written is said.
#include <gtest/gtest.h>
#include <hdf5.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <fstream>

#include "forming_sim/config/fault.h"
#include "forming_sim/results/checkpoint.h"
#include "forming_sim/results/result_file.h"
#include "forming_sim/results/result_reader.h"
#include "results/example_run.h"

namespace forming_sim {
namespace {

void expect_frame(const Frame& frame, const ResultHeader& header, int index) {
  const Frame expected = example_frame(header, index);
  EXPECT_EQ(frame.time, expected.time);
  EXPECT_EQ(frame.step, expected.step);
  EXPECT_EQ(frame.stage, expected.stage);
  EXPECT_EQ(frame.positions, expected.positions);
  EXPECT_EQ(frame.velocities, expected.velocities);
  EXPECT_EQ(frame.plastic_strain, expected.plastic_strain);
  EXPECT_EQ(frame.damage, expected.damage);
  EXPECT_EQ(frame.stress, expected.stress);
  EXPECT_EQ(frame.volume_ratio, expected.volume_ratio);
  EXPECT_EQ(frame.contact_pressure, expected.contact_pressure);
  EXPECT_EQ(frame.contact_gap, expected.contact_gap);
  EXPECT_EQ(frame.contact_slip, expected.contact_slip);
  EXPECT_EQ(frame.surface_strain, expected.surface_strain);
  EXPECT_EQ(frame.surface_strain_minor, expected.surface_strain_minor);
  EXPECT_EQ(frame.membrane_strain, expected.membrane_strain);
  EXPECT_EQ(frame.membrane_strain_minor, expected.membrane_strain_minor);
  EXPECT_EQ(frame.limit_ratio, expected.limit_ratio);
  EXPECT_EQ(frame.thickness, expected.thickness);
  EXPECT_EQ(frame.thinning, expected.thinning);
  ASSERT_EQ(frame.tools.size(), 2u);
  EXPECT_EQ(frame.tools[0].position, expected.tools[0].position);
  EXPECT_EQ(frame.tools[0].force, expected.tools[0].force);
  EXPECT_EQ(frame.tools[0].moment, expected.tools[0].moment);
  EXPECT_EQ(frame.tools[0].present, expected.tools[0].present);
}

TEST(ResultFile, IsReadBackAsWritten) {
  const TemporaryDirectory directory;
  const ResultHeader header = example_header(3);
  {
    ResultFile file(directory.file("result.h5"), header);
    for (int i = 0; i < 6; ++i) file.write(example_frame(header, i));
  }
  const ResultReader reader(directory.file("result.h5"));
  EXPECT_EQ(reader.header().elements, header.elements);
  EXPECT_EQ(reader.header().sets, header.sets);
  EXPECT_EQ(reader.header().scene_text, header.scene_text);
  EXPECT_EQ(reader.header().scene_name, header.scene_name);
  EXPECT_EQ(reader.header().initial_positions, header.initial_positions);
  ASSERT_EQ(reader.header().surface.size(), header.surface.size());
  EXPECT_EQ(reader.header().surface[2].element, 4);
  EXPECT_EQ(reader.header().tools[0].points, header.tools[0].points);
  EXPECT_EQ(reader.header().tools[0].facets, header.tools[0].facets);
  EXPECT_EQ(reader.header().tools[1].plane_normal, header.tools[1].plane_normal);
  ASSERT_EQ(reader.frames().size(), 6u);
  for (int i = 0; i < 6; ++i) expect_frame(reader.frame(i), header, i);
}

TEST(ResultFile, AnotherFileOfARunIsNone) {
  const TemporaryDirectory directory;
  save_checkpoint(directory.file("checkpoint.h5"), Checkpoint());
  try {
    ResultReader reader(directory.file("checkpoint.h5"));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("holds no result; give the result.h5 of a run"), std::string::npos) << error.what();
  }
}

TEST(ResultFile, ResumesAfterAStepAndDropsWhatCameLater) {
  const TemporaryDirectory directory;
  const ResultHeader header = example_header(3);
  const std::string path = directory.file("result.h5");
  {
    ResultFile file(path, header);
    for (int i = 0; i < 6; ++i) file.write(example_frame(header, i));
  }
  {
    auto file = ResultFile::resume(path, header, 35);
    ASSERT_TRUE(file);
    ASSERT_EQ(file->frames().size(), 4u);
    for (int i = 4; i < 7; ++i) file->write(example_frame(header, i));
  }
  {
    const ResultReader reader(path);
    ASSERT_EQ(reader.frames().size(), 7u);
    for (int i = 0; i < 7; ++i) expect_frame(reader.frame(i), header, i);
  }
  EXPECT_FALSE(ResultFile::resume(directory.file("absent.h5"), header, 35));
  ResultHeader same = header;
  same.scene_text += "# a remark";  // the checkpoint tells whether it is the same scene
  EXPECT_TRUE(ResultFile::resume(path, same, 35));
}

void expect_not_resumed(const std::string& path, const ResultHeader& header, const std::string& words) {
  try {
    ResultFile::resume(path, header, 35);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::output_error);
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
  }
}

// A file that is there stays as it is, whatever it is.
TEST(ResultFile, IsNotResumedAndStaysWhereItIsAnother) {
  const TemporaryDirectory directory;
  const ResultHeader header = example_header(3);
  const std::string path = directory.file("result.h5");
  {
    ResultFile file(path, header);
    file.write(example_frame(header, 0));
  }
  ResultHeader other = header;
  other.initial_positions[0][0] += 1e-9;
  expect_not_resumed(path, other, "another mesh");
  other = header;
  other.scene_name = "another";
  expect_not_resumed(path, other, "this is another");
  other = header;
  other.scene_hash += 1;
  expect_not_resumed(path, other, "other values");
  other = header;
  other.version = "0.0.0";
  expect_not_resumed(path, other, "0.0.0");
  EXPECT_EQ(ResultReader(path).frames().size(), 1u);
}

// Who looks at the file meanwhile would find an index whose parts do not fit each other, and HDF5 does not bear that.
TEST(ResultFile, FramesHaveNoIndex) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("result.h5");
  const ResultHeader header = example_header(2);
  {
    ResultFile file(path, header, 20);  // fewer than come
    for (int i = 0; i < 80; ++i) file.write(example_frame(header, i));
  }
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  for (const char* group : {"frames", "frames/000007"}) {
    H5G_info_t info{};
    ASSERT_GE(H5Gget_info_by_name(file, group, &info, H5P_DEFAULT), 0);
    EXPECT_EQ(info.storage_type, H5G_STORAGE_TYPE_COMPACT) << group;
  }
  H5Fclose(file);
}

TEST(ResultFile, IsReadableUpToTheLastCompleteFrameAfterAKill) {
  const ResultHeader header = example_header(40);
  for (int complete = 1; complete <= 16; ++complete) {
    const TemporaryDirectory directory;
    int channel[2];
    ASSERT_EQ(pipe(channel), 0);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      ResultFile file(directory.file("result.h5"), header);
      for (int i = 0;; ++i) {
        file.write(example_frame(header, i));
        if (write(channel[1], "f", 1) != 1) _exit(1);
      }
    }
    char byte;
    for (int i = 0; i < complete; ++i) ASSERT_EQ(read(channel[0], &byte, 1), 1);
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    close(channel[0]);
    close(channel[1]);

    const ResultReader reader(directory.file("result.h5"));
    const int frames = static_cast<int>(reader.frames().size());
    ASSERT_GE(frames, complete);
    for (int i = 0; i < frames; ++i) expect_frame(reader.frame(i), header, i);
  }
}

// Whoever looks finds whole frames, or is told that this opening failed; nothing worse.
TEST(ResultFile, CanBeReadWhileItIsWritten) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("result.h5");
  const ResultHeader header = example_header(10);
  int enough[2];  // closed by the reader: it has seen enough
  ASSERT_EQ(pipe(enough), 0);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    close(enough[1]);
    pollfd seen{enough[0], POLLIN, 0};
    ResultFile file(path, header, 400);
    for (int i = 0; i < 400 || poll(&seen, 1, 0) == 0; ++i) file.write(example_frame(header, i));
    _exit(0);
  }
  close(enough[0]);
  int status = 0, found = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    try {
      const ResultReader reader(path);
      if (reader.frames().empty()) continue;
      const int last = static_cast<int>(reader.frames().size()) - 1;
      expect_frame(reader.frame(last), header, last);
      if (++found == 5) close(enough[1]);
    } catch (const Error&) {
    }
  }
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_GE(found, 5);
  EXPECT_GE(ResultReader(path).frames().size(), 400u);
}

/// Writes frames until it fails, in a process of its own: files may grow to
/// `bytes`, as on a disk that fills up. Exits with 0 where the failure is the
/// sentence that it should be.
void write_on_a_small_disk(const std::string& path, rlim_t bytes) {
  signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{bytes, bytes};
  setrlimit(RLIMIT_FSIZE, &limit);
  const ResultHeader header = example_header(40);
  try {
    ResultFile file(path, header);
    for (int i = 0; i < 1000; ++i) file.write(example_frame(header, i));
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    std::exit(error.code() == Code::output_error ? 0 : 1);
  }
  std::exit(2);
}

TEST(ResultFileDeathTest, AFullDiskIsAnErrorThatNamesFileAndReason) {
  for (rlim_t bytes = 1000000; bytes < 1100000; bytes += 12345) {
    const TemporaryDirectory directory;
    const std::string path = directory.file("result.h5");
    EXPECT_EXIT(write_on_a_small_disk(path, bytes), testing::ExitedWithCode(0), "^cannot .*result.h5.*: File too large\n$");
    const ResultReader reader(path);  // what was complete is still there
    ASSERT_GE(reader.frames().size(), 2u) << bytes;
    for (std::size_t i = 0; i < reader.frames().size(); ++i)
      expect_frame(reader.frame(i), reader.header(), static_cast<int>(i));
  }
}

// Else every frame takes longer than the one before: a flush goes through all that is kept.
TEST(ResultFile, KeepsNoMoreInMemoryWithMoreFrames) {
  const TemporaryDirectory directory;
  const ResultHeader header = example_header(2);
  ResultFile file(directory.file("result.h5"), header);
  hid_t id = -1;
  ASSERT_EQ(H5Fget_obj_ids(H5F_OBJ_ALL, H5F_OBJ_FILE, 1, &id), 1);
  std::size_t bytes = 0;
  for (int i = 0; i < 200; ++i) {
    file.write(example_frame(header, i));
    H5Fget_mdc_size(id, nullptr, nullptr, &bytes, nullptr);
    ASSERT_LT(bytes, 80000u) << i;
  }
  EXPECT_GT(bytes, 1000u);
}

// What is allotted for a frame and not used is not in the file, and does not stay behind it.
TEST(ResultFile, TakesNoMoreOfTheDiskThanItIsLong) {
  const TemporaryDirectory directory;
  const ResultHeader header = example_header(40);
  ResultFile file(directory.file("result.h5"), header);
  for (int i = 0; i < 3; ++i) file.write(example_frame(header, i));
  file.finish();
  struct stat now;
  ASSERT_EQ(stat(directory.file("result.h5").c_str(), &now), 0);
  EXPECT_LT(now.st_blocks * 512, now.st_size + 2 * now.st_blksize);
  file.write(example_frame(header, 3));
  EXPECT_EQ(ResultReader(directory.file("result.h5")).frames().size(), 4u);
}

TEST(ResultFile, CannotBeCreatedInADirectoryThatIsNotThere) {
  try {
    ResultFile file("/nonexistent/directory/result.h5", example_header(2));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::output_error);
    EXPECT_STREQ(error.what(), "cannot create /nonexistent/directory/result.h5: No such file or directory");
  }
}

// Values that no run writes are refused with a sentence, wherever they stand.
TEST(ResultFile, RefusesWhatDoesNotFitTogether) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("result.h5");
  const ResultHeader good = example_header(3);
  const auto refused = [&](const ResultHeader& header, const Frame& frame, const std::string& words) {
    ResultFile(path, header).write(frame);
    try {
      ResultReader(path).frame(0);
      FAIL() << words;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  const Frame frame = example_frame(good, 0);
  ResultHeader bad = good;
  bad.elements[1][2] = 1 << 20;
  refused(bad, frame, "elements name 1048576");
  bad = good;
  bad.surface[0].element = -3;
  refused(bad, frame, "facets of the surface name -3");
  bad = good;
  bad.element_body[0] = 7;
  refused(bad, frame, "elements name 7");
  bad = good;
  bad.tools[0].facets[0][0] = 1 << 20;
  refused(bad, frame, "facets of tool");
  Frame off = frame;
  off.positions.pop_back();
  refused(good, off, "positions has");
  off = frame;
  off.plastic_strain.pop_back();
  refused(good, off, "plastic_strain has");
}

TEST(ResultFile, RefusesWhatIsNotHdf5) {
  const TemporaryDirectory directory;
  std::ofstream(directory.file("result.h5")) << "this is text";
  EXPECT_THROW(ResultReader{directory.file("result.h5")}, Error);
  expect_not_resumed(directory.file("result.h5"), example_header(2), "cannot open");
}

}  // namespace
}  // namespace forming_sim
