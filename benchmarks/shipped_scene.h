#pragma once
// A scene of the package, run as a user runs it, for the figures and problems that are scenes.
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "forming_sim/scene/scene.h"
#include "forming_sim/simulation/observer.h"
#include "rows.h"

namespace forming_sim::bench {

/// scenes/NAME.yaml. Throws SceneError.
Scene read_shipped(const std::string& name);

class Scratch;

class ShippedRun {
 public:
  /// Runs scenes/NAME.yaml on one core into DIR/NAME, or where the request names no
  /// directory into one that goes with this object. Throws std::runtime_error where the
  /// run does not succeed.
  ShippedRun(const std::string& name, const Request& request, Observer* watcher = nullptr);
  /// The same for a scene that was changed: read_shipped(NAME) and something else in it.
  ShippedRun(const Scene& scene, const std::string& name, const Request& request, Observer* watcher = nullptr);
  ~ShippedRun();

  /// DIR/<picture>: the section with a field, at the frame nearest to a time; nothing without DIR.
  void draw(const std::string& field, double time, const std::string& picture) const;

  /// Where the files of the run are.
  const std::string& directory() const { return directory_; }

  nlohmann::json summary;
  double wall_time = 0;  ///< s

 private:
  std::string name_, pictures_, directory_;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace forming_sim::bench
