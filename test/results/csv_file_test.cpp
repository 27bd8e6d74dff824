// history.csv as a file: RFC 4180, all digits, resumable.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <limits>

#include "forming_sim/config/fault.h"
#include "forming_sim/results/csv_file.h"
#include "forming_sim/results/text_file.h"
#include "results/example_run.h"

namespace forming_sim {
namespace {

TEST(CsvNumber, ReadsBackToTheSameDouble) {
  for (double value : {0.1, 1.0 / 3, 6.02214076e23, -5e-324, 0.0, 123456789.0, std::numeric_limits<double>::max()})
    EXPECT_EQ(std::strtod(csv_number(value).c_str(), nullptr), value) << csv_number(value);
  EXPECT_EQ(csv_number(std::numeric_limits<double>::quiet_NaN()), "");
  EXPECT_EQ(csv_number(std::numeric_limits<double>::infinity()), "");
}

TEST(CsvText, IsQuotedWhereItMustBe) {
  EXPECT_EQ(csv_text("tool die"), "tool die");
  EXPECT_EQ(csv_text("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_text("a \"b\""), "\"a \"\"b\"\"\"");
}

TEST(CsvFile, HoldsEveryRowAtOnce) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("history.csv");
  CsvFile file(path, {"time_s", "force, N"});
  EXPECT_EQ(read_text(path), "time_s,\"force, N\"\r\n");
  file.append({"0", "1.5"});
  EXPECT_EQ(read_text(path), "time_s,\"force, N\"\r\n0,1.5\r\n");
}

TEST(CsvFile, ResumesWithoutLaterRowsAndHalfRows) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("history.csv");
  {
    CsvFile file(path, {"time_s", "x"});
    for (const char* time : {"0", "1e-3", "2e-3", "3e-3"}) file.append({time, "7"});
  }
  std::ofstream(path, std::ios::app) << "4e-3";  // the program was stopped here
  CsvFile::resume(path, {"time_s", "x"}, 2e-3)->append({"2.5e-3", "8"});
  EXPECT_EQ(read_text(path), "time_s,x\r\n0,7\r\n1e-3,7\r\n2e-3,7\r\n2.5e-3,8\r\n");
  double until = 0;
  CsvFile::resume(path, {"time_s", "x"}, 1, &until);
  EXPECT_EQ(until, 2.5e-3);
  EXPECT_EQ(CsvFile::resume(path, {"time_s", "y"}, 1), nullptr);
  EXPECT_EQ(CsvFile::resume(directory.file("absent.csv"), {"time_s"}, 1), nullptr);
}

TEST(CsvFile, SaysWhereItCannotBeWritten) {
  try {
    CsvFile file("/nonexistent/history.csv", {"time_s"});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::output_error);
    EXPECT_STREQ(error.what(), "cannot write /nonexistent/history.csv: No such file or directory");
  }
}

}  // namespace
}  // namespace forming_sim
