#pragma once
// A scene of the package, run as a user runs it, for the figures that are scenes.
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "figures.h"
#include "forming_sim/simulation/observer.h"

namespace forming_sim::bench {

class ShippedRun {
 public:
  /// Runs scenes/NAME.yaml on one core into DIR/NAME, or where the request names no
  /// directory into one that goes with this object. Throws std::runtime_error where the
  /// run does not succeed.
  ShippedRun(const std::string& name, const Request& request, Observer* watcher = nullptr);
  ~ShippedRun();

  /// DIR/<picture>: the section with a field, at the frame nearest to a time; nothing without DIR.
  void draw(const std::string& field, double time, const std::string& picture) const;

  nlohmann::json summary;
  double wall_time = 0;  ///< s

 private:
  struct TemporaryDirectory;
  std::string name_, pictures_, directory_;
  std::unique_ptr<TemporaryDirectory> scratch_;
};

}  // namespace forming_sim::bench
