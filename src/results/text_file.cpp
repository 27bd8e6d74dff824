#include "forming_sim/results/text_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "forming_sim/config/fault.h"

namespace forming_sim {
namespace {

[[noreturn]] void fail(const std::string& action, const std::string& path, int reason) {
  throw Error(Code::output_error, "cannot " + action + " " + path + ": " + std::strerror(reason));
}

}  // namespace

void replace_file(const std::string& path, const std::string& text) {
  const std::string temporary = path + ".part";
  errno = 0;
  std::FILE* file = std::fopen(temporary.c_str(), "wb");
  if (!file) fail("write", path, errno);
  bool good = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  good = std::fflush(file) == 0 && good;
  int reason = errno;
  good = std::fclose(file) == 0 && good;
  if (good && std::rename(temporary.c_str(), path.c_str()) == 0) return;
  if (good) reason = errno;
  std::remove(temporary.c_str());
  fail("write", path, reason);
}

std::string read_text(const std::string& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) fail("read", path, errno);
  std::ostringstream text;
  text << file.rdbuf();
  if (file.bad()) fail("read", path, errno);
  return text.str();
}

void make_output_directory(const std::string& directory) {
  std::error_code problem;
  std::filesystem::create_directories(directory, problem);
  if (problem) fail("create the output directory", directory, problem.value());
  if (!std::filesystem::is_directory(directory, problem)) fail("use as output directory", directory, ENOTDIR);
  // access() says yes to root on a read-only file system; only writing tells.
  const std::string probe = in_directory(directory, ".forming_sim_write_test");
  std::FILE* file = std::fopen(probe.c_str(), "wb");
  if (!file) fail("write into the output directory", directory, errno);
  std::fclose(file);
  std::remove(probe.c_str());
}

std::string in_directory(const std::string& directory, const std::string& file) {
  return (std::filesystem::path(directory) / file).string();
}

}  // namespace forming_sim
