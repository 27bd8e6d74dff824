#pragma once
// A directory that is removed when it is left behind.
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace forming_sim::bench {

class Scratch {
 public:
  Scratch() : path_((std::filesystem::temp_directory_path() / "forming_bench_XXXXXX").string()) {
    if (!mkdtemp(path_.data())) throw std::runtime_error("no temporary directory " + path_);
  }
  Scratch(const Scratch&) = delete;
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace forming_sim::bench
