#pragma once
// One run at a time writes into a directory.
#include <string>

namespace forming_sim {

class DirectoryLock {
 public:
  /// Throws Error(output_error) where another run holds the directory.
  explicit DirectoryLock(const std::string& directory);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

 private:
  int handle_ = -1;
};

}  // namespace forming_sim
