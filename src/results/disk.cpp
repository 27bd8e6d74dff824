#include "forming_sim/results/disk.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "forming_sim/config/fault.h"

namespace forming_sim {
namespace {

/// Why the file cannot grow by so many bytes; 0 where it can, or where the file system cannot tell.
int obstacle(int file, std::uint64_t bytes) {
  struct stat now;
  struct rlimit largest;
  if (fstat(file, &now) != 0 || getrlimit(RLIMIT_FSIZE, &largest) != 0) return errno;
  if (largest.rlim_cur != RLIM_INFINITY && static_cast<std::uint64_t>(now.st_size) + bytes > largest.rlim_cur) return EFBIG;
  int reason;
  do reason = fallocate(file, FALLOC_FL_KEEP_SIZE, now.st_size, static_cast<off_t>(bytes)) == 0 ? 0 : errno;
  while (reason == EINTR);
  if (reason == EOPNOTSUPP || reason == ENOSYS || reason == EINVAL) return 0;
  if (reason != 0 && ftruncate(file, now.st_size) != 0) return reason;  // what was allotted before it failed is free again
  return reason;
}

}  // namespace

void allot(const std::string& path, std::uint64_t bytes) {
  const auto fail = [&](int reason) { throw Error(Code::output_error, "cannot write to " + path + ": " + std::strerror(reason)); };
  const int file = open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) fail(errno);
  const int reason = obstacle(file, bytes);
  close(file);
  if (reason != 0) fail(reason);
}

void give_back(const std::string& path) {
  struct stat now;
  // Where it fails the room stays allotted, and nothing else is amiss.
  if (stat(path.c_str(), &now) == 0 && truncate(path.c_str(), now.st_size) != 0) return;
}

}  // namespace forming_sim
