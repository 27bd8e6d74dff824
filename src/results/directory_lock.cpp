#include "forming_sim/results/directory_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "forming_sim/config/fault.h"

namespace forming_sim {

DirectoryLock::DirectoryLock(const std::string& directory) : handle_(open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (handle_ < 0 || flock(handle_, LOCK_EX | LOCK_NB) == 0) return;  // a file system without locks protects nobody
  const bool held = errno == EWOULDBLOCK;
  if (!held) return;
  close(handle_);
  throw Error(Code::output_error, "another run is writing into " + directory + ": wait for its end, or give another directory");
}

DirectoryLock::~DirectoryLock() {
  if (handle_ >= 0) close(handle_);
}

}  // namespace forming_sim
