#include "forming_sim/results/command_line.h"

#include <gtest/gtest.h>

#include "forming_sim/config/fault.h"
#include "forming_sim/results/progress_line.h"

namespace forming_sim {
namespace {

using Task = OfflineOptions::Task;

void expect_refused(const std::vector<std::string>& arguments, const std::string& word) {
  try {
    read_options(arguments);
    ADD_FAILURE() << "taken, and should be refused for: " << word;
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
  }
}

TEST(CommandLine, ARun) {
  const auto options = read_options({"a.yaml", "--output", "out", "--threads", "3", "--resume", "c.h5", "--quiet"});
  EXPECT_EQ(options.task, Task::run);
  EXPECT_EQ(options.scene, "a.yaml");
  EXPECT_EQ(options.output, "out");
  EXPECT_EQ(options.resume, "c.h5");
  EXPECT_EQ(options.thread_count(), 3);
  EXPECT_TRUE(options.quiet);
  EXPECT_GE(read_options({"--output", "out", "a.yaml"}).thread_count(), 1);
  const auto by_signs = read_options({"a.yaml", "--output=file:///runs/a=b", "--threads=2"});
  EXPECT_EQ(by_signs.output, "/runs/a=b");
  EXPECT_EQ(by_signs.threads, 2);
}

TEST(CommandLine, OtherTasks) {
  for (const char* help : {"--help", "-h"}) EXPECT_EQ(read_options({help}).task, Task::help);
  EXPECT_EQ(read_options({"--version"}).task, Task::version);
  EXPECT_EQ(read_options({"--schema"}).task, Task::schema);
  EXPECT_EQ(read_options({"--schema", "markdown"}).task, Task::schema_markdown);
  EXPECT_EQ(read_options({"--validate", "a.yaml"}).task, Task::validate);
  EXPECT_EQ(read_options({"a.yaml", "--validate"}).scene, "a.yaml");
  EXPECT_EQ(read_options({"--estimate", "a.yaml", "--threads", "1"}).threads, 1);
  EXPECT_EQ(read_options({"--plan", "a.yaml", "--threads", "1"}).task, Task::plan);
}

TEST(CommandLine, WrongOnesAreRefused) {
  expect_refused({}, "No scene");
  expect_refused({"a.yaml"}, "--output");
  expect_refused({"a.yaml", "--output"}, "without its value");
  expect_refused({"a.yaml", "--output", "--quiet"}, "without its value");
  expect_refused({"a.yaml", "--output", "o", "--treads", "2"}, "did you mean --threads?");
  expect_refused({"a.yaml", "--output", "o", "-q"}, "-q does not exist");
  expect_refused({"a.yaml", "b.yaml", "--output", "o"}, "Two scenes");
  expect_refused({"a.yaml", "--output", "ftp://host/o"}, "ftp:// is not known");
  expect_refused({"a.yaml", "--output="}, "without its value");
  expect_refused({"a.yaml", "--output", "o", "--output", "p"}, "twice");
  for (const char* threads : {"0", "-1", "two", "2x", "99999999999"}) expect_refused({"a.yaml", "--output", "o", "--threads", threads}, "--threads");
  expect_refused({"--validate", "--estimate", "a.yaml"}, "one of");
  expect_refused({"--validate", "a.yaml", "--output", "o"}, "does not go");
  expect_refused({"--plan", "a.yaml", "--quiet"}, "does not go");
  expect_refused({"--validate"}, "No scene");
  expect_refused({"--schema", "html"}, "markdown");
}

TEST(ProgressLine, Text) {
  EXPECT_EQ(progress_text("form", 0.5, 75), "form         [###############...............]  50 %  ETA 1:15");
  EXPECT_EQ(progress_text("form", 0, -1), "form         [..............................]   0 %");
  EXPECT_EQ(progress_text("form", 2, 0), "form         [##############################] 100 %  ETA 0:00");
}

}  // namespace
}  // namespace forming_sim
