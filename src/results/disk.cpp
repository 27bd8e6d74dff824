#include "forming_sim/results/disk.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "forming_sim/config/fault.h"

namespace forming_sim {

void allot(const std::string& path, std::uint64_t bytes) {
  const auto fail = [&](int reason) { throw Error(Code::output_error, "cannot write to " + path + ": " + std::strerror(reason)); };
  const int file = open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) fail(errno);
  struct stat now;
  const int reason = fstat(file, &now) != 0 ? errno : posix_fallocate(file, now.st_size, static_cast<off_t>(bytes));
  close(file);
  if (reason != 0 && reason != EINVAL && reason != EOPNOTSUPP) fail(reason);
}

}  // namespace forming_sim
